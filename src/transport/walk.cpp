#include "walk.h"

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

TexturePoint texture_point(PathContext const& c, Walk const& walk, SurfaceHit const& hit) {
    TexturePoint at;
    at.p = hit.s.p;
    at.uv = hit.s.uv;
    // An isotropic footprint: the pixel's cone, as wide as it is long, seen in (u, v). Fixed by the camera, not by the pass.
    float const width = c.job.camera().pixel_spread() * (walk.cone + hit.t);
    float const lu = length(hit.s.dpdu);
    float const lv = length(hit.s.dpdv);
    if (width > 0.0f && lu > 0.0f && lv > 0.0f) {
        at.duv_dx = {width / lu, 0};
        at.duv_dy = {0, width / lv};
    }
    return at;
}

/// The hero stands for all four lanes from here on (Wilkie et al. 2014).
void keep_hero(Walk& walk) {
    if (walk.hero_only) return;
    walk.beta = Spectrum(4.0f * walk.beta[0], 0, 0, 0);
    walk.hero_only = true;
}

}  // namespace

bool advance(PathContext& c, Walk& walk, EmissionWeight weight, Vertex& v, Spectrum& radiance) {
    RayKind const kind = walk.vertex == 0 ? RayKind::Camera : RayKind::Bounce;
    SurfaceHit& hit = v.hit;
    Vec3 const origin = walk.ray.o;  // before any surface was passed: portals are seen from here
    double mix = -1;                 // what decides at mixes; not drawn yet
    for (int i = 0; i < kMaxInterfaces; ++i) {
        if (!c.world.intersect(walk.ray, kInfinity, kind, c.stats, hit)) {
            for (LightId const light : c.world.infinite_lights()) {
                float const pdf =
                    walk.specular ? 0.0f : c.world.infinite_light_pdf(light, walk.from, c.lights, walk.ray.d);
                float const w = emission_weight(walk, weight, pdf);
                if (w > 0.0f)
                    radiance += walk.beta * c.world.environment(light, origin, walk.ray.d, c.lambda) * w;
            }
            return false;
        }
        if (hit.emits) {
            Spectrum const emitted = c.world.emitted(hit, -walk.ray.d, c.lambda);
            if (!emitted.is_black()) {
                float const pdf =
                    walk.specular ? 0.0f : c.world.light_pdf(hit, walk.from, c.lights, walk.ray.d);
                radiance += walk.beta * emitted * emission_weight(walk, weight, pdf);
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
            v.material = resolve_mix(assets, v.material, texture_point(c, walk, hit), mix);
        }
        if (hit.passage == Passage::Solid) return true;
        bool const passes = std::holds_alternative<InterfaceMaterial>(c.world.scene()[v.material].kind);
        if (!passes) return true;
        walk.ray = hit.spawn(walk.ray.d);
        walk.cone += hit.t;
    }
    return false;
}

bool prepare(PathContext& c, Walk const& walk, Vertex& v) {
    if (!v.material.valid()) return false;
    Assets const& assets = c.world.assets();
    TexturePoint at;
    if (assets.data(v.material).textured) at = texture_point(c, walk, v.hit);
    if (!make_bsdf(assets, v.material, at, c.lambda, v.bsdf)) return false;
    v.frame = frame_from_z(v.hit.s.ns);
    v.wo_local = v.frame.to_local(-walk.ray.d);
    return true;
}

Spectrum sample_direct(PathContext& c, Walk const& walk, Vertex const& v, bool mis) {
    c.sampler.at(dimension::of(walk.vertex, dimension::kLightChoice));
    double const u_choose = c.world.chooses_lights() ? c.sampler.next_1d_fine() : 0.0;
    c.sampler.at(dimension::of(walk.vertex, dimension::kLight));
    Vec2 const u = c.sampler.next_2d();
    auto const light = c.world.sample_light(receiver_of(v), c.lights, u_choose, u, c.lambda);
    if (!light || light->radiance.is_black()) return {};
    Vec3 const wi_local = v.frame.to_local(light->wi);
    Spectrum const f = evaluate(v.bsdf, v.wo_local, wi_local, Mode::Radiance);
    if (f.is_black()) return {};
    float const passing = c.world.transmittance(v.hit, *light, c.stats);
    if (passing == 0.0f) return {};
    // A delta light cannot be found by scattering: its weight is 1.
    float const w = light->delta || !mis
                        ? 1.0f
                        : power_heuristic(light->pdf, pdf(v.bsdf, v.wo_local, wi_local, c.hemisphere));
    return f * light->radiance * (abs_cos_theta(wi_local) * w * passing / light->pdf);
}

bool follow(PathContext& c, Walk& walk, Vertex const& v, BsdfSample const& s) {
    walk.beta *= s.f * (abs_cos_theta(s.wi) / s.pdf);
    if (s.keep_hero) keep_hero(walk);
    if (walk.beta.is_black()) return false;
    if (!walk.beta.is_finite()) {
        c.tainted = true;
        return false;
    }
    if (s.transmitted) walk.eta_scale *= sqr(s.eta);
    walk.specular = s.delta;
    walk.pdf = s.proportional ? pdf(v.bsdf, v.wo_local, s.wi, c.hemisphere) : s.pdf;
    if (!s.delta) walk.from = receiver_of(v);  // after a mirror nobody asks
    walk.cone += v.hit.t;
    walk.ray = v.hit.spawn(normalize(v.frame.from_local(s.wi)));
    ++walk.vertex;
    return true;
}

bool scatter(PathContext& c, Walk& walk, Vertex const& v) {
    // Draws have names, so those that nothing asks for are left out.
    BsdfTraits const is = traits(v.bsdf);
    float lobe = 0.0f;
    if (is.chooses) {
        c.sampler.at(dimension::of(walk.vertex, dimension::kLobe));
        lobe = c.sampler.next_1d();
    }
    Vec2 u{0, 0};
    if (!is.delta) {
        c.sampler.at(dimension::of(walk.vertex, dimension::kDirection));
        u = c.sampler.next_2d();
    }
    auto const s = sample(v.bsdf, v.wo_local, lobe, u, Mode::Radiance, c.hemisphere);
    return s && follow(c, walk, v, *s);
}

bool survives(PathContext& c, Walk& walk, Roulette const& roulette) {
    if (roulette.kind == RouletteKind::None) return true;
    // The walk has just moved on: the numbers are those of the vertex it left.
    std::uint32_t const vertex = walk.vertex - 1;
    float q = roulette.alpha;
    if (roulette.kind == RouletteKind::Throughput) {
        float const throughput = walk.beta.max() * walk.eta_scale * (walk.hero_only ? 0.25f : 1.0f);
        if (vertex == 0 || throughput >= 1.0f) return true;
        q = throughput;
    }
    c.sampler.at(dimension::of(vertex, dimension::kRoulette));
    if (c.sampler.next_1d() >= q) return false;
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
