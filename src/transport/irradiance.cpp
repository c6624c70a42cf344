#include "irradiance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace nephroid {

namespace {

constexpr std::uint32_t kEvery = 4;  // Christensen's choice
constexpr std::size_t kChunk = 256;  // places; what chunks return is added in their order
constexpr float kSameNormal = 0.7f;

struct ChunkSums {
    double radii = 0;
    RayStats rays;
};

}  // namespace

IrradianceMap::IrradianceMap(World const& world, PhotonMap const& map, EstimateRule const& rule,
                             RayStats& stats)
    : radius_(rule.radius) {
    std::size_t const n = (map.size() + kEvery - 1) / kEvery;
    if (n == 0) return;
    std::vector<Photon> places(n);
    std::vector<ChunkSums> chunks((n + kChunk - 1) / kChunk);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
        NearestPhotons nearest;
        for (std::size_t i = chunk * kChunk; i < std::min(n, (chunk + 1) * kChunk); ++i) {
            Photon const& photon = map[i * kEvery];
            PhotonRecord place;
            place.p = photon.p();
            place.n = photon.n();
            Estimate const e =
                irradiance(world, map, place.p, place.n, rule, nearest, chunks[chunk].rays, kEvery);
            place.power = e.radiance;
            chunks[chunk].radii += static_cast<double>(e.radius);
            places[i] = Photon(place);
        }
    });
    double radii = 0;
    for (ChunkSums const& c : chunks) {
        radii += c.radii;
        stats.add(c.rays);
    }
    typical_radius_ = static_cast<float>(radii / static_cast<double>(n));
    places_ = PhotonMap(std::move(places));
}

Spectrum IrradianceMap::at(Vec3 p, Vec3 n, NearestPhotons& nearest) const {
    FoundPhoton best{kInfinity, 0};
    auto const look = [&](FoundPhoton const& f) {
        bool const nearer =
            f.distance2 < best.distance2 || (f.distance2 == best.distance2 && f.index < best.index);
        if (nearer && dot(places_[f.index].n(), n) > kSameNormal) best = f;
    };
    // The nearest is nearly always on the same surface. In corners a few more have to be asked, and all of them on the dark side of
    // a wall that is lit.
    for (std::uint32_t const k : {4u, 32u}) {
        places_.nearest(p, k, radius_, nearest);
        for (FoundPhoton const& f : nearest.found) look(f);
        if (best.distance2 < kInfinity) return places_[best.index].power();
        if (nearest.found.size() < k) return {};  // there are no more
    }
    places_.within(p, radius_, [&](std::uint32_t i, float d2) { look({d2, i}); });
    return best.distance2 < kInfinity ? places_[best.index].power() : Spectrum{};
}

}  // namespace nephroid
