// Cones and frustums as triangles: we have no cone among our shapes. Its normals are the cone's, and at the apex, where it has
// none, each facet has that of its middle.
#include "ray_shapes.h"

#include <cmath>

namespace nephroid {

namespace {

constexpr int kSegments = 256;  // a chord is 1 - cos(pi / 256) = 1/13280 of the radius inside the circle

class ConeMesh {
  public:
    ConeMesh(float height, float bottom, float top)
        : low_(std::min(0.0f, height)),
          high_(std::max(0.0f, height)),
          r_low_(height < 0 ? top : bottom),
          r_high_(height < 0 ? bottom : top) {}

    void wall() {
        double const length = std::hypot(double{high_} - double{low_}, double{r_low_} - double{r_high_});
        if (!(length > 0)) return;
        across_ = (double{high_} - double{low_}) / length;
        along_ = (double{r_low_} - double{r_high_}) / length;
        for (int i = 0; i < kSegments; ++i) {
            int const a = corner(r_low_, low_, i, i), b = corner(r_low_, low_, i + 1, i + 1);
            if (!(r_high_ > 0)) {
                add(a, b, corner(0, high_, i, i + 0.5));
            } else if (!(r_low_ > 0)) {
                // The two at the bottom are one point.
                mesh_.n[static_cast<std::size_t>(a)] = normal(i + 0.5);
                add(a, corner(r_high_, high_, i + 1, i + 1), corner(r_high_, high_, i, i));
            } else {
                int const c = corner(r_high_, high_, i + 1, i + 1), d = corner(r_high_, high_, i, i);
                add(a, b, c), add(a, c, d);
            }
        }
    }
    void cap(bool upper) {
        float const r = upper ? r_high_ : r_low_, z = upper ? high_ : low_;
        if (!(r > 0)) return;
        Vec3 const n{0, 0, upper ? 1.0f : -1.0f};
        int const centre = vertex({0, 0, z}, n);
        for (int i = 0; i < kSegments; ++i) {
            int const a = vertex(point(r, z, i), n), b = vertex(point(r, z, i + 1), n);
            upper ? add(centre, a, b) : add(centre, b, a);
        }
    }
    TriangleMesh take() { return std::move(mesh_); }

  private:
    static double angle(double step) { return step * (2 * kPiDouble / kSegments); }
    /// The last one is the first, to the bit.
    static Vec3 point(float r, float z, int step) {
        double const phi = angle(step % kSegments);
        return {static_cast<float>(double{r} * std::cos(phi)), static_cast<float>(double{r} * std::sin(phi)),
                z};
    }
    [[nodiscard]] Vec3 normal(double step) const {
        double const phi = angle(step);
        return {static_cast<float>(across_ * std::cos(phi)), static_cast<float>(across_ * std::sin(phi)),
                static_cast<float>(along_)};
    }
    int vertex(Vec3 p, Vec3 n) {
        mesh_.p.push_back(p);
        mesh_.n.push_back(n);
        return static_cast<int>(mesh_.p.size() - 1);
    }
    int corner(float r, float z, int step, double normal_step) {
        return vertex(point(r, z, step), normal(normal_step));
    }
    void add(int a, int b, int c) { mesh_.triangles.emplace_back(a, b, c); }

    float low_, high_, r_low_, r_high_;
    double across_ = 1, along_ = 0;
    TriangleMesh mesh_;
};

}  // namespace

TriangleMesh cone_mesh(float height, float bottom, float top, bool capped) {
    ConeMesh cone(height, bottom, top);
    cone.wall();
    if (capped) cone.cap(false), cone.cap(true);
    return cone.take();
}

}  // namespace nephroid
