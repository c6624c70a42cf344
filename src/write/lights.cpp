// Lights, and the files of measured lamps.
#include "writer.h"

#include "scene/match.h"

#include <cmath>
#include <numbers>

namespace nephroid {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Degrees that become `angle` when they are multiplied by kDegree and rounded.
double ies_degrees(float angle, double most) {
    double const near = std::round(static_cast<double>(angle) / kDegree * 1e4) / 1e4;
    double const exact = std::min(static_cast<double>(angle) / kDegree, most);
    return static_cast<float>(near * kDegree) == angle ? near : exact;
}

/// What pictures are shares of.
bool is_white(Spd const& spd) {
    auto const* rgb = std::get_if<RgbIlluminantSpd>(&spd);
    return rgb && rgb->rgb == Vec3{1, 1, 1} && rgb->white == RgbWhite::D65;
}

/// pbrt takes 0 for "not given".
bool has_form(float power) { return power == -1 || power > 0; }

}  // namespace

/// LM-63 of 1995, type C, every plane that there is, candela as they are.
std::string Writer::lamp_file(IntensityTable const& t, SourceLocation where) {
    std::size_t const rows = t.vertical.size(), planes = t.horizontal.size();
    bool closed = t.horizontal.back() == kTwoPi;
    for (std::size_t i = 0; i < rows; ++i)
        closed = closed && t.candela[i] == t.candela[(planes - 1) * rows + i];
    if (!closed) refuse(where, "a measured lamp whose last plane is not its first one");
    std::string text =
        "IESNA:LM-63-1995\n[TEST] written from a scene\n[MANUFAC] unknown\nTILT=NONE\n1 -1 1 " +
        std::to_string(rows) + ' ' + std::to_string(planes) + " 1 2 0 0 0\n1 1 0\n";
    auto const list = [&](auto const& values, auto const& word) {
        std::size_t line = text.size();
        for (auto const& v : values) {
            if (text.size() - line > 100) text += '\n', line = text.size();
            text += word(v) + ' ';
        }
        text += '\n';
    };
    list(t.vertical, [](float a) { return text_of(ies_degrees(a, 180)); });
    list(t.horizontal, [](float a) { return text_of(ies_degrees(a, 360)); });
    list(t.candela, [](float c) { return text_of(c); });
    return part("lamp", ".ies", std::move(text));
}

void Writer::write_light(Light const& light) {
    ParamText p;
    SourceLocation const where = light.where;
    std::string space;
    auto const strength = [&](float scale, char const* name, float value) {
        p.number("scale", scale, 1);
        if (!has_form(value)) refuse(where, "a light of power 0 or below (give it a scale of 0)");
        if (value > 0) p.number(name, value);
    };
    auto const colour = [&](char const* name, Spd const& spectrum) {
        emission(p, name, spectrum, where);
        space = color_space_of(spectrum);
    };
    auto const place = [&](char const* name, Vec3 at, Vec3 otherwise) {
        if (at != otherwise) p.point(name, at);
    };
    char const* const type = match(
        light.kind,
        [&](PointLight const& l) {
            colour("I", l.intensity);
            strength(l.scale, "power", l.power);
            place("from", l.from, {0, 0, 0});
            return "point";
        },
        [&](SpotLight const& l) {
            colour("I", l.intensity);
            strength(l.scale, "power", l.power);
            place("from", l.from, {0, 0, 0});
            place("to", l.to, {0, 0, 1});
            p.angle("coneangle", l.cone_angle, !portable_);
            p.angle("conedeltaangle", l.cone_delta, !portable_);
            return "spot";
        },
        [&](DistantLight const& l) {
            colour("L", l.radiance);
            strength(l.scale, "illuminance", l.illuminance);
            place("from", l.from, {0, 0, 0});
            place("to", l.to, {0, 0, 1});
            return "distant";
        },
        [&](InfiniteLight const& l) {
            constexpr std::array<char const*, 3> kMappings{"bysize", "equalarea", "latlong"};
            if (!portable_) p.choice("mapping", kMappings[static_cast<std::size_t>(l.mapping)], "bysize");
            if (l.image.valid()) {
                if (!is_white(l.radiance)) refuse(where, "a picture of another light than white");
                p.string("filename", picture(l.image, "", where));
            } else {
                colour("L", l.radiance);
            }
            strength(l.scale, "illuminance", l.illuminance);
            if (l.portal) p.floats("point3", "portal", &(*l.portal)[0].x, 12);
            return "infinite";
        },
        [&](GoniometricLight const& l) {
            p.string("filename", picture(l.image, "", where));
            colour("I", l.intensity);
            strength(l.scale, "power", l.power);
            return "goniometric";
        },
        [&](ProjectionLight const& l) {
            p.string("filename", picture(l.image, "", where));
            p.angle("fov", l.fov, !portable_);
            strength(l.scale, "power", l.power);
            return "projection";
        },
        [&](MeasuredLight const& l) {
            p.string("filename", lamp_file(l.table, where));
            colour("I", l.intensity);
            strength(l.scale, "power", l.power);
            return "goniometric";
        },
        [&](SunSkyLight const& l) {
            p.number("turbidity", l.turbidity, 3);
            p.vector("sundirection", l.sun_direction);
            p.angle("sunsize", l.sun_radius, true);
            p.number("scale", l.scale, 1);
            p.boolean("sun", l.sun, true);
            p.boolean("sky", l.sky, true);
            return "sunsky";
        });
    std::string const text = "LightSource \"" + std::string(type) + '"' + p.text() + '\n';
    bool const plain = is_identity(light.to_world) && space.empty();
    if (plain) {
        world_ += text;
        return;
    }
    world_ += "AttributeBegin\n";
    if (!is_identity(light.to_world)) world_ += "  Transform" + matrix_text(light.to_world) + '\n';
    world_ += space + "  " + text + "AttributeEnd\n";
}

std::string Writer::area_light(AreaLight const& l) {
    ParamText p;
    std::string space;
    if (l.image.valid() && l.texture.valid()) refuse(l.where, "a light of both a picture and a texture");
    if ((l.image.valid() || l.texture.valid()) && !is_white(l.radiance))
        refuse(l.where, "a picture of another light than white");
    if (l.texture.valid()) {
        // Not as a value, which would be an emission.
        p.texture("L", texture(l.texture, SpectrumRole::Unbounded));
    } else if (l.image.valid()) {
        p.string("filename", picture(l.image, "", l.where));
    } else {
        emission(p, "L", l.radiance, l.where);
        space = color_space_of(l.radiance);
    }
    p.number("scale", l.scale, 1);
    if (!has_form(l.power)) refuse(l.where, "a light of power 0 or below (give it a scale of 0)");
    if (l.power > 0) p.number("power", l.power);
    p.boolean("twosided", l.two_sided, false);
    return space + "  AreaLightSource \"diffuse\"" + p.text() + '\n';
}

}  // namespace nephroid
