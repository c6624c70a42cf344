#include "portal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nephroid {

namespace {

using Vec = Portal::Vec;
constexpr double kPiD = std::numbers::pi;

Vec in_double(Vec3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Vec minus(Vec const& a, Vec const& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double inner(Vec const& a, Vec const& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(Vec const& a) { return std::sqrt(inner(a, a)); }
Vec times(Vec const& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Vec outer(Vec const& a, Vec const& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Components along the portal's axes.
Vec local(Portal const& p, Vec const& v) { return {inner(v, p.x), inner(v, p.y), inner(v, p.z)}; }

/// The angle with the normal along one side, as a share of the half circle.
double angle_share(double along, double normal) { return std::atan2(along, normal) / kPiD + 0.5; }

}  // namespace

std::optional<Portal> make_portal(std::array<Vec3, 4> const& corners) {
    std::optional<Portal> result;
    Vec const c0 = in_double(corners[0]), c1 = in_double(corners[1]), c2 = in_double(corners[2]),
              c3 = in_double(corners[3]);
    Vec const s01 = minus(c1, c0), s12 = minus(c2, c1), s32 = minus(c2, c3), s03 = minus(c3, c0);
    double const l01 = norm(s01), l12 = norm(s12), l32 = norm(s32), l03 = norm(s03);
    if (!(l01 > 0 && l12 > 0 && l32 > 0 && l03 > 0)) return result;
    if (!(std::abs(inner(s01, s32) / (l01 * l32) - 1) <= 1e-3) ||
        !(std::abs(inner(s12, s03) / (l12 * l03) - 1) <= 1e-3) ||
        !(std::abs(inner(s01, s03) / (l01 * l03)) <= 1e-3) ||
        !(std::abs(inner(s01, s12) / (l01 * l12)) <= 1e-3))
        return result;
    Portal& p = result.emplace();
    p.corner = c0;
    p.x = times(s03, 1 / l03);
    Vec const up = minus(s01, times(p.x, inner(s01, p.x)));
    p.height = norm(up);
    p.width = l03;
    p.y = times(up, 1 / p.height);
    p.z = outer(p.x, p.y);
    return result;
}

void tabulate(Portal& portal, int n, int points, std::function<double(Vec3)> const& radiance) {
    std::vector<double> f(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    double const step = 1.0 / (static_cast<double>(n) * points);
    double sum = 0;
    portal.flux = 0;
    for (int j = 0; j < n * points; ++j)
        for (int i = 0; i < n * points; ++i) {
            Vec3 const w = direction_through(portal, (i + 0.5) * step, (j + 0.5) * step);
            auto const at = portal_direction(portal, w);
            if (!at) continue;  // rounded into the wall
            double const value = radiance(w) * at->solid_angle * step * step;
            f[static_cast<std::size_t>(j / points) * static_cast<std::size_t>(n) +
              static_cast<std::size_t>(i / points)] += value;
            sum += value;
            portal.flux += value * at->cosine * portal.area();
        }
    // What points miss is drawn seldom, but drawn; the same share of the mean as in Distribution1D.
    double const least = 0x1p-8 * sum / (static_cast<double>(n) * n);
    std::vector<float> cells(f.size());
    std::transform(f.begin(), f.end(), cells.begin(),
                   [&](double v) { return static_cast<float>(std::max(v, least)); });
    portal.distribution = WindowedDistribution(cells, n, n);
}

std::optional<PortalDirection> portal_direction(Portal const& portal, Vec3 w) {
    std::optional<PortalDirection> result;
    Vec const v = in_double(w);
    Vec const l = times(local(portal, v), 1 / norm(v));
    if (!(l[2] > 0)) return result;
    PortalDirection& d = result.emplace();
    d.u = angle_share(l[0], l[2]);
    d.v = angle_share(l[1], l[2]);
    d.cosine = l[2];
    // PBRT 4th ed., 12.5.3: d(solid angle) / d(angles) = (1 - x^2) (1 - y^2) / z, with 1 - x^2 as y^2 + z^2.
    d.solid_angle = kPiD * kPiD * (l[1] * l[1] + l[2] * l[2]) * (l[0] * l[0] + l[2] * l[2]) / l[2];
    return result;
}

Vec3 direction_through(Portal const& portal, double u, double v) {
    double const a = std::tan((u - 0.5) * kPiD);
    double const b = std::tan((v - 0.5) * kPiD);
    double const scale = 1 / std::sqrt(a * a + b * b + 1);
    Vec3 w;
    for (int i = 0; i < 3; ++i) {
        auto const k = static_cast<std::size_t>(i);
        w[i] = static_cast<float>((a * portal.x[k] + b * portal.y[k] + portal.z[k]) * scale);
    }
    return w;
}

std::optional<SquareWindow> portal_window(Portal const& portal, Vec3 p) {
    std::optional<SquareWindow> result;
    Vec const l = local(portal, minus(portal.corner, in_double(p)));
    if (!(l[2] > 0)) return result;
    SquareWindow& w = result.emplace();
    w.x0 = angle_share(l[0], l[2]);
    w.x1 = angle_share(l[0] + portal.width, l[2]);
    w.y0 = angle_share(l[1], l[2]);
    w.y1 = angle_share(l[1] + portal.height, l[2]);
    return result;
}

Vec3 point_of(Portal const& portal, Vec2 u) {
    double const a = static_cast<double>(u.x) * portal.width;
    double const b = static_cast<double>(u.y) * portal.height;
    Vec3 p;
    for (int i = 0; i < 3; ++i) {
        auto const k = static_cast<std::size_t>(i);
        p[i] = static_cast<float>(portal.corner[k] + a * portal.x[k] + b * portal.y[k]);
    }
    return p;
}

bool passes(Portal const& portal, Vec3 p, Vec3 w) {
    Vec const o = local(portal, minus(in_double(p), portal.corner));
    Vec const d = local(portal, in_double(w));
    double const t = -o[2] / d[2];
    double const x = o[0] + t * d[0];
    double const y = o[1] + t * d[1];
    // Rays that were sent through the rectangle come back rounded: a little more than that is let in.
    double const slack = 0x1p-18 * (portal.width + portal.height + std::abs(t) * norm(d));
    return x >= -slack && x <= portal.width + slack && y >= -slack && y <= portal.height + slack;
}

}  // namespace nephroid
