// Scenes, renders and comparisons for the tests of the law.
#pragma once

#include "film/film.h"
#include "read/read.h"
#include "render/render.h"
#include "world/world.h"

#include <cmath>
#include <cstring>
#include <string>

namespace nephroid::test {

/// Walls, glass, metal, a mesh, instances, and lights of every kind.
inline char const* const kRoom = R"(
LookAt 0 1 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 50 "float lensradius" 0.02 "float focaldistance" 5
Film "rgb" "integer xresolution" 37 "integer yresolution" 21
PixelFilter "mitchell"
WorldBegin
LightSource "point" "point3 from" [ -2 3 -2 ] "float scale" 10
LightSource "infinite" "float scale" 0.2
MakeNamedMaterial "grey" "string type" "diffuse" "rgb reflectance" [ .6 .6 .5 ]
MakeNamedMaterial "glass" "string type" "dielectric" "spectrum eta" "glass-BK7"
NamedMaterial "grey"
Shape "bilinearmesh" "point3 P" [ -4 -1 -4  4 -1 -4  -4 -1 4  4 -1 4 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 8 7 6 ]
  Translate 0 3 0
  Shape "disk" "float radius" 0.7
  Rotate 90 1 0 0
  Shape "trianglemesh" "point3 P" [ -1 -1 0  1 -1 0  0 1 0 ] "integer indices" [ 0 1 2 ]
AttributeEnd
ObjectBegin "pair"
  NamedMaterial "glass"
  Shape "sphere" "float radius" 0.6
  Translate 1.3 0 0
  Material "conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" "metal-Cu-k"
  Shape "sphere" "float radius" 0.5
ObjectEnd
Translate -1 -0.3 0
ObjectInstance "pair"
Translate 0.4 0.1 -1
Scale 0.4 0.4 0.4
ObjectInstance "pair"
)";

/// Little light that is hard to find: heavy tails, much of it by chance, negative filter lobes.
inline char const* const kCup = R"(
Camera "orthographic" "float screenwindow" [ -2 2 -2 2 ]
Film "rgb" "integer xresolution" 19 "integer yresolution" 34
PixelFilter "sinc" "float xradius" 2 "float yradius" 2
WorldBegin
LightSource "spot" "point3 from" [ 0 4 -4 ] "point3 to" [ 0 0 0 ] "float scale" 40
Material "conductor"
Shape "cylinder" "float radius" 1.5 "float zmin" -1 "float zmax" 1 "float phimax" 200
Material "diffuse"
Shape "disk" "float height" 1 "float radius" 1.9
)";

inline char const* const kChecks = R"(
Camera "spherical"
Film "rgb" "integer xresolution" 20 "integer yresolution" 17
PixelFilter "box"
WorldBegin
LightSource "distant" "point3 from" [ 1 2 -3 ] "point3 to" [ 0 0 0 ]
Texture "c" "spectrum" "checkerboard" "float uscale" 6 "float vscale" 6 "rgb tex1" [ .1 .2 .8 ] "rgb tex2" [ .8 .8 .1 ]
MakeNamedMaterial "a" "string type" "diffuse" "texture reflectance" "c"
MakeNamedMaterial "b" "string type" "thindielectric"
Material "mix" "string materials" [ "a" "b" ] "float amount" 0.4
Translate 0 0 3
Shape "sphere"
Translate 0 -2 0
Material "interface"
Shape "sphere" "float radius" 0.7
Material "thindielectric"
AreaLightSource "diffuse" "rgb L" [ 3 3 3 ] "bool twosided" true
Shape "sphere" "float radius" 0.5 "float zmin" -0.3
)";

/// Bodies within bodies that absorb, surfaces that are there by chance or in part, and some that coincide.
inline char const* const kBodies = R"(
LookAt 0 1.5 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 33 "integer yresolution" 22
PixelFilter "gaussian"
WorldBegin
LightSource "infinite" "float scale" 0.3
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Translate 0 3 0
  Rotate 90 1 0 0
  Shape "disk" "float radius" 0.8
AttributeEnd
MakeNamedMaterial "grey" "string type" "diffuse" "rgb reflectance" [ .6 .6 .5 ]
MakeNamedMaterial "air" "string type" "interface"
MakeNamedMaterial "veil" "string type" "mix" "string materials" [ "grey" "air" ] "float amount" 0.5
NamedMaterial "grey"
Shape "bilinearmesh" "point3 P" [ -4 -1 -4  4 -1 -4  -4 -1 4  4 -1 4 ]
Shape "trianglemesh" "point3 P" [ -4 -1 -4  4 -1 -4  4 -1 4  -4 -1 4 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ -4 -1 -4  4 -1 -4  4 -1 4  -4 -1 4 ] "integer indices" [ 1 2 3  1 3 0 ]
AttributeBegin
  Translate -1 0 0
  Material "dielectric" "float eta" 1.5 "rgb absorption" [ .3 .1 .5 ] "integer priority" 1
  Shape "sphere" "float radius" 0.8
  Translate 0.5 0 0
  Material "dielectric" "float eta" 1.3 "rgb absorption" [ .5 .5 .1 ] "integer priority" 2
  Shape "sphere" "float radius" 0.7
AttributeEnd
Translate 1.4 0 0
NamedMaterial "veil"
Shape "sphere" "float radius" 0.7
NamedMaterial "grey"
Translate 0 0 -1.2
Shape "trianglemesh" "point3 P" [ -.5 -1 0  .5 -1 0  0 1 0 ] "integer indices" [ 0 1 2 ] "float alpha" 0.5
)";

inline Scene read_text(std::string const& text) {
    return read_pbrt_string(text, "test.pbrt", "/nonexistent");
}

inline std::vector<Integrator> integrators() {
    return {PathIntegrator{.max_depth = 6}, DirectIntegrator{}, WhittedIntegrator{.max_depth = 6},
            // Radii are given: to find some takes longer than a pass of these.
            PhotonMapIntegrator{.shooting = {.global_paths = 300},
                                .estimates = {.nused = 10, .radius = 0.5f, .edge_correction = true},
                                .gather_samples = 2,
                                .passes = 8},
            SppmIntegrator{.shooting = {.global_paths = 300}, .estimates = {.nused = 0, .radius = 0.2f}},
            LightPathIntegrator{}};
}
inline std::vector<Sampler> samplers() {
    return {SobolSampler{}, StratifiedSampler{.x_strata = 2, .y_strata = 3}, IndependentSampler{}};
}

/// The definition: the passes one after the other on this thread.
inline Film by_definition(RenderJob const& job, PassRange passes) {
    Film film = job.make_film();
    RayStats stats;
    for (std::uint64_t i = passes.begin; i < passes.end; ++i) render_pass(job, i, film, stats);
    return film;
}
inline RenderResult add_passes(RenderJob const& job, PassRange passes, Film& film, int threads = 2) {
    RenderControl control;
    control.passes = passes;
    control.threads = threads;
    return render(job, control, film);
}
inline Film rendered(RenderJob const& job, PassRange passes, int threads = 2) {
    Film film = job.make_film();
    CHECK(add_passes(job, passes, film, threads).end == RenderEnd::Complete);
    return film;
}

inline bool same_aov(AovSums const& a, AovSums const& b) {
    auto const same = [](auto const& x, auto const& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    return same(a.albedo, b.albedo) && same(a.shading_normal, b.shading_normal) &&
           same(a.geometric_normal, b.geometric_normal) && same(a.position, b.position) &&
           same(a.depth, b.depth) && same(a.hits, b.hits) && same(a.light, b.light) &&
           same(a.radius, b.radius) && same(a.photons, b.photons) && same(a.estimates, b.estimates) &&
           a.material_pass == b.material_pass && a.material == b.material;
}

/// Pixels of b's window whose sums or layers differ from a's in any bit; all of them when the passes differ.
inline int differing_pixels(Film const& a, Film const& b) {
    auto const crop = b.crop();
    int n = 0;
    bool const same_passes = a.passes() == b.passes() && a.dropped() == b.dropped();
    for (int y = crop[2]; y < crop[3]; ++y)
        for (int x = crop[0]; x < crop[1]; ++x) {
            bool same = same_passes && std::memcmp(&a.pixel(x, y), &b.pixel(x, y), sizeof(PixelSums)) == 0;
            if (a.has_aovs() || b.has_aovs()) same = same && same_aov(a.aov(x, y), b.aov(x, y));
            n += !same;
        }
    return n;
}

/// The largest difference of any sum, relative to the size of what was summed.
inline double rounding_between(Film const& a, Film const& b) {
    double most = a.passes() == b.passes() ? 0 : 1;
    auto const see = [&](double x, double y, double scale) {
        if (x != y) most = std::fmax(most, std::abs(x - y) / scale);
    };
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            PixelSums const& p = a.pixel(x, y);
            PixelSums const& q = b.pixel(x, y);
            double const n = static_cast<double>(p.samples);
            if (p.samples != q.samples) most = 1;
            for (std::size_t c = 0; c < 3; ++c) {
                see(p.rgb[c], q.rgb[c], std::sqrt(n * p.square[c]));
                see(p.square[c], q.square[c], p.square[c]);
                see(p.cross[c], q.cross[c], std::sqrt(p.weight_square * p.square[c]));
            }
            see(p.weight, q.weight, std::sqrt(n * p.weight_square));
            see(p.weight_square, q.weight_square, p.weight_square);
            if (!a.has_aovs()) continue;
            AovSums const& s = a.aov(x, y);
            AovSums const& t = b.aov(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                see(s.albedo[c], t.albedo[c], p.weight_square + n);
                see(s.shading_normal[c], t.shading_normal[c], p.weight_square + n);
                for (std::size_t i = 0; i < kLightClasses; ++i)
                    see(s.light[i][c], t.light[i][c], std::sqrt(n * p.square[c]) + p.weight_square + n);
                see(s.position[c], t.position[c], 10 * (p.weight_square + n));
            }
            see(s.radius, t.radius, p.weight_square + n);
            see(s.photons, t.photons, 100 * (p.weight_square + n));
            see(s.depth, t.depth, 10 * (p.weight_square + n));
            if (s.material != t.material || s.material_pass != t.material_pass) most = 1;
        }
    return most;
}

}  // namespace nephroid::test
