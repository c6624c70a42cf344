// Lights: directions that exist, strengths that are not negative.
#include "check.h"
#include "scene/match.h"

namespace nephroid {

namespace {

void check_strength(Check const& c, float scale, float power) {
    c.require(std::isfinite(scale) && scale >= 0, "the light's scale must be finite and not negative");
    c.require(std::isfinite(power), "the light's power or illuminance must be finite");
}
void check_direction(Check const& c, Vec3 from, Vec3 to) {
    c.require(is_finite(from) && is_finite(to), "the light's points `from` and `to` must be finite");
    c.require(from != to, "the light's points `from` and `to` are the same: give it a direction");
}

}  // namespace

void check_light(Check const& c, Light const& light) {
    check_matrix(c, light.to_world, "the light's transform");
    check_ids(c, light.kind, "the light");
    match(
        light.kind,
        [&](PointLight const& l) {
            check_spd(c, l.intensity, "the light's spectrum");
            check_strength(c, l.scale, l.power);
        },
        [&](SpotLight const& l) {
            check_spd(c, l.intensity, "the light's spectrum");
            check_strength(c, l.scale, l.power);
            check_direction(c, l.from, l.to);
            c.require(l.cone_angle > 0 && l.cone_angle <= kPi * 1.000001f,
                      "the spot light's cone must be above 0 and at most 180 degrees");
            c.require(l.cone_delta >= 0 && l.cone_delta <= l.cone_angle,
                      "the spot light's conedeltaangle must be at least 0 and at most its coneangle");
        },
        [&](DistantLight const& l) {
            check_spd(c, l.radiance, "the light's spectrum");
            check_strength(c, l.scale, l.illuminance);
            check_direction(c, l.from, l.to);
        },
        [&](InfiniteLight const& l) {
            check_spd(c, l.radiance, "the light's spectrum");
            check_strength(c, l.scale, l.illuminance);
        });
    check_finite(c, light.kind, "the light");
}

void check_area_light(Check const& c, AreaLight const& light) {
    check_ids(c, light.image, "the light");
    check_ids(c, light.texture, "the light");
    check_spd(c, light.radiance, "the light's spectrum");
    check_strength(c, light.scale, light.power);
}

}  // namespace nephroid
