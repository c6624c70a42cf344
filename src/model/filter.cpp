#include "model/filter.h"

#include "sampling/warp.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace nephroid {

namespace {

float gaussian(float x, float sigma) { return std::exp(-sqr(x) / (2.0f * sqr(sigma))); }

/// Mitchell & Netravali 1988, eq. 8, over [-2, 2].
float mitchell(float x, float b, float c) {
    x = std::abs(x);
    if (x <= 1.0f)
        return ((12.0f - 9.0f * b - 6.0f * c) * x * x * x + (-18.0f + 12.0f * b + 6.0f * c) * x * x +
                (6.0f - 2.0f * b)) /
               6.0f;
    if (x <= 2.0f)
        return ((-b - 6.0f * c) * x * x * x + (6.0f * b + 30.0f * c) * x * x + (-12.0f * b - 48.0f * c) * x +
                (8.0f * b + 24.0f * c)) /
               6.0f;
    return 0.0f;
}

float sinc(float x) {
    x *= kPi;
    return std::abs(x) < 1e-4f ? 1.0f : std::sin(x) / x;
}

/// One axis of a filter at offset x.
struct Profile {
    Filter const& filter;
    int axis;
    float floor = 0;  // a gaussian's value at its radius

    Profile(Filter const& f, int a) : filter(f), axis(a) {
        if (auto const* g = std::get_if<GaussianFilter>(&f)) floor = gaussian(g->radius[a], g->sigma);
    }

    float operator()(float x) const {
        return match(
            filter, [&](BoxFilter const& f) { return std::abs(x) <= f.radius[axis] ? 1.0f : 0.0f; },
            [&](TriangleFilter const& f) { return std::fmax(0.0f, f.radius[axis] - std::abs(x)); },
            [&](GaussianFilter const& f) {
                // Lowered so that it reaches 0 at the radius.
                return nephroid::max(0.0f, gaussian(x, f.sigma) - floor);
            },
            [&](MitchellFilter const& f) { return mitchell(2.0f * x / f.radius[axis], f.b, f.c); },
            [&](LanczosSincFilter const& f) {
                return std::abs(x) > f.radius[axis] ? 0.0f : sinc(x) * sinc(x / f.tau);
            });
    }
};

}  // namespace

Vec2 radius(Filter const& filter) {
    return match(filter, [](auto const& f) { return f.radius; });
}

float evaluate(Filter const& filter, Vec2 offset) {
    return Profile{filter, 0}(offset.x) * Profile{filter, 1}(offset.y);
}

FilterSampler::Axis FilterSampler::tabulate(Filter const& filter, int axis, double& integral) {
    Axis a;
    a.radius = nephroid::radius(filter)[axis];
    // 64 cells a pixel: across one of them f is linear to some 10^-4 of its peak.
    auto const n = static_cast<std::size_t>(std::ceil(128.0f * a.radius));
    a.cell_size = 2.0f * a.radius / static_cast<float>(n);
    Profile const f{filter, axis};
    // Inside the radius by a hair: a box's value at its edge is no one's business.
    auto const at = [&](double x) {
        double const r = static_cast<double>(a.radius) * (1 - 1e-6);
        return static_cast<double>(f(static_cast<float>(std::clamp(x, -r, r))));
    };
    std::vector<double> edge(n + 1);
    for (std::size_t i = 0; i <= n; ++i)
        edge[i] =
            at(static_cast<double>(a.cell_size) * static_cast<double>(i) - static_cast<double>(a.radius));
    // The mass of a cell: the integral of |f|, f linear, which may cross 0 within it. Never 0 where f is not.
    auto const mass = [&](std::size_t i) {
        double const p = edge[i];
        double const q = edge[i + 1];
        double const size = static_cast<double>(a.cell_size);
        return p * q >= 0 ? size * std::abs(p + q) / 2 : size * (p * p + q * q) / (2 * std::abs(p - q));
    };
    double total = 0;
    double net = 0;
    for (std::size_t i = 0; i < n; ++i) {
        total += mass(i);
        net += static_cast<double>(a.cell_size) * (edge[i] + edge[i + 1]) / 2;
    }
    integral *= net;
    double sum = 0;
    a.cells.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        double const density = mass(i) / (total * static_cast<double>(a.cell_size));
        Axis::Cell& c = a.cells[i];
        c.cdf = static_cast<float>(sum / total);
        c.density = static_cast<float>(density);
        sum += mass(i);
        if (!(density > 0)) continue;
        c.weight = static_cast<float>(edge[i] / (density * net));
        c.slope = static_cast<float>((edge[i + 1] - edge[i]) / (density * net));
    }
    for (std::size_t i = 0; i < n; ++i) {
        float const next = i + 1 < n ? a.cells[i + 1].cdf : 1.0f;
        if (next > a.cells[i].cdf) a.cells[i].inverse_width = 1.0f / (next - a.cells[i].cdf);
    }
    // Eight entries a cell: the search then mostly ends where it starts. A power of two: multiplying by it does not round.
    a.guide.resize(std::bit_ceil(8 * n));
    a.guide_size = static_cast<float>(a.guide.size());
    for (std::size_t k = 0, i = 0; k < a.guide.size(); ++k) {
        while (i + 1 < n && a.cells[i + 1].cdf <= static_cast<float>(k) / a.guide_size) ++i;
        a.guide[k] = static_cast<std::uint32_t>(i);
    }
    a.cells.push_back({.cdf = 1.0f});
    return a;
}

float FilterSampler::Axis::sample(float u, float& w) const {
    // The cell with cdf <= u < the next one's, which so has mass.
    std::uint32_t const start = guide[static_cast<std::uint32_t>(u * guide_size)];
    Cell const* c = &cells[start];
    float i = static_cast<float>(start);
    for (; c[1].cdf <= u; ++c) ++i;
    float const t = nephroid::min((u - c->cdf) * c->inverse_width, 1.0f);
    w *= c->weight + t * c->slope;
    return nephroid::min(cell_size * (i + t) - radius, radius);
}

float FilterSampler::Axis::pdf(float offset) const {
    float const i = std::floor((offset + radius) / cell_size);
    return i >= 0.0f && i < static_cast<float>(cells.size()) ? cells[static_cast<std::size_t>(i)].density
                                                             : 0.0f;
}

FilterSampler::FilterSampler(Filter const& filter) : filter_(filter), radius_(radius(filter)) {
    match(
        filter_, [&](BoxFilter const&) { integral_ = 4.0f * radius_.x * radius_.y; },
        [&](TriangleFilter const&) { integral_ = sqr(radius_.x) * sqr(radius_.y); },
        [&](auto const&) {
            double integral = 1;
            x_ = tabulate(filter_, 0, integral);
            y_ = tabulate(filter_, 1, integral);
            integral_ = static_cast<float>(integral);
        });
}

FilterSample FilterSampler::sample(Vec2 u) const {
    return match(
        filter_,
        [&](BoxFilter const&) {
            return FilterSample{{lerp(u.x, -radius_.x, radius_.x), lerp(u.y, -radius_.y, radius_.y)}, 1.0f};
        },
        [&](TriangleFilter const&) {
            return FilterSample{{sample_tent(u.x, radius_.x), sample_tent(u.y, radius_.y)}, 1.0f};
        },
        [&](auto const&) {
            FilterSample s;
            s.offset.x = x_.sample(u.x, s.weight);
            s.offset.y = y_.sample(u.y, s.weight);
            return s;
        });
}

FilterPixel FilterSampler::choose_pixel(Vec2 raster, Vec2 u) const {
    // f(x, y) = f(x, 0) f(0, y) / f(0, 0): axis by axis.
    auto const choose = [](float at, float reach, float number, auto&& f, int& pixel) {
        int const first = static_cast<int>(std::ceil(at - 0.5f - reach));
        int const last = static_cast<int>(std::floor(at - 0.5f + reach));
        auto const value = [&](int i) { return f(static_cast<float>(i) + 0.5f - at); };
        float sum = 0;
        for (int i = first; i <= last; ++i) sum += std::abs(value(i));
        if (!(sum > 0.0f)) return 0.0f;
        float left = number * sum;
        float sign = 0;
        for (int i = first; i <= last; ++i) {
            float const v = value(i);
            if (v == 0.0f) continue;
            pixel = i;
            sign = v > 0.0f ? 1.0f : -1.0f;
            left -= std::abs(v);
            if (left < 0.0f) break;
        }
        return sign * sum;
    };
    FilterPixel chosen;
    auto const along_x = [&](float d) { return evaluate(filter_, {d, 0}); };
    auto const along_y = [&](float d) { return evaluate(filter_, {0, d}); };
    float const x = choose(raster.x, radius_.x, u.x, along_x, chosen.pixel.x);
    float const y = choose(raster.y, radius_.y, u.y, along_y, chosen.pixel.y);
    chosen.weight = x * y / (evaluate(filter_, {0, 0}) * integral_);
    return chosen;
}

float FilterSampler::pdf(Vec2 offset) const {
    return match(
        filter_,
        [&](BoxFilter const&) {
            return std::abs(offset.x) <= radius_.x && std::abs(offset.y) <= radius_.y ? 1.0f / integral_
                                                                                      : 0.0f;
        },
        [&](TriangleFilter const&) { return tent_pdf(offset.x, radius_.x) * tent_pdf(offset.y, radius_.y); },
        [&](auto const&) { return x_.pdf(offset.x) * y_.pdf(offset.y); });
}

}  // namespace nephroid
