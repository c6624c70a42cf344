// A lamp as it was measured: intensities at pairs of angles, bilinear between.
#include "light_kinds.h"

#include <cmath>

namespace nephroid {

namespace {

/// Vertical (from -z) and horizontal (from +x towards +y, in [0, 2 pi]) angle of a direction in light space.
struct Angles {
    float vertical = 0, horizontal = 0;
};
Angles angles_of(Vec3 local) {
    float const phi = std::atan2(local.y, local.x);
    // Not by acos, which loses half of the digits at the poles.
    return {std::atan2(std::sqrt(sqr(local.x) + sqr(local.y)), -local.z), phi < 0.0f ? phi + kTwoPi : phi};
}
Vec3 direction_of(Angles a) {
    return spherical_direction(std::sin(a.vertical), -std::cos(a.vertical), a.horizontal);
}

/// The interval of an ascending list that holds x; the last one for its end, and nothing outside.
std::optional<std::size_t> interval(std::vector<float> const& list, float x) {
    std::optional<std::size_t> result;
    if (!(x >= list.front() && x <= list.back())) return result;
    auto const above = std::upper_bound(list.begin(), list.end(), x);
    result.emplace(std::min(static_cast<std::size_t>(above - list.begin()), list.size() - 1) - 1);
    return result;
}

float candela(IntensityTable const& t, Angles a) {
    auto const i = interval(t.vertical, a.vertical);
    // The last angle may have been rounded to just below a full turn.
    auto const j = interval(t.horizontal, std::min(a.horizontal, t.horizontal.back()));
    if (!i || !j) return 0.0f;
    float const v = (a.vertical - t.vertical[*i]) / (t.vertical[*i + 1] - t.vertical[*i]);
    float const h =
        clamp((a.horizontal - t.horizontal[*j]) / (t.horizontal[*j + 1] - t.horizontal[*j]), 0.0f, 1.0f);
    std::size_t const n = t.vertical.size();
    float const* const here = &t.candela[*j * n + *i];
    float const* const next = here + n;
    return lerp(h, lerp(v, here[0], here[1]), lerp(v, next[0], next[1]));
}

/// No step is wider than this: then the intensity changes little over a cell of the table that is sampled.
constexpr float kCell = kPi / 72;
std::vector<float> refined(std::vector<float> const& angles) {
    std::vector<float> r{angles.front()};
    for (std::size_t i = 1; i < angles.size(); ++i) {
        float const step = angles[i] - angles[i - 1];
        int const parts = std::max(1, static_cast<int>(std::ceil(step / kCell - 1e-3f)));
        for (int k = 1; k < parts; ++k)
            r.push_back(angles[i - 1] + step * static_cast<float>(k) / static_cast<float>(parts));
        r.push_back(angles[i]);
    }
    return r;
}

/// cos(a) - cos(b), also where they are close.
float cos_difference(float a, float b) { return 2.0f * std::sin((a + b) / 2.0f) * std::sin((b - a) / 2.0f); }

/// Row i and column j of the table, as a part of the square: d(solid angle) / d(square). Solid angle is even within a cell.
float element(EnvironmentTable const& t, std::size_t i, std::size_t j) {
    return cos_difference(t.vertical[i], t.vertical[i + 1]) * (t.horizontal[j + 1] - t.horizontal[j]) *
           static_cast<float>(t.vertical.size() - 1) * static_cast<float>(t.horizontal.size() - 1);
}

/// Mean over a cell by Simpson's rule: along each angle the product of a line and a sine.
float cell_mean(LightData const& d, IntensityTable const& table, EnvironmentTable const& t, std::size_t i,
                std::size_t j) {
    float sum = 0;
    float weights = 0;
    for (int a = 0; a <= 2; ++a)
        for (int b = 0; b <= 2; ++b) {
            Angles const at{lerp(0.5f * static_cast<float>(a), t.vertical[i], t.vertical[i + 1]),
                            lerp(0.5f * static_cast<float>(b), t.horizontal[j], t.horizontal[j + 1])};
            float const weight = (a == 1 ? 4.0f : 1.0f) * (b == 1 ? 4.0f : 1.0f) * std::sin(at.vertical);
            sum += weight * candela(table, at) / direction_density(d, direction_of(at));
            weights += weight;
        }
    return weights > 0.0f ? sum / weights : 0.0f;
}

float intensity(MeasuredLight const& l, LightData const& d, Vec3 w) {
    return candela(l.table, angles_of(local_direction(d, w)));
}
float density(LightData const& d, Vec3 w) {
    Vec3 const local = local_direction(d, w);
    Angles const a = angles_of(local);
    EnvironmentTable const& t = *d.table;
    auto const i = interval(t.vertical, a.vertical);
    auto const j = interval(t.horizontal, std::min(a.horizontal, t.horizontal.back()));
    if (!i || !j) return 0.0f;
    Vec2 const middle{(static_cast<float>(*j) + 0.5f) / static_cast<float>(t.horizontal.size() - 1),
                      (static_cast<float>(*i) + 0.5f) / static_cast<float>(t.vertical.size() - 1)};
    return t.distribution.pdf(middle) / element(t, *i, *j) * direction_density(d, local);
}

/// A point of the square, in light space.
Vec3 direction_at(EnvironmentTable const& t, Vec2 st) {
    auto const split = [](float x, std::size_t cells, std::size_t& cell) {
        float const scaled = x * static_cast<float>(cells);
        cell = std::min(static_cast<std::size_t>(scaled), cells - 1);
        return clamp(scaled - static_cast<float>(cell), 0.0f, 1.0f);
    };
    std::size_t i = 0;
    std::size_t j = 0;
    float const v = split(st.y, t.vertical.size() - 1, i);
    float const h = split(st.x, t.horizontal.size() - 1, j);
    // Even in the cosine; 1 - cos and 1 + cos each without cancellation, for the two poles.
    float const step = cos_difference(t.vertical[i], t.vertical[i + 1]);
    float const below = 2.0f * sqr(std::sin(t.vertical[i] / 2.0f)) + v * step;
    float const above = 2.0f * sqr(std::cos(t.vertical[i + 1] / 2.0f)) + (1.0f - v) * step;
    return spherical_direction(safe_sqrt(below * above), (below - above) / 2.0f,
                               lerp(h, t.horizontal[j], t.horizontal[j + 1]));
}

}  // namespace

LightData prepare(MeasuredLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.position = d.to_world.point({0, 0, 0});
    d.direction = normalize(d.to_world.vector({0, 0, -1}));
    d.direction_scale = direction_scale(d.to_world);
    EnvironmentTable t;
    t.vertical = refined(l.table.vertical);
    t.horizontal = refined(l.table.horizontal);
    std::size_t const rows = t.vertical.size() - 1;
    std::size_t const columns = t.horizontal.size() - 1;
    std::vector<float> f;
    f.reserve(rows * columns);
    double sum = 0;
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            f.push_back(cell_mean(d, l.table, t, i, j) * element(t, i, j));
            sum += static_cast<double>(f.back());
        }
    double const flux = sum / static_cast<double>(f.size());
    d.flux = static_cast<float>(flux);
    for (float const cd : l.table.candela) d.peak = std::max(d.peak, cd);
    t.distribution = Distribution2D(f, static_cast<int>(columns), static_cast<int>(rows));
    d.table = std::make_shared<EnvironmentTable>(std::move(t));
    // Candela times a spectrum of luminance 1 are candela.
    d.emission = emission_spectrum(assets, l.intensity, l.scale, l.power, flux);
    return d;
}

std::optional<LightSample> sample_light(MeasuredLight const& l, LightData const& d, Assets const&, Vec3 p,
                                        Vec2, Wavelengths const& lambda) {
    return sample_from_point(d, p, d.emission.sample(lambda) * intensity(l, d, p - d.position));
}

float power(MeasuredLight const&, LightData const& d, Assets const&, BoundingSphere const&) {
    return d.emission.max_value() * d.flux;
}

std::optional<EmissionSample> sample_emission(MeasuredLight const& l, LightData const& d, Assets const&,
                                              BoundingSphere const&, Vec2, Vec2 u_direction,
                                              Wavelengths const& lambda) {
    Vec3 const local = direction_at(*d.table, d.table->distribution.sample(u_direction));
    Vec3 const w = normalize(d.to_world.vector(local));
    return emission_from_point(d, w, d.emission.sample(lambda) * intensity(l, d, w), density(d, w));
}

EmissionDensity emission_density(MeasuredLight const&, LightData const& d, BoundingSphere const&, Vec3,
                                 Vec3 w) {
    return {0.0f, density(d, w)};
}

std::optional<LightBounds> light_bounds(MeasuredLight const& l, LightData const& d, Assets const&) {
    float const intensity = d.emission.max_value() * d.peak;
    if (d.direction_scale != 0.0f) return bounds_at_point(d, intensity);
    // Most lamps light one side: up to the angle after the last one where any plane is lit.
    std::size_t const n = l.table.vertical.size();
    std::size_t last = 0;
    for (std::size_t k = 0; k < l.table.candela.size(); ++k)
        if (l.table.candela[k] > 0.0f) last = std::max(last, k % n);
    return bounds_at_point(d, intensity, d.direction, l.table.vertical[std::min(last + 1, n - 1)],
                           kSharpEdge);
}

}  // namespace nephroid
