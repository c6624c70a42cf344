#include "density.h"

#include "kernel.h"

#include <cmath>

namespace nephroid {

namespace {

constexpr float kSameNormal = 0.5f;
constexpr float kPlate = 0.25f;  // half its thickness over the radius

/// Where photons must have landed.
struct Place {
    Vec3 p, n;
    bool both_sides = false;
};

/// What the photons that count amount to, and where they lie.
struct Gathered {
    float radius = 0;
    std::uint32_t photons = 0;
    Vec3 offsets{0, 0, 0};  // their sum, for the centroid
};

/// Calls use(photon, K / r^2) for every photon that counts (eq. 1).
template <class Use>
Gathered for_each_photon(PhotonMap const& map, Place const& at, EstimateRule const& rule,
                         NearestPhotons& nearest, Use&& use) {
    Gathered g;
    g.radius = rule.radius;
    if (map.empty()) return g;
    auto const sum = [&](auto const& kernel) {
        auto const count = [&](std::uint32_t i, float d2) {
            Photon const& photon = map[i];
            Vec3 const offset = photon.p() - at.p;
            float const off_plane = std::abs(dot(offset, at.n));
            if (off_plane > kPlate * g.radius) return;
            float const facing = dot(photon.n(), at.n);
            if ((at.both_sides ? std::abs(facing) : facing) < kSameNormal) return;
            float const inverse = 1.0f / (g.radius * g.radius);
            if (use(photon, kernel(d2 * inverse) * inverse)) {
                ++g.photons;
                g.offsets += offset;
            }
        };
        if (rule.k == 0) {
            map.within(at.p, g.radius, count);
            return;
        }
        map.nearest(at.p, rule.k, rule.radius, nearest);
        float farthest = rule.radius * rule.radius;
        if (nearest.found.size() == rule.k) {
            farthest = 0;
            for (FoundPhoton const& f : nearest.found) farthest = max(farthest, f.distance2);
        }
        // Squared distances are compared: the square of a rounded root may lie beyond the k-th, which then would count.
        float const most = sqr(rule.shrink) * farthest;
        g.radius = std::sqrt(most);
        if (!(g.radius > 0.0f)) return;  // k photons at one point
        for (FoundPhoton const& f : nearest.found)
            if (f.distance2 < most) count(f.index, f.distance2);
    };
    with_kernel(rule.kernel, sum);
    return g;
}

/// Something is missing on one side: the photons' centroid is farther out than 1.5 standard deviations of that of an even disk, whose
/// coordinates have a variance of r^2 / 4 each.
bool lopsided(Gathered const& g) {
    auto const n = static_cast<float>(g.photons);
    return dot(g.offsets, g.offsets) > sqr(1.5f) * 0.5f * n * sqr(g.radius);
}

float edge_factor(World const& world, Place const& at, EstimateRule const& rule, Gathered const& g,
                  RayStats& stats) {
    if (!rule.edge_correction || g.photons == 0 || !lopsided(g)) return 1.0f;
    float const share = covered_share(world, at.p, at.n, g.radius, rule.kernel, stats);
    // Below an eighth the place is no corner of a wall any more, and photons tell too little.
    return share > 0.125f ? 1.0f / share : 1.0f;
}

}  // namespace

float covered_share(World const& world, Vec3 p, Vec3 n, float radius, Kernel kernel, RayStats& stats) {
    Frame const frame = frame_from_z(n);
    float const height = kPlate * radius;
    SurfaceHit hit;
    auto const is_surface = [&](float r, float phi) {
        Vec3 const foot = p + r * radius * (std::cos(phi) * frame.x + std::sin(phi) * frame.y);
        return world.intersect({foot + height * n, -n}, 2.0f * height, RayKind::Bounce, stats, hit) &&
               abs_dot(hit.s.ng, n) >= kSameNormal;
    };
    bool whole = true;
    constexpr int kRim = 8, kPoints = 64;
    for (int i = 0; i < kRim && whole; ++i)
        whole = is_surface(0.97f, kTwoPi * (static_cast<float>(i) + 0.5f) / static_cast<float>(kRim));
    if (whole) return 1.0f;
    // A sunflower: rings of equal area, turned by the golden angle.
    return with_kernel(kernel, [&](auto const& k) {
        float all = 0, found = 0;
        for (int i = 0; i < kPoints; ++i) {
            float const r2 = (static_cast<float>(i) + 0.5f) / static_cast<float>(kPoints);
            float const weight = k(r2);
            all += weight;
            if (is_surface(std::sqrt(r2), 2.3999632f * static_cast<float>(i))) found += weight;
        }
        return found / all;
    });
}

Estimate reflected(PathContext& c, Walk const& walk, Vertex const& v, PhotonMap const& map,
                   EstimateRule const& rule, std::uint32_t most_bounces) {
    Estimate e;
    Place const at{v.hit.s.p, dot(walk.ray.d, v.hit.s.ng) < 0.0f ? v.hit.s.ng : -v.hit.s.ng,
                   v.is.spreads_through};
    bool const same_normals = v.hit.s.ns == v.hit.s.ng;
    auto const* diffuse = std::get_if<DiffuseBsdf>(&v.bsdf);
    Gathered const g = for_each_photon(map, at, rule, *c.nearest, [&](Photon const& photon, float weight) {
        if (photon.bounces() + 1 + walk.vertex > most_bounces) return false;
        // Both stand for all four lanes by the hero's: once is enough.
        if (walk.hero_only && photon.hero_only()) weight *= 0.25f;
        if (diffuse && same_normals) {
            e.radiance += photon.power() * weight;
            return true;
        }
        Vec3 const wi = photon.wi();
        if (!same_normals) {
            // Flux goes by the geometric normal, scattering by the shading normal (Veach 1997, 5.3).
            float const cosine = abs_dot(wi, v.hit.s.ng);
            if (!(cosine > 0.0f)) return false;
            weight *= abs_dot(wi, v.hit.s.ns) / cosine;
        }
        e.radiance +=
            evaluate(v.bsdf, v.wo_local, v.frame.to_local(wi), Mode::Radiance) * photon.power() * weight;
        return true;
    });
    if (diffuse && same_normals) e.radiance *= diffuse->reflectance * kInvPi;
    e.radiance *= edge_factor(c.world, at, rule, g, c.stats);
    e.radius = g.radius;
    e.photons = g.photons;
    return e;
}

Estimate irradiance(World const& world, PhotonMap const& map, Vec3 p, Vec3 n, EstimateRule const& rule,
                    NearestPhotons& nearest, RayStats& stats) {
    Estimate e;
    Place const at{p, n};
    Gathered const g = for_each_photon(map, at, rule, nearest, [&](Photon const& photon, float weight) {
        e.radiance += photon.power() * weight;
        return true;
    });
    e.radiance *= edge_factor(world, at, rule, g, stats);
    e.radius = g.radius;
    e.photons = g.photons;
    return e;
}

}  // namespace nephroid
