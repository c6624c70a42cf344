#include "model/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace nephroid {

namespace {

/// The permutation of 0 … 255 from Perlin's reference implementation of 2002 (mrl.cs.nyu.edu/~perlin/noise), which pbrt
/// has too: the same scene shows the same pattern.
// clang-format off
constexpr std::array<std::uint8_t, 256> kPermutation{
    151, 160, 137,  91,  90,  15, 131,  13, 201,  95,  96,  53, 194, 233,   7, 225, 140,  36, 103,  30,  69, 142,   8,  99,
     37, 240,  21,  10,  23, 190,   6, 148, 247, 120, 234,  75,   0,  26, 197,  62,  94, 252, 219, 203, 117,  35,  11,  32,
     57, 177,  33,  88, 237, 149,  56,  87, 174,  20, 125, 136, 171, 168,  68, 175,  74, 165,  71, 134, 139,  48,  27, 166,
     77, 146, 158, 231,  83, 111, 229, 122,  60, 211, 133, 230, 220, 105,  92,  41,  55,  46, 245,  40, 244, 102, 143,  54,
     65,  25,  63, 161,   1, 216,  80,  73, 209,  76, 132, 187, 208,  89,  18, 169, 200, 196, 135, 130, 116, 188, 159,  86,
    164, 100, 109, 198, 173, 186,   3,  64,  52, 217, 226, 250, 124, 123,   5, 202,  38, 147, 118, 126, 255,  82,  85, 212,
    207, 206,  59, 227,  47,  16,  58,  17, 182, 189,  28,  42, 223, 183, 170, 213, 119, 248, 152,   2,  44, 154, 163,  70,
    221, 153, 101, 155, 167,  43, 172,   9, 129,  22,  39, 253,  19,  98, 108, 110,  79, 113, 224, 232, 178, 185, 112, 104,
    218, 246,  97, 228, 251,  34, 242, 193, 238, 210, 144,  12, 191, 179, 162, 241,  81,  51, 145, 235, 249,  14, 239, 107,
     49, 192, 214,  31, 181, 199, 106, 157, 184,  84, 204, 176, 115, 121,  50,  45, 127,   4, 150, 254, 138, 236, 205,  93,
    222, 114,  67,  29,  24,  72, 243, 141, 128, 195,  78,  66, 215,  61, 156, 180};
// clang-format on

std::uint8_t permuted(int i) { return kPermutation[static_cast<std::size_t>(i & 255)]; }

/// The gradient of a lattice point by the last four bits of its hash: one of the 12 directions to the middles of a cube's
/// edges, four of them twice to make 16. Which four is pbrt's choice; Perlin has two of them in the other order.
constexpr std::array<std::array<float, 3>, 16> kGradients{{{1, 1, 0},
                                                           {-1, 1, 0},
                                                           {1, -1, 0},
                                                           {-1, -1, 0},
                                                           {1, 0, 1},
                                                           {-1, 0, 1},
                                                           {1, 0, -1},
                                                           {-1, 0, -1},
                                                           {0, 1, 1},
                                                           {0, -1, 1},
                                                           {0, 1, -1},
                                                           {0, -1, -1},
                                                           {1, 1, 0},
                                                           {-1, 1, 0},
                                                           {0, 1, -1},
                                                           {0, -1, -1}}};

/// 6 t^5 - 15 t^4 + 10 t^3: first and second derivatives are 0 at both ends, so that cells join smoothly.
float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

float smooth_step(float x, float from, float to) {
    float const t = clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

constexpr float kLacunarity = 1.99f;     // not quite 2: the zeros of the octaves should not coincide
constexpr float kMeanOfAbsolute = 0.2f;  // of |noise|, about

/// How many octaves are coarse enough for the footprint: the finest has half of it as its period.
float octaves_shown(Octaves const& o) {
    float const squared = max(length_squared(o.dpdx), length_squared(o.dpdy));
    auto const all = static_cast<float>(o.count);
    return squared > 0.0f ? clamp(-1.0f - 0.5f * std::log2(squared), 0.0f, all) : all;
}

/// The sum over octaves of shape(noise), the last one shown in part.
template <class Shape>
float sum_of_octaves(Octaves const& o, float shown, float hidden_mean, Shape shape) {
    int const whole = static_cast<int>(shown);
    float sum = 0.0f, frequency = 1.0f, height = 1.0f;
    for (int i = 0; i < whole; ++i) {
        sum += height * shape(perlin_noise(frequency * o.p));
        frequency *= kLacunarity;
        height *= o.roughness;
    }
    float const part = smooth_step(shown - static_cast<float>(whole), 0.3f, 0.7f);
    sum +=
        height * (part > 0.0f ? lerp(part, hidden_mean, shape(perlin_noise(frequency * o.p))) : hidden_mean);
    if (hidden_mean == 0.0f) return sum;
    for (int i = whole; i < o.count; ++i) {
        sum += height * hidden_mean;
        height *= o.roughness;
    }
    return sum;
}

}  // namespace

float perlin_noise(Vec3 p) {
    if (!is_finite(p)) return 0.0f;
    // A period of the pattern, and whole numbers that fit an int.
    constexpr float kFar = 1 << 30;
    for (int i = 0; i < 3; ++i)
        if (std::abs(p[i]) >= kFar) p[i] = std::fmod(p[i], kFar);
    Vec3 const cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    int const x = static_cast<int>(cell.x), y = static_cast<int>(cell.y), z = static_cast<int>(cell.z);
    Vec3 const d = p - cell;
    float const u = fade(d.x), v = fade(d.y), w = fade(d.z);
    // A lattice point's hash is p[p[p[x] + y] + z]: what neighbours share is looked up once.
    std::array<int, 2> const by_x{permuted(x), permuted(x + 1)};
    auto const row = [&](int dy, int dz) {
        std::array<float, 2> plane{};
        for (std::size_t i = 0; i < 2; ++i) {
            auto const& g = kGradients[permuted(permuted(by_x[i] + y + dy) + z + dz) & 15];
            plane[i] = g[0] * (d.x - static_cast<float>(i)) + g[1] * (d.y - static_cast<float>(dy)) +
                       g[2] * (d.z - static_cast<float>(dz));
        }
        return lerp(u, plane[0], plane[1]);
    };
    return lerp(w, lerp(v, row(0, 0), row(1, 0)), lerp(v, row(0, 1), row(1, 1)));
}

float fbm(Octaves const& o) {
    return sum_of_octaves(o, octaves_shown(o), 0.0f, [](float noise) { return noise; });
}

float turbulence(Octaves const& o) {
    return sum_of_octaves(o, octaves_shown(o), kMeanOfAbsolute, [](float noise) { return std::abs(noise); });
}

}  // namespace nephroid
