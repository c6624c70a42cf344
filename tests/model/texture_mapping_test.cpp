// Mappings against finite differences of themselves, over their seams too.
#include "model/texture_mapping.h"

#include "support.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Mat4 some_matrix() { return translate(1, -2, 0.5) * rotate(40, 1, 2, 3).value() * scale(0.5, 2, 1.5); }

/// Turns that differ by a whole one are the same.
double turn_difference(float a, float b) {
    double const d = static_cast<double>(a) - static_cast<double>(b);
    return d - std::round(d);
}

struct Probe {
    TextureMapping mapping;
    Transform to_texture;
    int turn = -1;  // which coordinate is an angle

    [[nodiscard]] MappedPoint operator()(Vec3 p, Vec3 dpdx = Vec3{0}, Vec3 dpdy = Vec3{0}) const {
        TexturePoint at;
        at.p = p, at.dpdx = dpdx, at.dpdy = dpdy;
        return map_point(mapping, to_texture, at);
    }
    /// The derivative of coordinate i along d, by a difference over 2 h.
    [[nodiscard]] double difference(int i, Vec3 p, Vec3 d, float h) const {
        float const after = (*this)(p + h * d).st[i], before = (*this)(p - h * d).st[i];
        double const change = i == turn ? turn_difference(after, before)
                                        : static_cast<double>(after) - static_cast<double>(before);
        return change / (2 * static_cast<double>(h));
    }
};

std::vector<Probe> probes() {
    Transform const t = make_transform(some_matrix()).value();
    return {{SphericalMapping{some_matrix()}, t, 1},
            {CylindricalMapping{some_matrix()}, t, 0},
            {PlanarMapping{some_matrix(), {1, 0.5f, -2}, {0.3f, 0, 1}, 0.25f, -3}, t}};
}

}  // namespace

TEST_CASE("footprints in (s, t) are the mappings' derivatives along the footprint in space") {
    Random r(1);
    for (Probe const& probe : probes()) {
        CAPTURE(probe.mapping.index());
        for (int i = 0; i < 2000; ++i) {
            // A point in texture space away from the axis, where a difference is a derivative.
            float const height = static_cast<float>(r.uniform(-2, 2));
            double const phi = r.uniform(-kPiD, kPiD), radius = r.uniform(0.5, 2);
            Vec3 const p =
                probe.to_texture.point_inverse({static_cast<float>(radius * std::cos(phi)),
                                                static_cast<float>(radius * std::sin(phi)), height});
            Vec3 const dx = random_direction(r), dy = random_direction(r);
            MappedPoint const m = probe(p, dx, dy);
            for (int k = 0; k < 2; ++k) {
                CHECK(std::abs(static_cast<double>(m.dst_dx[k]) - probe.difference(k, p, dx, 2e-3f)) < 2e-3);
                CHECK(std::abs(static_cast<double>(m.dst_dy[k]) - probe.difference(k, p, dy, 2e-3f)) < 2e-3);
            }
        }
    }
}

TEST_CASE("on the seam the footprint is as small as beside it") {
    // Spherical: where the azimuth is 0, a plain difference of t is -1. Cylindrical: where it is pi.
    for (Probe const& probe : probes()) {
        if (probe.turn < 0) continue;
        float const side = probe.turn == 1 ? 1.0f : -1.0f;
        for (float const y : {-1e-6f, 0.0f, 1e-6f}) {
            Vec3 const p = probe.to_texture.point_inverse({side, y, 0.3f});
            Vec3 const across = 0.1f * probe.to_texture.vector_inverse({0, 1, 0});
            MappedPoint const m = probe(p, across);
            CHECK(std::abs(m.dst_dx[probe.turn]) == doctest::Approx(0.1 / (2 * kPiD)).epsilon(1e-3));
        }
    }
}

TEST_CASE("on the axis of a mapping everything is finite") {
    for (Probe const& probe : probes())
        for (float const z : {-1.0f, 0.0f, 1.0f}) {
            MappedPoint const m =
                probe(probe.to_texture.point_inverse({0, 0, z}), {0.1f, 0, 0}, {0, 0.1f, 0});
            for (int k = 0; k < 2; ++k) {
                CHECK(std::isfinite(m.st[k]));
                CHECK(!std::isnan(m.dst_dx[k] + m.dst_dy[k]));
            }
        }
    // Exactly there, in a space that rounds nothing: theta is 0 and pi, and nothing is known of the footprint.
    Probe const plain{SphericalMapping{}, Transform{}, 1};
    CHECK(plain({0, 0, 2}).st.x == 0);
    CHECK(plain({0, 0, -2}).st.x == doctest::Approx(1));
    for (Vec3 const p : {Vec3{0, 0, 2}, Vec3{0}}) {
        MappedPoint const m = plain(p, {1, 0, 0}, {0, 1, 0});
        CHECK(m.dst_dx == Vec2{0});
        CHECK(m.dst_dy == Vec2{0});
    }
    // Near a pole theta keeps its digits.
    CHECK(plain({1e-5f, 0, 1}).st.x == doctest::Approx(1e-5 / kPiD).epsilon(1e-5));
}

TEST_CASE("(u, v) are scaled, and so are their footprints") {
    TexturePoint at;
    at.uv = {0.25f, 0.5f}, at.duv_dx = {0.1f, 0.2f}, at.duv_dy = {-0.3f, 0.4f};
    MappedPoint const m = map_point(UvMapping{2, 3, 0.5f, -1}, {}, at);
    CHECK(m.st == Vec2{1, 0.5f});
    CHECK(m.dst_dx == Vec2{0.2f, 0.6f});
    CHECK(m.dst_dy.x == doctest::Approx(-0.6));
    CHECK(m.dst_dy.y == doctest::Approx(1.2));
}
