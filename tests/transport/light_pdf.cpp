// The density with which light sampling finds a direction, asked again of the light that a real ray in this direction meets.
#include "emitters.h"
#include "image/write.h"
#include "measure.h"

#include <filesystem>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Compares samples with what rays find; returns the share of samples that could be compared.
double compare(World const& world, Vec3 p, int n) {
    Random random(7);
    RayStats stats;
    int compared = 0;
    int wrong = 0;
    int edges = 0;
    double worst = 0;
    for (int i = 0; i < n; ++i) {
        float const choose = random.unit();
        Vec2 const u{random.unit(), random.unit()};
        auto const s = world.sample_light(Receiver{p}, {}, choose, u, Wavelengths::rgb());
        if (!s || s->delta) continue;
        SurfaceHit hit;
        bool const found = world.intersect({p, s->wi}, kInfinity, RayKind::Bounce, stats, hit);
        float pdf = 0;
        double tolerance = 1e-4;
        if (s->at_infinity) {
            if (found) continue;
            pdf = world.infinite_light_pdf(world.infinite_lights().front(), Receiver{p}, {}, s->wi);
        } else {
            // The far side of a closed light is sampled too, and not seen.
            if (!found || !hit.emits || length(hit.s.p - s->p) > 1e-4f * length(s->p - p)) continue;
            // Seen at a grazing angle, a curved surface's cosine magnifies the rounding of the direction.
            float const cosine = abs_dot(hit.s.ng, s->wi);
            tolerance = std::max(1e-4, 2e-6 / static_cast<double>(cosine * cosine));
            pdf = world.light_pdf(hit, Receiver{p}, {}, s->wi);
            // At an edge the ray may meet the next face.
            if (length(hit.s.ng - s->n) > 1e-2f) {
                ++edges;
                continue;
            }
        }
        ++compared;
        double const off = std::abs(static_cast<double>(pdf) / static_cast<double>(s->pdf) - 1);
        worst = std::max(worst, off / tolerance);
        if (!(off <= tolerance)) ++wrong;
    }
    CHECK(compared > 0);
    CHECK(edges <= 1 + n / 1000);
    CHECK_MESSAGE(wrong == 0, wrong, " of ", compared, " differ, by up to ", worst, " tolerances");
    return static_cast<double>(compared) / n;
}

}  // namespace

TEST_CASE("light pdf: every emitting shape under every transform, alone and in instances") {
    for (auto const& e : emitting_shapes()) {
        CAPTURE(e.name);
        for (auto const& where : placements()) {
            CAPTURE(where.name);
            for (int nesting : {0, 1, 2}) {
                CAPTURE(nesting);
                Scene s;
                place(s, e, where, nesting, white(1, true));
                World const world = compile(s);
                for (Vec3 const p : {Vec3{0, 0, 0}, Vec3{1.5f, -1, 0.5f}, Vec3{-0.3f, 0.2f, 4}})
                    CHECK(compare(world, p, 500) > 0.05);
            }
        }
    }
}

TEST_CASE("light pdf: a twisted bilinear patch") {
    BilinearMesh m;
    m.p = {{-0.5f, -0.5f, 1.5f}, {0.5f, -0.4f, 2}, {-0.4f, 0.5f, 2.1f}, {0.6f, 0.5f, 1.4f}};
    m.patches = {{0, 1, 2, 3}};
    Scene s;
    add(s, m).light = white(1, true);
    World const world = compile(s);
    CHECK(compare(world, {0, 0, 0}, 5000) > 0.9);
}

TEST_CASE("light pdf: many lights of different power share one choice") {
    Scene s;
    int i = 0;
    auto const all = placements();
    for (auto const& e : emitting_shapes()) {
        Placement where = all[static_cast<std::size_t>(i) % all.size()];
        where.outer = translate(3.0 * (i % 3 - 1), 3.0 * (i / 3 - 1), 0) * where.outer;
        place(s, e, where, i % 3, white(static_cast<float>(1 + i), true));
        ++i;
    }
    // One group, seen twice.
    s.world().instances.push_back(s.world().instances.front());
    s.world().instances.back().to_parent[2][3] += 4;
    s.add(sky(0.01f));
    s.add(point_light({0, 0, 9}, 3));
    World const world = compile(s);
    for (Vec3 const p : {Vec3{0, 0, 0}, Vec3{1.5f, -1, 0.5f}, Vec3{-0.3f, 0.2f, 8}}) compare(world, p, 20000);
}

TEST_CASE("light pdf: environment pictures") {
    Random random(3);
    auto const folder = std::filesystem::temp_directory_path() / "nephroid-transport-test";
    std::filesystem::create_directories(folder);
    auto const picture = [&](int w, int h, char const* name) {
        Image image(PixelFormat::Float, w, h, {"R", "G", "B"});
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                for (int c = 0; c < 3; ++c) image.set(x, y, c, 0.01f + std::pow(random.unit(), 4.0f));
        write_pfm(folder / name, image);
        return (folder / name).string();
    };
    for (EnvironmentMapping const mapping : {EnvironmentMapping::EqualArea, EnvironmentMapping::LatLong}) {
        Scene s;
        InfiniteLight l;
        l.mapping = mapping;
        l.image = s.add(ImageFile{mapping == EnvironmentMapping::EqualArea ? picture(16, 16, "square.pfm")
                                                                           : picture(32, 16, "long.pfm"),
                                  "",
                                  {}});
        s.add(Light{l, rotation(40, 1, 2, 3), {}});
        add(s, Sphere{});  // what the sky lights
        World const world = compile(s);
        // The density is constant over texels: a direction at the edge of one may round into its neighbour, and a
        // rotation rounds more than 1e-4 of the way to the pole within 1e-3 of it.
        Random u(11);
        int wrong = 0;
        for (int i = 0; i < 20000; ++i) {
            float const choose = u.unit();
            Vec2 const at{u.unit(), u.unit()};
            auto const sample = world.sample_light({}, {}, choose, at, Wavelengths::rgb());
            REQUIRE(sample);
            float const pdf = world.infinite_light_pdf(LightId{0}, {}, {}, sample->wi);
            if (!(std::abs(pdf / sample->pdf - 1) <= 1e-4f)) ++wrong;
            Spectrum const seen = world.environment({}, sample->wi, Wavelengths::rgb());
            CHECK(seen[1] == doctest::Approx(sample->radiance[1]).epsilon(1e-3));
        }
        CHECK(wrong <= 10);
        // The density integrates to 1, and radiance / pdf to the integral of radiance.
        double density = 0;
        double radiance = 0;
        double sampled = 0;
        int const n = 400000;
        for (int i = 0; i < n; ++i) {
            Vec3 const w = square_to_uniform_sphere({u.unit(), u.unit()});
            density += static_cast<double>(world.infinite_light_pdf(LightId{0}, {}, {}, w));
            radiance += static_cast<double>(world.environment({}, w, Wavelengths::rgb())[1]);
            auto const s1 = world.sample_light({}, {}, u.unit(), {u.unit(), u.unit()}, Wavelengths::rgb());
            sampled += static_cast<double>(s1->radiance[1] / s1->pdf);
        }
        double const sphere = 4 * 3.14159265358979323846 / n;
        CHECK(density * sphere == doctest::Approx(1).epsilon(0.01));
        CHECK(radiance * sphere == doctest::Approx(sampled / n).epsilon(0.01));
    }
    std::filesystem::remove_all(folder);
}
