// The camera, and other things whose place the reader finds by inverting the current transform.
#include "writer.h"

#include "scene/match.h"

namespace nephroid {

// Inverting twice does not give back the same bits. Where it does not, the matrix itself is kept as a
// coordinate system, and the parameter "inverse" (ours) names it.
std::string Writer::inverse_transform(ParamText& p, Mat4 const& m, std::string const& name) const {
    if (is_identity(m)) return {};
    auto const back = inverse(m);
    if (!back) return {};  // validate() has refused it
    std::string const there = "Transform" + matrix_text(*back) + '\n';
    auto const again = inverse(*back);
    if (portable_ || (again && *again == m)) return there;
    p.string("inverse", name);
    return "Transform" + matrix_text(m) + "\nCoordinateSystem " + in_quotes(name) + '\n' + there;
}

void Writer::write_camera() {
    Camera const& c = scene_.camera;
    if (!(c.exposure_time > 0)) refuse(c.where, "a shutter that is never open");
    ParamText p;
    auto const lens = [&](auto const& k) {
        p.number("lensradius", k.lens_radius, 0);
        p.number("focaldistance", k.focal_distance, 1e6f);
    };
    char const* const type = match(
        c.kind,
        [&](PerspectiveCamera const& k) {
            p.angle("fov", k.fov, !portable_);
            lens(k);
            return "perspective";
        },
        [&](OrthographicCamera const& k) {
            lens(k);
            return "orthographic";
        },
        [&](SphericalCamera const& k) {
            p.string("mapping",
                     k.mapping == SphericalMappingKind::EqualArea ? "equalarea" : "equirectangular");
            return "spherical";
        });
    if (c.screen_window) p.floats("float", "screenwindow", c.screen_window->data(), 4);
    if (c.frame_aspect_ratio) p.number("frameaspectratio", *c.frame_aspect_ratio);
    p.number("shutterclose", c.exposure_time, 1);
    head_ += inverse_transform(p, c.to_world, "world from camera");
    head_ += "Camera \"" + std::string(type) + '"' + p.text() + '\n';
}

}  // namespace nephroid
