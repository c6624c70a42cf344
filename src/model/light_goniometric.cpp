// A point with an intensity from a picture over all directions.
#include "light_kinds.h"

namespace nephroid {

namespace {

/// Light space to picture space and back: pbrt-v4 swaps y and z, so that the middle of the picture is up (+y).
Vec3 swapped(Vec3 w) { return {w.x, w.z, w.y}; }
constexpr float kElement = 4 * kPi;  // d(solid angle) / d(square): the map keeps areas

float relative(GoniometricLight const& l, Assets const& assets, Texel at) {
    Vec3 const rgb = max(assets.pyramid(l.image).texel_rgb(0, at.x, at.y), Vec3{0.0f});
    return (rgb.x + rgb.y + rgb.z) / 3.0f;
}
Spectrum intensity(GoniometricLight const& l, LightData const& d, Assets const& assets, Vec3 w,
                   Wavelengths const& lambda) {
    Vec2 const st = equal_area_sphere_to_square(swapped(local_direction(d, w)));
    Texel const at = nearest_texel(assets.pyramid(l.image).level(0), st);
    return d.emission.sample(lambda) * relative(l, assets, at);
}
/// Mean over a texel of how much a transform that changes angles widens solid angles; 1 where it does not.
float widening(LightData const& d, int side, Texel at) {
    if (d.direction_scale == 0.0f) return 1.0f;
    int const n = std::max(2, 256 / side);
    float sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            auto const within = [&](int texel, int part) {
                return (static_cast<float>(texel) +
                        (static_cast<float>(part) + 0.5f) / static_cast<float>(n)) /
                       static_cast<float>(side);
            };
            Vec2 const st{within(at.x, i), within(at.y, j)};
            sum += 1.0f / direction_density(d, swapped(equal_area_square_to_sphere(st)));
        }
    return sum / static_cast<float>(n * n);
}
float density(LightData const& d, Vec3 w) {
    Vec3 const local = local_direction(d, w);
    return d.table->distribution.pdf(equal_area_sphere_to_square(swapped(local))) / kElement *
           direction_density(d, local);
}

}  // namespace

LightData prepare(GoniometricLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.position = d.to_world.point({0, 0, 0});
    d.direction_scale = direction_scale(d.to_world);
    Image const& image = assets.pyramid(l.image).level(0);
    int const side = image.width();
    if (image.height() != side)
        assets.scene().fail(light.where, "the goniometric picture " + assets.scene()[l.image].path + " (" +
                                             std::to_string(side) + " x " + std::to_string(image.height()) +
                                             ") must be square: pbrt-v4 takes equal-area pictures "
                                             "(`imgtool makeequiarea` makes them of longitude by latitude)");
    std::vector<float> f;
    double sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float const value = relative(l, assets, {x, y});
            d.peak = std::max(d.peak, value);
            f.push_back(value * widening(d, side, {x, y}));
            sum += static_cast<double>(f.back());
        }
    double const flux = sum / static_cast<double>(f.size()) * static_cast<double>(kElement);
    d.flux = static_cast<float>(flux);
    d.table = std::make_shared<EnvironmentTable>(EnvironmentTable{Distribution2D(f, side, side), {}, {}});
    d.emission = emission_spectrum(assets, l.intensity, l.scale, l.power, flux);
    return d;
}

std::optional<LightSample> sample_light(GoniometricLight const& l, LightData const& d, Assets const& assets,
                                        Vec3 p, Vec2, Wavelengths const& lambda) {
    return sample_from_point(d, p, intensity(l, d, assets, p - d.position, lambda));
}

float power(GoniometricLight const&, LightData const& d, Assets const&, BoundingSphere const&) {
    return d.emission.max_value() * d.flux;
}

std::optional<EmissionSample> sample_emission(GoniometricLight const& l, LightData const& d,
                                              Assets const& assets, BoundingSphere const&, Vec2,
                                              Vec2 u_direction, Wavelengths const& lambda) {
    Vec2 const st = d.table->distribution.sample(u_direction);
    Vec3 const w = normalize(d.to_world.vector(swapped(equal_area_square_to_sphere(st))));
    return emission_from_point(d, w, intensity(l, d, assets, w, lambda), density(d, w));
}

EmissionDensity emission_density(GoniometricLight const&, LightData const& d, BoundingSphere const&, Vec3,
                                 Vec3 w) {
    return {0.0f, density(d, w)};
}

std::optional<LightBounds> light_bounds(GoniometricLight const&, LightData const& d, Assets const&) {
    return bounds_at_point(d, d.emission.max_value() * d.peak);
}

}  // namespace nephroid
