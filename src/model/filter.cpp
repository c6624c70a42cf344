#include "model/filter.h"

#include "sampling/warp.h"

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
struct Axis {
    Filter const& filter;
    int axis;
    float floor = 0;  // a gaussian's value at its radius

    Axis(Filter const& f, int a) : filter(f), axis(a) {
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
    return Axis{filter, 0}(offset.x) * Axis{filter, 1}(offset.y);
}

FilterSampler::FilterSampler(Filter const& filter) : filter_(filter), radius_(radius(filter)) {
    auto const tabulate = [&](int axis) {
        // 64 cells a pixel, each with the mean of |f| over 8 points: never 0 where the filter is not.
        auto const cells = static_cast<std::size_t>(std::ceil(128.0f * radius_[axis]));
        std::vector<float> f(cells);
        double sum = 0;
        Axis const value{filter_, axis};
        for (std::size_t i = 0; i < cells; ++i)
            for (int k = 0; k < 8; ++k) {
                float const t = (static_cast<float>(i) + (static_cast<float>(k) + 0.5f) / 8.0f) /
                                static_cast<float>(cells);
                float const v = value(radius_[axis] * (2.0f * t - 1.0f));
                f[i] += std::abs(v) / 8.0f;
                sum += static_cast<double>(v);
            }
        integral_ *= static_cast<float>(sum / (8.0 * static_cast<double>(cells))) * 2.0f * radius_[axis];
        return Distribution1D(f);
    };
    match(
        filter_, [&](BoxFilter const&) { integral_ = 4.0f * radius_.x * radius_.y; },
        [&](TriangleFilter const&) { integral_ = sqr(radius_.x) * sqr(radius_.y); },
        [&](auto const&) {
            x_ = tabulate(0);
            y_ = tabulate(1);
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
            float px = 0;
            float py = 0;
            Vec2 const t{x_.sample(u.x, &px), y_.sample(u.y, &py)};
            Vec2 const offset{radius_.x * (2.0f * t.x - 1.0f), radius_.y * (2.0f * t.y - 1.0f)};
            float const density = px * py / (4.0f * radius_.x * radius_.y);
            return FilterSample{offset, evaluate(filter_, offset) / (density * integral_)};
        });
}

float FilterSampler::pdf(Vec2 offset) const {
    return match(
        filter_,
        [&](BoxFilter const&) {
            return std::abs(offset.x) <= radius_.x && std::abs(offset.y) <= radius_.y ? 1.0f / integral_
                                                                                      : 0.0f;
        },
        [&](TriangleFilter const&) { return tent_pdf(offset.x, radius_.x) * tent_pdf(offset.y, radius_.y); },
        [&](auto const&) {
            Vec2 const t{(offset.x / radius_.x + 1.0f) * 0.5f, (offset.y / radius_.y + 1.0f) * 0.5f};
            return x_.pdf(t.x) * y_.pdf(t.y) / (4.0f * radius_.x * radius_.y);
        });
}

}  // namespace nephroid
