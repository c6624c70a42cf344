// The film: a commutative monoid of passes. Each pixel keeps weighted sums in double; which passes are in them is part of
// the film. Films grow by merge() and by nothing else, so a render may be split, permuted, resumed or distributed.
#pragma once

#include "film/pass_set.h"
#include "math/vec.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nephroid {

/// The light of a picture by its ways from the light to the eye: direct, caustic, indirect, specular, in the order of
/// transport/light_class.h. Which way is whose is decided there; here they are four parts of a sum.
inline constexpr std::size_t kLightClasses = 4;

/// What a camera sample knows besides its value: what its first hit looked like, what light came which way, and what photon
/// estimate it asked for. Averaged, except for the material's id.
struct AovSample {
    Vec3 albedo{0, 0, 0};
    Vec3 shading_normal{0, 0, 0};
    Vec3 geometric_normal{0, 0, 0};
    Vec3 position{0, 0, 0};
    float depth = 0;  // along the ray from the camera, scene units; 0 where nothing was hit
    bool hit = false;
    std::uint32_t material = 0xFFFFFFFFu;
    std::array<Vec3, kLightClasses> light{};  // linear sRGB; together the sample's value
    // The photon estimates at the first surface that asked for any.
    bool estimated = false;
    float radius = 0;   // scene units
    float photons = 0;  // that counted
};

/// Sums over the samples of one pixel, each of value v and filter weight w.
struct PixelSums {
    std::array<double, 3> rgb{};     // sum of w v, linear sRGB
    double weight = 0;               // sum of w
    std::array<double, 3> square{};  // sum of (w v)^2  \.
    std::array<double, 3> cross{};   // sum of w^2 v     } for the variance, see develop_variance()
    double weight_square = 0;        // sum of w^2      /
    std::uint64_t samples = 0;
};
/// Colours and normals are averaged like the beauty: over all samples, those that hit nothing count as 0. Positions and
/// depths are averaged over the samples that hit something, by |w|: a place between a surface and nothing is no place,
/// and negative weights would leave the surface. So are radii and numbers of photons, over the samples that had an estimate.
struct AovSums {
    std::array<double, 3> albedo{}, shading_normal{}, geometric_normal{};  // sums of w a
    std::array<double, 3> position{};                                      // sum of |w| p over hits
    double depth = 0;                                                      // sum of |w| z over hits
    double hits = 0;                                                       // sum of |w| over hits
    std::array<std::array<double, 3>, kLightClasses> light{};              // sums of w v
    double radius = 0, photons = 0;       // sums of |w| r and |w| n over estimates
    double estimates = 0;                 // sum of |w| over estimates
    std::uint64_t material_pass = ~0ull;  // the earliest pass that hit something …
    std::uint32_t material = 0xFFFFFFFFu;  // … and the material it saw: commutative, unlike "the first added"
};

/// Which render a film belongs to. Films with different identities do not merge.
struct FilmIdentity {
    std::string scene_hash, settings_hash;
    std::uint64_t seed = 0;
    bool operator==(FilmIdentity const&) const = default;
};
/// Settings by the option that sets them ("--color" -> "rgb"): the hash says that two differ, these say how.
using SettingWords = std::map<std::string, std::string>;

/// All of a film but its sums.
struct FilmHeader {
    FilmIdentity identity;
    Vec2i resolution{0, 0};
    std::array<int, 4> crop{0, 0, 0, 0};
    bool aovs = false;
    PassSet passes;
    std::uint64_t dropped = 0, rejected = 0;
    SettingWords words;
};
/// How the renders of two films differ, in words; empty when they are the same. Passes do not count.
std::string difference(FilmHeader const& a, FilmHeader const& b);
/// Memory of a film of so many pixels.
std::uint64_t film_bytes(std::uint64_t pixels, bool with_aovs);

class Film {
  public:
    Film() = default;
    /// A picture of `resolution` of which only the pixels [x0, x1) × [y0, y1) of `crop` are kept.
    /// Throws Error(Input) when the crop window is empty or leaves the picture, Error(Limit) beyond 2^28 pixels.
    Film(Vec2i resolution, std::array<int, 4> crop, bool with_aovs, FilmIdentity identity);

    [[nodiscard]] Vec2i resolution() const { return resolution_; }
    [[nodiscard]] std::array<int, 4> crop() const { return crop_; }
    [[nodiscard]] int width() const { return crop_[1] - crop_[0]; }
    [[nodiscard]] int height() const { return crop_[3] - crop_[2]; }
    [[nodiscard]] bool has_aovs() const { return !aovs_.empty(); }
    [[nodiscard]] FilmIdentity const& identity() const { return identity_; }
    [[nodiscard]] PassSet const& passes() const { return passes_; }
    /// Samples that were not finite and count as black.
    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
    /// Rays that were not finite and were not traced: something is missing in the sums.
    [[nodiscard]] std::uint64_t rejected() const { return rejected_; }
    [[nodiscard]] bool tainted() const { return dropped_ > 0 || rejected_ > 0; }
    [[nodiscard]] FilmHeader header() const;
    void describe(SettingWords words) { words_ = std::move(words); }
    [[nodiscard]] std::size_t bytes() const;

    /// Adds one camera sample to pixel (x, y) of the whole picture. A sample that is not finite is dropped: it counts with
    /// its weight as black (not at all if the weight is not finite), and false comes back so that the caller can tell
    /// add_dropped(). Threads may add at the same time to different pixels.
    bool add(int x, int y, Vec3 rgb, float weight);
    /// A sample that is not finite leaves the layers as they are.
    void add_aov(int x, int y, std::uint64_t pass, AovSample const& sample, float weight);
    void add_dropped(std::uint64_t n) { dropped_ += n; }
    void add_rejected(std::uint64_t n) { rejected_ += n; }
    /// Declares that pass i is complete in the sums.
    void finish_pass(std::uint64_t i) { passes_.insert(i); }

    [[nodiscard]] PixelSums const& pixel(int x, int y) const { return pixels_[index(x, y)]; }
    PixelSums& pixel(int x, int y) { return pixels_[index(x, y)]; }
    [[nodiscard]] AovSums const& aov(int x, int y) const { return aovs_[index(x, y)]; }
    AovSums& aov(int x, int y) { return aovs_[index(x, y)]; }

    friend void merge_into(Film& a, Film const& b);
    friend class FilmFile;

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - crop_[2]) * static_cast<std::size_t>(width()) +
               static_cast<std::size_t>(x - crop_[0]);
    }

    Vec2i resolution_{0, 0};
    std::array<int, 4> crop_{0, 0, 0, 0};
    FilmIdentity identity_;
    PassSet passes_;
    std::uint64_t dropped_ = 0, rejected_ = 0;
    SettingWords words_;
    std::vector<PixelSums> pixels_;
    std::vector<AovSums> aovs_;
};

inline bool Film::add(int x, int y, Vec3 rgb, float weight) {
    if (!std::isfinite(weight)) return false;
    // Floats squared fit a double by far, so that sums of finite samples stay finite.
    PixelSums& sums = pixel(x, y);
    double const w = static_cast<double>(weight);
    sums.weight += w;
    sums.weight_square += w * w;
    ++sums.samples;
    if (!is_finite(rgb)) return false;
    for (std::size_t c = 0; c < 3; ++c) {
        double const wv = w * static_cast<double>(rgb[static_cast<int>(c)]);
        sums.rgb[c] += wv;
        sums.square[c] += wv * wv;
        sums.cross[c] += w * wv;
    }
    return true;
}

/// a += b. Throws Error(Input) when the films belong to different renders or share a pass. A film without pixels,
/// Film{}, is neutral.
void merge_into(Film& a, Film const& b);
Film merge(Film a, Film const& b);

}  // namespace nephroid
