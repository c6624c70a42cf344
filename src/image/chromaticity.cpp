#include "image/chromaticity.h"

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace nephroid {

namespace {

/// RGB to XYZ: the primaries' XYZ, scaled so that (1,1,1) is white of luminance 1.
std::optional<glm::dmat3> to_xyz(Chromaticities const& c) {
    auto xyz = [](Vec2 xy) { return glm::dvec3(xy.x, xy.y, 1.0 - double{xy.x} - double{xy.y}); };
    glm::dmat3 const primaries(xyz(c.r), xyz(c.g), xyz(c.b));
    double const determinant = glm::determinant(primaries);
    if (!(std::abs(determinant) > 1e-6) || !(std::abs(c.w.y) > 1e-6f)) return std::nullopt;
    glm::dvec3 const scale = glm::inverse(primaries) * (xyz(c.w) / double{c.w.y});
    glm::dmat3 const m(primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z);
    if (!(std::abs(glm::determinant(m)) > 1e-9)) return std::nullopt;  // NaN too
    return m;
}

bool close(Chromaticities const& a, Chromaticities const& b) {
    auto near = [](Vec2 p, Vec2 q) { return std::abs(p.x - q.x) < 1e-3f && std::abs(p.y - q.y) < 1e-3f; };
    return near(a.r, b.r) && near(a.g, b.g) && near(a.b, b.b) && near(a.w, b.w);
}

}  // namespace

bool convert_to_rec709(Image& image) {
    auto const r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
    if (!image.chromaticities || !r || !g || !b) return false;
    auto const from = to_xyz(*image.chromaticities);
    bool const same = close(*image.chromaticities, kRec709);
    image.chromaticities.reset();
    if (!from || same) return false;
    glm::dmat3 const m = glm::inverse(*to_xyz(kRec709)) * *from;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            glm::dvec3 const v =
                m * glm::dvec3(image.get(x, y, *r), image.get(x, y, *g), image.get(x, y, *b));
            image.set(x, y, *r, static_cast<float>(v.x));
            image.set(x, y, *g, static_cast<float>(v.y));
            image.set(x, y, *b, static_cast<float>(v.z));
        }
    return true;
}

}  // namespace nephroid
