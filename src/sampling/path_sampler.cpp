#include "sampling/path_sampler.h"

#include <algorithm>

namespace nephroid {

std::uint32_t permutation_element(std::uint32_t i, std::uint32_t n, std::uint32_t key) {
    // A bijection of 0..2^k-1, 2^k >= n, walked until it lands inside 0..n-1: cycle walking keeps it a bijection.
    std::uint32_t w = n - 1;
    w |= w >> 1;
    w |= w >> 2;
    w |= w >> 4;
    w |= w >> 8;
    w |= w >> 16;
    do {
        i ^= key;
        i *= 0xe170893du;
        i ^= key >> 16;
        i ^= (i & w) >> 4;
        i ^= key >> 8;
        i *= 0x0929eb3fu;
        i ^= key >> 23;
        i ^= (i & w) >> 1;
        i *= 1u | key >> 27;
        i *= 0x6935fa69u;
        i ^= (i & w) >> 11;
        i *= 0x74dcb303u;
        i ^= (i & w) >> 2;
        i *= 0x9e501cc3u;
        i ^= (i & w) >> 2;
        i *= 0xc860a3dfu;
        i &= w;
        i ^= i >> 5;
    } while (i >= n);
    return (i + key) % n;
}

// Pass i belongs to block i / n; within the block, a random permutation named by (draw, block) gives it its cell.
double PathSampler::stratified_1d_fine(std::uint64_t key) const {
    std::uint32_t const n = std::max(1u, sequence_->x_strata * sequence_->y_strata);
    std::uint64_t const block = hash_keys(key, index_ / n);
    std::uint32_t const cell = permutation_element(index_ % n, n, static_cast<std::uint32_t>(block));
    double const offset = sequence_->jitter ? to_unit_double(hash_keys(block, index_ % n)) : 0.5;
    return std::min((static_cast<double>(cell) + offset) / static_cast<double>(n), 1.0 - 0x1p-53);
}

Vec2 PathSampler::stratified_2d(std::uint64_t key) const {
    std::uint32_t const nx = std::max(1u, sequence_->x_strata);
    std::uint32_t const ny = std::max(1u, sequence_->y_strata);
    std::uint32_t const n = nx * ny;
    std::uint64_t const block = hash_keys(key, index_ / n);
    std::uint32_t const cell = permutation_element(index_ % n, n, static_cast<std::uint32_t>(block));
    Vec2 offset{0.5f, 0.5f};
    if (sequence_->jitter) {
        std::uint64_t const bits = hash_keys(block, index_ % n);
        offset = {to_unit_float(static_cast<std::uint32_t>(bits)),
                  to_unit_float(static_cast<std::uint32_t>(bits >> 32))};
    }
    std::uint32_t const column = cell % nx;
    std::uint32_t const row = cell / nx;
    return {std::min((static_cast<float>(column) + offset.x) / static_cast<float>(nx), kOneMinusEpsilon),
            std::min((static_cast<float>(row) + offset.y) / static_cast<float>(ny), kOneMinusEpsilon)};
}

float PathSampler::other_1d(std::uint64_t key) const {
    if (sequence_->kind == SequenceKind::Independent) return to_unit_float(static_cast<std::uint32_t>(key));
    return std::min(static_cast<float>(stratified_1d_fine(key)), kOneMinusEpsilon);
}

Vec2 PathSampler::other_2d(std::uint64_t key) const {
    if (sequence_->kind == SequenceKind::Stratified) return stratified_2d(key);
    return {to_unit_float(static_cast<std::uint32_t>(key)),
            to_unit_float(static_cast<std::uint32_t>(key >> 32))};
}

double PathSampler::other_1d_fine(std::uint64_t key) const {
    return sequence_->kind == SequenceKind::Independent ? to_unit_double(key) : stratified_1d_fine(key);
}

}  // namespace nephroid
