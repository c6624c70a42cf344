// Radii that nobody gave: they suit the scene, grow with it, and are there even where nothing is.
#include "estimates.h"
#include "photon_plan.h"

#include <algorithm>
#include <chrono>

using namespace nephroid;
using namespace nephroid::test;

namespace {
/// A room of side 2 k with a light under its ceiling, a glass ball if wanted, and the camera in it.
World radius_room(float k, bool ball, float reflectance = 0.6f) {
    Scene s;
    MaterialId const grey = diffuse(s, reflectance);
    add(s, box_mesh(Vec3(-k), Vec3(k), true), grey);
    Object& lamp =
        add(s, Quad{Vec3{-0.25f, 0.25f, 0.99f} * k, Vec3{0.5f, 0, 0} * k, Vec3{0, -0.5f, 0} * k}, grey);
    lamp.light = white(10);
    if (ball) {
        Object& o = add(s, Sphere{0.3f * k, -0.3f * k, 0.3f * k}, glass(s));
        double const d = static_cast<double>(k);
        o.to_group = translate(0.3 * d, 0.2 * d, -0.6 * d);
    }
    look(s, Vec3{0.1f, -0.9f, 0.1f} * k, Vec3{0, 0.2f, -0.3f} * k);
    return compile(std::move(s));
}
SppmIntegrator sppm(int paths = -1) {
    SppmIntegrator p;
    p.shooting.global_paths = paths;
    return p;
}
struct Radii {
    float global, caustic, further;
    bool operator==(Radii const&) const = default;
};
Radii radii(World const& world, Settings const& s) {
    RenderJob const job(world, s);
    PhotonPlan const& plan = *job.photon_plan();
    return {plan.global_radius, plan.caustic_radius, plan.further_radius};
}
/// Photons of pass 0 in the estimates of pixels, and the radius: medians over those that made one.
struct Medians {
    double photons = 0, radius = 0;
};
Medians in_pass_0(World const& world, Settings s) {
    s.film.aovs = true;
    RenderJob const job(world, s);
    Film film = job.make_film();
    RayStats stats;
    render_pass(job, 0, film, stats);
    std::vector<double> photons, radius;
    for (int y = 0; y < s.film.resolution.y; ++y)
        for (int x = 0; x < s.film.resolution.x; ++x)
            if (AovSums const& a = film.aov(x, y); a.estimates > 0) {
                photons.push_back(a.photons / a.estimates);
                radius.push_back(a.radius / a.estimates);
            }
    REQUIRE(!photons.empty());
    auto const median = [](std::vector<double>& v) {
        std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
        return v[v.size() / 2];
    };
    return {median(photons), median(radius)};
}
}  // namespace

TEST_CASE("automatic radii hold some dozens of photons where the camera looks, whatever is shot") {
    for (float const reflectance : {0.2f, 0.7f}) {
        World const world = radius_room(1, false, reflectance);
        float before = kInfinity;
        for (int const paths : {1000, 10000, 100000}) {
            Settings const s = settings(sppm(paths), 200, 200);
            Medians const m = in_pass_0(world, s);
            INFO(paths, " paths, reflectance ", reflectance, ": ", m.photons, " photons within ", m.radius);
            CHECK(m.photons >= 18);
            CHECK(m.photons <= 50);
            float const r = radii(world, s).global;
            CHECK(r < before);
            before = r;
        }
    }
}

TEST_CASE("no finer than pixels: a coarse picture does not ask for less than it shows") {
    World const world = radius_room(1, false);
    auto const at = [&](int resolution) {
        RenderJob const job(world, settings(sppm(100000), resolution, resolution));
        return std::pair(job.photon_plan()->global_radius, job.camera().pixel_spread());
    };
    auto const [coarse, coarse_pixel] = at(16);
    auto const [fine, fine_pixel] = at(400);
    // What is seen is one to two units away.
    CHECK(coarse >= coarse_pixel);
    CHECK(coarse <= 2 * coarse_pixel);
    CHECK(fine < 0.3f * coarse);
    CHECK(fine > 2 * fine_pixel);
}

TEST_CASE("of the nearest k the radius bounds the search, and few reach it") {
    World const world = radius_room(1, false);
    SppmIntegrator p = sppm(20000);
    p.estimates.nused = 50;  // photonmap's default
    Settings const s = settings(p, 100, 100);
    Medians const m = in_pass_0(world, s);
    CHECK(m.photons >= 35);
    CHECK(m.photons <= 49);
    INFO(m.photons, " photons within ", m.radius, ", at most ", radii(world, s).global);
    CHECK(m.radius < 0.6 * static_cast<double>(radii(world, s).global));
    CHECK(static_cast<double>(radii(world, s).global) < 12 * m.radius);
}

TEST_CASE("the caustic radius is that of the caustic's photons") {
    World const world = radius_room(1, true);
    Settings const s = settings(sppm(40000), 400, 400);
    Radii const r = radii(world, s);
    // 40,000 paths of which few meet the ball, which gathers them in a spot no larger than itself.
    INFO(r.caustic, " and ", r.global);
    CHECK(r.caustic > 0);
    CHECK(r.caustic < 0.3f);
    CHECK(r.caustic != r.global);
}

TEST_CASE("radii grow with the scene: exactly by powers of two, and from 1e-3 to 1e5") {
    Settings const s = settings(sppm(4000), 200, 200);
    Radii const one = radii(radius_room(1, true), s);
    CHECK(std::isfinite(one.global));
    for (int const power : {-13, -3, 6, 17}) {
        float const k = std::ldexp(1.0f, power);
        Radii const r = radii(radius_room(k, true), s);
        CHECK(r.global == one.global * k);
        CHECK(r.caustic == one.caustic * k);
    }
    for (float const k : {1e-3f, 1e5f}) {
        Radii const r = radii(radius_room(k, true), s);
        // Other roundings, other paths: as far apart as other seeds would be.
        CHECK(r.global == doctest::Approx(one.global * k).epsilon(0.2));
        CHECK(r.caustic == doctest::Approx(one.caustic * k).epsilon(0.4));
    }
}

TEST_CASE("radii are a function of the job, given ones are kept, and finding them is quick") {
    World const world = radius_room(1, true);
    Settings s = settings(sppm(250000), 500, 500);
    auto const begun = std::chrono::steady_clock::now();
    Radii const a = radii(world, s);
    double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    MESSAGE("the job was ready after ", seconds, " s");
    CHECK(a == radii(world, s));
    auto& p = std::get<SppmIntegrator>(s.integrator);
    p.estimates.caustic_radius = 0.125f;
    CHECK(radii(world, s) == Radii{a.global, 0.125f, a.further});
    p.estimates.radius = 0.5f;
    CHECK(radii(world, s) == Radii{0.5f, 0.125f, 0.5f});
    p.estimates.caustic_radius = 0;
    CHECK(radii(world, s) == Radii{0.5f, 0.5f, 0.5f});
}

TEST_CASE("some radius even where there is nothing: no light, nothing in view, no surface at all, no paths") {
    auto const some = [](World const& w, int paths = 1000) {
        Radii const r = radii(w, settings(sppm(paths), 16, 16));
        return r.global > 0 && r.caustic > 0 && r.further > 0 && std::isfinite(r.global) &&
               std::isfinite(r.caustic) && std::isfinite(r.further);
    };
    Scene dark;
    add(dark, floor_quad(100), diffuse(dark, 0.5f));
    look(dark, {0, 0, 5}, {0, 0.1f, 0});
    CHECK(some(compile(std::move(dark))));
    Scene away;
    add(away, floor_quad(1), diffuse(away, 0.5f));
    away.add(point_light({0, 0, 1}, 1));
    look(away, {0, 0, 5}, {0, 0, 10});
    CHECK(some(compile(std::move(away))));
    Scene empty;
    empty.add(sky());
    CHECK(some(compile(std::move(empty))));
    CHECK(some(radius_room(1, true), 0));
    Scene mirrors;
    add(mirrors, box_mesh(Vec3(-1), Vec3(1), true), mirror(mirrors, 1));
    mirrors.add(point_light({0, 0, 0.5f}, 1));
    look(mirrors, {0, 0, 0}, {0, 1, 0.3f});
    CHECK(some(compile(std::move(mirrors))));
    // All photons at one point, nearly: a beam.
    Scene beam;
    add(beam, floor_quad(1), diffuse(beam, 0.5f));
    SpotLight l;
    l.from = {0, 0, 1};
    l.to = {0, 0, 0};
    l.cone_angle = 1e-6f;
    l.cone_delta = 0;
    beam.add(Light{l, {}, {}});
    look(beam, {0, -1, 2}, {0, 0, 0});
    CHECK(some(compile(std::move(beam))));
}
