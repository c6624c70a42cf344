// Textures: an image and its smaller copies, filtered in linear light. (s, t) covers the image once in [0,1]^2, (0,0) is
// the upper left corner of the first row: who means v upwards flips it before. Filters and level choice follow pbrt-v4's
// MIPMap, so that scenes written for it look the same. Lookups never throw; a non-finite coordinate reads texel (0,0).
#pragma once

#include "image/image.h"

#include <cstddef>
#include <vector>

namespace nephroid {

/// OctahedralSphere: the image is an equal-area octahedral map of directions (Clarberg 2008); its edges fold onto
/// themselves.
enum class Wrap { Repeat, Black, Clamp, OctahedralSphere };
enum class TextureFilter { Point, Bilinear, Trilinear, Ewa };

inline constexpr float kMaxAnisotropy = 8.0f;  // pbrt-v4's

class Pyramid {
  public:
    Pyramid() = default;
    /// Level 0 is `image`. Each next level halves the sides, rounding down: a texel is the exact area average of those it
    /// covers, also for odd sides, so each level has the mean of the image. Format and encoding are kept.
    explicit Pyramid(Image image);

    [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
    [[nodiscard]] Image const& level(int i) const { return levels_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] int channels() const { return levels_.empty() ? 0 : levels_[0].channels(); }
    [[nodiscard]] std::size_t bytes() const;

    /// Channel c at texel (x, y) of a level; coordinates outside are wrapped.
    [[nodiscard]] float texel(int level, int x, int y, int c, Wrap wrap = Wrap::Repeat) const;
    [[nodiscard]] float bilerp(int level, Vec2 st, int c, Wrap wrap = Wrap::Repeat) const;
    /// R, G, B by their names, or the first three channels; gray images give gray.
    [[nodiscard]] Vec3 bilerp_rgb(int level, Vec2 st, Wrap wrap = Wrap::Repeat) const;

    /// The same of one texel, which must lie inside.
    [[nodiscard]] Vec3 texel_rgb(int level_index, int x, int y) const {
        Image const& image = level(level_index);
        return {image.get(x, y, rgb_[0]), image.get(x, y, rgb_[1]), image.get(x, y, rgb_[2])};
    }

    /// dst0 and dst1 are the derivatives of (s, t) along the two axes of the pixel's footprint. Of Ewa, a footprint longer
    /// than max_anisotropy (1 to 64) times its width is widened: that is what bounds its cost.
    [[nodiscard]] Vec3 lookup_rgb(Vec2 st, TextureFilter filter, Wrap wrap, Vec2 dst0, Vec2 dst1,
                                  float max_anisotropy = kMaxAnisotropy) const;
    /// One number, as pbrt-v4 takes it: a gray image's value, the average of RGB, or alpha where there is one below 1.
    [[nodiscard]] float lookup(Vec2 st, TextureFilter filter, Wrap wrap, Vec2 dst0, Vec2 dst1,
                               float max_anisotropy = kMaxAnisotropy) const;

  private:
    std::vector<Image> levels_;
    int rgb_[3] = {0, 0, 0};
    int scalar_ = 0;  // the channel of lookup(), or -1 for the average of RGB
};

/// Moves (x, y) inside; false where Wrap::Black reads black.
bool wrap_texel(Wrap wrap, int width, int height, int& x, int& y);

}  // namespace nephroid
