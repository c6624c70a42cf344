#include "lights.h"
#include "ies.h"
#include "shown.h"

#include "spectra.h"

#include <array>

namespace nephroid {

namespace {

constexpr auto kColour = {ParamType::Rgb, ParamType::Spectrum, ParamType::Blackbody};

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
    l.cone_angle = radians(p.number("coneangle", 30));
    l.cone_delta = radians(p.number("conedeltaangle", 5));
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

InfiniteLight infinite(Params& p) {
    InfiniteLight l;
    if (p.find("L", kColour) && p.find("filename", {ParamType::String}))
        p.fail("give either \"L\" or \"filename\", not both");
    l.radiance = emission(p, "L");
    l.image = image_of(p, &l.mapping);
    if (l.image.valid()) l.radiance = picture_white();
    l.scale = p.number("scale", 1);
    l.illuminance = output(p, "illuminance");
    if (p.find("portal", {ParamType::Point3})) p.note("portals are not used yet: the whole sky is sampled");
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
    float const fov = p.number("fov", 90);
    if (!(fov > 0 && fov < 180)) p.fail("\"fov\" must be above 0 and below 180 degrees");
    l.fov = radians(fov);
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
    if (type == "goniometric") return goniometric(p);
    if (type == "projection") return projection(p);
    if (type == "exinfinite") p.fail("\"exinfinite\" is of pbrt-v3; in pbrt-v4 it is \"infinite\"");
    p.fail("unknown light" +
           did_you_mean(type, {"point", "spot", "distant", "infinite", "goniometric", "projection"}));
}

AreaLight make_area_light(std::string const& type, Params& p) {
    if (type == "area") p.fail("\"area\" is of pbrt-v2; in pbrt-v4 it is \"diffuse\"");
    if (type != "diffuse") p.fail("unknown area light; the only one is \"diffuse\"");
    AreaLight l;
    if (p.find("L", kColour) && p.find("filename", {ParamType::String}))
        p.fail("give either \"L\" or \"filename\", not both");
    l.radiance = emission(p, "L");
    l.image = image_of(p);
    if (l.image.valid()) l.radiance = picture_white();
    l.scale = p.number("scale", 1);
    l.power = output(p, "power");
    l.two_sided = p.boolean("twosided", false);
    l.where = p.where();
    return l;
}

}  // namespace nephroid
