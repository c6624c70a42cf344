// Lights of ours as the nearest of pbrt-v4's.
#include "portable.h"

#include "image/peek.h"
#include "scene/match.h"

#include <cmath>

namespace nephroid {

namespace {

/// The luminous flux (lm): the trapezoid rule in the horizontal angle, and in the vertical one between two
/// cosines.
float flux(IntensityTable const& t) {
    std::size_t const rows = t.vertical.size();
    double sum = 0;
    auto const cosine = [&](std::size_t i) { return std::cos(static_cast<double>(t.vertical[i])); };
    for (std::size_t h = 0; h + 1 < t.horizontal.size(); ++h)
        for (std::size_t v = 0; v + 1 < rows; ++v) {
            double const cell = (cosine(v) - cosine(v + 1)) * (static_cast<double>(t.horizontal[h + 1]) -
                                                               static_cast<double>(t.horizontal[h]));
            double mean = 0;
            for (std::size_t const at :
                 {h * rows + v, h * rows + v + 1, (h + 1) * rows + v, (h + 1) * rows + v + 1})
                mean += static_cast<double>(t.candela[at]) / 4;
            sum += cell * mean;
        }
    return static_cast<float>(sum);
}

/// pbrt-v4 has no triple of sRGB under another white.
void keep_white(Scene& scene, Spd& spd, SourceLocation where) {
    auto* rgb = std::get_if<RgbIlluminantSpd>(&spd);
    if (!rgb || rgb->white == RgbWhite::D65 || rgb->rgb == Vec3{1, 1, 1}) return;
    scene.note(where, "a light's share of D60 is replaced by the same share of D65");
    rgb->white = RgbWhite::D65;
}

/// False where it is to be left out.
bool make_light_portable(Scene& scene, Light& light) {
    auto const note = [&](char const* text) { scene.note(light.where, text); };
    LightKind const before = light.kind;
    return match(
        before,
        [&](MeasuredLight const& l) {
            note("a measured lamp is replaced by a point that shines as much to all sides");
            PointLight p{
                .intensity = l.intensity, .scale = l.scale, .power = l.power > 0 ? l.power : flux(l.table)};
            bool const shines = p.power > 0;
            light.kind = std::move(p);
            return shines;
        },
        [&](SunSkyLight const&) {
            note(
                "\"sunsky\" is left out: pbrt-v4 has no daylight; give it an environment picture and a "
                "distant light");
            return false;
        },
        [&](InfiniteLight const& l) {
            if (!l.image.valid()) return true;
            auto const size = peek_size(scene[l.image].path);
            bool const square = size && (*size)[0] == (*size)[1];
            if (l.mapping == EnvironmentMapping::LatLong ||
                (l.mapping == EnvironmentMapping::BySize && !square))
                note(
                    "the environment picture is longitude by latitude: pbrt-v4 needs it equal-area (imgtool "
                    "makeequiarea)");
            std::get<InfiniteLight>(light.kind).mapping = EnvironmentMapping::BySize;
            return true;
        },
        [](auto const&) { return true; });
}

}  // namespace

void make_lights_portable(Scene& scene) {
    std::vector<Light> kept;
    for (Light& light : scene.lights) {
        if (!make_light_portable(scene, light)) continue;
        match(light.kind, [&](auto& l) {
            if constexpr (requires { l.intensity; }) keep_white(scene, l.intensity, light.where);
            if constexpr (requires { l.radiance; }) keep_white(scene, l.radiance, light.where);
        });
        kept.push_back(std::move(light));
    }
    scene.lights = std::move(kept);
    for (Group& g : scene.groups)
        for (Object& o : g.objects)
            if (o.light) keep_white(scene, o.light->radiance, o.where);
}

}  // namespace nephroid
