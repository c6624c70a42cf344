// Bodies that overlap, and absorption inside them.
#include "measure.h"
#include "model/fresnel.h"
#include "scenes.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

MaterialId body(Scene& s, float eta, int priority, float absorption = 0) {
    DielectricMaterial m;
    m.eta = ConstantSpd{eta};
    m.interior.priority = priority;
    m.interior.absorption = ConstantSpd{absorption};
    return material(s, m);
}

/// A slab across z, as wide as anyone looks.
void slab(Scene& s, float lo, float hi, MaterialId m) { add(s, Box{{-40, -40, lo}, {40, 40, hi}}, m); }

/// Straight down through whatever is there, onto an emitter of radiance 1.
void look_down(Scene& s, float from = 10) {
    add(s, floor_quad(60, -20)).light = white(1, true);
    look_parallel(s, {0, 0, from}, {0, 0, -1}, 0.1f);
}

double reflectance(double a, double b) { return (a - b) * (a - b) / ((a + b) * (a + b)); }

/// Transmittance of boundaries and absorbing layers, all orders of reflection, by adding one layer after the other.
struct Stack {
    double t = 1, up = 0, down = 0;  // through; reflected for light from above, from below
    void boundary(double a, double b) { add(1 - reflectance(a, b), reflectance(a, b)); }
    void layer(double optical_depth) {
        t *= std::exp(-optical_depth);
        down *= std::exp(-2 * optical_depth);
    }
    void add(double t2, double r2) {
        double const between = 1 / (1 - down * r2);
        up += t * t * r2 * between;
        double const new_down = r2 + t2 * t2 * down * between;
        t = t * t2 * between;
        down = new_down;
    }
};

std::vector<Integrator> through_bodies() { return {path(20), naive(path(20)), WhittedIntegrator{12}}; }

}  // namespace

TEST_CASE("an absorbing slab: T = (1-F)^2 e^-a / (1 - F^2 e^-2a)") {
    for (int const priority : {0, 4})
        for (float const absorption : {0.1f, 1.0f}) {
            Scene s;
            slab(s, -2, 0, body(s, 1.5f, priority, absorption));
            look_down(s);
            World const w = compile(std::move(s));
            double const a = 2 * static_cast<double>(absorption);
            double const f = 0.04;
            double const t = (1 - f) * (1 - f) * std::exp(-a) / (1 - f * f * std::exp(-2 * a));
            for (Integrator const& i : through_bodies()) check_mean(w, settings(i), 64, t);
            Settings spectral = settings(path(60));
            spectral.color = ColorMode::Spectral;
            check_mean(w, spectral, 256, t);
        }
}

TEST_CASE("thin walls have no inside that could absorb") {
    for (bool const thin : {true, false}) {
        Scene s;
        MetallicRoughnessMaterial m;
        m.base_color = spectrum(s, ConstantSpd{1});
        m.metallic = m.roughness = s.add(Texture{ConstantFloatTexture{0}, {}});
        m.transmission.factor = s.add(Texture{ConstantFloatTexture{1}, {}});
        m.transmission.thin = thin;
        m.transmission.interior.absorption = ConstantSpd{1};
        m.transmission.interior.priority = 1;
        slab(s, 0, 1, material(s, m));
        look_down(s);
        World const world = compile(s);
        CHECK(world.encloses() == !thin);
        Stack stack;
        stack.boundary(1, 1.5);
        if (!thin) stack.layer(1);
        stack.boundary(1.5, 1);
        check_mean(world, settings(path(40)), 64, stack.t);
    }
}

TEST_CASE("a body of mixed boundaries is left by another than it was entered by") {
    for (int const priority : {0, 1}) {
        Scene s;
        TextureId const half = s.add(Texture{ConstantFloatTexture{0.5f}, {}});
        MaterialId const a = body(s, 1, priority, 0.5f), b = body(s, 1, priority, 0.5f);
        slab(s, 0, 1, material(s, MixMaterial{a, b, half}));
        // Clear or absorbing by where it was entered: half of the light goes by each.
        slab(s, 2, 3, material(s, MixMaterial{a, body(s, 1, 0), half}));
        look_down(s);
        World const world = compile(s);
        for (Integrator const& i : {Integrator{path(20)}, Integrator{naive(path(20))}})
            check_mean(world, settings(i), 256, std::exp(-0.5) * (0.5 + 0.5 * std::exp(-0.5)));
    }
}

TEST_CASE("a liquid that overlaps its glass is the same as one that meets it") {
    // Glass from -4 to -1; water from -1.5 upwards to 0: at -1.5 … -1 there is glass.
    Stack expected;
    expected.boundary(1, 1.33);
    expected.layer(0.3 * 1);
    expected.boundary(1.33, 1.5);
    expected.layer(0.1 * 3);
    expected.boundary(1.5, 1);
    Scene s;
    MaterialId const water = body(s, 1.33f, 1, 0.3f);
    MaterialId const glass = body(s, 1.5f, 2, 0.1f);
    slab(s, -4, -1, glass);
    slab(s, -1.5f, 0, water);
    look_down(s);
    World const w = compile(std::move(s));
    for (Integrator const& i : through_bodies()) check_mean(w, settings(i), 64, expected.t);
    // Control: with the ranks exchanged the glass begins only at -1.5.
    Scene other;
    MaterialId const water2 = body(other, 1.33f, 2, 0.3f);
    slab(other, -4, -1, body(other, 1.5f, 1, 0.1f));
    slab(other, -1.5f, 0, water2);
    look_down(other);
    Stack exchanged;
    exchanged.boundary(1, 1.33);
    exchanged.layer(0.3 * 1.5);
    exchanged.boundary(1.33, 1.5);
    exchanged.layer(0.1 * 2.5);
    exchanged.boundary(1.5, 1);
    check_mean(compile(std::move(other)), settings(path(60)), 256, exchanged.t);
}

TEST_CASE("ice in water in glass, all overlapping: the highest priority is there") {
    // Glass -4 … -1 (3); water -1.5 … 2 (1); ice -1.2 … 3 (2): from above ice, ice, then glass from -1 on.
    Stack expected;
    expected.boundary(1, 1.31);  // at 3; water's surface at 2 is inside the ice
    expected.layer(0.2 * 4);     // 3 … -1
    expected.boundary(1.31, 1.5);
    expected.layer(0.1 * 3);
    expected.boundary(1.5, 1);
    Scene s;
    MaterialId const water = body(s, 1.33f, 1, 0.7f);
    MaterialId const ice = body(s, 1.31f, 2, 0.2f);
    MaterialId const glass = body(s, 1.5f, 3, 0.1f);
    slab(s, -4, -1, glass);
    slab(s, -1.5f, 2, water);
    slab(s, -1.2f, 3, ice);
    look_down(s);
    World const w = compile(std::move(s));
    for (Integrator const& i : through_bodies()) check_mean(w, settings(i), 64, expected.t);
}

TEST_CASE("the same body twice, overlapping, is one; equal indices make no boundary") {
    Scene s;
    MaterialId const water = body(s, 1.33f, 1, 0.1f);
    slab(s, -2, 0, water);
    slab(s, -3, -1, water);
    slab(s, -2.7f, -2.5f, body(s, 1.33f, 5, 0.1f));
    look_down(s);
    World const w = compile(std::move(s));
    Stack expected;
    expected.boundary(1, 1.33);
    expected.layer(0.1 * 3);
    expected.boundary(1.33, 1);
    for (Integrator const& i : through_bodies()) check_mean(w, settings(i), 64, expected.t);
}

TEST_CASE("a body with holes is noted") {
    for (bool const holes : {false, true}) {
        Scene s;
        slab(s, -2, 0, body(s, 1.5f, 1, 0.1f));
        if (holes) s.world().objects[0].alpha = s.add(Texture{ConstantFloatTexture{0.5f}, {}});
        look_down(s);
        World const w = compile(std::move(s));
        CHECK(w.scene().notes.size() == (holes ? 1 : 0));
    }
}

TEST_CASE("a camera inside knows what it is in") {
    for (float const from : {-0.5f, -1.7f}) {
        Scene s;
        slab(s, -4, -1.5f, body(s, 1.5f, 2, 0.1f));
        slab(s, -2, 0, body(s, 1.33f, 1, 0.3f));
        look_down(s, from);
        World const w = compile(std::move(s));
        bool const in_water = from > -1.5f;
        RayStats stats;
        CHECK_FALSE(interiors_at(w, {0, 0, from}, stats).empty());
        // Down to the emitter, and what the boundaries send back and forth: only reflections above come back to it as well, and
        // the emitter is below, so that the stack below the camera and the one above it make a cavity.
        Stack above, below;
        if (in_water) {
            below.layer(0.3 * 1.0);
            below.boundary(1.33, 1.5);
            below.layer(0.1 * 2.5);
            below.boundary(1.5, 1);
            above.boundary(1, 1.33);
            above.layer(0.3 * 0.5);
        } else {
            below.layer(0.1 * 2.3);
            below.boundary(1.5, 1);
            above.boundary(1, 1.33);
            above.layer(0.3 * 1.5);
            above.boundary(1.33, 1.5);
            above.layer(0.1 * 0.2);
        }
        // Light from below through `below`, then between the two; what arrives at the camera from below. Radiance in a medium of
        // index n is n^2 times as large.
        double const n = in_water ? 1.33 : 1.5;
        double up_to_camera = below.t / (1 - below.up * above.down);
        for (Integrator const& i : through_bodies()) check_mean(w, settings(i), 64, n * n * up_to_camera);
    }
}

TEST_CASE("lights are attenuated on the way to a surface in a liquid, sampled or found") {
    // A white floor under absorbing water: the lamp hangs inside, the surface is above everything.
    Scene s;
    add(s, floor_quad(40, -3), diffuse(s, 0.5f));
    slab(s, -5, 4, body(s, 1.33f, 1, 0.5f));
    add(s, Quad{{-2, -2, -0.5f}, {0, 4, 0}, {4, 0, 0}}).light = white(1);
    look_parallel(s, {0, 0, -1}, {0, 0, -1}, 1.0f);
    World const w = compile(std::move(s));
    check_same({{"lights and MIS", &w, settings(path(4)), 64},
                {"by chance", &w, settings(naive(path(4))), 512},
                {"lights alone", &w, settings(without_mis(path(4))), 64}});
}

TEST_CASE("hidden boundaries do not spoil the weights of light sampling") {
    // A lamp in water behind a hidden wall of the water's own kind: shadow rays end there, scattered ones do not.
    Scene s;
    MaterialId const water = body(s, 1.33f, 1, 0.05f);
    add(s, floor_quad(40, -3), diffuse(s, 0.5f));
    slab(s, -5, 0, water);
    slab(s, -2, 4, water);  // its lower face, at -2, is hidden, and so is the upper one of the other at 0
    add(s, Quad{{-4, -4, 1}, {8, 0, 0}, {0, 8, 0}}).light = white(1, true);
    look_parallel(s, {0, 0, -2.5f}, {0, 0, -1}, 1.0f);
    World const w = compile(std::move(s));
    check_same(
        {{"lights and MIS", &w, settings(path(4)), 256}, {"by chance", &w, settings(naive(path(4))), 256}});
}
