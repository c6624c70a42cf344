// Daylight: the sky by a table of its luminance, the sun by its cone, and one of the two by the light that it gives.
#include "light_kinds.h"
#include "sky.h"

#include "spectrum/color.h"

#include <cmath>

namespace nephroid {

/// The sky itself is computed wherever it is looked at; only the choice of directions goes by a table (LightData::table).
struct SunSky {
    Sky sky;
    Frame sun;                  // about the direction towards it
    float one_minus_cos = 0;    // of the cone that the sun fills
    float sun_probability = 0;  // with which a sample is one of the sun
    float mean_radiance = 0;    // over the sphere, as power() counts
};

namespace {

/// The square of the table is Clarberg's: its cells have equal solid angles, and the horizon is their diagonals.
constexpr int kTableSide = 128;
/// Neither sun nor sky gets less than this share of the samples: each may be hidden from a point.
constexpr float kLeastShare = 0.125f;

/// The share of a disk above the horizon, by the height of its centre in radii.
double visible_share(double height) {
    if (height >= 1) return 1;
    double const h = std::max(height, -1.0);
    return 1 - (std::acos(h) - h * std::sqrt(1 - h * h)) / static_cast<double>(kPi);
}

/// Chords tell small angles apart, which cosines do not.
bool within_sun(SunSky const& s, Vec3 local) {
    return distance_squared(local, s.sun.z) <= 2.0f * s.one_minus_cos;
}

Spectrum radiance(SunSkyLight const& l, LightData const& d, Vec3 local, Wavelengths const& lambda) {
    if (!(local.z > 0.0f)) return {};
    Spectrum sum;
    if (l.sky) sum = sky_radiance(d.sun_sky->sky, local, lambda) * l.scale;
    if (l.sun && within_sun(*d.sun_sky, local)) sum += d.emission.sample(lambda);
    return sum;
}

float daylight_density(LightData const& d, Vec3 local) {
    SunSky const& s = *d.sun_sky;
    float sum = 0;
    if (s.sun_probability < 1.0f)
        sum += (1.0f - s.sun_probability) * kInvFourPi *
               d.table->distribution.pdf(equal_area_sphere_to_square(local));
    if (s.sun_probability > 0.0f && within_sun(s, local))
        sum += s.sun_probability * uniform_cone_pdf(s.one_minus_cos);
    return sum * direction_density(d, local);
}

}  // namespace

LightData prepare(SunSkyLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.direction_scale = direction_scale(d.to_world);
    auto s = std::make_shared<SunSky>();
    Vec3 const sun = normalize(l.sun_direction / max_component(abs(l.sun_direction)));
    s->sky = make_sky(l.turbidity, sun);
    s->sun = frame_from_z(sun);
    double const half = std::sin(static_cast<double>(l.sun_radius) / 2);
    double const real = std::sin(static_cast<double>(kSunRadius) / 2);
    s->one_minus_cos = static_cast<float>(2 * half * half);

    double sun_light = 0;
    double sky_light = 0;
    if (l.sun) {
        // W to klm; the light of the real sun, from the cone of this one.
        TabulatedSpd const spd = sun_spectrum(l.turbidity, sun.z);
        double const luminance = 0.683 * photometric(spd) * (real * real) / (half * half);
        d.emission = emission_spectrum(assets, spd, l.scale * static_cast<float>(luminance), -1, 1);
        double const share = visible_share(static_cast<double>(std::asin(sun.z) / l.sun_radius));
        sun_light =
            static_cast<double>(d.emission.max_value()) * share * 4 * static_cast<double>(kPi) * half * half;
    }
    if (l.sky) {
        std::vector<float> f;
        double sum = 0;
        constexpr int sub = 4;
        for (int y = 0; y < kTableSide; ++y)
            for (int x = 0; x < kTableSide; ++x) {
                float value = 0;
                for (int j = 0; j < sub; ++j)
                    for (int i = 0; i < sub; ++i)
                        value +=
                            sky_color(s->sky,
                                      equal_area_square_to_sphere(
                                          {(static_cast<float>(x * sub + i) + 0.5f) / (kTableSide * sub),
                                           (static_cast<float>(y * sub + j) + 0.5f) / (kTableSide * sub)}))
                                .z;
                f.push_back(value);
                sum += static_cast<double>(value) / (sub * sub);
            }
        d.table =
            std::make_shared<EnvironmentTable>(EnvironmentTable{Distribution2D(f, kTableSide, kTableSide)});
        float const white =
            emission_spectrum(assets, RgbIlluminantSpd{{1, 1, 1}}, l.scale, -1, 1).max_value();
        sky_light =
            sum * 4 * static_cast<double>(kPi) / (kTableSide * kTableSide) * static_cast<double>(white);
    }
    if (l.sun && l.sky && sun_light + sky_light > 0)
        s->sun_probability =
            clamp(static_cast<float>(sun_light / (sun_light + sky_light)), kLeastShare, 1 - kLeastShare);
    else
        s->sun_probability = l.sky ? 0.0f : 1.0f;
    s->mean_radiance = static_cast<float>((sun_light + sky_light) / (4 * static_cast<double>(kPi)));
    d.sun_sky = std::move(s);
    return d;
}

std::optional<LightSample> sample_light(SunSkyLight const& l, LightData const& d, Assets const&, Vec3, Vec2 u,
                                        Wavelengths const& lambda) {
    std::optional<LightSample> result;
    SunSky const& s = *d.sun_sky;
    float const p = s.sun_probability;
    Vec3 const direction =
        u.x < p
            ? s.sun.from_local(square_to_uniform_cone({min(u.x / p, kOneMinusEpsilon), u.y}, s.one_minus_cos))
            : equal_area_square_to_sphere(
                  d.table->distribution.sample({min((u.x - p) / (1.0f - p), kOneMinusEpsilon), u.y}));
    // What is said of the direction is said of its rounded self, so that whoever meets it again finds the same.
    Vec3 const wi = normalize(d.to_world.vector(direction));
    Vec3 const local = local_direction(d, wi);
    float const pdf = daylight_density(d, local);
    if (!(pdf > 0.0f)) return result;
    LightSample& sample = result.emplace();
    sample.at_infinity = true;
    sample.wi = wi;
    sample.pdf = pdf;
    sample.radiance = radiance(l, d, local, lambda);
    return result;
}

Spectrum environment_radiance(SunSkyLight const& l, LightData const& d, Assets const&, Vec3, Vec3 w,
                              Wavelengths const& lambda) {
    return radiance(l, d, local_direction(d, w), lambda);
}

float environment_pdf(SunSkyLight const&, LightData const& d, Vec3, Vec3 w) {
    return daylight_density(d, local_direction(d, w));
}

float power(SunSkyLight const&, LightData const& d, Assets const&, BoundingSphere const& scene) {
    return 4.0f * kPi * (kPi * sqr(scene.radius)) * d.sun_sky->mean_radiance;
}

std::optional<EmissionSample> sample_emission(SunSkyLight const& l, LightData const& d, Assets const& assets,
                                              BoundingSphere const& scene, Vec2 u_position, Vec2 u_direction,
                                              Wavelengths const& lambda) {
    auto const from = sample_light(l, d, assets, scene.centre, u_direction, lambda);
    if (!from || from->radiance.is_black()) return std::nullopt;
    return emission_from_infinity(scene, from->wi, from->radiance, from->pdf, false, u_position);
}

EmissionDensity emission_density(SunSkyLight const& l, LightData const& d, BoundingSphere const& scene,
                                 Vec3 p, Vec3 w) {
    return {disk_density(scene, p, w), environment_pdf(l, d, scene.centre, -w)};
}

std::optional<LightBounds> light_bounds(SunSkyLight const&, LightData const&, Assets const&) {
    return std::nullopt;
}

}  // namespace nephroid
