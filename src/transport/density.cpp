#include "density.h"

#include "kernel.h"

#include <array>
#include <cmath>

namespace nephroid {

namespace {

constexpr float kSameNormal = 0.5f;
constexpr float kPlate = 0.25f;  // half its thickness over the radius

constexpr float kLeastSquare = 1e-37f;  // of a radius whose square has an inverse

/// Where photons must have landed.
struct Place {
    Vec3 p, n;
    bool both_sides = false;
    std::uint32_t thinned =
        0;  // every so-manieth photon of the map does not count, and the others stand for it
};

/// Whether photons landed on the place's side of much the same plane, by their normals. Neighbours have the same one mostly: what was said
/// of the last is kept.
class Side {
  public:
    explicit Side(Place const& at) : at_(at) {}
    bool accepts(Photon const& photon) {
        if (photon.packed_n() != last_) {
            last_ = photon.packed_n();
            accepted_ = faces(photon.along_n());
        }
        return accepted_;
    }

  private:
    [[nodiscard]] bool faces(Vec3 n) const {
        float const facing = at_.both_sides ? abs_dot(n, at_.n) : dot(n, at_.n);
        return facing > 0.0f && sqr(facing) >= sqr(kSameNormal) * length_squared(n);
    }

    Place const& at_;
    std::uint32_t last_ = ~0u;  // of none
    bool accepted_ = false;
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
    if (map.empty()) return g;
    g.radius = rule.radius;
    auto const sum = [&](auto const& kernel) {
        if (!(sqr(g.radius) >= kLeastSquare)) return;
        float inverse = 1.0f / sqr(g.radius);
        float plate = kPlate * g.radius;
        Side side(at);
        // Copies: whatever a photon adds to might be one of these, as far as a compiler knows, and it would read them again each time.
        Photon const* const photons = &map[0];
        Vec3 const p = at.p;
        Vec3 const n = at.n;
        std::uint32_t const thinned = at.thinned;
        bool const only_caustics = rule.only_caustics;
        auto const count = [&, photons, p, n, thinned, only_caustics](std::uint32_t i, float d2) {
            if (thinned > 0 && i % thinned == 0) return;
            Photon const& photon = photons[i];
            if (only_caustics && !photon.caustic()) return;
            Vec3 const offset = photon.p() - p;
            float const off_plane = std::abs(dot(offset, n));
            if (off_plane > plate) return;
            if (!side.accepts(photon)) return;
            if (use(photon, kernel(d2 * inverse) * inverse)) {
                ++g.photons;
                g.offsets += offset;
            }
        };
        if (rule.k == 0) {
            map.within(at.p, g.radius, count);
            return;
        }
        // As many count as without thinning; one of those that do not lies at the place itself.
        std::uint32_t const k = at.thinned > 0 ? rule.k + rule.k / (at.thinned - 1) + 1 : rule.k;
        map.nearest(at.p, k, rule.radius, nearest);
        float farthest = rule.radius * rule.radius;
        if (nearest.found.size() == k) {
            farthest = 0;
            for (FoundPhoton const& f : nearest.found) farthest = max(farthest, f.distance2);
        }
        // Squared distances are compared: the square of a rounded root may lie beyond the k-th, which then would count.
        float const most = sqr(rule.shrink) * farthest;
        g.radius = std::sqrt(most);
        if (!(most >= kLeastSquare)) return;  // k photons at one point
        inverse = 1.0f / most;
        plate = kPlate * g.radius;
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
    Coverage const covered = coverage(world, at.p, at.n, g.radius, rule.kernel, stats);
    // Photons that lie where there is no surface came from beyond a wall: they are not to be made more of. Below an eighth the
    // place is no corner of a wall any more, and photons tell too little.
    if (covered.share <= 0.125f || dot(covered.centre, g.offsets) < 0.0f) return 1.0f;
    return 1.0f / covered.share;
}

}  // namespace

Coverage coverage(World const& world, Vec3 p, Vec3 n, float radius, Kernel kernel, RayStats& stats) {
    Frame const frame = frame_from_z(n);
    Vec3 const up = kPlate * radius * n;
    SurfaceHit hit;
    // Seen from above, and no wall stands between: the floor that goes on under a box gets no light.
    auto const is_surface = [&](Vec3 offset) {
        return world.intersect({p + offset + up, -up}, 2.0f, RayKind::Bounce, stats, hit) &&
               abs_dot(hit.s.ng, n) >= kSameNormal &&
               !world.intersect({p + up, offset}, 1.0f, RayKind::Bounce, stats, hit);
    };
    auto const at = [&](float r, float turn) {
        float const phi = kTwoPi * turn;
        return r * radius * (std::cos(phi) * frame.x + std::sin(phi) * frame.y);
    };
    constexpr int kRim = 8;
    bool whole = true;
    for (int i = 0; i < kRim && whole; ++i)
        whole = is_surface(at(0.97f, (static_cast<float>(i) + 0.5f) / kRim));
    Coverage c{1, {0, 0, 0}};
    if (whole) return c;
    // Points of a net (Hammersley's) by squared radius and angle: 8 rings of equal area by 8 sectors, and no two points at one radius
    // or in one direction. In a half or a quarter of the disk every ring has exactly so many, all of which weigh the same.
    static constexpr std::array<int, 8> kReversed{0, 4, 2, 6, 1, 5, 3, 7};
    with_kernel(kernel, [&](auto const& k) {
        float all = 0, found = 0;
        for (std::size_t ring = 0; ring < 8; ++ring) {
            float const weight = k((static_cast<float>(ring) + 0.5f) / 8.0f);
            for (std::size_t sector = 0; sector < 8; ++sector) {
                auto const place = [](std::size_t coarse, std::size_t fine) {
                    return (static_cast<float>(8 * coarse) + static_cast<float>(kReversed[fine]) + 0.5f) /
                           64.0f;
                };
                Vec3 const offset = at(std::sqrt(place(ring, sector)), place(sector, ring));
                all += weight;
                if (!is_surface(offset)) continue;
                found += weight;
                c.centre += offset;
            }
        }
        c.share = found / all;
    });
    return c;
}

Estimate reflected(PathContext& c, Walk const& walk, Vertex const& v, PhotonMap const& map,
                   EstimateRule const& rule, std::uint32_t most_bounces) {
    Estimate e;
    Place const at{v.hit.s.p, facing_normal(walk, v), v.is.spreads_through};
    bool const same_normals = v.hit.s.ns == v.hit.s.ng;
    auto const* diffuse = std::get_if<DiffuseBsdf>(&v.bsdf);
    bool const by_power_alone = diffuse && same_normals;
    std::uint32_t const before = walk.vertex + 1;
    bool const hero_only = walk.hero_only;
    Spectrum sum;
    auto const use = [&, by_power_alone, before, hero_only, most_bounces](Photon const& photon,
                                                                          float weight) {
        if (photon.bounces() + before > most_bounces) return false;
        // Both stand for all four lanes by the hero's: once is enough.
        if (hero_only && photon.hero_only()) weight *= 0.25f;
        if (by_power_alone) {
            sum += photon.power() * weight;
            return true;
        }
        Vec3 const wi = photon.wi();
        if (!same_normals) {
            // Flux came by the geometric normal where it landed, scattering goes by the shading normal (Veach 1997, 5.3). A facet beside
            // may face the light quite differently. Photons know their normals to a degree: no cosine is less certain than that.
            Vec3 const n = photon.n();
            constexpr float kOneDegree = 0.0175f, kSameFacet = 0.9996f;
            float const cosine =
                abs_dot(n, at.n) > kSameFacet ? abs_dot(wi, at.n) : max(abs_dot(wi, n), kOneDegree);
            if (!(cosine > 0.0f)) return false;
            weight *= abs_dot(wi, v.hit.s.ns) / cosine;
        }
        sum += evaluate(v.bsdf, v.wo_local, v.frame.to_local(wi), Mode::Radiance) * photon.power() * weight;
        return true;
    };
    Gathered const g = for_each_photon(map, at, rule, *c.nearest, use);
    e.radiance = by_power_alone ? sum * (diffuse->reflectance * kInvPi) : sum;
    e.radiance *= edge_factor(c.world, at, rule, g, c.stats);
    e.radius = g.radius;
    e.photons = g.photons;
    return e;
}

Estimate irradiance(World const& world, PhotonMap const& map, Vec3 p, Vec3 n, EstimateRule const& rule,
                    NearestPhotons& nearest, RayStats& stats, std::uint32_t thinned) {
    Estimate e;
    Place const at{p, n, false, thinned};
    Gathered const g = for_each_photon(map, at, rule, nearest, [&](Photon const& photon, float weight) {
        e.radiance += photon.power() * weight;
        return true;
    });
    if (thinned > 0) e.radiance *= static_cast<float>(thinned) / static_cast<float>(thinned - 1);
    e.radiance *= edge_factor(world, at, rule, g, stats);
    e.radius = g.radius;
    e.photons = g.photons;
    return e;
}

}  // namespace nephroid
