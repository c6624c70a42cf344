// Density estimates of photons that were laid out by hand, at points of a world that a ray finds.
#pragma once

#include "density.h"
#include "measure.h"
#include "scenes.h"

#include <optional>

namespace nephroid::test {

inline constexpr Kernel kKernels[] = {Kernel::Box, Kernel::Cone, Kernel::Epanechnikov, Kernel::Gaussian};
inline std::string name_of(Kernel k) {
    char const* const names[] = {"box", "cone", "Epanechnikov", "Gaussian"};
    return names[static_cast<int>(k)];
}
inline EstimateRule rule(Kernel kernel, std::uint32_t k, float radius) {
    EstimateRule r;
    r.kernel = kernel;
    r.k = k;
    r.radius = radius;
    return r;
}

/// Walks one ray to the surface that it meets, and estimates there.
class Probe {
  public:
    explicit Probe(World const& world) : job_(world, settings(path(1), 1, 1)) {}

    Estimate reflected(PhotonMap const& map, EstimateRule const& how, Ray const& ray,
                       std::uint32_t most_bounces = 99, bool hero_only = false) {
        PathSampler sampler(job_.sequence(), stream::kCamera, 0, 0);
        PathContext c{job_, job_.world(), job_.pass_wavelengths(0), sampler, stats_};
        c.nearest = &nearest_;
        Walk walk = Walk::from_camera(c, ray);
        Vertex v;
        Spectrum unseen;
        REQUIRE(advance(c, walk, EmissionWeight::None, v, unseen));
        REQUIRE(prepare(c, walk, v));
        walk.hero_only = hero_only;
        return nephroid::reflected(c, walk, v, map, how, most_bounces);
    }
    Estimate irradiance(PhotonMap const& map, EstimateRule const& how, Vec3 p, Vec3 n,
                        std::uint32_t thinned = 0) {
        return nephroid::irradiance(job_.world(), map, p, n, how, nearest_, stats_, thinned);
    }
    [[nodiscard]] std::uint64_t rays() const { return stats_.rays[0] + stats_.rays[1] + stats_.rays[2]; }

  private:
    RenderJob job_;
    RayStats stats_;
    NearestPhotons nearest_;
};

/// Of a batch. Seeds that follow each other would be the same numbers, one draw on.
inline Random numbers_of(int batch) { return Random(static_cast<std::uint64_t>(batch) << 32); }

/// A photon that came along the normal.
inline PhotonRecord landed(Vec3 p, Vec3 n, float power) {
    PhotonRecord r;
    r.p = p;
    r.n = r.wi = n;
    r.power = Spectrum(power, power, power, 0);
    return r;
}
/// n photons, evenly by area over origin + s u + t v, that carry `irradiance` in all: a draw of the field whose mean is even.
inline void scatter_over(std::vector<Photon>& photons, Random& random, Quad const& q, Vec3 n, int count,
                         float irradiance = 1) {
    float const power = irradiance * length(cross(q.edge_u, q.edge_v)) / static_cast<float>(count);
    for (int i = 0; i < count; ++i)
        photons.emplace_back(
            landed(q.origin + random.unit() * q.edge_u + random.unit() * q.edge_v, n, power));
}

}  // namespace nephroid::test
