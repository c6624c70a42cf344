// The creature is where a field is 0: tapered capsules, blended by a minimum without a crease. The field is made into triangles by
// surface nets (Gibson 1998, "Constrained Elastic Surface Nets"): one point in each cell that the surface crosses, brought onto the
// surface along the gradient, and one quadrilateral around each edge that it crosses. With half as many triangles as marching
// tetrahedra need for the same detail there are no slivers. Normals are gradients.
// Ties between diagonals are settled by a margin, lest the last bit of somebody else's arithmetic choose.
#include "creature.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <stdexcept>
#include <utility>

namespace meshes {

namespace {

/// From a sphere of radius ra around a to one of radius rb around b, which melts into what came before it over the width `blend`.
struct Limb {
    Vec3 a;
    double ra;
    Vec3 b;
    double rb;
    double blend;
};

double distance(Limb const& l, Vec3 p) {
    Vec3 const along = l.b - l.a;
    double const length2 = glm::dot(along, along);
    double const t = length2 > 0 ? std::clamp(glm::dot(p - l.a, along) / length2, 0.0, 1.0) : 0;
    return glm::length(p - l.a - t * along) - (l.ra + t * (l.rb - l.ra));
}

// Quilez's quadratic minimum: it differs from the least by a quarter of `blend` at most.
double blended(double a, double b, double blend) {
    double const h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - h * h * blend / 4;
}

std::vector<Limb> limbs() {
    std::vector<Limb> l;
    auto const add = [&](Vec3 a, double ra, Vec3 b, double rb, double blend) {
        l.push_back({a, ra, b, rb, blend});
    };
    // Rump, neck, head, snout with a chin.
    add({-0.36, 0, 0.60}, 0.36, {0.28, 0, 0.66}, 0.30, 0.10);
    add({0.36, 0, 0.74}, 0.24, {0.66, 0.05, 1.14}, 0.16, 0.22);
    add({0.68, 0.06, 1.24}, 0.225, {0.80, 0.08, 1.22}, 0.20, 0.10);
    add({0.84, 0.09, 1.18}, 0.165, {1.13, 0.15, 1.11}, 0.125, 0.12);
    add({0.82, 0.09, 1.10}, 0.11, {1.06, 0.14, 1.02}, 0.085, 0.05);
    // The tail sinks, then curls up and aside.
    add({-0.58, 0, 0.55}, 0.25, {-0.98, 0.03, 0.37}, 0.16, 0.2);
    add({-0.98, 0.03, 0.37}, 0.16, {-1.28, 0.16, 0.29}, 0.105, 0.06);
    add({-1.28, 0.16, 0.29}, 0.105, {-1.50, 0.36, 0.36}, 0.07, 0.05);
    add({-1.50, 0.36, 0.36}, 0.07, {-1.58, 0.52, 0.52}, 0.04, 0.04);
    for (double const side : {-1.0, 1.0}) {
        // Thighs, shins and feet behind; legs and feet in front, one step ahead of the other.
        double const step = 0.07 * side;
        add({-0.40, 0.22 * side, 0.50}, 0.23, {-0.36 - step, 0.31 * side, 0.16}, 0.125, 0.10);
        add({-0.36 - step, 0.31 * side, 0.12}, 0.12, {-0.20 - step, 0.33 * side, 0.09}, 0.09, 0.05);
        add({0.28, 0.20 * side, 0.50}, 0.165, {0.34 + step, 0.27 * side, 0.15}, 0.11, 0.10);
        add({0.34 + step, 0.27 * side, 0.11}, 0.11, {0.47 + step, 0.28 * side, 0.085}, 0.085, 0.05);
        // Eyes that bulge, and nostrils.
        Vec3 const eye{0.86, 0.09 + 0.135 * side, 1.335};
        add(eye, 0.075, eye, 0.075, 0.03);
        Vec3 const nostril{1.19, 0.165 + 0.062 * side, 1.205};
        add(nostril, 0.035, nostril, 0.035, 0.05);
        // Small horns.
        add({0.60, 0.05 + 0.11 * side, 1.40}, 0.06, {0.50, 0.05 + 0.16 * side, 1.57}, 0.022, 0.06);
    }
    // Spikes along the back: where they stand, where they point, how long they are.
    struct Spike {
        Vec3 at, to;
        double length;
    };
    for (Spike const& s : {Spike{{0.50, 0.04, 1.16}, {-0.75, 0, 0.66}, 0.20},
                           {{0.31, 0.01, 0.97}, {-0.6, 0, 0.8}, 0.25},
                           {{0.06, 0, 0.93}, {-0.3, 0, 0.95}, 0.29},
                           {{-0.22, 0, 0.93}, {-0.25, 0, 0.97}, 0.30},
                           {{-0.50, 0, 0.88}, {-0.45, 0, 0.89}, 0.27},
                           {{-0.75, 0.01, 0.68}, {-0.5, 0, 0.87}, 0.23},
                           {{-0.98, 0.03, 0.51}, {-0.4, -0.05, 0.92}, 0.18},
                           {{-1.21, 0.12, 0.39}, {-0.3, -0.1, 0.95}, 0.14}}) {
        Vec3 const to = glm::normalize(s.to);
        add(s.at - 0.05 * to, 0.30 * s.length, s.at + s.length * to, 0.032, 0.05);
    }
    return l;
}

class Field {
  public:
    [[nodiscard]] double operator()(Vec3 p) const {
        double d = 1e9;
        for (Limb const& l : limbs_) d = blended(d, distance(l, p), l.blend);
        return d;
    }
    [[nodiscard]] Vec3 gradient(Vec3 p) const {
        constexpr double e = 1e-5;
        auto const along = [&](Vec3 step) { return ((*this)(p + step) - (*this)(p - step)) / (2 * e); };
        return {along({e, 0, 0}), along({0, e, 0}), along({0, 0, e})};
    }

  private:
    std::vector<Limb> limbs_ = limbs();
};

// Corners of cells are at kLow + kCell * (i, j, k).
constexpr Vec3 kLow{-1.72, -0.56, -0.08};
constexpr double kCell = 0.0361;
constexpr std::array<int, 3> kCorners{86, 37, 51};

int index(int i, int j, int k) { return (k * kCorners[1] + j) * kCorners[0] + i; }
Vec3 corner(int i, int j, int k) { return kLow + kCell * Vec3(i, j, k); }

class Net {
  public:
    Mesh make() {
        sample();
        add_points();
        add_faces();
        check_closed();
        return std::move(mesh_);
    }

  private:
    void sample() {
        for (int k = 0; k < kCorners[2]; ++k)
            for (int j = 0; j < kCorners[1]; ++j)
                for (int i = 0; i < kCorners[0]; ++i) values_.push_back(field_(corner(i, j, k)));
    }
    [[nodiscard]] double value(int i, int j, int k) const {
        return values_[static_cast<std::size_t>(index(i, j, k))];
    }

    void add_points() {
        points_.assign(values_.size(), -1);
        for (int k = 0; k + 1 < kCorners[2]; ++k)
            for (int j = 0; j + 1 < kCorners[1]; ++j)
                for (int i = 0; i + 1 < kCorners[0]; ++i) add_point(i, j, k);
    }

    /// The mean of the crossings on the cell's edges, then three steps of Newton's.
    void add_point(int i, int j, int k) {
        Vec3 sum{0};
        int crossings = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 4; ++side) {
                std::array<int, 3> a{i, j, k};
                a[static_cast<std::size_t>((axis + 1) % 3)] += side & 1;
                a[static_cast<std::size_t>((axis + 2) % 3)] += side >> 1;
                std::array<int, 3> b = a;
                ++b[static_cast<std::size_t>(axis)];
                double const at_a = value(a[0], a[1], a[2]), at_b = value(b[0], b[1], b[2]);
                if ((at_a < 0) == (at_b < 0)) continue;
                double const t = at_a / (at_a - at_b);
                sum += (1 - t) * corner(a[0], a[1], a[2]) + t * corner(b[0], b[1], b[2]);
                ++crossings;
            }
        if (crossings == 0) return;
        Vec3 p = sum / double(crossings);
        for (int step = 0; step < 3; ++step) {
            Vec3 const g = field_.gradient(p);
            p -= field_(p) * g / glm::dot(g, g);
        }
        points_[static_cast<std::size_t>(index(i, j, k))] = static_cast<std::int32_t>(mesh_.p.size());
        mesh_.p.push_back(p);
        mesh_.n.push_back(glm::normalize(field_.gradient(p)));
    }

    void add_faces() {
        for (int k = 1; k + 1 < kCorners[2]; ++k)
            for (int j = 1; j + 1 < kCorners[1]; ++j)
                for (int i = 1; i + 1 < kCorners[0]; ++i)
                    for (int axis = 0; axis < 3; ++axis) add_face({i, j, k}, axis);
    }

    /// Around the edge that leaves this corner along the axis: counter-clockwise as seen from its far end.
    void add_face(std::array<int, 3> at, int axis) {
        std::array<int, 3> far = at;
        ++far[static_cast<std::size_t>(axis)];
        bool const inside = value(at[0], at[1], at[2]) < 0;
        if (inside == (value(far[0], far[1], far[2]) < 0)) return;
        std::array<std::int32_t, 4> q{};
        constexpr std::array<std::array<int, 2>, 4> around{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
        for (std::size_t c = 0; c < 4; ++c) {
            std::array<int, 3> cell = at;
            cell[static_cast<std::size_t>((axis + 1) % 3)] += around[c][0];
            cell[static_cast<std::size_t>((axis + 2) % 3)] += around[c][1];
            q[c] = points_[static_cast<std::size_t>(index(cell[0], cell[1], cell[2]))];
        }
        if (!inside) std::swap(q[1], q[3]);
        auto const between = [&](std::size_t a, std::size_t b) {
            return glm::length(mesh_.p[static_cast<std::size_t>(q[a])] -
                               mesh_.p[static_cast<std::size_t>(q[b])]);
        };
        if (between(1, 3) < between(0, 2) - 1e-6) {
            mesh_.triangles.push_back({q[0], q[1], q[3]});
            mesh_.triangles.push_back({q[1], q[2], q[3]});
        } else {
            mesh_.triangles.push_back({q[0], q[1], q[2]});
            mesh_.triangles.push_back({q[0], q[2], q[3]});
        }
    }

    /// Each edge once in each direction: closed, and where cells are ambiguous nets may not be.
    void check_closed() const {
        std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
        for (auto const& t : mesh_.triangles)
            for (std::size_t c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
        for (auto const& [edge, count] : edges)
            if (count != 1 || !edges.contains({edge.second, edge.first}))
                throw std::logic_error("the creature's surface is not closed");
        for (auto const& t : mesh_.triangles) {
            auto const p = [&](std::size_t c) { return mesh_.p[static_cast<std::size_t>(t[c])]; };
            if (glm::dot(glm::cross(p(1) - p(0), p(2) - p(0)), mesh_.n[static_cast<std::size_t>(t[0])]) <= 0)
                throw std::logic_error("a triangle of the creature faces inwards");
        }
    }

    Field field_;
    std::vector<double> values_;
    std::vector<std::int32_t> points_;
    Mesh mesh_;
};

}  // namespace

Mesh creature() { return Net().make(); }

}  // namespace meshes
