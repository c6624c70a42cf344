// Light from everywhere around: constant, or a picture by its importance, or what of it comes through a portal.
#include "light_kinds.h"
#include "portal.h"

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
    int const w = picture.level(0).width();
    int const h = picture.level(0).height();
    // The radiance is bilinear between texel centres, the table constant over texels.
    std::vector<float> f = cell_means(w, h, [&](Vec2 st) {
        Vec3 const rgb = environment_rgb(mapping, picture, st);
        return (rgb.x + rgb.y + rgb.z) / 3.0f;
    });
    if (mapping == EnvironmentMapping::LatLong)
        for (std::size_t i = 0; i < f.size(); ++i) {
            auto const y = static_cast<float>(i / static_cast<std::size_t>(w));
            f[i] *= std::sin((y + 0.5f) / static_cast<float>(h) * kPi);
        }
    return std::make_shared<EnvironmentTable>(EnvironmentTable{Distribution2D(f, w, h)});
}

/// All around, portal or not.
Spectrum sky_radiance(InfiniteLight const& l, LightData const& d, Assets const& assets, Vec3 w,
                      Wavelengths const& lambda) {
    if (!l.image.valid()) return d.emission.sample(lambda);
    Vec2 const st = direction_to_square(d.mapping, local_direction(d, w));
    return image_radiance(d, environment_rgb(d.mapping, assets.pyramid(l.image), st), lambda);
}

// --- through a portal -------------------------------------------------------------------------------------------------

std::shared_ptr<Portal const> prepare_portal(InfiniteLight const& l, LightData const& d, Light const& light,
                                             Assets const& assets) {
    auto portal = make_portal(*l.portal);
    if (!portal) assets.scene().fail(light.where, "the light's portal is not a rectangle");
    if (!l.image.valid()) {
        tabulate(*portal, 64, 4, [](Vec3) { return 1.0; });
    } else {
        Pyramid const& picture = assets.pyramid(l.image);
        // Of a picture of the whole sphere w texels wide, about w / 2 fall to the width of the portal's half. Larger ones
        // are added up in the table's cells, with the points at least as dense as texels.
        int const side = std::max(picture.level(0).width(), picture.level(0).height());
        int const n = std::min(std::max(side / 2, 64), 512);
        tabulate(*portal, n, std::max(2, side / n), [&](Vec3 w) {
            Vec3 const rgb =
                environment_rgb(d.mapping, picture, direction_to_square(d.mapping, local_direction(d, w)));
            return static_cast<double>((rgb.x + rgb.y + rgb.z) / 3.0f);
        });
    }
    return std::make_shared<Portal>(std::move(*portal));
}

/// Density by solid angle over a window.
float portal_pdf(Portal const& portal, SquareWindow const& window, PortalDirection const& at) {
    return static_cast<float>(portal.distribution.pdf(at.u, at.v, window) / at.solid_angle);
}

std::optional<LightSample> sample_portal(InfiniteLight const& l, LightData const& d, Assets const& assets,
                                         SquareWindow const& window, Vec2 u, Wavelengths const& lambda) {
    std::optional<LightSample> result;
    auto const place =
        d.portal->distribution.sample(static_cast<double>(u.x), static_cast<double>(u.y), window);
    if (!place) return result;
    Vec3 const w = direction_through(*d.portal, place->x, place->y);
    auto const at = portal_direction(*d.portal, w);
    if (!at) return result;  // rounded into the wall
    LightSample& s = result.emplace();
    s.at_infinity = true;
    s.wi = normalize(w);
    s.pdf = static_cast<float>(place->pdf / at->solid_angle);
    s.radiance = sky_radiance(l, d, assets, s.wi, lambda);
    return result;
}

}  // namespace

LightData prepare(InfiniteLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.direction_scale = direction_scale(d.to_world);
    double const pi = static_cast<double>(kPi);
    if (!l.image.valid()) {
        // Illuminance of a surface facing a sky of luminance 1 is pi (pbrt-v4).
        d.emission = emission_spectrum(assets, l.radiance, l.scale, l.illuminance, pi);
        if (l.portal) d.portal = prepare_portal(l, d, light, assets);
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
    if (l.portal)
        d.portal = prepare_portal(l, d, light, assets);
    else
        d.table = environment_table(d.mapping, picture);
    return d;
}

std::optional<LightSample> sample_light(InfiniteLight const& l, LightData const& d, Assets const& assets,
                                        Vec3 p, Vec2 u, Wavelengths const& lambda) {
    std::optional<LightSample> result;
    if (d.portal) {
        if (auto const window = portal_window(*d.portal, p))
            result = sample_portal(l, d, assets, *window, u, lambda);
        return result;
    }
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

Spectrum environment_radiance(InfiniteLight const& l, LightData const& d, Assets const& assets, Vec3 p,
                              Vec3 w, Wavelengths const& lambda) {
    if (d.portal) {
        auto const window = portal_window(*d.portal, p);
        auto const at = portal_direction(*d.portal, w);
        if (!window || !at || !is_inside(*window, *at)) return {};
    }
    return sky_radiance(l, d, assets, w, lambda);
}

float environment_pdf(InfiniteLight const& l, LightData const& d, Vec3 p, Vec3 w) {
    if (d.portal) {
        auto const window = portal_window(*d.portal, p);
        auto const at = portal_direction(*d.portal, w);
        return window && at ? portal_pdf(*d.portal, *window, *at) : 0.0f;
    }
    if (!l.image.valid()) return kUniformSpherePdf;
    Vec3 const local = local_direction(d, w);
    Vec2 const st = direction_to_square(d.mapping, local);
    float const element = solid_angle_element(d.mapping, local);
    return element > 0.0f ? d.table->distribution.pdf(st) / element * direction_density(d, local) : 0.0f;
}

float power(InfiniteLight const& l, LightData const& d, Assets const&, BoundingSphere const& scene) {
    float radiance = d.emission.max_value() * (l.image.valid() ? d.image_scale : 1.0f);
    if (d.portal) return radiance * static_cast<float>(d.portal->flux);
    if (l.image.valid()) {
        // The table's mean over the square; by latitude it holds L sin(theta), whose mean is 2/pi that of L.
        radiance *= d.table->distribution.integral();
        if (d.mapping == EnvironmentMapping::LatLong) radiance *= kPiOver2;
    }
    return 4.0f * kPi * (kPi * sqr(scene.radius)) * radiance;
}

std::optional<EmissionSample> sample_emission(InfiniteLight const& l, LightData const& d,
                                              Assets const& assets, BoundingSphere const& scene,
                                              Vec2 u_position, Vec2 u_direction, Wavelengths const& lambda) {
    std::optional<EmissionSample> result;
    if (d.portal) {
        // Through the rectangle, as wide as it looks from there; from as far outside as through the disk.
        auto const from = sample_portal(l, d, assets, {}, u_direction, lambda);
        auto const at = from ? portal_direction(*d.portal, from->wi) : std::nullopt;
        float const seen = at ? static_cast<float>(d.portal->area() * at->cosine) : 0.0f;
        if (!(seen > 0.0f) || !std::isfinite(1.0f / seen) || from->radiance.is_black()) return result;
        Vec3 const q = point_of(*d.portal, u_position);
        EmissionSample& s = result.emplace();
        s.ray.o = q + (scene.radius - dot(q - scene.centre, from->wi)) * from->wi;
        s.ray.d = -from->wi;
        s.radiance = from->radiance;
        s.pdf_position = 1.0f / seen;
        s.pdf_direction = portal_pdf(*d.portal, {}, *at);
        return result;
    }
    auto const from = sample_light(l, d, assets, scene.centre, u_direction, lambda);
    if (!from) return result;
    // The density is asked for again, so that who follows the ray backwards gets the same one also at texels' edges.
    result = emission_from_infinity(scene, from->wi, from->radiance,
                                    environment_pdf(l, d, scene.centre, from->wi), false, u_position);
    return result;
}

EmissionDensity emission_density(InfiniteLight const& l, LightData const& d, BoundingSphere const& scene,
                                 Vec3 p, Vec3 w) {
    if (d.portal) {
        auto const at = portal_direction(*d.portal, -w);
        if (!at) return {};
        float const seen = static_cast<float>(d.portal->area() * at->cosine);
        bool const through = seen > 0.0f && std::isfinite(1.0f / seen) && passes(*d.portal, p, w);
        return {through ? 1.0f / seen : 0.0f, portal_pdf(*d.portal, {}, *at)};
    }
    return {disk_density(scene, p, w), environment_pdf(l, d, scene.centre, -w)};
}

std::optional<LightBounds> light_bounds(InfiniteLight const&, LightData const&, Assets const&) {
    return std::nullopt;
}

}  // namespace nephroid
