// Light from everywhere around: constant, or a picture by its importance.
#include "light_kinds.h"

#include "spectrum/color.h"

#include <cmath>

namespace nephroid {

namespace {

/// Picture coordinates of a direction in light space, and the other way round.
Vec2 direction_to_square(EnvironmentMapping mapping, Vec3 w) {
    if (mapping == EnvironmentMapping::EqualArea) return equal_area_sphere_to_square(w);
    float phi = std::atan2(w.y, w.x);
    if (phi < 0.0f) phi += kTwoPi;
    // Not by acos, which loses half of the digits at the poles.
    return {phi * kInvTwoPi, std::atan2(std::sqrt(sqr(w.x) + sqr(w.y)), w.z) * kInvPi};
}
Vec3 square_to_direction(EnvironmentMapping mapping, Vec2 st) {
    if (mapping == EnvironmentMapping::EqualArea) return equal_area_square_to_sphere(st);
    float const theta = st.y * kPi;
    return spherical_direction(std::sin(theta), std::cos(theta), st.x * kTwoPi);
}
/// d(solid angle) / d(square).
float solid_angle_element(EnvironmentMapping mapping, Vec2 st) {
    if (mapping == EnvironmentMapping::EqualArea) return 4.0f * kPi;
    return 2.0f * kPi * kPi * std::sin(st.y * kPi);
}
/// The same at a direction in light space: exact also at the lower pole, where 1 - st.y has few digits left.
float solid_angle_element(EnvironmentMapping mapping, Vec3 w) {
    if (mapping == EnvironmentMapping::EqualArea) return 4.0f * kPi;
    return 2.0f * kPi * kPi * std::sqrt(sqr(w.x) + sqr(w.y));
}
Wrap environment_wrap(EnvironmentMapping mapping) {
    return mapping == EnvironmentMapping::EqualArea ? Wrap::OctahedralSphere : Wrap::Repeat;
}

Vec3 environment_rgb(EnvironmentMapping mapping, Pyramid const& picture, Vec2 st) {
    if (mapping == EnvironmentMapping::LatLong) {
        // Longitude repeats, latitude ends at the poles.
        float const half_texel = 0.5f / static_cast<float>(picture.level(0).height());
        st.y = clamp(st.y, half_texel, 1.0f - half_texel);
    }
    return max(picture.bilerp_rgb(0, st, environment_wrap(mapping)), Vec3{0.0f});
}

Spectrum image_radiance(LightData const& d, Vec3 rgb, Wavelengths const& lambda) {
    // The picture's colours are relative to the illuminant of its colour space, whose spectrum d.emission is.
    return rgb_to_spectrum(rgb, SpectrumRole::Unbounded, lambda) * d.emission.sample(lambda) * d.image_scale;
}

std::shared_ptr<EnvironmentTable const> environment_table(EnvironmentMapping mapping,
                                                          Pyramid const& picture) {
    Image const& image = picture.level(0);
    int const w = image.width();
    int const h = image.height();
    std::vector<float> f(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    // The radiance is bilinear between texel centres, the table constant over texels: a texel's weight is the mean
    // of what bilinear interpolation takes over it, by a 3 x 3 grid that reaches its corners, so that no lit point has density 0.
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            float value = 0;
            for (int j = 0; j <= 2; ++j)
                for (int i = 0; i <= 2; ++i) {
                    Vec2 const st{
                        (static_cast<float>(x) + 0.5f * static_cast<float>(i)) / static_cast<float>(w),
                        (static_cast<float>(y) + 0.5f * static_cast<float>(j)) / static_cast<float>(h)};
                    Vec3 const rgb = environment_rgb(mapping, picture, st);
                    float const weight = (i == 1 ? 2.0f : 1.0f) * (j == 1 ? 2.0f : 1.0f) / 16.0f;
                    value += weight * (rgb.x + rgb.y + rgb.z) / 3.0f;
                }
            if (mapping == EnvironmentMapping::LatLong)
                value *= std::sin((static_cast<float>(y) + 0.5f) / static_cast<float>(h) * kPi);
            f[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)] =
                value;
        }
    return std::make_shared<EnvironmentTable>(EnvironmentTable{Distribution2D(f, w, h)});
}

}  // namespace

LightData prepare(InfiniteLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.volume_scale = volume_scale(d.to_world);
    double const pi = static_cast<double>(kPi);
    if (!l.image.valid()) {
        // Illuminance of a surface facing a sky of luminance 1 is pi (pbrt-v4).
        d.emission = emission_spectrum(assets, l.radiance, l.scale, l.illuminance, pi);
        return d;
    }
    Pyramid const& picture = assets.pyramid(l.image);
    int const width = picture.level(0).width();
    int const height = picture.level(0).height();
    std::string const name = "the environment picture " + assets.scene()[l.image].path + " (" +
                             std::to_string(width) + " x " + std::to_string(height) + ")";
    d.mapping = l.mapping;
    if (l.mapping == EnvironmentMapping::BySize) {
        d.mapping = width == height ? EnvironmentMapping::EqualArea : EnvironmentMapping::LatLong;
        if (width != height && width != 2 * height)
            assets.scene().fail(light.where, name +
                                                 " must be square (equal-area) or twice as wide as high "
                                                 "(longitude by latitude); say which "
                                                 "with \"string mapping\" \"equalarea\" or \"latlong\"");
    }
    if (d.mapping == EnvironmentMapping::EqualArea && width != height)
        assets.scene().fail(light.where, name + " is equal-area and must be square");
    d.emission = emission_spectrum(assets, l.radiance, 1, -1, 1);
    d.image_scale = l.scale;
    if (l.illuminance >= 0) {
        // Illuminance of the upper hemisphere (light space +z), texel by texel.
        Image const& image = picture.level(0);
        double sum = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) {
                Vec2 const st{(static_cast<float>(x) + 0.5f) / static_cast<float>(image.width()),
                              (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height())};
                Vec3 const w = square_to_direction(d.mapping, st);
                if (w.z > 0)
                    sum += static_cast<double>(luminance(environment_rgb(d.mapping, picture, st)) * w.z *
                                               solid_angle_element(d.mapping, st));
            }
        sum /= static_cast<double>(image.width()) * image.height();
        if (sum > 0) d.image_scale *= static_cast<float>(static_cast<double>(l.illuminance) / sum);
    }
    d.table = environment_table(d.mapping, picture);
    return d;
}

std::optional<LightSample> sample_light(InfiniteLight const& l, LightData const& d, Assets const& assets,
                                        Vec3, Vec2 u, Wavelengths const& lambda) {
    std::optional<LightSample> result;
    if (!l.image.valid()) {
        LightSample& s = result.emplace();
        s.at_infinity = true;
        s.wi = square_to_uniform_sphere(u);
        s.pdf = kUniformSpherePdf;
        s.radiance = d.emission.sample(lambda);
        return result;
    }
    float square_pdf = 0;
    Vec2 const st = d.table->distribution.sample(u, &square_pdf);
    float const element = solid_angle_element(d.mapping, st);
    if (!(square_pdf > 0.0f) || !(element > 0.0f)) return result;
    Vec3 const local = square_to_direction(d.mapping, st);
    LightSample& s = result.emplace();
    s.at_infinity = true;
    s.wi = normalize(d.to_world.vector(local));
    s.pdf = square_pdf / element * direction_density(d, local);
    s.radiance = image_radiance(d, environment_rgb(d.mapping, assets.pyramid(l.image), st), lambda);
    return result;
}

Spectrum environment_radiance(InfiniteLight const& l, LightData const& d, Assets const& assets, Vec3, Vec3 w,
                              Wavelengths const& lambda) {
    if (!l.image.valid()) return d.emission.sample(lambda);
    Vec2 const st = direction_to_square(d.mapping, local_direction(d, w));
    return image_radiance(d, environment_rgb(d.mapping, assets.pyramid(l.image), st), lambda);
}

float environment_pdf(InfiniteLight const& l, LightData const& d, Vec3, Vec3 w) {
    if (!l.image.valid()) return kUniformSpherePdf;
    Vec3 const local = local_direction(d, w);
    Vec2 const st = direction_to_square(d.mapping, local);
    float const element = solid_angle_element(d.mapping, local);
    return element > 0.0f ? d.table->distribution.pdf(st) / element * direction_density(d, local) : 0.0f;
}

float power(InfiniteLight const& l, LightData const& d, Assets const&, BoundingSphere const& scene) {
    float radiance = d.emission.max_value();
    if (l.image.valid()) {
        // The table's mean over the square; by latitude it holds L sin(theta), whose mean is 2/pi that of L.
        radiance *= d.image_scale * d.table->distribution.integral();
        if (d.mapping == EnvironmentMapping::LatLong) radiance *= kPiOver2;
    }
    return 4.0f * kPi * (kPi * sqr(scene.radius)) * radiance;
}

std::optional<EmissionSample> sample_emission(InfiniteLight const& l, LightData const& d,
                                              Assets const& assets, BoundingSphere const& scene,
                                              Vec2 u_position, Vec2 u_direction, Wavelengths const& lambda) {
    auto const from = sample_light(l, d, assets, scene.centre, u_direction, lambda);
    if (!from) return std::nullopt;
    // The density is asked for again, so that who follows the ray backwards gets the same one also at texels' edges.
    return emission_from_infinity(scene, from->wi, from->radiance,
                                  environment_pdf(l, d, scene.centre, from->wi), false, u_position);
}

EmissionDensity emission_density(InfiniteLight const& l, LightData const& d, BoundingSphere const& scene,
                                 Vec3 p, Vec3 w) {
    return {disk_density(scene, p, w), environment_pdf(l, d, scene.centre, -w)};
}

std::optional<LightBounds> light_bounds(InfiniteLight const&, LightData const&, Assets const&) {
    return std::nullopt;
}

}  // namespace nephroid
