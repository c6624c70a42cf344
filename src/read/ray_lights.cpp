#include "ray_lights.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

bool RayLights::is_light(std::string_view name) {
    return name == "ambient_light" || name == "directional_light" || name == "point_light" ||
           name == "area_light";
}

void RayLights::read(std::string_view name) {
    if (name == "ambient_light") return ambient_light();
    if (name == "directional_light") return directional_light();
    if (name == "point_light") return point_light();
    area_light();
}

RayAttribute RayLights::triple(std::string_view name, std::optional<Vec3>& out) {
    return {name, {}, [this, &out] { out = in_.value([this] { return in_.triple(); }); }, true};
}

RayAttribute RayLights::colour(std::string_view what, std::optional<Vec3>& out) {
    return {"color", "colour", [this, what, &out] { out = in_.value([&] { return in_.colour(what); }); },
            true};
}

RayAttribute RayLights::coefficient(std::string_view name, float& out) {
    return {name, {}, [this, name, &out] {
                auto const where = in_.here();
                out = in_.value([this] { return in_.real(); });
                if (out < 0) in_.context().fail(where, "\"" + std::string(name) + "\" must not be negative");
            }};
}

Vec3 RayLights::needed(std::optional<Vec3> const& value, std::string const& what,
                       SourceLocation where) const {
    if (!value) in_.context().fail(where, what + "; add it");
    return *value;
}

void RayLights::ambient_light() {
    auto const where = in_.here();
    std::optional<Vec3> c;
    in_.block("ambient_light", {colour("ambient_light", c)});
    Vec3 const radiance = needed(c, "ambient_light has no \"color\"", where);
    if (radiance == Vec3{0}) return;
    if (!ambient_) ambient_ = where;
    auto& context = in_.context();
    context.note(
        where,
        "ambient_light is a sky of that colour: it is seen behind everything, and does not reach inside "
        "closed rooms");
    InfiniteLight sky;
    sky.radiance = RgbIlluminantSpd{radiance};
    context.scene.add(Light{sky, {}, where});
}

void RayLights::directional_light() {
    auto const where = in_.here();
    std::optional<Vec3> c, direction;
    in_.block("directional_light", {triple("direction", direction), colour("directional_light", c)});
    DistantLight sun;
    sun.radiance = RgbIlluminantSpd{needed(c, "directional_light has no \"color\"", where)};
    sun.scale = kPi;
    sun.to = needed(direction, "directional_light has no \"direction\"", where);
    if (sun.to == Vec3{0}) in_.context().fail(where, "the direction is (0, 0, 0): say where the light goes");
    in_.context().scene.add(Light{sun, {}, where});
}

void RayLights::point_light() {
    Attenuated light;
    light.where = in_.here();
    std::optional<Vec3> c, position;
    in_.block("point_light", {triple("position", position), colour("point_light", c),
                              coefficient("constant_attenuation_coeff", light.constant),
                              coefficient("linear_attenuation_coeff", light.linear),
                              coefficient("quadratic_attenuation_coeff", light.quadratic)});
    light.colour = needed(c, "point_light has no \"color\"", light.where);
    light.position = needed(position, "point_light has no \"position\"", light.where);
    attenuated_.push_back(light);
}

void RayLights::area_light() {
    Attenuated light;
    light.where = in_.here();
    std::optional<Vec3> c, position, u, v;
    std::optional<float> radius;
    in_.block("area_light",
              {triple("position", position),
               colour("area_light", c),
               {"light_radius", {}, [&] { radius = in_.value([&] { return in_.real(); }); }, true},
               triple("u", u),
               triple("v", v),
               coefficient("constant_attenuation_coeff", light.constant),
               coefficient("linear_attenuation_coeff", light.linear),
               coefficient("quadratic_attenuation_coeff", light.quadratic)});
    auto const& context = in_.context();
    light.colour = needed(c, "area_light has no \"color\"", light.where);
    light.position = needed(position, "area_light has no \"position\"", light.where);
    if (radius.has_value() == (u || v))
        context.fail(light.where,
                     "area_light needs either \"light_radius\" (a ball), or \"u\" and \"v\" (the edges of "
                     "a parallelogram)");
    if (!radius) {
        parallelogram(light.position, light.colour, needed(u, "area_light has no \"u\"", light.where),
                      needed(v, "area_light has no \"v\"", light.where), light.where);
        return;
    }
    if (!(*radius > 0)) context.fail(light.where, "\"light_radius\" must be above 0");
    light.radius = *radius;
    attenuated_.push_back(light);
}

namespace {

/// A shape that emits and reflects nothing.
void add_emitter(Scene& scene, Shape shape, Mat4 const& to_world, AreaLight const& light) {
    auto const black =
        scene.add(Texture{ConstantSpectrumTexture{ConstantSpd{0}, SpectrumRole::Albedo}, light.where});
    Object object;
    object.shape = std::move(shape);
    object.to_group = to_world;
    object.material = scene.add(Material{DiffuseMaterial{black}, {}, light.where});
    object.light = light;
    object.where = light.where;
    scene.world().objects.push_back(std::move(object));
}

}  // namespace

void RayLights::parallelogram(Vec3 position, Vec3 colour, Vec3 u, Vec3 v, SourceLocation where) {
    AreaLight light;
    light.radiance = RgbIlluminantSpd{colour};
    light.where = where;
    add_emitter(in_.context().scene, Quad{position, u, v}, {}, light);
}

/// What the colour is to be multiplied by for an intensity: pi times d^2 times the attenuation at the scene's centre. With the
/// quadratic coefficient alone that is the same at every distance at which those programs did not clamp it.
float RayLights::intensity(Attenuated const& l, Bounds3 const& bounds) {
    auto const& context = in_.context();
    auto const sphere = bounding_sphere(bounds);
    double d = double{length(l.position - sphere.centre)};
    // A light at the very centre: as it is at the edge.
    if (!(d > 1e-3 * double{sphere.radius})) d = double{sphere.radius};
    if (!(d > 0) || !std::isfinite(d)) d = 1;
    double const sum = double{l.constant} + d * (double{l.linear} + d * double{l.quadratic});
    if (l.constant == 0 && l.linear == 0 && sum >= 1) return kPi / l.quadratic;
    double const share = sum > 1 ? 1 / sum : 1;  // those programs clamped it
    in_.context().note(l.where,
                       "light falls off with the square of the distance here: it is as bright as the "
                       "attenuation says at the centre of the scene, brighter before it and darker behind");
    auto const result = static_cast<float>(double{kPi} * d * d * share);
    if (!std::isfinite(result)) context.fail(l.where, "the light is too far away; move it towards the scene");
    return result;
}

void RayLights::finish(Bounds3 const& bounds) {
    auto& scene = in_.context().scene;
    for (auto const& l : attenuated_) {
        float const scale = intensity(l, bounds);
        if (l.radius > 0) {
            // A ball of radiance L has the intensity pi r^2 L.
            AreaLight light;
            light.radiance = RgbIlluminantSpd{l.colour};
            light.scale = scale / (kPi * sqr(l.radius));
            light.where = l.where;
            if (!std::isfinite(light.scale))
                in_.context().fail(l.where, "\"light_radius\" is too small; use a point_light");
            auto const p = l.position;
            add_emitter(scene, Sphere{l.radius, -l.radius, l.radius},
                        translate(double{p.x}, double{p.y}, double{p.z}), light);
            continue;
        }
        PointLight point;
        point.intensity = RgbIlluminantSpd{l.colour};
        point.scale = scale;
        point.from = l.position;
        scene.add(Light{point, {}, l.where});
    }
    attenuated_.clear();
}

}  // namespace nephroid
