// What throws caustics, in pieces: World::casters().
#include "scene/match.h"
#include "world/world.h"
#include "world_parts.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// More triangles than this are taken together.
constexpr std::uint64_t kMostPieces = 1u << 18;

/// Not less than how much the linear part makes a vector longer: the largest singular value s1 is below the 2^k-th root of
/// s1^2^k + s2^2^k + s3^2^k, and within 1% of it for k = 7.
float greatest_stretch(AffineMap const& map) {
    std::array<std::array<double, 3>, 3> a{};
    double scale = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            scale = std::max(scale, std::abs(static_cast<double>(map.m[i][j])));
    if (!(scale > 0)) return 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k)
                a[i][j] +=
                    static_cast<double>(map.m[k][i]) / scale * (static_cast<double>(map.m[k][j]) / scale);
    double log = 0;  // what was divided out of (A^T A)^(2^n), to the power 2^-n
    double power = 1;
    for (int n = 0; n < 6; ++n) {
        std::array<std::array<double, 3>, 3> b{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k) b[i][j] += a[i][k] * a[k][j];
        power /= 2;
        double const trace = b[0][0] + b[1][1] + b[2][2];
        log += std::log(trace) * power;
        for (auto& row : b)
            for (double& x : row) x /= trace;
        a = b;
    }
    return static_cast<float>(scale * std::exp(log / 2) * (1 + 1e-6));
}

/// Points of a piece, and how far it reaches beyond them, into the world.
struct Mapped {
    AffineMap const* place;  // null: nothing to do
    AffineMap const* instance;

    CasterPiece operator()(CasterPiece piece) const {
        for (AffineMap const* map : {place, instance}) {
            if (!map) continue;
            for (Vec3& p : piece.p) p = map->point(p);
            if (piece.reach > 0.0f) piece.reach *= greatest_stretch(*map);
        }
        return piece;
    }
};

CasterPiece ball(Vec3 centre, float radius) { return {{centre, centre, centre, centre}, radius}; }
CasterPiece ball(Bounds3 const& box) {
    BoundingSphere const s = bounding_sphere(box);
    return ball(s.centre, s.radius);
}

template <class Emit>
void pieces_of(ObjectRecord const& r, std::size_t together, Emit const& emit) {
    auto const faces = [&](auto const& mesh, auto const& list) {
        for (std::size_t i = 0; i < list.size();) {
            std::size_t const end = std::min(list.size(), i + together);
            Bounds3 box;
            CasterPiece one;
            for (; i < end; ++i) {
                auto corners = [&] {
                    if constexpr (requires { list[i].x; })
                        return std::array{list[i].x, list[i].y, list[i].z, list[i].z};
                    else
                        return list[i];
                }();
                for (std::size_t c = 0; c < 4; ++c) {
                    one.p[c] = mesh.p[static_cast<std::size_t>(corners[c])];
                    box.add(one.p[c]);
                }
            }
            emit(together == 1 ? one : ball(box));
        }
    };
    match(
        r.object->shape, [&](TriangleMesh const& m) { faces(m, m.triangles); },
        [&](BilinearMesh const& m) { faces(m, m.patches); }, [](LoopSubdivision const&) {},
        [&](Sphere const& s) {
            BoundingSphere const box = bounding_sphere(bounds(s));
            emit(box.radius < s.radius ? ball(box.centre, box.radius) : ball({0, 0, 0}, s.radius));
        },
        [&](Cylinder const& c) {
            float const half = (c.z_max - c.z_min) / 2.0f;
            emit(ball({0, 0, c.z_min + half}, std::sqrt(sqr(half) + sqr(c.radius))));
        },
        [&](Disk const& d) {
            emit(ball({0, 0, d.height}, d.radius));
        },
        [&](Box const& b) {
            emit(ball(Bounds3{b.lo, b.hi}));
        },
        [&](Quad const& q) {
            emit(CasterPiece{
                {q.origin, q.origin + q.edge_u, q.origin + q.edge_v, q.origin + q.edge_u + q.edge_v}});
        });
}

}  // namespace

std::vector<CasterPiece> World::casters() const {
    auto const casts = [&](ObjectRecord const& r) {
        return r.material.valid() && assets_->data(r.material).casts;
    };
    auto const each = [&](auto const& visit) {
        auto const group = [&](std::uint32_t first, std::uint32_t count, AffineMap const* instance) {
            for (std::uint32_t i = first; i < first + count; ++i)
                if (ObjectRecord const& r = parts_->records[i]; casts(r)) visit(r, instance);
        };
        group(parts_->first_record[0], parts_->record_count[0], nullptr);
        for (InstanceRecord const& i : parts_->instances)
            group(i.first_record, parts_->count_from(i.first_record), &i.to_world);
    };
    std::uint64_t total = 0;
    each([&](ObjectRecord const& r, AffineMap const*) { total += part_count(r); });
    std::size_t const together = static_cast<std::size_t>(total / kMostPieces + 1);
    std::vector<CasterPiece> pieces;
    each([&](ObjectRecord const& r, AffineMap const* instance) {
        Mapped const mapped{r.place ? &r.place->shape_to_group : nullptr, instance};
        pieces_of(r, together, [&](CasterPiece const& p) { pieces.push_back(mapped(p)); });
    });
    return pieces;
}

}  // namespace nephroid
