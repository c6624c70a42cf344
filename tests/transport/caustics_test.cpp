// Photons behind mirrors and glass, against closed forms.
#include "emitters.h"
#include "photons.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Refracted at a plane of normal n against d; eta is outside over inside.
D3 refracted(D3 d, D3 n, double eta) {
    double const c = -dot(d, n);
    double const k = 1 - eta * eta * (1 - c * c);
    return d * eta + n * (eta * c - std::sqrt(k));
}

}  // namespace

TEST_CASE("caustics: a ball of glass in parallel light sends the shares of Fresnel's and Snell's laws") {
    // A black tube that is open towards the light keeps all that the ball sends, but for 2e-5 that goes straight back (much of it
    // by the glory: an internal reflection of light that came in at 83 degrees).
    Scene s;
    add_sphere(s, {0, 0, 0}, 1, glass(s));
    MaterialId const black = diffuse(s, 0);
    add(s, Cylinder{1.05f, -5, 2000}, black);
    add(s, Disk{-5, 1.05f}, black);
    s.add(distant({0, 0, 1}));
    World const world = compile(s);
    double const shares[] = {0.09178, 0.83554, 0.06118, 0.01149};
    double const within[] = {0.01, 0.01, 0.015, 0.03};
    int const n = samples(32000, 320000);
    double const alpha = sidak(8);
    for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
        Settings st = shot_settings(n, color, true, 32);
        std::array<Mean, 4> parts;
        for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
            st.seed = 2000 + batch;
            RenderJob const job(world, st);
            double const e = color == ColorMode::Rgb
                                 ? 1.0
                                 : static_cast<double>(world.assets().neutral_illuminant().sample(
                                       job.pass_wavelengths(0))[1]);
            Shot const shot = shot_of(world, st, ShotKind::Caustic);
            for (std::uint32_t k = 0; k < 4; ++k)
                parts[k].add(sum_of(shot.photons, 1,
                                    [&](Photon const& p) { return std::min(p.bounces(), 4u) == k + 1; }) /
                             (e * kPiD));
        }
        for (std::size_t k = 0; k < 4; ++k) {
            auto const a = agrees(parts[k], shares[k], within[k], alpha);
            // The shares have five digits, and the tube an end.
            double const off = std::abs(parts[k].mean() - shares[k]);
            CHECK_MESSAGE((a || (off < 2.5e-5 && a.powerful)), "class ", k, ": ", a);
        }
    }
}

TEST_CASE("caustics: a mirror's, of a point light") {
    Scene s;
    add(s, floor_quad(3), diffuse(s, 0.5f));
    add(s, Quad{{1, -50, 0}, {0, 0, 60}, {0, 100, 0}}, mirror(s, 1));
    s.add(point_light({0, 0, 1}, 1));
    World const world = compile(s);
    // The image of the light is at (2, 0, 1): E = h / d^3, over a disk about (1/2, 0, 0).
    constexpr double radius = 0.1;
    auto const irradiance = [](double x, double y) { return std::pow((x - 2) * (x - 2) + y * y + 1, -1.5); };
    CHECK(irradiance(0.5, 0) == doctest::Approx(0.170677).epsilon(1e-5));
    double caustic = 0, direct = 0;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
            double const r = radius * std::sqrt((i + 0.5) / 64), phi = 2 * kPiD * (j + 0.5) / 64;
            double const x = 0.5 + r * std::cos(phi), y = r * std::sin(phi);
            caustic += irradiance(x, y) / (64 * 64) * kPiD * radius * radius;
            direct += std::pow(x * x + y * y + 1, -1.5) / (64 * 64) * kPiD * radius * radius;
        }
    auto const near = [](Photon const& p) {
        Vec3 const d = p.p() - Vec3{0.5f, 0, 0};
        return p.p().z < 1e-3f && length(d) < static_cast<float>(radius);
    };
    // The mirror is one of a metal: nearly 1.
    double const alpha = sidak(4);
    for (bool const aim : {true, false}) {
        Settings const st = shot_settings(samples(64000, 640000), ColorMode::Rgb, aim);
        auto const a = agrees(batches_of(world, st, ShotKind::Caustic, near), caustic, 0.05, alpha);
        CHECK_MESSAGE(a, a);
    }
    Settings const st = shot_settings(samples(64000, 640000));
    auto const both =
        agrees(batches_of(world, st, ShotKind::Global,
                          [&](Photon const& p) { return near(p) && (p.caustic() || p.bounces() == 0); }),
               caustic + direct, 0.03, alpha);
    CHECK_MESSAGE(both, both);
}

TEST_CASE("caustics: a tilted shading normal reflects forward what a path from the eye finds") {
    double watts[2];
    for (bool const tilt : {false, true}) {
        Scene s;
        TriangleMesh patch = rectangle({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
        if (tilt) patch.n.assign(4, normalize(Vec3{0.6f, 0.1f, 1}));
        add(s, patch, diffuse(s, 0.8f));
        add(s, Quad{{0.5f, -1, 1}, {0, 2, 0}, {2, 0, 0}}, diffuse(s, 1));  // faces down
        s.add(spot_light({-0.5f, 0, 2}, {0, 0, 0}, 3, 20, 10));
        look_parallel(s, {1.5f, 0, 0.99f}, {0, 0, 1}, 1);
        World const world = compile(s);
        Means const seen =
            measure(world, settings(path(2)), static_cast<std::uint64_t>(samples(4096, 40960)));
        // A white surface's radiance is E / pi; 2 x 2 units.
        double const per_radiance = kPiD * 4;
        double const expected = seen[0][1].mean() * per_radiance;
        Mean const sent = batches_of(world, shot_settings(samples(64000, 640000)), ShotKind::Global,
                                     [](Photon const& p) { return p.bounces() == 1 && p.p().z > 0.9f; });
        double const error = std::hypot(sent.standard_error(), seen[0][1].standard_error() * per_radiance);
        CHECK(error < 0.008 * kSanitizerRoom * expected);
        CHECK_MESSAGE(student_p((sent.mean() - expected) / error, 31) > sidak(2), sent.mean(),
                      ", from the eye ", expected, " +- ", error);
        watts[tilt ? 1 : 0] = expected;
    }
    CHECK(watts[1] < 0.9 * watts[0]);  // it does matter
}

TEST_CASE("caustics: a prism's photons go where Snell's law sends their wavelength") {
    // A wedge: light falls straight on its bottom face z = 0 and leaves by one that is tilted by 25 degrees about y.
    Scene s;
    double const tilt = 25 * kPiD / 180;
    float const t = static_cast<float>(std::tan(tilt));
    TriangleMesh wedge = box_mesh({-1, -1, 0}, {1, 1, 2}, false);
    for (Vec3& p : wedge.p)
        if (p.z > 1) p.z = 1.0f + t * p.x;
    MaterialId const flint = glass(s, TabulatedSpd{{380, 500, 700}, {1.72f, 1.66f, 1.62f}});
    add(s, wedge, flint);
    add(s, Quad{{-50, -50, 60}, {100, 0, 0}, {0, 100, 0}}, diffuse(s, 0.5f));
    DistantLight sun;
    sun.from = {0.2f, 0, -1};
    sun.to = {0, 0, 0};
    s.add(Light{sun, {}, {}});
    World const world = compile(s);
    double least = 1e9, most = -1e9;
    std::size_t checked = 0;
    for (std::uint64_t pass = 0; pass < 16; ++pass) {
        Settings const st = shot_settings(2000, ColorMode::Spectral);
        RenderJob const job(world, st);
        Shot const shot = shot_of(world, st, ShotKind::Caustic, pass);
        double const n =
            static_cast<double>(world.assets().data(flint).eta.sample(job.pass_wavelengths(pass))[0]);
        double const norm = std::sqrt(0.04 + 1);
        D3 d{-0.2 / norm, 0, 1 / norm};
        d = refracted(d, {0, 0, -1}, 1 / n);
        d = refracted(d, {std::sin(tilt), 0, -std::cos(tilt)}, n);
        for (Photon const& p : shot.photons) {
            // In at the bottom and straight out at the top: the others have other directions.
            if (p.bounces() != 2 || p.wi().y * p.wi().y > 1e-6f) continue;
            D3 const w = doubles(-p.wi());
            if (length(w - d) > 0.02) continue;
            CHECK(p.hero_only());
            CHECK(length(w - d) < 1e-4);
            ++checked;
        }
        least = std::min(least, d[0]);
        most = std::max(most, d[0]);
    }
    CHECK(checked > 3000);
    CHECK(most - least > 0.02);  // the colours do part
}

TEST_CASE("caustics: absorbing glass takes what Beer's law says, from outside and from within") {
    Vec3 const sigma{0.2f, 0.7f, 1.5f};
    double const alpha = sidak(12);
    auto const check = [&](World const& world, ShotKind kind, Which const& which,
                           std::function<double(double)> e, double within) {
        for (int lane = 0; lane < 3; ++lane) {
            Mean const m = batches_of(world, shot_settings(samples(4000, 40000), ColorMode::Rgb, true, 40),
                                      kind, which, lane);
            auto const a = agrees(m, e(static_cast<double>(sigma[lane])), within, alpha);
            CHECK_MESSAGE(a, "lane ", lane, ": ", a);
        }
    };
    SUBCASE("a slab") {
        Scene s;
        add(s, box_mesh({-1, -1, 1}, {1, 1, 2}, false), filled(s, 1.5f, sigma));
        add(s, floor_quad(1), diffuse(s, 0.5f));
        s.add(distant({0, 0, 1}));
        check(
            compile(s), ShotKind::Caustic, [](Photon const& p) { return p.bounces() == 2 && p.p().z < 0.5f; },
            [](double a) { return 4 * 0.96 * 0.96 * std::exp(-a); }, 0.05);
    }
    SUBCASE("a light in a ball") {
        Scene s;
        add_sphere(s, {0, 0, 0}, 1, filled(s, 1.5f, sigma));
        add_sphere(s, {0, 0, 0}, 3, diffuse(s, 0));
        s.add(point_light({0, 0, 0}, 1));
        World const world = compile(s);
        auto const all = [](Photon const&) { return true; };
        auto const e = [](double a) {
            return 4 * kPiD * std::exp(-a) * 0.96 / (1 - 0.04 * std::exp(-2 * a));
        };
        check(world, ShotKind::Caustic, all, e, 0.05);
        check(world, ShotKind::Global, all, e, 0.05);
    }
    SUBCASE("bodies in one another") {
        // Glass from 1 to 2 sunk into a liquid from 0 to 1.2: in the overlap there is glass.
        Scene s;
        add(s, box_mesh({-1, -1, 1}, {1, 1, 2}, false), filled(s, 1.5f, {0, 0, 0}, 2));
        add(s, box_mesh({-1, -1, 0}, {1, 1, 1.2f}, false), filled(s, 1.3f, sigma, 1));
        add(s, floor_quad(1, -1), diffuse(s, 0.5f));
        s.add(distant({0, 0, 1}));
        auto const passes = [](double a, double b) { return 1 - std::pow((a - b) / (a + b), 2); };
        check(
            compile(s), ShotKind::Caustic,
            [](Photon const& p) { return p.bounces() == 3 && p.p().z < -0.5f; },
            [&](double a) { return 4 * passes(1, 1.5) * passes(1.5, 1.3) * passes(1.3, 1) * std::exp(-a); },
            0.05);
    }
}
