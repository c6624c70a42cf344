// Photon integrators of given radii, and the means of whole films by class of light.
#pragma once

#include "layers.h"
#include "scenes.h"

namespace nephroid::test {

/// All photons within the radii; automatic ones where 0.
inline PhotonMapIntegrator photon_map(int paths, bool gathers, float radius, float caustic_radius) {
    PhotonMapIntegrator p;
    p.shooting.global_paths = paths;
    p.final_gather = gathers;
    p.gather_samples = 4;
    p.estimates.radius = radius;
    p.estimates.caustic_radius = caustic_radius;
    if (!gathers) p.estimates.nused = 0;
    return p;
}
inline SppmIntegrator progressive(int max_depth, int paths, float radius = 0) {
    SppmIntegrator p;
    p.max_depth = max_depth;
    p.shooting.global_paths = paths;
    p.shooting.max_depth = max_depth;
    p.estimates.radius = radius;
    p.estimates.edge_correction = true;
    return p;
}

/// The film's means: classes, and what is left of the beauty without them.
struct FilmMeans {
    std::array<std::array<Mean, 3>, kLightClasses> light;
    std::array<Mean, 3> beauty;
    double missing = 0;  // the largest |beauty - sum of classes| / beauty
};
inline FilmMeans film_means(World const& world, Settings s, std::uint64_t passes, std::uint64_t first_seed) {
    s.film.aovs = true;
    FilmMeans means;
    RayStats stats;
    int const nx = s.film.resolution.x, ny = s.film.resolution.y;
    for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
        s.seed = first_seed * 1000 + batch;
        RenderJob const job(world, s);
        Film film = job.make_film();
        for (std::uint64_t i = 0; i < passes; ++i) render_pass(job, i, film, stats);
        CHECK(film.dropped() == 0);
        for (std::size_t c = 0; c < 3; ++c) {
            double all = 0;
            std::array<double, kLightClasses> by_class{};
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x) {
                    double const w = film.pixel(x, y).weight * nx * ny;
                    all += film.pixel(x, y).rgb[c] / w;
                    for (std::size_t k = 0; k < kLightClasses; ++k)
                        by_class[k] += film.aov(x, y).light[k][c] / w;
                }
            double sum = 0;
            for (std::size_t k = 0; k < kLightClasses; ++k) {
                means.light[k][c].add(by_class[k]);
                sum += by_class[k];
            }
            means.beauty[c].add(all);
            if (all > 0) means.missing = std::max(means.missing, std::abs(sum - all) / all);
        }
    }
    CHECK(stats.rejected == 0);
    return means;
}
/// Bends colours far apart.
inline MaterialId flint(Scene& s) { return glass(s, TabulatedSpd{{380, 500, 700}, {1.9f, 1.7f, 1.5f}}); }

}  // namespace nephroid::test
