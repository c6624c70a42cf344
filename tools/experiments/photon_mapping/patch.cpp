#include "patch.h"

#include "scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace nephroid::experiment {

namespace {

constexpr float kReflectance = 0.5f;

}  // namespace

double Patch::radiance(double x, double y) const {
    // The image of the light: (2, 0, 1). It is seen through the mirror's plane at this share of the way from there.
    double const t = 1 / (2 - x);
    double const at_y = y * t, at_z = 1 - t;
    if (at_y < y0 || at_y > y1 || at_z < z0 || at_z > z1) return 0;
    double const square = (2 - x) * (2 - x) + y * y + 1;
    return kReflectance / std::numbers::pi / (square * std::sqrt(square));
}

Setup patch_setup(Patch const& patch, int n) {
    return prepare(
        scenes::floor_view(n, n, scenes::Pixels::Points, -0.3f, 0.9f, -0.6f, 0.6f) +
        "LightSource \"point\" \"point3 from\" [ 0 0 1 ] \"rgb I\" [ 1 1 1 ]\n" +
        scenes::matte(kReflectance) + scenes::floor() +
        fmt::format(
            "Material \"conductor\" \"float roughness\" 0 \"rgb eta\" [ 0 0 0 ] \"rgb k\" [ 0 0 0 ]\n"
            "Shape \"quad\" \"point3 origin\" [ 1 {} {} ] \"vector3 u\" [ 0 {} 0 ] \"vector3 v\" [ 0 0 {} "
            "]\n",
            patch.y0, patch.z0, patch.y1 - patch.y0, patch.z1 - patch.z0));
}

Reference patch_reference(Patch const& patch, Setup const& setup) {
    return closed_form(
        setup, [&](Vec3 p) { return patch.radiance(static_cast<double>(p.x), static_cast<double>(p.y)); });
}

}  // namespace nephroid::experiment
