#include "walk.h"

#include "model/shading_normal.h"
#include "path_trace.h"
#include "shadow_queue.h"
#include "spectrum/color.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// The weight of emission that the walk ran into, `light_pdf` being the density with which light sampling finds it.
float emission_weight(Walk const& walk, EmissionWeight how, float light_pdf) {
    if (walk.specular || how == EmissionWeight::All) return 1.0f;
    if (how == EmissionWeight::SpecularOnly) return light_pdf > 0.0f ? 0.0f : 1.0f;
    return power_heuristic(walk.pdf, light_pdf);
}

/// Surfaces that only separate media are passed through; more of them than this on one line is a broken scene.
constexpr int kMaxInterfaces = 4096;

/// The pixel's cone cut by the surface's tangent plane: an ellipse, longer where the ray grazes it ("ray cones", Akenine-Moeller
/// et al. 2021). The cone is as wide as the path is long, whatever it was reflected by. Fixed by the camera, not by the number of
/// passes, which no pass knows: an eighth of a pixel, what pbrt-v4 comes down to at 64 samples. The passes average over the rest.
TexturePoint texture_point(Walk const& walk, SurfaceHit const& hit) {
    TexturePoint at;
    at.p = hit.s.p;
    at.uv = hit.s.uv;
    at.n = hit.s.ng;
    constexpr float kShareOfPixel = 0.125f;
    float const width = kShareOfPixel * walk.spread * (walk.cone + hit.t);
    if (!(width > 0.0f)) return at;
    // Axes in the tangent plane, across the plane of incidence and in it.
    Vec3 const d = walk.ray.d;
    Vec3 const n = hit.s.ng;
    constexpr float kGrazing = 1e-3f;  // an ellipse longer than a thousand pixels is no footprint any more
    float const cosine = max(abs_dot(n, d), kGrazing);
    Vec3 across = cross(n, d);
    float const len = length(across);
    across = len > 1e-6f ? across / len : frame_from_z(n).x;
    at.dpdx = across * width;
    at.dpdy = cross(n, across) * (width / cosine);
    // (du, dv) with du dp/du + dv dp/dv nearest to the axis: the normal equations (PBRT 4th ed., eq. 10.6).
    Vec3 const u = hit.s.dpdu, v = hit.s.dpdv;
    float const uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
    float const det = difference_of_products(uu, vv, uv, uv);
    if (!(det > 0.0f)) return at;
    auto const solve = [&](Vec3 axis) {
        float const a = dot(u, axis), b = dot(v, axis);
        Vec2 const r{difference_of_products(vv, a, uv, b) / det, difference_of_products(uu, b, uv, a) / det};
        return std::isfinite(r.x) && std::isfinite(r.y) ? r : Vec2{0, 0};
    };
    at.duv_dx = solve(at.dpdx);
    at.duv_dy = solve(at.dpdy);
    return at;
}

/// A boundary inside a body that outranks it.
bool is_hidden(PathContext const& c, Walk const& walk, Vertex const& v) {
    Assets const& assets = c.world.assets();
    return assets.data(v.material).encloses &&
           walk.interiors.hides(assets, {v.hit.material, v.material}, dot(walk.ray.d, v.hit.s.ng) < 0.0f);
}

/// The hero stands for all four lanes from here on (Wilkie et al. 2014).
void keep_hero(Walk& walk) {
    if (walk.hero_only) return;
    walk.beta = Spectrum(4.0f * walk.beta[0], 0, 0, 0);
    walk.hero_only = true;
}

/// Which bodies the walk is in once it leaves along w. Out of line: few worlds enclose anything.
[[gnu::noinline]] void cross_boundary(PathContext& c, Walk& walk, Vertex const& v, Vec3 w) {
    walk.interiors = beyond(c, walk, v, w);
}

/// Any material's scattering, frame and traits. Out of line, where its registers are out of the way of plain ones.
[[gnu::noinline]] bool prepare_any(PathContext& c, Walk& walk, Vertex& v, MaterialData const& data) {
    Assets const& assets = c.world.assets();
    TexturePoint at;
    if (data.textured) at = texture_point(walk, v.hit);
    if (!make_bsdf(assets, v.material, at, c.lambda, v.bsdf)) return false;
    if (data.encloses)
        walk.interiors.immerse(assets, {v.hit.material, v.material}, dot(walk.ray.d, v.hit.s.ng) < 0.0f,
                               c.lambda, v.bsdf);
    if (data.perturbed) perturb_normal(assets, v.material, at, v.hit.s);
    v.frame = data.oriented ? frame_from_zx(v.hit.s.ns, v.hit.s.dpdu) : frame_from_z(v.hit.s.ns);
    v.is = traits(v.bsdf);
    if (v.is.hero_only) keep_hero(walk);
    return true;
}

}  // namespace

Spectrum transmittance(PathContext const& c, Interiors const& interiors, float distance) {
    Spectrum const sigma = interiors.absorption(c.world.assets(), c.lambda);
    Spectrum left;
    // exp(-0 * infinity) is 1.
    for (int i = 0; i < 4; ++i) left.set(i, sigma[i] > 0.0f ? std::exp(-sigma[i] * distance) : 1.0f);
    return left;
}

Interiors beyond(PathContext const& c, Walk const& walk, Vertex const& v, Vec3 w) {
    Interiors in = walk.interiors;
    float const came = dot(walk.ray.d, v.hit.s.ng), goes = dot(w, v.hit.s.ng);
    bool const crossed = came * goes > 0.0f;
    if (!crossed || !v.material.valid()) return in;
    Assets const& assets = c.world.assets();
    bool const inwards = goes < 0.0f;
    if (assets.data(inwards ? v.material : v.hit.material).encloses)
        in.cross({v.hit.material, v.material}, inwards);
    return in;
}

bool advance(PathContext& c, Walk& walk, EmissionWeight weight, Vertex& v, Spectrum& radiance) {
    RayKind const kind = walk.vertex == 0 && walk.mode == Mode::Radiance ? RayKind::Camera : RayKind::Bounce;
    SurfaceHit& hit = v.hit;
    Vec3 const origin = walk.ray.o;  // before any surface was passed: portals are seen from here
    double mix = -1;                 // what decides at mixes; not drawn yet
    for (int i = 0; i < kMaxInterfaces; ++i) {
        bool const found = walk.met ? c.world.surface(*walk.met, hit)
                                    : c.world.intersect(walk.ray, kInfinity, kind, c.stats, hit);
        walk.met = nullptr;
        if (!walk.interiors.empty()) walk.beta *= transmittance(c, walk.interiors, found ? hit.t : kInfinity);
        if (!found) {
            if (c.trace) c.trace->left(walk);
            if (weight == EmissionWeight::None) return false;
            for (LightId const light : c.world.infinite_lights()) {
                float const pdf =
                    walk.specular ? 0.0f : c.world.infinite_light_pdf(light, walk.from, c.lights, walk.ray.d);
                float const w = emission_weight(walk, weight, pdf);
                if (w > 0.0f) {
                    Spectrum const seen =
                        walk.beta * c.world.environment(light, origin, walk.ray.d, c.lambda) * w;
                    radiance += seen;
                    if (c.trace) c.trace->met_sky(walk, light, seen, w, pdf);
                }
            }
            return false;
        }
        if (hit.emits && weight != EmissionWeight::None) {
            Spectrum const emitted = c.world.emitted(hit, -walk.ray.d, c.lambda);
            if (!emitted.is_black()) {
                float const pdf =
                    walk.specular ? 0.0f : c.world.light_pdf(hit, walk.from, c.lights, walk.ray.d);
                float const w = emission_weight(walk, weight, pdf);
                Spectrum const seen = walk.beta * emitted * w;
                radiance += seen;
                if (c.trace) c.trace->met_light(walk, hit, seen, w, pdf);
            }
        }
        v.material = hit.material;
        if (v.material.valid() && c.world.assets().data(v.material).mix) {
            // One number for all mixes on this segment: resolving leaves a fresh one behind.
            if (mix < 0) {
                c.sampler.at(dimension::of(walk.vertex, dimension::kMix));
                mix = c.sampler.next_1d_fine();
            }
            Assets const& assets = c.world.assets();
            v.material = resolve_mix(assets, v.material, texture_point(walk, hit), mix);
        }
        if (c.world.encloses() && v.material.valid() && is_hidden(c, walk, v)) {
            walk.interiors.cross({hit.material, v.material}, dot(walk.ray.d, hit.s.ng) < 0.0f);
            // Shadow rays end at such a boundary: what comes now could not be sampled.
            walk.specular = true;
            walk.ray = hit.spawn(walk.ray.d);
            walk.cone += hit.t;
            continue;
        }
        bool const passes = hit.passage != Passage::Solid &&
                            std::holds_alternative<InterfaceMaterial>(c.world.scene()[v.material].kind);
        if (!passes) {
            if (c.trace) c.trace->arrived(walk, v);
            return true;
        }
        walk.ray = hit.spawn(walk.ray.d);
        walk.cone += hit.t;
    }
    if (c.trace) c.trace->left(walk);
    return false;
}

bool prepare(PathContext& c, Walk& walk, Vertex& v) {
    if (!v.material.valid()) return false;
    if (prepare_plain(c, v)) {
        // Most of what paths meet.
        orient(walk, v);
    } else {
        if (!prepare_any(c, walk, v, c.world.assets().data(v.material))) return false;
        v.wo_local = v.frame.to_local(-walk.ray.d);
    }
    if (c.trace) c.trace->scatters(v);
    return true;
}

namespace {

/// Two numbers for one use at the vertex; `ahead` where they have been drawn.
Vec2 number_2d(PathContext& c, Walk const& walk, Vertex const& v, std::uint32_t use, Vec2 ahead) {
    if (v.drawn_ahead) return ahead;
    c.sampler.at(dimension::of(walk.vertex, use));
    return c.sampler.next_2d();
}

/// A light sample at a vertex, and what it brings there.
struct DirectLight {
    std::optional<LightSample> from;  // none: nothing
    float weight = 1;                 // by MIS
    Spectrum light{};                 // f |cos| Li weight / pdf, unless something is in the way; without beta
};

DirectLight choose_direct(PathContext& c, Walk const& walk, Vertex const& v, bool mis) {
    c.sampler.at(dimension::of(walk.vertex, dimension::kLightChoice));
    double const u_choose = c.world.chooses_lights() ? c.sampler.next_1d_fine() : 0.0;
    Vec2 const u = number_2d(c, walk, v, dimension::kLight, v.drawn.light);
    DirectLight direct{c.world.sample_light(receiver_of(v), c.lights, u_choose, u, c.lambda)};
    if (!direct.from) return direct;
    LightSample const& light = *direct.from;
    Vec3 const wi_local = v.frame.to_local(light.wi);
    Spectrum const f = evaluate(v.bsdf, v.wo_local, wi_local, Mode::Radiance) * light.radiance;
    if (f.is_black()) {
        direct.from.reset();
        return direct;
    }
    // A delta light cannot be found by scattering: its weight is 1.
    if (mis && !light.delta)
        direct.weight = power_heuristic(light.pdf, pdf(v.bsdf, v.wo_local, wi_local, c.hemisphere));
    direct.light = f * (abs_cos_theta(wi_local) * direct.weight / light.pdf);
    if (c.world.encloses()) {
        float const distance = light.at_infinity ? kInfinity : length(light.p - v.hit.s.p);
        direct.light = direct.light * transmittance(c, beyond(c, walk, v, light.wi), distance);
    }
    return direct;
}

/// … with what is in the way.
Spectrum arriving(PathContext& c, Walk const& walk, Vertex const& v, DirectLight const& direct) {
    float const passing = c.world.transmittance(v.hit, *direct.from, c.stats);
    if (passing == 0.0f) {
        if (c.trace) c.trace->occluded(walk, *direct.from);
        return {};
    }
    Spectrum const light = direct.light * passing;
    if (c.trace) c.trace->lit(walk, *direct.from, light, direct.weight, passing);
    return light;
}

}  // namespace

Spectrum sample_direct(PathContext& c, Walk const& walk, Vertex const& v, bool mis) {
    DirectLight const direct = choose_direct(c, walk, v, mis);
    if (!direct.from) return {};
    return arriving(c, walk, v, direct);
}

void add_direct(PathContext& c, Walk const& walk, Vertex const& v, bool mis, SeenLight& seen) {
    LightClass const as = walk.path_class.ends_after(v.is.near_specular);
    DirectLight const direct = choose_direct(c, walk, v, mis);
    if (!direct.from) return;
    if (!c.shadows) {
        seen[as] += walk.beta * arriving(c, walk, v, direct);
    } else if (c.trace || c.world.passes_partly()) {
        c.shadows->arrive(c.path, as, walk.beta * arriving(c, walk, v, direct));
    } else {
        c.shadows->wait(c.path, as, walk.beta * direct.light, shadow_ray(v.hit, *direct.from), walk.vertex);
    }
}

namespace {

/// The body of follow(), in line where most paths go on.
[[gnu::always_inline]] inline bool go_on(PathContext& c, Walk& walk, Vertex const& v, BsdfSample const& s) {
    Vec3 const wi = normalize(v.frame.from_local(s.wi));
    walk.beta *= s.f * (abs_cos_theta(s.wi) / s.pdf *
                        shading_normal_scale(walk.mode, -walk.ray.d, wi, v.hit.s.ns, v.hit.s.ng));
    if (s.keep_hero) keep_hero(walk);
    if (c.trace) c.trace->scattered(c, walk, v, s, wi);
    if (!carries_on(c, walk)) return false;
    if (s.transmitted) walk.eta_scale *= sqr(s.eta);
    walk.specular = s.delta;
    walk.pdf = s.proportional ? pdf(v.bsdf, v.wo_local, s.wi, c.hemisphere) : s.pdf;
    if (!s.delta) receive(v, walk.from);  // after a mirror nobody asks
    walk.cone += v.hit.t;
    walk.path_class.scatter(s.delta || v.is.near_specular);
    if (c.world.encloses()) cross_boundary(c, walk, v, wi);
    walk.ray = v.hit.spawn(wi);
    ++walk.vertex;
    return true;
}

}  // namespace

bool follow(PathContext& c, Walk& walk, Vertex const& v, BsdfSample const& s) { return go_on(c, walk, v, s); }

bool scatter(PathContext& c, Walk& walk, Vertex const& v) {
    // Draws have names, so those that nothing asks for are left out.
    float lobe = 0.0f;
    if (v.is.chooses) {
        c.sampler.at(dimension::of(walk.vertex, dimension::kLobe));
        lobe = c.sampler.next_1d();
    }
    Vec2 u{0, 0};
    if (!v.is.delta) {
        u = number_2d(c, walk, v, dimension::kDirection, v.drawn.direction);
    }
    auto const s = sample(v.bsdf, v.wo_local, lobe, u, walk.mode, c.hemisphere);
    if (!s && c.trace) c.trace->absorbed();
    return s && go_on(c, walk, v, *s);
}

bool survives(PathContext& c, Walk& walk, Roulette const& roulette) {
    float const q = survival(walk, roulette);
    if (!takes_chance(q)) return true;
    c.sampler.at(roulette_dimension(walk));
    bool const dies = c.sampler.next_1d() >= q;
    if (c.trace) c.trace->chance(q, dies);
    if (dies) return false;
    walk.beta /= q;
    return true;
}

void record_first_hit(PathContext& c, Walk const& walk, bool scatters, Vertex const& v, AovSample* aov) {
    if (walk.vertex != 0) return;
    Assets const& assets = c.world.assets();
    aov->hit = true;
    if (scatters) {
        Spectrum const white = assets.neutral_illuminant().sample(c.lambda);
        aov->albedo = to_linear_srgb(albedo(v.bsdf, v.wo_local) * white, c.lambda);
    }
    aov->shading_normal = v.hit.s.ns;
    aov->geometric_normal = v.hit.s.ng;
    aov->position = v.hit.s.p;
    aov->depth = walk.cone + v.hit.t;
    aov->material = v.hit.material.value;
}

}  // namespace nephroid
