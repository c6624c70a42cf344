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

/// A rectangle within pbrt-v4's tolerance: cosines within 0.001 of what they should be.
void check_portal(Check const& c, std::array<Vec3, 4> const& corners) {
    std::array<std::array<double, 3>, 4> side{};  // from each corner to the next
    std::array<double, 4> length{};
    for (Vec3 const corner : corners)
        c.require(is_finite(corner), "the light's portal must have finite corners");
    for (std::size_t i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k)
            side[i][static_cast<std::size_t>(k)] =
                static_cast<double>(corners[(i + 1) % 4][k]) - static_cast<double>(corners[i][k]);
        length[i] = std::sqrt(side[i][0] * side[i][0] + side[i][1] * side[i][1] + side[i][2] * side[i][2]);
        c.require(length[i] > 0, "the light's portal has two equal corners; give it four, in order");
        c.require(length[i] < 1e15, "the light's portal is wider than 1e15: make it as large as the opening");
    }
    auto const cosine = [&](std::size_t i, std::size_t j) {
        return (side[i][0] * side[j][0] + side[i][1] * side[j][1] + side[i][2] * side[j][2]) /
               (length[i] * length[j]);
    };
    c.require(cosine(0, 2) <= -0.999 && cosine(1, 3) <= -0.999 && std::abs(cosine(0, 1)) <= 1e-3 &&
                  std::abs(cosine(0, 3)) <= 1e-3,
              "the light's portal is not a rectangle; give its four corners in order");
}

void check_angles(Check const& c, std::vector<float> const& angles, float last, char const* what) {
    auto const say = [&](char const* wrong) { return std::string("the measured light's ") + what + wrong; };
    c.require(angles.size() >= 2, say(" angles must be at least two").c_str());
    c.require(angles.front() >= 0 && angles.back() <= last * 1.000001f,
              say(" angles must be within their range").c_str());
    for (std::size_t i = 1; i < angles.size(); ++i)
        c.require(angles[i] > angles[i - 1], say(" angles must increase").c_str());
}
void check_table(Check const& c, IntensityTable const& t) {
    check_finite(c, t, "the measured light");
    check_angles(c, t.vertical, kPi, "vertical");
    check_angles(c, t.horizontal, kTwoPi, "horizontal");
    c.require(t.horizontal.front() == 0 && t.horizontal.back() >= kTwoPi * 0.999999f,
              "the measured light's horizontal angles must go all the way around, from 0 to 360 degrees");
    c.require(t.candela.size() == t.vertical.size() * t.horizontal.size(),
              "the measured light must have one intensity for each pair of angles");
    for (float const cd : t.candela)
        c.require(cd >= 0, "the measured light has a negative intensity: replace it by 0 or more");
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
            if (l.portal) check_portal(c, *l.portal);
        },
        [&](SunSkyLight const& l) {
            check_strength(c, l.scale, -1);
            c.require(l.turbidity >= 1.7f && l.turbidity <= 10,
                      "the sky's turbidity must be from 1.7 (pure air) to 10 (haze)");
            c.require(is_finite(l.sun_direction) && l.sun_direction != Vec3{0, 0, 0},
                      "the direction of the sun must be finite and not (0, 0, 0)");
            c.require(l.sun_direction.z >= 0,
                      "the sun is below the horizon (z < 0), where this model of the sky ends: raise it");
            // A smaller one would be lost between the directions that floats can tell apart.
            c.require(l.sun_radius >= 2e-5f && l.sun_radius <= kPi / 4,
                      "half of the sun's angle must be from 0.00115 to 45 degrees");
            c.require(l.sun || l.sky, "a light of neither sun nor sky: leave it out, or turn on one of them");
        },
        [&](GoniometricLight const& l) {
            check_spd(c, l.intensity, "the light's spectrum");
            check_strength(c, l.scale, l.power);
            c.require(l.image.valid(), "the goniometric light needs a picture of its intensities");
        },
        [&](ProjectionLight const& l) {
            check_strength(c, l.scale, l.power);
            c.require(l.image.valid(), "the projection light needs a picture");
            c.require(l.fov > 0 && l.fov < kPi,
                      "the projection light's fov must be above 0 and below 180 degrees");
        },
        [&](MeasuredLight const& l) {
            check_spd(c, l.intensity, "the light's spectrum");
            check_strength(c, l.scale, l.power);
            check_table(c, l.table);
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
