// How a scene is to be rendered: what a file asks for and the command line overrides. A pass is a pure function of
// (world, settings, seed, i); everything in Settings except `spp`, `film.filename` and the places shapes the pass.
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
using Integrator = std::variant<PathIntegrator, WhittedIntegrator, DirectIntegrator>;

struct FilmSettings {
    Vec2i resolution{1280, 720};
    std::optional<std::array<int, 4>> crop;  // x0 x1 y0 y1 in pixels, half-open
    std::string filename;
    float iso = 100;
    float white_balance = 0;  // kelvin; 0 = none
    float max_component =
        kInfinity;  // a sample's largest component is scaled down to this (pbrt's maxcomponentvalue)
    bool half_float = true;
    bool aovs = false;  // record the layers of the first hit
    SourceLocation where;
};

struct Settings {
    Filter filter = GaussianFilter{};
    Sampler sampler;
    Integrator integrator;
    FilmSettings film;
    ColorMode color = ColorMode::Spectral;
    std::uint64_t seed = 0;
    int spp = 16;  // passes that the scene asks for
    SourceLocation filter_where, sampler_where, integrator_where;
};

}  // namespace nephroid
