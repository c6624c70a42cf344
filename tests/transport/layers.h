// Renders small films with their layers of light in independent batches.
#pragma once

#include "measure.h"

namespace nephroid::test {

/// Per pixel: the beauty, and the four classes of light; each by channel.
struct LayerMeans {
    std::array<Mean, 3> beauty;
    std::array<std::array<Mean, 3>, kLightClasses> light;
};

/// 32 films with scrambles of their own.
inline std::vector<LayerMeans> measure_layers(World const& world, Settings s, std::uint64_t passes,
                                              std::uint64_t first_seed = 1) {
    s.film.aovs = true;
    int const nx = s.film.resolution.x;
    auto const pixels = static_cast<std::size_t>(nx) * static_cast<std::size_t>(s.film.resolution.y);
    std::vector<LayerMeans> means(pixels);
    RayStats stats;
    for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
        s.seed = first_seed * 1000 + batch;
        RenderJob const job(world, s);
        Film film = job.make_film();
        for (std::uint64_t i = 0; i < passes; ++i) render_pass(job, i, film, stats);
        CHECK(film.dropped() == 0);
        for (std::size_t i = 0; i < pixels; ++i) {
            int const x = static_cast<int>(i) % nx, y = static_cast<int>(i) / nx;
            PixelSums const& p = film.pixel(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                means[i].beauty[c].add(p.rgb[c] / p.weight);
                for (std::size_t k = 0; k < kLightClasses; ++k)
                    means[i].light[k][c].add(film.aov(x, y).light[k][c] / p.weight);
            }
        }
    }
    CHECK(stats.rejected == 0);
    return means;
}

/// Welch's test of one mean against another, with room for float rounding; and that it could have seen a difference of `within`
/// as a share of `unit`.
struct Compared {
    double p = 1, width = 0;
};
inline Compared compare(Mean const& a, Mean const& b, double unit) {
    double const va = a.standard_error() * a.standard_error();
    double const vb = b.standard_error() * b.standard_error();
    double const off = std::abs(a.mean() - b.mean()) - 1e-5 * std::abs(b.mean());
    Compared r;
    r.width = unit > 0 ? 2.6 * std::sqrt(va + vb) / unit : 0;
    if (off <= 0) return r;
    double const dof = (va + vb) * (va + vb) / ((va * va + vb * vb) / (kBatches - 1) + 1e-300);
    r.p = va + vb > 0 ? student_p(off / std::sqrt(va + vb), dof) : 0;
    return r;
}

}  // namespace nephroid::test
