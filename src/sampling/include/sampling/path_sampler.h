// The numbers of one path: a pure function of (seed, stream, pixel or path, pass, dimension).
//
// Draws are named by dimension, not counted by state: `at(d)` moves the cursor, so that a bounce reads the same dimensions
// whatever the bounces before it consumed. `stream` keeps different uses of a pass apart (camera paths, photons, …).
#pragma once

#include "math/vec.h"
#include "sampling/hash.h"
#include "sampling/sobol.h"

#include <cstdint>
#include <span>

namespace nephroid {

enum class SequenceKind : std::uint8_t { Sobol, Stratified, Independent };

/// Which points a render uses; see scene/settings.h for what they mean.
struct Sequence {
    SequenceKind kind = SequenceKind::Sobol;
    std::uint64_t seed = 0;
    std::uint32_t x_strata = 4, y_strata = 4;
    bool jitter = true;
};

class PathSampler {
  public:
    /// To be assigned to.
    PathSampler() = default;
    /// `path` names the pixel (or the photon path) within the picture, `pass` the sample of that pixel.
    PathSampler(Sequence const& sequence, std::uint64_t stream, std::uint64_t path, std::uint64_t pass)
        : sequence_(&sequence),
          key_(hash_keys(sequence.seed ^ (stream << 56), path)),
          index_(static_cast<std::uint32_t>(pass)),
          sobol_(index_) {
        // Beyond 2^32 passes the sequence starts anew under another scramble.
        if (pass >> 32) key_ = hash_keys(key_, pass >> 32);
        if (sequence.kind == SequenceKind::Independent) key_ = hash_keys(key_, pass);
    }

    /// Where a path splits into n: the numbers of branch s. The branches of all passes are one sequence, whose every n points in a
    /// row are well spread.
    [[nodiscard]] PathSampler branch(std::uint32_t s, std::uint32_t n) const {
        std::uint64_t const index = std::uint64_t{index_} * n + s;
        PathSampler b = *this;
        b.key_ = hash_keys(key_, 0x6272616e6368ull + (index >> 32));
        b.index_ = static_cast<std::uint32_t>(index);
        b.sobol_ = SobolIndex(b.index_);
        if (sequence_->kind == SequenceKind::Independent) b.key_ = hash_keys(b.key_, index);
        return b;
    }

    void at(std::uint32_t dimension) { dimension_ = dimension; }
    [[nodiscard]] std::uint32_t dimension() const { return dimension_; }

    float next_1d() {
        std::uint64_t const key = next_key();
        if (sequence_->kind == SequenceKind::Sobol) [[likely]]
            return sobol_1d(sobol_, key);
        return other_1d(key);
    }
    Vec2 next_2d() {
        std::uint64_t const key = next_key();
        if (sequence_->kind == SequenceKind::Sobol) [[likely]]
            return sobol_2d(sobol_, key);
        return other_2d(key);
    }

    /// A draw of 53 bits, for choosing among many: as well spread as next_1d(), with random bits below the first 32.
    double next_1d_fine() {
        std::uint64_t const key = next_key();
        if (sequence_->kind != SequenceKind::Sobol) return other_1d_fine(key);
        std::uint64_t const low = mix64(key ^ (index_ + 0x9e3779b97f4a7c15ull)) >> 32;
        return to_unit_double(static_cast<std::uint64_t>(sobol_1d_bits(sobol_, key)) << 32 | low);
    }

    friend class ManyDraws;  // draw_1d, draw_2d of many

  private:
    std::uint64_t next_key() { return mix64(key_ + 0x9e3779b97f4a7c15ull * ++dimension_); }
    // The sequences that are not Sobol's are not inlined where numbers are drawn.
    [[nodiscard]] float other_1d(std::uint64_t key) const;
    [[nodiscard]] Vec2 other_2d(std::uint64_t key) const;
    [[nodiscard]] double other_1d_fine(std::uint64_t key) const;
    [[nodiscard]] double stratified_1d_fine(std::uint64_t key) const;
    [[nodiscard]] Vec2 stratified_2d(std::uint64_t key) const;

    Sequence const* sequence_ = nullptr;
    std::uint64_t key_ = 0;
    std::uint32_t index_ = 0;
    SobolIndex sobol_;  // index_, as Sobol' points want it
    std::uint32_t dimension_ = 0;
};

/// The same draw of many paths of one sequence: out[i] is what paths[i]->at(dimension), next_2d() gives, for half of the instructions.
void draw_2d(std::span<PathSampler* const> paths, std::uint32_t dimension, Vec2* out);
/// … and what next_1d() gives.
void draw_1d(std::span<PathSampler* const> paths, std::uint32_t dimension, float* out);

/// Element i of a random permutation of 0..n-1 named by `key` (Kensler 2013, "Correlated Multi-Jittered Sampling").
std::uint32_t permutation_element(std::uint32_t i, std::uint32_t n, std::uint32_t key);

}  // namespace nephroid
