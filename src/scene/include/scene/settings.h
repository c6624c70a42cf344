// How a scene is to be rendered: what a file asks for and the command line overrides. A pass is a pure function of
// (world, settings, seed, i); everything in Settings shapes the pass except `film.filename`, the places, and `spp`, of which
// samples_per_pass() alone does.
#pragma once

#include "math/vec.h"
#include "scene/id.h"
#include "spectrum/wavelengths.h"

#include <array>
#include <optional>
#include <string>
#include <variant>

namespace nephroid {

// Pixel filters; radii in pixels, from the pixel's centre (pbrt-v4's defaults).
struct BoxFilter {
    Vec2 radius{0.5f, 0.5f};
};
struct TriangleFilter {
    Vec2 radius{2, 2};
};
struct GaussianFilter {
    Vec2 radius{1.5f, 1.5f};
    float sigma = 0.5f;
};
struct MitchellFilter {
    Vec2 radius{2, 2};
    float b = 1.0f / 3.0f, c = 1.0f / 3.0f;
};
struct LanczosSincFilter {
    Vec2 radius{4, 4};
    float tau = 3;
};
using Filter = std::variant<BoxFilter, TriangleFilter, GaussianFilter, MitchellFilter, LanczosSincFilter>;

// Samplers. None of them knows how many passes there will be.
/// Owen-scrambled Sobol' points, padded: each one- or two-dimensional draw has its own scramble.
struct SobolSampler {};
/// Blocks of x_strata * y_strata passes, each block stratified; jittered or at the cells' centres.
struct StratifiedSampler {
    int x_strata = 4, y_strata = 4;
    bool jitter = true;
};
struct IndependentSampler {};
using Sampler = std::variant<SobolSampler, StratifiedSampler, IndependentSampler>;

enum class RouletteKind : std::uint8_t {
    Throughput,  // survive with min(1, max throughput), from the second bounce on (pbrt-v4)
    Fixed,       // survive each bounce with probability `alpha` (the report's rule)
    None
};
struct Roulette {
    RouletteKind kind = RouletteKind::Throughput;
    float alpha = 0.5f;
};
enum class HemisphereSampling : std::uint8_t { Cosine, Uniform };

/// Which light is asked.
enum class LightChoice : std::uint8_t {
    Bvh,    // by what it may contribute at the receiver (Conty & Kulla 2018)
    Power,  // by its power
    Uniform
};
/// Where on an emitting shape a point is drawn.
enum class ShapeSampling : std::uint8_t {
    SolidAngle,   // uniform in what the receiver sees of it, where that can be done
    Area,         // uniform over the whole surface
    VisibleArea,  // box: the visible faces, chosen by area, uniform over each
    Projected,    // box: the visible faces, chosen by the area that they show to the receiver
    VisibleUnweighed  // box: one visible face is as likely as another, and the density says otherwise: biased, and kept to show it
};
struct LightSampling {
    LightChoice choice = LightChoice::Bvh;
    ShapeSampling shapes = ShapeSampling::SolidAngle;
};
/// What finds direct light.
enum class DirectStrategy : std::uint8_t { Mis, Light, Bsdf };

/// Unidirectional path tracing with next-event estimation and MIS.
struct PathIntegrator {
    int max_depth = 5;  // bounces; depth 0 sees emission only
    Roulette roulette;
    bool sample_lights = true;  // false: the naive tracer, light is found by chance alone
    bool sample_bsdf_mis =
        true;  // false: with sample_lights, emission hit by chance counts only where lights cannot be sampled
    HemisphereSampling hemisphere = HemisphereSampling::Cosine;
    LightSampling lights;
};
/// Whitted 1980: direct light at diffuse surfaces, both branches of a tree at specular ones.
struct WhittedIntegrator {
    int max_depth = 5;
    LightSampling lights;
};
/// Direct light alone, specular chains followed by chance.
struct DirectIntegrator {
    int max_depth = 5;
    DirectStrategy strategy = DirectStrategy::Mis;
    HemisphereSampling hemisphere = HemisphereSampling::Cosine;
    LightSampling lights;
};

/// How photons within a radius are weighed by their distance.
enum class Kernel : std::uint8_t { Box, Cone, Epanechnikov, Gaussian };
/// What the photon integrators show instead of the picture.
enum class PhotonView : std::uint8_t {
    None,
    Global,   // the estimate from the global map, at the first surface that is not specular
    Caustic,  // … from the caustic map
    Both,     // … their sum, in which the global map leaves caustics to the other
    Radiance  // the irradiance that was precomputed at photons, as it is looked up
};
/// What a pass shoots. Paths are counted as they are emitted, not as they are stored: the law, 1.4.
struct PhotonShooting {
    int global_paths = 100000;  // per pass, into the global map
    int caustic_paths = -1;     // per pass, into the caustic map; -1 = as many as global_paths
    int max_depth = 16;         // scatterings of a photon
    bool aim = true;            // caustic paths are sent towards what reflects or refracts
};
/// How maps are asked.
struct PhotonEstimates {
    int nused = 50;            // photons per estimate, at most; 0 = all within the radius
    float radius = 0;          // of the first pass; 0 = by the scene and the number of photons
    float caustic_radius = 0;  // … of the caustic map; 0 = `radius`, or automatic
    Kernel kernel = Kernel::Epanechnikov;
    bool edge_correction = false;  // where the surface does not fill the disk, divide by what it fills
};

/// Jensen's two maps (1996, 2001): direct light by sampling lights, specular chains by tracing, caustics from their map, the rest
/// by final gathering into the global map. A pass has many samples a pixel.
struct PhotonMapIntegrator {
    int max_depth = 16;  // specular bounces from the camera, and bounces of gather rays that go on as paths
    PhotonShooting shooting{.global_paths = 200000};
    PhotonEstimates estimates{.edge_correction = true};
    float alpha = 2.0f / 3.0f;  // how radii shrink from pass to pass (Knaus & Zwicker 2011)
    bool final_gather = true;
    int gather_samples = 16;
    int passes = 1;  // the samples of a pixel are shared out among so many
    PhotonView visualize = PhotonView::None;
    LightSampling lights;
};
/// Progressive photon mapping (Hachisuka et al. 2008; Knaus & Zwicker 2011): a sample of each pixel and new photons in each pass,
/// radii that shrink. Indirect light and caustics are read from the maps directly.
struct SppmIntegrator {
    int max_depth = 5;  // bounces of whole paths, as the path integrator counts them
    PhotonShooting shooting{.global_paths = -1};  // -1 = as many as pixels
    PhotonEstimates estimates{.nused = 0};
    float alpha = 2.0f / 3.0f;
    PhotonView visualize = PhotonView::None;
    LightSampling lights;
};
/// Light tracing: photon paths connected to the camera at every vertex.
struct LightPathIntegrator {
    int max_depth = 5;
    int paths = -1;  // per pass; -1 = as many as pixels
    LightSampling lights;
};
using Integrator = std::variant<PathIntegrator, WhittedIntegrator, DirectIntegrator, PhotonMapIntegrator,
                                SppmIntegrator, LightPathIntegrator>;

struct FilmSettings {
    Vec2i resolution{1280, 720};
    std::optional<std::array<int, 4>> crop;  // x0 x1 y0 y1 in pixels, half-open
    std::string filename;
    float iso = 100;
    float white_balance = 0;  // kelvin; 0 = none
    float max_component =
        kInfinity;  // a sample's largest component is scaled down to this (pbrt's maxcomponentvalue)
    bool half_float = true;
    bool aovs = false;  // record layers: the first hit, classes of light, photon estimates
    SourceLocation where;
};

struct Settings {
    Filter filter = GaussianFilter{};
    Sampler sampler;
    Integrator integrator;
    FilmSettings film;
    ColorMode color = ColorMode::Spectral;
    bool color_given = false;  // by the file or the command line: it no longer follows the integrator
    std::uint64_t seed = 0;
    int spp = 16;  // samples of a pixel that the scene asks for
    SourceLocation filter_where, sampler_where, integrator_where;
};

/// Where nobody said which colours are wanted. Few passes, which share their wavelengths, would have wrong ones in spectral mode: the
/// integrator that is made for few is in rgb.
inline ColorMode default_color(Integrator const& i) {
    return std::holds_alternative<PhotonMapIntegrator>(i) ? ColorMode::Rgb : ColorMode::Spectral;
}

/// Samples of a pixel in one pass. Part of what a pass is, unlike their number: hash() knows.
inline int samples_per_pass(Settings const& s) {
    auto const* p = std::get_if<PhotonMapIntegrator>(&s.integrator);
    return p ? (s.spp - 1) / p->passes + 1 : 1;
}
/// Passes that the settings ask for.
inline int wanted_passes(Settings const& s) {
    auto const* p = std::get_if<PhotonMapIntegrator>(&s.integrator);
    return p ? p->passes : s.spp;
}

}  // namespace nephroid
