// A slide projector: a picture through a window before a point (PBRT 4th ed., 12.2.2).
#include "light_kinds.h"

#include "spectrum/color.h"

#include <cmath>

namespace nephroid {

namespace {

/// Where a direction of light space goes through the picture; nothing beside it. The picture's first row is at the top (+y).
std::optional<Vec2> to_picture(LightData const& d, Vec3 local) {
    std::optional<Vec2> result;
    if (!(local.z > 0.0f)) return result;
    Vec2 const st{0.5f + 0.5f * local.x / (local.z * d.window.x),
                  0.5f - 0.5f * local.y / (local.z * d.window.y)};
    if (st.x >= 0.0f && st.x <= 1.0f && st.y >= 0.0f && st.y <= 1.0f) result.emplace(st);
    return result;
}
Vec3 to_direction(LightData const& d, Vec2 st) {
    return normalize(Vec3{(2.0f * st.x - 1.0f) * d.window.x, (1.0f - 2.0f * st.y) * d.window.y, 1.0f});
}
/// d(solid angle) / d(square): the window's area at distance 1, seen at an angle and from further away.
float element(LightData const& d, Vec3 local) {
    return 4.0f * d.window.x * d.window.y * local.z * local.z * local.z;
}
/// Of a triangle seen from the origin (Van Oosterom & Strackee 1983).
double solid_angle(Vec3 a, Vec3 b, Vec3 c) {
    auto const at = [](Vec3 u, Vec3 v) { return static_cast<double>(dot(u, v)); };
    double const la = std::sqrt(at(a, a));
    double const lb = std::sqrt(at(b, b));
    double const lc = std::sqrt(at(c, c));
    double const volume = std::abs(static_cast<double>(dot(a, cross_accurate(b - a, c - a))));
    return 2 * std::atan2(volume, la * lb * lc + at(a, b) * lc + at(b, c) * la + at(c, a) * lb);
}
/// Of a texel of the picture, seen in the world: exact, also for few large ones and for transforms that change angles.
double solid_angle(LightData const& d, int width, int height, Texel t) {
    auto const corner = [&](int i, int j) {
        float const s = static_cast<float>(t.x + i) / static_cast<float>(width);
        float const v = static_cast<float>(t.y + j) / static_cast<float>(height);
        return d.to_world.vector({(2.0f * s - 1.0f) * d.window.x, (1.0f - 2.0f * v) * d.window.y, 1.0f});
    };
    return solid_angle(corner(0, 0), corner(1, 0), corner(0, 1)) +
           solid_angle(corner(1, 1), corner(1, 0), corner(0, 1));
}
Vec3 colour(ProjectionLight const& l, Assets const& assets, Texel at) {
    return max(assets.pyramid(l.image).texel_rgb(0, at.x, at.y), Vec3{0.0f});
}
Spectrum intensity(ProjectionLight const& l, LightData const& d, Assets const& assets, Vec3 w,
                   Wavelengths const& lambda) {
    auto const st = to_picture(d, local_direction(d, w));
    if (!st) return {};
    Vec3 const rgb = colour(l, assets, nearest_texel(assets.pyramid(l.image).level(0), *st));
    return rgb_to_spectrum(rgb, SpectrumRole::Unbounded, lambda) * d.emission.sample(lambda);
}
float beam_density(LightData const& d, Vec3 w) {
    Vec3 const local = local_direction(d, w);
    auto const st = to_picture(d, local);
    return st ? d.table->distribution.pdf(*st) / element(d, local) * direction_density(d, local) : 0.0f;
}

}  // namespace

LightData prepare(ProjectionLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.position = d.to_world.point({0, 0, 0});
    d.direction = normalize(d.to_world.vector({0, 0, 1}));
    d.direction_scale = direction_scale(d.to_world);
    Image const& image = assets.pyramid(l.image).level(0);
    int const width = image.width();
    int const height = image.height();
    float const half = std::tan(l.fov / 2.0f);  // of the shorter side
    float const aspect = static_cast<float>(width) / static_cast<float>(height);
    d.window = aspect > 1.0f ? Vec2{half * aspect, half} : Vec2{half, half / aspect};
    std::vector<float> f;
    double sum = 0;
    double lumens = 0;
    double const texels = static_cast<double>(width) * height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Vec3 const rgb = colour(l, assets, {x, y});
            float const mean = (rgb.x + rgb.y + rgb.z) / 3.0f;
            // As a share of the square: the mean of d(solid angle) / d(square) over the texel.
            auto const there = static_cast<float>(solid_angle(d, width, height, {x, y}) * texels);
            d.peak = std::max({d.peak, rgb.x, rgb.y, rgb.z});
            f.push_back(mean * there);
            sum += static_cast<double>(f.back());
            lumens += static_cast<double>(luminance(rgb) * there);
        }
    d.flux = static_cast<float>(sum / texels);
    d.table = std::make_shared<EnvironmentTable>(EnvironmentTable{Distribution2D(f, width, height), {}, {}});
    // Colours of the picture are shares of sRGB's white.
    d.emission = emission_spectrum(assets, RgbIlluminantSpd{{1, 1, 1}}, l.scale, l.power, lumens / texels);
    return d;
}

std::optional<LightSample> sample_light(ProjectionLight const& l, LightData const& d, Assets const& assets,
                                        Vec3 p, Vec2, Wavelengths const& lambda) {
    return sample_from_point(d, p, intensity(l, d, assets, p - d.position, lambda));
}

float power(ProjectionLight const&, LightData const& d, Assets const&, BoundingSphere const&) {
    return d.emission.max_value() * d.flux;
}

std::optional<EmissionSample> sample_emission(ProjectionLight const& l, LightData const& d,
                                              Assets const& assets, BoundingSphere const&, Vec2,
                                              Vec2 u_direction, Wavelengths const& lambda) {
    Vec3 const local = to_direction(d, d.table->distribution.sample(u_direction));
    Vec3 const w = normalize(d.to_world.vector(local));
    return emission_from_point(d, w, intensity(l, d, assets, w, lambda), beam_density(d, w));
}

EmissionDensity emission_density(ProjectionLight const&, LightData const& d, BoundingSphere const&, Vec3,
                                 Vec3 w) {
    return {0.0f, beam_density(d, w)};
}

std::optional<LightBounds> light_bounds(ProjectionLight const&, LightData const& d, Assets const&) {
    float const intensity = d.emission.max_value() * d.peak;
    // A transform that changes angles would change those of the window as well.
    if (d.direction_scale != 0.0f) return bounds_at_point(d, intensity);
    float const corner = std::atan(std::sqrt(sqr(d.window.x) + sqr(d.window.y)));
    return bounds_at_point(d, intensity, d.direction, corner, kSharpEdge);
}

}  // namespace nephroid
