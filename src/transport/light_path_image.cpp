#include "light_path_image.h"

#include <tbb/parallel_for.h>

namespace nephroid {

void SplatChunk::sort() {
    // By counting, and stable: within a share the order of the paths remains.
    begin_.fill(0);
    for (Splat const& s : splats_) ++begin_[share_of(s) + 1];
    for (std::size_t i = 0; i < kShares; ++i) begin_[i + 1] += begin_[i];
    sorted_.resize(splats_.size());
    std::array<std::uint32_t, kShares + 1> next = begin_;
    for (Splat const& s : splats_) sorted_[next[share_of(s)]++] = s;
}

LightPathImage::LightPathImage(std::array<int, 4> crop, bool by_class) : crop_(crop) {
    auto const pixels =
        static_cast<std::size_t>(crop[1] - crop[0]) * static_cast<std::size_t>(crop[3] - crop[2]);
    total_.resize(pixels);
    if (by_class) by_class_.resize(pixels);
}

std::array<Vec3, kLightClasses> LightPathImage::at(int x, int y) const {
    std::array<Vec3, kLightClasses> classes{};
    if (by_class_.empty()) return classes;
    for (std::size_t i = 0; i < classes.size(); ++i) classes[i] = vec(by_class_[index(x, y)][i]);
    return classes;
}

std::size_t LightPathImage::bytes() const {
    return total_.size() * sizeof(total_[0]) + by_class_.size() * sizeof(by_class_[0]);
}

void LightPathImage::add(std::span<SplatChunk const> chunks) {
    tbb::parallel_for(std::size_t{0}, SplatChunk::kShares, [&](std::size_t share) {
        for (SplatChunk const& chunk : chunks)
            for (Splat const& s : chunk.share(share))
                for (std::size_t c = 0; c < 3; ++c) {
                    double const v = static_cast<double>(s.rgb[static_cast<int>(c)]);
                    total_[s.where()][c] += v;
                    if (!by_class_.empty()) by_class_[s.where()][s.light_class()][c] += v;
                }
    });
}

}  // namespace nephroid
