#include "world/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {

namespace {

/// cos(max(0, a - b)) from sines and cosines, a and b in [0, pi].
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
/// sin(max(0, a - b)).
float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

// --- building: bounds of crowds -------------------------------------------------------------------------------------

float angle_of(float cosine) { return std::acos(clamp(cosine, -1.0f, 1.0f)); }

Vec3 rotated(Vec3 v, Vec3 axis, float angle) {  // Rodrigues; the axis is a unit vector
    float const c = std::cos(angle);
    return v * c + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1.0f - c));
}

/// The smallest cone around both (PBRT 4th ed., 3.8.4).
void unite_cones(LightBounds& a, Vec3 axis, float cos_normals) {
    float const theta_a = angle_of(a.cos_normals);
    float const theta_b = angle_of(cos_normals);
    float const between = angle_between(a.axis, axis);
    if (std::fmin(between + theta_b, kPi) <= theta_a) return;
    if (std::fmin(between + theta_a, kPi) <= theta_b) {
        a.axis = axis;
        a.cos_normals = cos_normals;
        return;
    }
    float const half = (theta_a + between + theta_b) / 2.0f;
    Vec3 const turn = cross(a.axis, axis);
    float const length2 = length_squared(turn);
    if (half >= kPi || !(length2 > 0.0f)) {
        a.cos_normals = -1.0f;
        return;
    }
    a.axis = normalize(rotated(a.axis, turn / std::sqrt(length2), half - theta_a));
    a.cos_normals = std::cos(half);
}

void unite(LightBounds& a, LightBounds const& b) {
    if (!(b.intensity > 0.0f)) return;
    if (!(a.intensity > 0.0f)) {
        a = b;
        return;
    }
    a.box.add(b.box);
    // Of a two-sided light either side will do: take the nearer one.
    bool const turn = a.two_sided && b.two_sided && dot(a.axis, b.axis) < 0.0f;
    unite_cones(a, turn ? -b.axis : b.axis, b.cos_normals);
    a.cos_emission = std::fmin(a.cos_emission, b.cos_emission);
    a.intensity += b.intensity;
    a.two_sided = a.two_sided || b.two_sided;
}

/// The measure of a crowd's spread (Conty & Kulla 2018, eqs. 1 and 2): intensity, solid angle that it shines into, and extent.
/// A share of the diagonal keeps the extent of a row of lights from being 0.
float spread(LightBounds const& b) {
    if (!(b.intensity > 0.0f)) return 0.0f;
    float const theta_o = angle_of(b.cos_normals);
    float const theta_w = std::fmin(theta_o + angle_of(b.cos_emission), kPi);
    float const sin_o = std::sin(theta_o);
    float const directions = kTwoPi * (1.0f - b.cos_normals) +
                             kPiOver2 * (2.0f * theta_w * sin_o - std::cos(theta_o - 2.0f * theta_w) -
                                         2.0f * theta_o * sin_o + b.cos_normals);
    Vec3 const d = b.box.diagonal();
    float const extent = d.x * d.y + d.y * d.z + d.z * d.x + 0.0625f * length_squared(d);
    return b.intensity * directions * extent;
}

constexpr int kBuckets = 12;
constexpr int kDeep = 48;

struct Split {
    float cost = kInfinity;
    int axis = 0, bucket = 0;
};

}  // namespace

class LightTreeBuilder {
  public:
    LightTreeBuilder(LightTree& tree, std::span<LightBounds const> bounds) : tree_(tree), bounds_(bounds) {
        for (std::uint32_t i = 0; i < bounds.size(); ++i)
            if (bounds[i].intensity > 0.0f) order_.push_back(i);
        tree.order_.assign(bounds.size(), LightTree::kNone);
        if (order_.empty()) return;
        tree.nodes_.reserve(2 * order_.size());
        tree.nodes_.resize(1);
        build(0, 0, order_.size(), 0);
    }

  private:
    Vec3 centre(std::uint32_t light) const { return bounds_[light].box.centre(); }

    LightBounds build(std::uint32_t node, std::size_t begin, std::size_t end, int depth) {
        LightBounds all;
        if (end - begin == 1) {
            std::uint32_t const light = order_[begin];
            all = bounds_[light];
            fill(node, all, begin, end);
            tree_.nodes_[node].link = LightTree::kLeaf | light;
            tree_.order_[light] = static_cast<std::uint32_t>(begin);
            return all;
        }
        // Lights whose distances grow like powers would make a tree as deep as they are many: halves end that.
        std::size_t const middle = depth < kDeep ? split(begin, end) : begin + (end - begin) / 2;
        auto const first = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.resize(tree_.nodes_.size() + 2);
        all = build(first, begin, middle, depth + 1);
        unite(all, build(first + 1, middle, end, depth + 1));
        fill(node, all, begin, end);
        tree_.nodes_[node].link = first;
        return all;
    }

    void fill(std::uint32_t index, LightBounds const& b, std::size_t begin, std::size_t end) {
        LightTree::Node& n = tree_.nodes_[index];
        n.centre = b.box.centre();
        n.radius2 = 0.25f * length_squared(b.box.diagonal());
        n.axis = b.axis;
        n.intensity = b.intensity;
        n.cos_normals = b.cos_normals;
        n.sin_normals = safe_sqrt(1.0f - sqr(b.cos_normals));
        n.cos_emission = b.cos_emission;
        n.two_sided = b.two_sided;
        n.begin = static_cast<std::uint32_t>(begin);
        n.count = static_cast<std::uint32_t>(end - begin);
    }

    /// Puts [begin, end) in an order in which [begin, middle) and [middle, end) are the children.
    std::size_t split(std::size_t begin, std::size_t end) {
        std::size_t const halves = begin + (end - begin) / 2;
        Bounds3 centres;
        Bounds3 box;
        for (std::size_t i = begin; i < end; ++i) {
            centres.add(centre(order_[i]));
            box.add(bounds_[order_[i]].box);
        }
        Vec3 const width = centres.diagonal();
        if (end - begin == 2 || !(max_component(width) > 0.0f)) return halves;
        Split best;
        for (int axis = 0; axis < 3; ++axis)
            if (width[axis] > 0.0f) try_axis(begin, end, axis, centres, box.diagonal(), best);
        if (!(best.cost < kInfinity)) return halves;
        auto const begin_it = order_.begin() + static_cast<std::ptrdiff_t>(begin);
        auto const end_it = order_.begin() + static_cast<std::ptrdiff_t>(end);
        auto const middle = std::partition(begin_it, end_it, [&](std::uint32_t light) {
            return bucket(light, best.axis, centres) <= best.bucket;
        });
        return begin + static_cast<std::size_t>(middle - begin_it);
    }

    int bucket(std::uint32_t light, int axis, Bounds3 const& centres) const {
        float const x =
            (centre(light)[axis] - centres.lo[axis]) / (centres.hi[axis] - centres.lo[axis]) * kBuckets;
        return std::clamp(static_cast<int>(x), 0, kBuckets - 1);
    }

    void try_axis(std::size_t begin, std::size_t end, int axis, Bounds3 const& centres, Vec3 width,
                  Split& best) {
        std::array<LightBounds, kBuckets> buckets;
        for (std::size_t i = begin; i < end; ++i)
            unite(buckets[static_cast<std::size_t>(bucket(order_[i], axis, centres))], bounds_[order_[i]]);
        // Costs of all that is left of each cut and of all that is right of it.
        std::array<float, kBuckets> left{};
        LightBounds sum;
        for (std::size_t i = 0; i + 1 < kBuckets; ++i) {
            unite(sum, buckets[i]);
            left[i] = spread(sum);
        }
        sum = {};
        // Long boxes are cut across.
        float const across = max_component(width) / width[axis];
        for (std::size_t i = kBuckets - 1; i > 0; --i) {
            unite(sum, buckets[i]);
            if (!(sum.intensity > 0.0f)) continue;
            float const cost = across * (left[i - 1] + spread(sum));
            if (cost < best.cost) best = {cost, axis, static_cast<int>(i) - 1};
        }
    }

    LightTree& tree_;
    std::span<LightBounds const> bounds_;
    std::vector<std::uint32_t> order_;
};

LightTree::LightTree(std::span<LightBounds const> bounds) {
    LightTreeBuilder const builder(*this, bounds);
    nodes_.shrink_to_fit();
}

std::size_t LightTree::bytes() const {
    return nodes_.size() * sizeof(Node) + order_.size() * sizeof(std::uint32_t);
}

/// What the crowd may send to the receiver at most, up to a factor (Conty & Kulla 2018, eq. 3): intensity / d^2, with the
/// cosines that the most favourable light of it could have.
float LightTree::importance(Node const& node, Receiver const& to) {
    Vec3 const from_light = to.p - node.centre;
    float const d2 = length_squared(from_light);
    float const near2 = max(d2, node.radius2);
    if (!(near2 > 0.0f)) return 0.0f;
    // Within the sphere a light may be in any direction.
    bool const inside = d2 <= node.radius2;
    Vec3 const w = d2 > 0.0f ? from_light * (1.0f / std::sqrt(d2)) : Vec3{0, 0, 1};
    // theta_b: half of the angle that the crowd fills as the receiver sees it.
    float const sin2_b = inside ? 0.0f : node.radius2 / d2;
    float const sin_b = std::sqrt(sin2_b);
    float const cos_b = inside ? -1.0f : std::sqrt(1.0f - sin2_b);
    // theta' = theta_w - theta_o - theta_b: the least angle between a normal and the direction to the receiver.
    float cos_w = dot(node.axis, w);
    if (node.two_sided) cos_w = std::abs(cos_w);
    float const sin_w = safe_sqrt(1.0f - cos_w * cos_w);
    float const cos_x = cos_of_difference(sin_w, cos_w, node.sin_normals, node.cos_normals);
    float const sin_x = sin_of_difference(sin_w, cos_w, node.sin_normals, node.cos_normals);
    float const cos_least = cos_of_difference(sin_x, cos_x, sin_b, cos_b);
    if (cos_least <= node.cos_emission) return 0.0f;
    // Surfaces emit by a cosine; what shines farther round than they do is no surface.
    float value = node.intensity / near2;
    if (!inside && node.cos_emission >= 0.0f) value *= cos_least;
    // The receiver's own cosine, by the same reasoning.
    float cos_i = -dot(to.n, w);
    if (to.n != Vec3(0)) {
        if (to.both_sides) cos_i = std::abs(cos_i);
        float const sin_i = safe_sqrt(1.0f - cos_i * cos_i);
        value *= inside ? 1.0f : max(cos_of_difference(sin_i, cos_i, sin_b, cos_b), 0.0f);
    }
    return min(value, 1e30f);
}

/// Nodes to choose among, and what each may contribute.
struct LightTree::Front {
    static constexpr std::uint32_t kMost = 192;
    std::array<std::uint32_t, kMost> node;
    std::array<float, kMost> weight;
    std::uint32_t size = 0;
    double sum = 0;
};

/// The front below a node: all of a small node's lights; else three generations below it, and below what is near (as seen from the
/// receiver it fills a large angle, or surrounds it) as many as there is room for. It depends on the receiver alone, so that pmf()
/// finds what sample() saw.
void LightTree::gather(std::uint32_t root, Receiver const& to, Front& front) const {
    constexpr std::uint32_t kGenerations = 3;
    constexpr float kNear2 = 0.1f;  // squared radius over squared distance
    struct Open {
        std::uint32_t node, generation;
    };
    std::array<Open, Front::kMost> open;
    std::uint32_t waiting = 0;
    bool const small = nodes_[root].count <= kSmall;
    front.size = 0;
    front.sum = 0;
    open[waiting++] = {root, 0};
    while (waiting > 0) {
        Open const o = open[--waiting];
        Node const& n = nodes_[o.node];
        bool split = !(n.link & kLeaf);
        if (split && !small && o.generation >= kGenerations)
            split = n.count > kSmall && n.radius2 > kNear2 * distance_squared(to.p, n.centre);
        if (split && (o.generation == 0 || front.size + waiting + 2 <= Front::kMost)) {
            open[waiting++] = {n.link + 1, o.generation + 1};
            open[waiting++] = {n.link, o.generation + 1};
            continue;
        }
        float const w = importance(n, to);
        if (!(w > 0.0f)) continue;
        front.node[front.size] = o.node;
        front.weight[front.size] = w;
        ++front.size;
        front.sum += static_cast<double>(w);
    }
}

std::optional<LightTree::Choice> LightTree::sample(Receiver const& to, double u) const {
    std::optional<Choice> choice;
    if (nodes_.empty()) return choice;
    Front front;
    std::uint32_t at = 0;
    double pmf = 1;
    while (!(nodes_[at].link & kLeaf)) {
        gather(at, to, front);
        if (front.size == 0) return choice;
        double left = u * front.sum;
        std::uint32_t i = 0;
        while (i + 1 < front.size && left >= static_cast<double>(front.weight[i]))
            left -= static_cast<double>(front.weight[i++]);
        auto const w = static_cast<double>(front.weight[i]);
        pmf *= w / front.sum;
        u = std::clamp(left / w, 0.0, 1 - 0x1p-53);
        at = front.node[i];
    }
    choice.emplace(Choice{nodes_[at].link & ~kLeaf, static_cast<float>(pmf)});
    return choice;
}

float LightTree::pmf(Receiver const& to, std::uint32_t light) const {
    std::uint32_t const order = order_[light];
    if (order == kNone) return 0.0f;
    Front front;
    std::uint32_t at = 0;
    double pmf = 1;
    while (!(nodes_[at].link & kLeaf)) {
        gather(at, to, front);
        // The one that the light is in.
        std::uint32_t i = 0;
        while (i < front.size && order - nodes_[front.node[i]].begin >= nodes_[front.node[i]].count) ++i;
        if (i == front.size) return 0.0f;
        pmf *= static_cast<double>(front.weight[i]) / front.sum;
        at = front.node[i];
    }
    return static_cast<float>(pmf);
}

}  // namespace nephroid
