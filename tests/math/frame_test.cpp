// Frames: orthonormal everywhere, and without an axis that they prefer.
#include "math/frame.h"

#include "faulty_bases.h"
#include "math/vec.h"
#include "statistics.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

Vec3 random_unit(Random& r) {
    double const z = r.uniform(-1, 1);
    double const phi = r.uniform(0, 2 * 3.14159265358979);
    double const s = std::sqrt(1 - z * z);
    return normalize(Vec3{static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                          static_cast<float>(z)});
}

double frame_fault(Frame const& f) {
    double fault = 0;
    auto const d = [](Vec3 a, Vec3 b) {
        return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y +
               static_cast<double>(a.z) * b.z;
    };
    for (Vec3 const a : {f.x, f.y, f.z}) fault = std::max(fault, std::abs(d(a, a) - 1));
    fault = std::max({fault, std::abs(d(f.x, f.y)), std::abs(d(f.y, f.z)), std::abs(d(f.z, f.x))});
    // Right-handed: x × y = z.
    return std::max(fault, static_cast<double>(length(cross(f.x, f.y) - f.z)));
}

/// Directions at a fixed polar angle and evenly stepped local azimuths, over random normals. Their directions in the world must
/// be isotropic, and so must their azimuths about the normal as seen from the world's axes.
template <class Basis>
std::pair<ChiSquare, ChiSquare> isotropy(Basis const& basis, int n, std::uint64_t seed) {
    constexpr int kZ = 16;
    constexpr int kPhi = 32;
    std::vector<double> sphere(kZ * kPhi);
    std::vector<double> azimuth(8 * 64);
    Random r(seed);
    for (int i = 0; i < n; ++i) {
        Vec3 const normal = random_unit(r);
        Frame const f = basis(normal);
        auto const phi = static_cast<float>(r.uniform(0, 2 * 3.14159265358979));
        Vec3 const w = normalize(f.from_local(spherical_direction(std::sqrt(0.75f), 0.5f, phi)));
        int const z = std::min(kZ - 1, static_cast<int>((w.z + 1) / 2 * kZ));
        double a = std::atan2(w.y, w.x) / (2 * 3.14159265358979) + 0.5;
        ++sphere[static_cast<std::size_t>(z * kPhi + std::min(kPhi - 1, static_cast<int>(a * kPhi)))];
        // Azimuth about the normal, counted from the meridian through the pole; apart for bands of the normal's height.
        Vec3 const east = normalize(cross(Vec3{0, 0, 1}, normal));
        Vec3 const north = cross(normal, east);
        a = std::atan2(dot(w, north), dot(w, east)) / (2 * 3.14159265358979) + 0.5;
        int const band = std::min(7, static_cast<int>((normal.z + 1) / 2 * 8));
        ++azimuth[static_cast<std::size_t>(band * 64 + std::min(63, static_cast<int>(a * 64)))];
    }
    std::vector<double> const e1(sphere.size(), static_cast<double>(n) / static_cast<double>(sphere.size()));
    std::vector<double> const e2(azimuth.size(),
                                 static_cast<double>(n) / static_cast<double>(azimuth.size()));
    return {chi_square(sphere, e1), chi_square(azimuth, e2)};
}

}  // namespace

TEST_CASE("frames about random normals are orthonormal and right-handed") {
    Random r(1);
    double worst = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        Vec3 const n = random_unit(r);
        worst = std::max(worst, frame_fault(frame_from_z(n)));
    }
    CHECK(worst < 1e-6);
    worst = 0;
    for (int i = 0; i < 100'000; ++i) {
        Vec3 const n = random_unit(r);
        Vec3 const t = random_unit(r) * 3.0f;
        Frame const f = frame_from_zx(n, t);
        if (length(cross(n, t)) < 0.1f) continue;
        worst = std::max(worst, frame_fault(f));
        CHECK(dot(f.x, t) > 0.0f);
        CHECK(std::abs(dot(f.y, t)) < 1e-6f);
    }
    CHECK(worst < 1e-5);  // cancellation grows as the tangent nears the normal
}

TEST_CASE("frames at and near the poles") {
    for (float const z : {1.0f, -1.0f}) {
        for (float const e : {0.0f, 1e-30f, 1e-10f, 1e-7f, 3e-5f, 2e-4f, 1e-3f, 1e-2f})
            for (float const a : {-1.0f, 0.0f, 1.0f})
                for (float const b : {-1.0f, 0.0f, 0.5f}) {
                    Vec3 const n = normalize(Vec3{a * e, b * e, z});
                    CAPTURE(n.x);
                    CAPTURE(n.y);
                    CAPTURE(n.z);
                    CHECK(frame_fault(frame_from_z(n)) < 1e-6);
                }
    }
    for (float const zero : {0.0f, -0.0f})
        for (Vec3 const n : {Vec3{1, 0, zero}, Vec3{-1, 0, zero}, Vec3{0, 1, zero}, Vec3{0, -1, zero}})
            CHECK(frame_fault(frame_from_z(n)) < 1e-6);
}

TEST_CASE("a tangent that is 0, parallel to the normal or not finite falls back") {
    Vec3 const n{0, 0.6f, 0.8f};
    for (Vec3 const t : {Vec3{0, 0, 0}, Vec3{kInfinity, 0, 0}, Vec3{NAN, 0, 0}})
        CHECK(frame_fault(frame_from_zx(n, t)) < 1e-6);
    CHECK(frame_fault(frame_from_zx({0, 0, 1}, {0, 0, 2})) < 1e-6);
}

TEST_CASE("to_local and from_local are each other's inverse") {
    Random r(2);
    for (int i = 0; i < 1000; ++i) {
        Frame const f = frame_from_z(random_unit(r));
        Vec3 const v = random_unit(r);
        CHECK(length(f.from_local(f.to_local(v)) - v) < 1e-6f);
        CHECK(f.to_local(f.z).z == doctest::Approx(1));
        CHECK(std::abs(f.to_local(v).z - dot(v, f.z)) < 1e-6f);
    }
}

TEST_CASE("a frame from a normal has no preferred axis") {
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(2);
    auto const [sphere, azimuth] = isotropy(frame_from_z, n, 3);
    INFO("directions: ", sphere);
    CHECK(sphere.p >= alpha);
    INFO("azimuths: ", azimuth);
    CHECK(azimuth.p >= alpha);
}

TEST_CASE("control: the test of preferred axes rejects the classical faulty bases") {
    CHECK(isotropy(unnormalised_basis, 200'000, 3).first.p < 1e-6);
    CHECK(isotropy(half_normalised_basis, 200'000, 3).second.p < 1e-6);
    CHECK(isotropy(skewed_basis, 200'000, 3).first.p < 1e-6);
    CHECK(isotropy(skewed_basis, 200'000, 3).second.p < 1e-6);
}
