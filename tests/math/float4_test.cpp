// Four lanes make the bits that vectors make; the branch-free offset of rays is pbrt's.
#include "math/float4.h"

#include "math/ray.h"
#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool same_bits(Vec3 a, Vec3 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z); }

/// Of all sizes and signs, some coordinates 0.
Vec3 some_vector(Random& r) {
    double const size = std::exp(r.uniform(-20, 20));
    Vec3 v;
    for (int i = 0; i < 3; ++i)
        v[i] = r.uniform(0, 1) < 0.1 ? std::copysign(0.0f, static_cast<float>(r.uniform(-1, 1)))
                                     : static_cast<float>(r.uniform(-size, size));
    return v;
}

float next_by_definition(float x, float towards) {
    return towards > 0.0f ? next_float_up(x) : towards < 0.0f ? next_float_down(x) : x;
}
/// OffsetRayOrigin as PBRT 4th ed., 6.8.6 has it.
Vec3 offset_by_definition(Vec3 p, Vec3 p_error, Vec3 n, Vec3 w) {
    Vec3 offset = n * dot(abs(n), p_error);
    if (dot(w, n) < 0.0f) offset = -offset;
    Vec3 o = p + offset;
    for (int i = 0; i < 3; ++i) o[i] = next_by_definition(o[i], offset[i]);
    return o;
}

}  // namespace

TEST_CASE("lanes make the same bits as vectors") {
    Random r(21);
    for (int i = 0; i < 100'000; ++i) {
        Vec3 const a = some_vector(r);
        Vec3 const b = i % 2 ? some_vector(r) : a * static_cast<float>(r.uniform(0.999, 1.001));
        REQUIRE(same_bits(to_vec3(to_lanes(a)), a));
        REQUIRE(same_bits(to_vec3(abs(to_lanes(a))), abs(a)));
        REQUIRE(same_bits(dot(to_lanes(a), to_lanes(b)), dot(a, b)));
        REQUIRE(same_bits(length(to_lanes(a)), length(a)));
        REQUIRE(same_bits(to_vec3(cross_accurate(to_lanes(a), to_lanes(b))), cross_accurate(a, b)));
    }
}

TEST_CASE("next_float is next_float_up or next_float_down") {
    float const least = std::numeric_limits<float>::denorm_min();
    float const most = std::numeric_limits<float>::max();
    auto const check = [](float x, float towards) {
        float const next = next_float(Float4{x, 0, 0, 0}, Float4{towards, 0, 0, 0})[0];
        REQUIRE(same_bits(next, next_by_definition(x, towards)));
        REQUIRE(same_bits(next_float_towards(x, towards), next));
    };
    for (float const x :
         {0.0f, -0.0f, least, -least, 1.0f, -1.0f, kOneMinusEpsilon, -kOneMinusEpsilon, most, -most})
        for (float const towards : {0.0f, -0.0f, least, -least, 1.0f, -1.0f}) check(x, towards);
    Random r(22);
    for (int i = 0; i < 100'000; ++i) check(some_vector(r).x, some_vector(r).y);
}

TEST_CASE("offset_ray_origin without branches is the one with branches") {
    Random r(23);
    for (int i = 0; i < 200'000; ++i) {
        Vec3 const p = some_vector(r);
        Vec3 n = some_vector(r);
        if (n == Vec3(0)) n.x = 1;
        n = normalize(n);
        Vec3 const e = abs(i % 5 ? p : some_vector(r)) * static_cast<float>(r.uniform(0, 1e-5));
        Vec3 const w = some_vector(r);
        REQUIRE(same_bits(offset_ray_origin(p, e, n, w), offset_by_definition(p, e, n, w)));
        REQUIRE(same_bits(offset_of_lane(p, e, n, w), offset_by_definition(p, e, n, w)));
        // What is moved on to 0 is moved on past it.
        Vec3 const offset = n * dot(abs(n), e);
        REQUIRE(same_bits(offset_ray_origin(-offset, e, n, n), offset_by_definition(-offset, e, n, n)));
    }
}
