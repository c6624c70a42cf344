// Normals that are not the surface's: what they do to radiance, and to importance (Veach 1997, 5.3).
#include "measure.h"
#include "model/material.h"
#include "scenes.h"
#include "tilted_floor.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {}  // namespace

TEST_CASE("light from above on a normal tilted by 30 degrees: rho E cos 30 / pi") {
    World const w = compile(tilted_floor_lit_from_above());
    Settings const how = settings(path(1));
    // E of a distant light of radiance-like scale 1: 1 on a facing surface.
    check_mean(w, how, 16, 0.6 * std::cos(kPiD / 6) / kPiD);
}

TEST_CASE("the adjoint: power that a light sends to a tilted surface is scattered as the camera sees it") {
    // A path light - x - camera is worth the same whichever end it is built from. From the camera: L = f |light.ns| E_perp. From
    // the light: the power E_perp |light.ng| dA goes on with f* |camera.ns| times the factor, and is seen as radiance per
    // projected area |camera.ng| dA.
    Random r(3);
    for (int i = 0; i < 1000; ++i) {
        auto const direction = [&] {
            double const z = r.uniform(0.1, 1), phi = r.uniform(0, 2 * kPiD), s = std::sqrt(1 - z * z);
            return Vec3(s * std::cos(phi), s * std::sin(phi), z);
        };
        Vec3 const ng{0, 0, 1};
        Vec3 const ns = normalize(direction() + Vec3{0, 0, 1.5f});
        Vec3 const camera = direction(), light = direction();
        if (dot(camera, ns) <= 0.05f || dot(light, ns) <= 0.05f) continue;
        Frame const frame = frame_from_z(ns);
        Bsdf const b = DiffuseBsdf{Spectrum(0.7f)};
        auto const value = [&](Vec3 wo, Vec3 wi, Mode mode) {
            return static_cast<double>(evaluate(b, frame.to_local(wo), frame.to_local(wi), mode)[0]) *
                   static_cast<double>(abs_dot(wi, ns) * shading_normal_scale(mode, wo, wi, ns, ng));
        };
        double const from_camera = value(camera, light, Mode::Radiance);
        double const from_light = value(light, camera, Mode::Importance) *
                                  static_cast<double>(abs_dot(light, ng)) /
                                  static_cast<double>(abs_dot(camera, ng));
        CHECK(from_light == doctest::Approx(from_camera).epsilon(1e-5));
        CHECK(shading_normal_scale(Mode::Radiance, camera, light, ns, ng) == 1.0f);
        CHECK(shading_normal_scale(Mode::Importance, camera, light, ng, ng) ==
              doctest::Approx(1).epsilon(1e-6));
    }
}

TEST_CASE(
    "a ray of light traced forward through a tilted floor: the flux that leaves is what a camera would see") {
    // Radiosity by tracing importance: a wide beam E = 1 from above; the power that leaves per area is the integral of what cameras
    // see in all directions, times |w.ng|.
    double const tilt = kPiD / 6;
    Vec3 const ns(std::sin(tilt), 0, std::cos(tilt)), ng{0, 0, 1}, light{0, 0, 1};
    Frame const frame = frame_from_z(ns);
    Bsdf const b = DiffuseBsdf{Spectrum(0.6f)};
    Vec3 const wo = frame.to_local(light);
    Mean with, without;
    Random r(5);
    for (int i = 0; i < samples(1'500'000, 6'000'000); ++i) {
        auto const s = sample(b, wo, 0, {r.unit(), r.unit()}, Mode::Importance, HemisphereSampling::Cosine);
        Vec3 const wi = frame.from_local(s->wi);
        if (dot(wi, ng) <= 0) {
            with.add(0), without.add(0);
            continue;
        }
        double const weight = static_cast<double>(s->f[0] * abs_cos_theta(s->wi) / s->pdf);
        without.add(weight);
        with.add(weight * static_cast<double>(shading_normal_scale(Mode::Importance, light, wi, ns, ng)));
    }
    // Cameras see rho cos30 / pi in every direction that is above both planes. Its integral against |w.ng|: pi / 2 for the quarter
    // on the far side, pi cos30 / 2 for the lune that the tilted plane leaves of the other.
    double const expected = 0.6 * std::cos(tilt) / kPiD * (kPiD * (1 + std::cos(tilt)) / 2);
    auto const a = agrees(with, expected, 0.005 * (kSanitizerShare > 1 ? 4 : 1), 0.01);
    INFO(a);
    CHECK(a);
    CHECK(std::abs(without.mean() - expected) > 0.02 * expected);
}
