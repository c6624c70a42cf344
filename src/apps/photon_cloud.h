// Photons to look at: those of one pass, one after the other, with the colours in which files and pictures show them.
#pragma once

#include "transport/shooting.h"

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::cli {

/// The scene's own photons; where its integrator shoots none into maps, those that photonmap would shoot.
Settings photon_settings(Settings const& settings);

/// Which maps are looked at.
enum class ShownMap : std::uint8_t { Global, Caustic, Both };
/// "global", "caustic" or "both".
ShownMap shown_map(std::string const& name);
std::vector<ShotKind> shots_of(ShownMap map);

/// Linear sRGB of a photon's power, W. Of four wavelengths alone it may lie outside of what sRGB can show, and be negative there.
Vec3 power_rgb(PhotonRecord const& photon, Wavelengths const& lambda);

/// How bright photons are drawn: their hue as bright as it can be, dimmed by how much less power they have than most.
class PhotonColors {
  public:
    /// `typical`: the largest component of the power of a photon in the middle of all.
    explicit PhotonColors(float typical) : typical_(typical) {}
    /// Linear sRGB in [0, 1].
    [[nodiscard]] Vec3 operator()(Vec3 power) const;

  private:
    float typical_;
};
/// The middle one of the numbers; 0 of none.
float median_of(std::vector<float> numbers);

/// What a segment of a path is: light that nothing has scattered, that mirrors and glass alone have, or that a surface has
/// scattered that is neither.
enum class PathSegment : std::uint8_t { Direct, Caustic, Indirect };
PathSegment segment_of(TracedPath const& path, std::size_t first_vertex);

}  // namespace nephroid::cli
