// Draws of many paths at once: the arithmetic of sobol.h and hash.h eight paths a vector. No tables: a vector would gather from them one by one.
#include "math/lanes.h"
#include "sampling/path_sampler.h"

#include <algorithm>

namespace nephroid {

namespace {

typedef std::uint32_t Bits __attribute__((vector_size(32)));
typedef std::int32_t Ints __attribute__((vector_size(32)));
typedef float Floats __attribute__((vector_size(32)));

Bits reverse_bits(Bits x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return x >> 16 | x << 16;
}

/// reverse_bits(sobol_second(i)): Pascal's triangle mod 2 is a Kronecker power, a factor for each bit of a bit's number.
Bits sobol_second_reversed(Bits i) {
    i ^= (i >> 1) & 0x55555555u;
    i ^= (i >> 2) & 0x33333333u;
    i ^= (i >> 4) & 0x0f0f0f0fu;
    i ^= (i >> 8) & 0x00ff00ffu;
    return i ^ i >> 16;
}

Floats to_unit_float(Bits x) {
    // As signed numbers, which 24 bits are as well: vectors convert no others.
    return __builtin_convertvector(reinterpret_cast<Ints>(x >> 8), Floats) * 0x1p-24f;
}

}  // namespace

/// What draws of the same dimension have in common.
class ManyDraws {
  public:
    /// several(where the first lane's number goes, the shuffled indices, the scrambles), or alone(sampler, where): what is too little for
    /// a vector, or of another sequence.
    template <class Several, class Alone>
    static void draw(std::span<PathSampler* const> paths, std::uint32_t dimension, Several several,
                     Alone alone) {
        for (std::size_t first = 0; first < paths.size(); first += kLanes) {
            std::size_t const n = std::min(kLanes, paths.size() - first);
            if (paths[first]->sequence_->kind != SequenceKind::Sobol || n < 3) {
                for (std::size_t i = first; i < first + n; ++i) {
                    paths[i]->at(dimension);
                    alone(*paths[i], i);
                }
                continue;
            }
            Bits begun{}, shuffle{}, scramble{};
            for (std::size_t i = 0; i < n; ++i) {
                PathSampler& s = *paths[first + i];
                s.at(dimension);
                std::uint64_t const key = s.next_key();
                begun[i] = s.sobol_.begun();
                shuffle[i] = static_cast<std::uint32_t>(key);
                scramble[i] = static_cast<std::uint32_t>(key >> 32);
            }
            several(first, n, reverse_bits(owen_scramble_end(begun, shuffle)), scramble);
        }
    }
};

void draw_2d(std::span<PathSampler* const> paths, std::uint32_t dimension, Vec2* out) {
    ManyDraws::draw(
        paths, dimension,
        [&](std::size_t first, std::size_t n, Bits index, Bits scramble) {
            Bits const a = owen_scramble_reversed(index, scramble);
            Bits const b = owen_scramble_reversed(sobol_second_reversed(index), mix32(scramble));
            Floats const x = to_unit_float(reverse_bits(a));
            Floats const y = to_unit_float(reverse_bits(b));
            for (std::size_t i = 0; i < n; ++i) out[first + i] = {x[i], y[i]};
        },
        [&](PathSampler& s, std::size_t i) { out[i] = s.next_2d(); });
}

void draw_1d(std::span<PathSampler* const> paths, std::uint32_t dimension, float* out) {
    ManyDraws::draw(
        paths, dimension,
        [&](std::size_t first, std::size_t n, Bits index, Bits scramble) {
            Floats const x = to_unit_float(reverse_bits(owen_scramble_reversed(index, scramble)));
            for (std::size_t i = 0; i < n; ++i) out[first + i] = x[i];
        },
        [&](PathSampler& s, std::size_t i) { out[i] = s.next_1d(); });
}

}  // namespace nephroid
