#include "lights.h"
#include "ies.h"
#include "shown.h"

#include "spectra.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {

namespace {

constexpr auto kColour = {ParamType::Rgb, ParamType::Spectrum, ParamType::Blackbody, ParamType::Float};

ImageId image_of(Params& p, EnvironmentMapping* mapping = nullptr) {
    auto const name = p.string("filename", "");
    if (mapping)
        *mapping = std::array{
            EnvironmentMapping::BySize, EnvironmentMapping::EqualArea,
            EnvironmentMapping::LatLong}[p.choice("mapping", {"bysize", "equalarea", "latlong"}, 0)];
    if (name.empty()) return {};
    auto& context = p.context();
    auto const where = p.find("filename", {ParamType::String})->where;
    return context.scene.add(ImageFile{context.resolve(where, name).string(), "", where});
}

/// What a picture's rgb are shares of: the ColorSpace in force is not that of pictures, which are read as sRGB.
Spd picture_white() { return RgbIlluminantSpd{{1, 1, 1}}; }

/// Power or illuminance; as in pbrt, 0 and less count as not given.
float output(Params& p, char const* name) {
    float const value = p.number(name, -1);
    if (value > 0) return value;
    if (auto const* given = p.find(name, {ParamType::Float}))
        p.context().note(given->where,
                         p.what() + ": \"" + shown(name) + "\" is not above 0 and counts as not given");
    return -1;
}

PointLight point(Params& p) {
    PointLight l;
    l.intensity = emission(p, "I");
    l.scale = p.number("scale", 1);
    l.power = output(p, "power");
    l.from = p.point3("from", {0, 0, 0});
    return l;
}

SpotLight spot(Params& p) {
    SpotLight l;
    l.intensity = emission(p, "I");
    l.scale = p.number("scale", 1);
    l.power = output(p, "power");
    l.from = p.point3("from", {0, 0, 0});
    l.to = p.point3("to", {0, 0, 1});
    l.cone_angle = p.angle("coneangle", 30);
    l.cone_delta = p.angle("conedeltaangle", 5);
    if (l.cone_delta > l.cone_angle && l.cone_angle > 0) {
        p.note("\"conedeltaangle\" is above \"coneangle\" and was clamped to it");
        l.cone_delta = l.cone_angle;
    }
    if (l.from == l.to) p.fail("\"from\" and \"to\" are the same point: it has no direction");
    return l;
}

DistantLight distant(Params& p) {
    DistantLight l;
    l.radiance = emission(p, "L");
    l.scale = p.number("scale", 1);
    l.illuminance = output(p, "illuminance");
    l.from = p.point3("from", {0, 0, 0});
    l.to = p.point3("to", {0, 0, 1});
    if (l.from == l.to) p.fail("\"from\" and \"to\" are the same point: it has no direction");
    return l;
}

/// Corners in the world, whatever the transformation in force (pbrt-v4). That they are a rectangle is validate()'s to say.
std::array<Vec3, 4> portal_of(Params& p, Param const& given) {
    auto const points = p.points3("portal");
    if (points.size() != 4)
        p.context().fail(given.where, p.what() + ": \"portal\" has " + std::to_string(points.size()) +
                                          " points; it must have 4, the corners of a rectangle in order");
    return {points[0], points[1], points[2], points[3]};
}

InfiniteLight infinite(Params& p) {
    InfiniteLight l;
    if (p.find("L", kColour) && p.find("filename", {ParamType::String}))
        p.fail("give either \"L\" or \"filename\", not both");
    l.radiance = emission(p, "L");
    l.image = image_of(p, &l.mapping);
    if (l.image.valid()) l.radiance = picture_white();
    l.scale = p.number("scale", 1);
    l.illuminance = output(p, "illuminance");
    if (auto const* given = p.find("portal", {ParamType::Point3})) l.portal = portal_of(p, *given);
    return l;
}

SunSkyLight sun_sky(Params& p) {
    SunSkyLight l;
    float const turbidity = p.number("turbidity", l.turbidity);
    if (turbidity < 1) p.fail("\"turbidity\" is below 1, that of air without any haze; 2 is a clear day");
    l.turbidity = std::clamp(turbidity, 1.7f, 10.0f);
    if (l.turbidity != turbidity)
        p.note("the sky is known for a \"turbidity\" from 1.7 to 10: it was clamped to " +
               std::string(turbidity < 2 ? "1.7" : "10"));
    if (auto const* given = p.find("sundirection", {ParamType::Vector3})) {
        for (auto const* angle : {"elevation", "azimuth"})
            if (p.find(angle, {ParamType::Float}))
                p.context().fail(given->where, p.what() +
                                                   ": give either \"sundirection\" or \"elevation\" and "
                                                   "\"azimuth\", not both");
        l.sun_direction = p.vector3("sundirection", l.sun_direction);
    } else {
        float const elevation = p.number("elevation", 45);
        float const azimuth = radians(p.number("azimuth", 0));
        if (!(elevation >= -90 && elevation <= 90)) p.fail("\"elevation\" must be from -90 to 90 degrees");
        // Exactly in the zenith where the file says so.
        float const up = std::sin(radians(elevation));
        float const along = std::abs(elevation) == 90 ? 0.0f : std::cos(radians(elevation));
        l.sun_direction = {along * std::cos(azimuth), along * std::sin(azimuth), up};
    }
    if (l.sun_direction == Vec3{0, 0, 0}) p.fail("\"sundirection\" is (0, 0, 0): it has no direction");
    if (l.sun_direction.z < 0) {
        p.note(
            "the sun is below the horizon, where this model of the sky ends: it was raised to the horizon");
        l.sun_direction.z = 0;
        if (l.sun_direction == Vec3{0, 0, 0})
            p.fail("the sun is at the nadir: it has no place on the horizon");
    }
    l.sun_radius = p.angle("sunsize", 0.2665f);
    l.scale = p.number("scale", 1);
    l.sun = p.boolean("sun", true);
    l.sky = p.boolean("sky", true);
    return l;
}

/// The file that a light cannot do without.
std::string needed_file(Params& p, char const* what) {
    auto name = p.string("filename", "");
    if (name.empty()) p.fail(std::string("it needs a \"filename\" of ") + what);
    return name;
}

bool is_ies(std::string const& name) {
    auto extension = std::filesystem::path(name).extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return extension == ".ies";
}

LightKind measured(Params& p, std::string const& name) {
    auto& context = p.context();
    auto const where = p.find("filename", {ParamType::String})->where;
    auto const path = context.resolve(where, name);
    auto file = parse_ies(context.read_named(where, "IES file", path), path.string());
    for (auto const& note : file.notes) context.note(where, note);
    MeasuredLight l;
    l.intensity = emission(p, "I");
    l.table = std::move(file.table);
    l.scale = p.number("scale", 1);
    l.power = output(p, "power");
    return l;
}

LightKind goniometric(Params& p) {
    auto const name = needed_file(p, "a square equal-area picture, or an IES file");
    if (is_ies(name)) return measured(p, name);
    GoniometricLight l;
    l.intensity = emission(p, "I");
    l.image = image_of(p);
    l.scale = p.number("scale", 1);
    l.power = output(p, "power");
    return l;
}

ProjectionLight projection(Params& p) {
    needed_file(p, "a picture");
    ProjectionLight l;
    l.image = image_of(p);
    l.fov = p.angle("fov", 90);
    if (!(l.fov > 0 && l.fov < kPi)) p.fail("\"fov\" must be above 0 and below 180 degrees");
    l.scale = p.number("scale", 1);
    l.power = output(p, "power");
    return l;
}

}  // namespace

LightKind make_light(std::string const& type, Params& p) {
    if (type == "point") return point(p);
    if (type == "spot") return spot(p);
    if (type == "distant") return distant(p);
    if (type == "infinite") return infinite(p);
    if (type == "sunsky") return sun_sky(p);
    if (type == "goniometric") return goniometric(p);
    if (type == "projection") return projection(p);
    if (type == "exinfinite") p.fail("\"exinfinite\" is of pbrt-v3; in pbrt-v4 it is \"infinite\"");
    p.fail("unknown light" + did_you_mean(type, {"point", "spot", "distant", "infinite", "sunsky",
                                                 "goniometric", "projection"}));
}

AreaLight make_area_light(std::string const& type, Params& p, Textures& textures) {
    if (type == "area") p.fail("\"area\" is of pbrt-v2; in pbrt-v4 it is \"diffuse\"");
    if (type != "diffuse") p.fail("unknown area light; the only one is \"diffuse\"");
    AreaLight l;
    auto const* colour = p.find("L", {ParamType::Rgb, ParamType::Spectrum, ParamType::Blackbody,
                                      ParamType::Float, ParamType::Texture});
    if (colour && p.find("filename", {ParamType::String}))
        p.fail("give either \"L\" or \"filename\", not both");
    if (colour && colour->type == ParamType::Texture) {
        l.texture = textures.spectrum_param(p, "L", {}, SpectrumRole::Unbounded);
    } else {
        l.radiance = emission(p, "L");
    }
    l.image = image_of(p);
    if (l.image.valid() || l.texture.valid()) l.radiance = picture_white();
    l.scale = p.number("scale", 1);
    l.power = output(p, "power");
    l.two_sided = p.boolean("twosided", false);
    l.where = p.where();
    return l;
}

}  // namespace nephroid
