#include "shapes.h"

#include <algorithm>
#include <array>

namespace nephroid {

namespace {

/// Degrees from parameter phimax to radians, in (0, 2 pi].
float phi_max(Params& p) {
    float const phi = p.angle("phimax", 360);
    return phi >= radians(360) ? kTwoPi : phi;  // not rounded: a whole turn must close
}

Sphere sphere(Params& p) {
    Sphere s;
    s.radius = p.number("radius", 1);
    // Of radius 0 nothing is to be seen; drop_degenerate() leaves it out with a note.
    if (!(s.radius >= 0)) p.fail("\"radius\" must not be negative");
    float const z0 = p.number("zmin", -s.radius), z1 = p.number("zmax", s.radius);
    s.z_min = clamp(std::min(z0, z1), -s.radius, s.radius);
    s.z_max = clamp(std::max(z0, z1), -s.radius, s.radius);
    s.phi_max = phi_max(p);
    return s;
}

Cylinder cylinder(Params& p) {
    Cylinder c;
    c.radius = p.number("radius", 1);
    float const z0 = p.number("zmin", -1), z1 = p.number("zmax", 1);
    c.z_min = std::min(z0, z1), c.z_max = std::max(z0, z1);
    c.phi_max = phi_max(p);
    return c;
}

Disk disk(Params& p) {
    Disk d;
    d.height = p.number("height", 0);
    d.radius = p.number("radius", 1);
    d.inner_radius = p.number("innerradius", 0);
    d.phi_max = phi_max(p);
    return d;
}

Box box(Params& p) {
    Box const standard;
    Vec3 const a = p.point3("lo", standard.lo), b = p.point3("hi", standard.hi);
    return {min(a, b), max(a, b)};
}

Quad quad(Params& p) {
    Quad q;
    q.origin = p.point3("origin", q.origin);
    q.edge_u = p.vector3("u", q.edge_u);
    q.edge_v = p.vector3("v", q.edge_v);
    return q;
}

}  // namespace

std::optional<Shape> make_shape(std::string const& type, Params& p) {
    if (type == "trianglemesh") return triangle_mesh(p);
    if (type == "plymesh" || type == "objmesh") return mesh_from_file(p);
    if (type == "sphere") return sphere(p);
    if (type == "bilinearmesh") return bilinear_mesh(p);
    if (type == "loopsubdiv") return loop_subdivision(p);
    if (type == "cylinder") return cylinder(p);
    if (type == "disk") return disk(p);
    if (type == "box") return box(p);
    if (type == "quad") return quad(p);
    constexpr std::array<std::string_view, 6> kAbsent{"curve",      "cone",        "hyperboloid",
                                                      "paraboloid", "heightfield", "nurbs"};
    bool const known = std::find(kAbsent.begin(), kAbsent.end(), type) != kAbsent.end();
    p.note((known ? "is not rendered yet: left out" : "is an unknown shape: left out") +
           did_you_mean(type, {"trianglemesh", "plymesh", "objmesh", "sphere", "bilinearmesh", "loopsubdiv",
                               "cylinder", "disk", "box", "quad"}));
    p.ignore_all();
    return std::nullopt;
}

}  // namespace nephroid
