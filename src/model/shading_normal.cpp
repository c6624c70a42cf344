// Normal maps (PBRT 4th ed., 10.5.3) and bump maps (Blinn 1978, "Simulation of Wrinkled Surfaces").
#include "model/shading_normal.h"

#include "math/frame.h"

#include <cmath>

namespace nephroid {

namespace {

/// The tangent v without its part along the unit normal n.
Vec3 across(Vec3 v, Vec3 n) { return v - n * dot(n, v); }

/// n' = (r, g, b) of the picture, 0..1 meaning -1..1, in the frame of dp/du and the shading normal. The picture's x and y may
/// be scaled (glTF). Looked up at its finest, as pbrt does: averaged normals would be those of a smoother surface.
bool from_picture(Assets const& assets, NormalMap const& map, TexturePoint const& at, SurfacePoint& s) {
    Vec3 const rgb = assets.pyramid(map.image).bilerp_rgb(0, {at.uv.x, 1.0f - at.uv.y}, Wrap::Repeat);
    Vec3 const local = (2.0f * rgb - Vec3{1.0f}) * Vec3{map.scale, map.scale, 1.0f};
    float const len = length(local);
    if (!(len > 0.0f) || !std::isfinite(len)) return false;
    s.ns = frame_from_zx(s.ns, s.dpdu).from_local(local / len);
    return true;
}

/// The surface p + d(u, v) n has the tangents dp/du + (dd/du) n + d dn/du (Blinn 1978, eq. 2), of which the last term, small
/// where the displacement is small beside the radius of curvature, is left out. The slope is taken over half a pixel.
bool from_bumps(Assets const& assets, TextureId displacement, TexturePoint const& at, SurfacePoint& s) {
    constexpr float kLeastStep = 0.0005f;  // where there is no footprint
    auto const step = [](float dx, float dy) {
        float const d = 0.5f * (std::abs(dx) + std::abs(dy));
        return d > 0.0f && std::isfinite(d) ? d : kLeastStep;
    };
    float const du = step(at.duv_dx.x, at.duv_dy.x), dv = step(at.duv_dx.y, at.duv_dy.y);
    TexturePoint along_u = at, along_v = at;
    along_u.p += du * s.dpdu;
    along_u.uv.x += du;
    along_v.p += dv * s.dpdv;
    along_v.uv.y += dv;
    float const here = evaluate_float(assets, displacement, at);
    float const slope_u = (evaluate_float(assets, displacement, along_u) - here) / du;
    float const slope_v = (evaluate_float(assets, displacement, along_v) - here) / dv;
    Vec3 const n = cross(across(s.dpdu, s.ns) + slope_u * s.ns, across(s.dpdv, s.ns) + slope_v * s.ns);
    float const len = length(n);
    if (!(len > 0.0f) || !std::isfinite(len)) return false;
    s.ns = face_forward(n / len, s.ns);
    return true;
}

}  // namespace

void perturb_normal(Assets const& assets, MaterialId id, TexturePoint const& at, SurfacePoint& s) {
    Material const& m = assets.scene()[id];
    Vec3 const before = s.ns;
    bool const turned = m.normal_map.image.valid() ? from_picture(assets, m.normal_map, at, s)
                                                   : from_bumps(assets, m.displacement, at, s);
    if (!turned) return;
    s.ns = face_forward(s.ns, before);
    s.dpdu = across(s.dpdu, s.ns);
    s.dpdv = across(s.dpdv, s.ns);
}

}  // namespace nephroid
