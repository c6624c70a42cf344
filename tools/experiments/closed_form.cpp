#include "closed_form.h"

#include <algorithm>
#include <cmath>

namespace nephroid::experiment {

double polygon_irradiance(Vec3 receiver, std::vector<Point> const& corners) {
    Point const origin{receiver.x, receiver.y, receiver.z};
    std::vector<Point> above;  // relative to the receiver, cut at the horizon
    for (std::size_t i = 0; i < corners.size(); ++i) {
        Point a;
        Point b;
        for (std::size_t k = 0; k < 3; ++k) {
            a[k] = corners[i][k] - origin[k];
            b[k] = corners[(i + 1) % corners.size()][k] - origin[k];
        }
        if (a[2] >= 0) above.push_back(a);
        if (a[2] * b[2] < 0) {
            double const t = a[2] / (a[2] - b[2]);
            above.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), 0});
        }
    }
    double sum = 0;
    for (std::size_t i = 0; i < above.size(); ++i) {
        Point const& a = above[i];
        Point const& b = above[(i + 1) % above.size()];
        Point const n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        double const sine = std::hypot(n[0], n[1], n[2]);
        // The angle of the edge, times the z of the normal of its plane.
        if (sine > 0) sum += std::atan2(sine, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * n[2] / sine;
    }
    // Counter-clockwise from the front is clockwise around the direction of view.
    return std::max(0.0, -sum / 2);
}

double parallelogram_irradiance(Vec3 receiver, Point origin, Point u, Point v) {
    auto const corner = [&](double s, double t) {
        return Point{origin[0] + s * u[0] + t * v[0], origin[1] + s * u[1] + t * v[1],
                     origin[2] + s * u[2] + t * v[2]};
    };
    return polygon_irradiance(receiver, {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)});
}

double box_irradiance(Vec3 receiver, Point lo, Point hi) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::size_t const a = (axis + 1) % 3;
        std::size_t const b = (axis + 2) % 3;
        Point u{};
        Point v{};
        u[a] = hi[a] - lo[a], v[b] = hi[b] - lo[b];
        Point top = lo;
        top[axis] = hi[axis];
        sum += parallelogram_irradiance(receiver, top, u, v);  // u x v is +axis
        sum += parallelogram_irradiance(receiver, lo, v, u);   // -axis
    }
    return sum;
}

double fresnel_reflectance(double cosine, std::complex<double> index) {
    std::complex<double> const sine =
        std::sqrt(1 - cosine * cosine) / index;                        // of the refracted ray: Snell's law
    std::complex<double> const inside = std::sqrt(1.0 - sine * sine);  // its cosine
    std::complex<double> const s = (cosine - index * inside) / (cosine + index * inside);
    std::complex<double> const p = (index * cosine - inside) / (index * cosine + inside);
    return (std::norm(s) + std::norm(p)) / 2;
}

}  // namespace nephroid::experiment
