#include "caster_balls.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// Rounding must not let a piece stick out.
constexpr float kRoom = 1e-3f;
/// Two halves may cover this much more, as seen from far away, than the whole did: halves of a plate cover as much, and are
/// split for what they spare when seen from the side; halves of a ball cover 2.5 times as much.
constexpr float kMostCover = 1.3f;

struct Cluster {
    std::span<CasterPiece> pieces;
    BoundingSphere ball;
};

Vec3 middle(CasterPiece const& p) { return 0.25f * (p.p[0] + p.p[1]) + 0.25f * (p.p[2] + p.p[3]); }

Cluster cluster(std::span<CasterPiece> pieces) {
    Bounds3 box;
    for (CasterPiece const& piece : pieces)
        for (Vec3 const p : piece.p) box.add(Bounds3{p - Vec3(piece.reach), p + Vec3(piece.reach)});
    Cluster c{pieces, {box.centre(), 0}};
    float largest = 0;
    for (CasterPiece const& piece : pieces)
        for (Vec3 const p : piece.p) {
            c.ball.radius = max(c.ball.radius, distance(p, c.ball.centre) + piece.reach);
            largest = max(largest, max_component(abs(p)));
        }
    c.ball.radius = c.ball.radius * (1.0f + kRoom) + 1e-6f * largest;
    return c;
}

/// In the middle of the longest side of what holds the pieces' centres.
std::size_t split_point(std::span<CasterPiece> pieces) {
    Bounds3 box;
    for (CasterPiece const& p : pieces) box.add(middle(p));
    Vec3 const d = box.diagonal();
    int const axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
    float const half = box.centre()[axis];
    auto const below = std::partition(pieces.begin(), pieces.end(),
                                      [&](CasterPiece const& p) { return middle(p)[axis] < half; });
    return static_cast<std::size_t>(below - pieces.begin());
}

}  // namespace

std::vector<BoundingSphere> caster_balls(std::vector<CasterPiece> pieces, std::size_t most) {
    std::vector<BoundingSphere> balls;
    if (pieces.empty()) return balls;
    std::vector<Cluster> open{cluster(pieces)};
    // The largest first; what is not worth being split is done.
    while (!open.empty()) {
        auto const largest = std::max_element(
            open.begin(), open.end(),
            [](Cluster const& a, Cluster const& b) { return a.ball.radius < b.ball.radius; });
        Cluster const whole = *largest;
        open.erase(largest);
        std::size_t const at = balls.size() + open.size() + 2 <= most ? split_point(whole.pieces) : 0;
        if (at == 0 || at == whole.pieces.size()) {
            balls.push_back(whole.ball);
            continue;
        }
        Cluster const a = cluster(whole.pieces.first(at)), b = cluster(whole.pieces.subspan(at));
        if (sqr(a.ball.radius) + sqr(b.ball.radius) > kMostCover * sqr(whole.ball.radius)) {
            balls.push_back(whole.ball);
            continue;
        }
        open.push_back(a);
        open.push_back(b);
    }
    return balls;
}

}  // namespace nephroid
