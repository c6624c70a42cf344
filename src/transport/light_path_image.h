// What the light paths of a pass drew: light that arrived at each pixel (light_path.cpp).
//
// Splats are added to a pixel in the order of their paths, in double, whichever threads made them and when: a picture is the same to
// the bit on any number of threads (docs/decisions/0009-splats.md).
#pragma once

#include "transport/pass_work.h"
#include "transport/render_pass.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nephroid {

/// Light that one path brings to one pixel, by one of its vertices.
struct Splat {
    std::uint32_t pixel = 0;  // by LightPathImage::index(); the class of the path in the upper four bits
    Vec3 rgb{0, 0, 0};        // sensor value

    static constexpr int kPixelBits = 28;  // films have no more pixels (film.cpp)
    [[nodiscard]] std::uint32_t where() const { return pixel & ((1u << kPixelBits) - 1); }
    [[nodiscard]] std::uint32_t light_class() const { return pixel >> kPixelBits; }
};
static_assert(sizeof(Splat) == 16);

/// Splats of some paths in their order, sorted by the share of the picture that they fall on. A share is every 64th run of 64
/// pixels: a caustic lies in many of them.
class SplatChunk {
  public:
    static constexpr std::size_t kShares = 64;
    static std::size_t share_of(Splat const& s) { return s.where() / 64 % kShares; }

    void clear() { splats_.clear(); }
    void add(Splat const& s) { splats_.push_back(s); }
    /// Once all are in.
    void sort();
    [[nodiscard]] std::span<Splat const> share(std::size_t i) const {
        return std::span(sorted_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }

  private:
    std::vector<Splat> splats_, sorted_;
    std::array<std::uint32_t, kShares + 1> begin_{};
};

class LightPathImage {
  public:
    LightPathImage() = default;
    /// Black. `by_class`: the classes of light are kept apart, too.
    LightPathImage(std::array<int, 4> crop, bool by_class);

    /// Sensor values of pixel (x, y) of the whole picture.
    [[nodiscard]] Vec3 total(int x, int y) const { return vec(total_[index(x, y)]); }
    /// By class of path; black where they were not kept.
    [[nodiscard]] std::array<Vec3, kLightClasses> at(int x, int y) const;
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] bool holds(Vec2i p) const {
        return p.x >= crop_[0] && p.x < crop_[1] && p.y >= crop_[2] && p.y < crop_[3];
    }
    [[nodiscard]] std::uint32_t index(int x, int y) const {
        return static_cast<std::uint32_t>(y - crop_[2]) * static_cast<std::uint32_t>(crop_[1] - crop_[0]) +
               static_cast<std::uint32_t>(x - crop_[0]);
    }
    /// Adds the splats of chunks in their order, the shares at the same time.
    void add(std::span<SplatChunk const> chunks);

  private:
    using Rgb = std::array<double, 3>;
    static Vec3 vec(Rgb const& v) {
        return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    }

    std::array<int, 4> crop_{};
    std::vector<Rgb> total_;
    std::vector<std::array<Rgb, kLightClasses>> by_class_;
};

/// The picture of pass i. Nothing when `control` stopped it.
std::optional<LightPathImage> draw_light_paths(RenderJob const& job, std::uint64_t pass,
                                               PrepareControl const& control, RayStats& stats);

}  // namespace nephroid
