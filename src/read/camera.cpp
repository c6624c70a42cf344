#include "options.h"

namespace nephroid {

namespace {

PerspectiveCamera perspective_camera(Params& p) {
    float const fov = p.angle("fov", 90);
    if (!(fov > 0 && fov < kPi)) p.fail("\"fov\" must be above 0 and below 180 degrees");
    return {fov, p.number("lensradius", 0), p.number("focaldistance", 1e6f)};
}

PerspectiveCamera realistic_stand_in(Params& p) {
    constexpr float kNormalLens = 40;  // degrees, of the shorter side: about a 50 mm lens before a 35 mm film
    p.note("lens systems are not rendered yet: a pinhole camera of 40 degrees stands in");
    p.ignore_all();
    return {radians(kNormalLens), 0, p.number("focusdistance", 10)};
}

/// Those that every camera has.
void common(Params& p, Camera& camera) {
    if (auto const* f = p.find("frameaspectratio", {ParamType::Float})) {
        float const ratio = p.number("frameaspectratio", 1);
        if (!(ratio > 0)) p.context().fail(f->where, "\"frameaspectratio\" must be above 0");
        camera.frame_aspect_ratio = ratio;
    }
    if (auto const* w = p.find("screenwindow", {ParamType::Float})) {
        if (w->floats.size() != 4)
            p.context().fail(w->where, "\"screenwindow\" needs four values: x0 x1 y0 y1");
        camera.screen_window = {w->floats[0], w->floats[1], w->floats[2], w->floats[3]};
    }
    camera.exposure_time = p.number("shutterclose", 1) - p.number("shutteropen", 0);
    if (!(camera.exposure_time > 0)) p.fail("\"shutterclose\" must be after \"shutteropen\"");
}

}  // namespace

Camera make_camera(std::string const& type, Params& p, Mat4 const& world_from_camera) {
    Camera camera;
    camera.where = p.where();
    camera.to_world = world_from_camera;
    if (type == "perspective") {
        camera.kind = perspective_camera(p);
    } else if (type == "orthographic") {
        camera.kind = OrthographicCamera{p.number("lensradius", 0), p.number("focaldistance", 1e6f)};
    } else if (type == "spherical") {
        auto const mapping = p.choice("mapping", {"equalarea", "equirectangular"}, 0);
        camera.kind = SphericalCamera{mapping == 0 ? SphericalMappingKind::EqualArea
                                                   : SphericalMappingKind::EquiRectangular};
        p.find("lensradius"), p.find("focaldistance");
    } else if (type == "realistic") {
        camera.kind = realistic_stand_in(p);
    } else if (type == "environment") {
        p.fail(
            "\"environment\" is of pbrt-v3; in pbrt-v4 it is \"spherical\" with \"string mapping\" "
            "\"equirectangular\"");
    } else {
        p.fail("unknown camera" +
               did_you_mean(type, {"perspective", "orthographic", "spherical", "realistic"}));
    }
    common(p, camera);
    return camera;
}

}  // namespace nephroid
