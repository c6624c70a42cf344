#include "water.h"

#include "math/vec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::experiment {

namespace {

// The water reaches a little into the walls, so that there is no film of air between.
constexpr float kX0 = -6, kX1 = 562, kZ0 = 1, kZ1 = 564, kLevel = 170;
constexpr int kCells = 72;

struct Wave {
    float x, z, phase, height;  // radians per mm, radians, mm
};
constexpr Wave kWaves[] = {{0.037f, 0.011f, 0.3f, 7}, {-0.014f, 0.041f, 1.9f, 6}, {0.027f, -0.045f, 4.1f, 3}};

/// Height and its slopes. The amplitude grows over 120 mm from the pane on.
struct Surface {
    float y, dx, dz;
};
Surface surface(float x, float z) {
    float const t = std::clamp((z - kZ0) / 120, 0.0f, 1.0f);
    float const grown = t * t * (3 - 2 * t), growing = 6 * t * (1 - t) / 120;
    Surface s{kLevel, 0, 0};
    for (Wave const& w : kWaves) {
        float const angle = w.x * x + w.z * z + w.phase;
        s.y += grown * w.height * std::sin(angle);
        s.dx += grown * w.height * w.x * std::cos(angle);
        s.dz += w.height * (grown * w.z * std::cos(angle) + growing * std::sin(angle));
    }
    return s;
}

}  // namespace

std::string water_in_the_box() {
    std::string points, normals, indices;
    for (int j = 0; j <= kCells; ++j)
        for (int i = 0; i <= kCells; ++i) {
            float const x = kX0 + (kX1 - kX0) * static_cast<float>(i) / kCells;
            float const z = kZ0 + (kZ1 - kZ0) * static_cast<float>(j) / kCells;
            Surface const s = surface(x, z);
            points += fmt::format(" {} {} {}", x, s.y, z);
            normals += fmt::format(" {} 1 {}", -s.dx, -s.dz);
            if (i == kCells || j == kCells) continue;
            // Counter-clockwise from above.
            int const a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
            indices += fmt::format(" {} {} {} {} {} {}", a, c, b, b, c, d);
        }
    return "AttributeBegin\nMaterial \"dielectric\" \"float eta\" 1.33\nShape \"trianglemesh\" \"point3 P\" "
           "[" +
           points + " ] \"normal N\" [" + normals + " ] \"integer indices\" [" + indices +
           fmt::format(
               " ]\nShape \"quad\" \"point3 origin\" [ {0} -1 {1} ] \"vector3 u\" [ 0 {2} 0 ] \"vector3 v\" "
               "[ {3} 0 0 ]\nAttributeEnd\n",
               kX0, kZ0, kLevel + 1, kX1 - kX0);
}

}  // namespace nephroid::experiment
