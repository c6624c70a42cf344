// Lights as they send rays out: every sampler against its density, all of the power, and what arrives is what was sent.
#include "lights.h"

#include <doctest/doctest.h>

#include <memory>
#include <vector>

using namespace nephroid;
using namespace nephroid::test;

namespace {

BoundingSphere const kScene{{1, -2, 0.5f}, 3};

/// A lamp that lights two sides unevenly, with a dark sector and steps that are not even.
IntensityTable batwing() {
    IntensityTable t;
    for (double const a : {0.0, 10.0, 25.0, 40.0, 55.0, 70.0, 90.0, 120.0, 150.0})
        t.vertical.push_back(static_cast<float>(a * kPiD / 180));
    for (double const a : {0.0, 30.0, 90.0, 180.0, 200.0, 360.0})
        t.horizontal.push_back(static_cast<float>(a * kPiD / 180));
    Random r(11);
    for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t i = 0; i < 9; ++i) {
            double const v = j == 3 || i == 8 ? 0 : 100 + 400 * r.uniform();
            t.candela.push_back(static_cast<float>(v));
        }
    for (std::size_t i = 0; i < 9; ++i) t.candela[5 * 9 + i] = t.candela[i];  // 360 is 0
    for (std::size_t j = 0; j < 6; ++j) t.candela[j * 9] = 300;               // nadir is one direction
    return t;
}

struct Case {
    std::string name;
    std::unique_ptr<Lit> lit;
};

class Lamps {
  public:
    Lamps()
        : spread_("spread", 20, 20,
                  [](int x, int y) {
                      float const v = y % 6 == 2 ? 0.0f : 0.2f + 0.1f * static_cast<float>((3 * x + y) % 7);
                      return Vec3{v, v, v};
                  }),
          slide_("slide", 24, 16,
                 [](int x, int y) {
                     float const v = x == 5 ? 0.0f : 0.1f + 0.1f * static_cast<float>((x + 2 * y) % 9);
                     return Vec3{v, v, v};
                 }),
          lat_long_("sky", 24, 12, [](int x, int y) {
              float const v = x == 3 && y == 4 ? 30.0f : 0.2f + 0.1f * static_cast<float>((x + y) % 5);
              return Vec3{v, v, v};
          }) {
        Spd const white = RgbIlluminantSpd{{1, 1, 1}};
        Mat4 const place = translate(0.5, 1, -2) * turned();
        Mat4 const squeezed = place * scale(1, 1.5, 0.5);
        add("point", PointLight{white, 3, -1, {1, 0, 0}}, place);
        add("spot", SpotLight{white, 3, -1, {1, 0, 0}, {0, 1, 1}, 0.9f, 0.5f}, place);
        add("spot, all of it falling off", SpotLight{white, 3, -1, {1, 0, 0}, {0, 1, 1}, 2.0f, 2.0f}, place);
        add("spot with an edge", SpotLight{white, 3, -1, {1, 0, 0}, {0, 1, 1}, 0.6f, 0}, place);
        for (Mat4 const& m : {place, squeezed}) {
            add("goniometric", GoniometricLight{white, ImageId{0}, 2, -1}, m, spread_.files());
            add("projection", ProjectionLight{ImageId{0}, 1.2f, 2, -1}, m, slide_.files());
            add("measured", MeasuredLight{white, batwing(), 2, -1}, m);
        }
        at_points = cases.size();
        add("distant", DistantLight{white, 3, -1, {1, 0, 0}, {0, 1, 1}}, place);
        add("constant sky", InfiniteLight{white, {}, EnvironmentMapping::EqualArea, 2, -1}, place);
        add("sky", InfiniteLight{white, ImageId{0}, EnvironmentMapping::LatLong, 2, -1}, place,
            lat_long_.files());
        add("squeezed sky", InfiniteLight{white, ImageId{0}, EnvironmentMapping::LatLong, 2, -1}, squeezed,
            lat_long_.files());
    }

    std::vector<Case> cases;
    std::size_t at_points = 0;  // the first ones

  private:
    void add(std::string const& name, LightKind const& kind, Mat4 const& m,
             std::vector<ImageFile> images = {}) {
        cases.push_back({name + " " + std::to_string(cases.size()), std::make_unique<Lit>(kind, m, images)});
    }
    Picture spread_, slide_, lat_long_;
};

std::optional<EmissionSample> emit(Lit const& l, Vec2 u_position, Vec2 u_direction,
                                   Wavelengths const& w = Wavelengths::rgb()) {
    return sample_emission(l.light(), l.data, l.assets, kScene, u_position, u_direction, w);
}
/// W/sr that arrive along w from a light at a point.
Spectrum sent(Lit const& l, Vec3 w) {
    auto const s = l.sample(l.data.position + 2.0f * w, {0.5f, 0.5f});
    return s ? s->radiance * 4.0f : Spectrum{};
}

}  // namespace

TEST_CASE("emission: directions are drawn from their density, which is also that of the ray met again") {
    Lamps const lamps;
    int const n = samples(1'000'000, 4'000'000);
    double const alpha = sidak(static_cast<int>(lamps.cases.size()));
    for (Case const& lamp : lamps.cases) {
        auto const& name = lamp.name;  // CAPTURE takes no structured bindings (clang 14)
        auto const& lit = lamp.lit;
        if (std::holds_alternative<DistantLight>(lit->light().kind)) continue;
        CAPTURE(name);
        bool const at_point = !is_infinite(lit->light());
        SphereCells const cells(24, 40);
        std::vector<double> o(cells.size());
        Random r(5);
        int lost = 0;
        int others = 0;
        for (int i = 0; i < n; ++i) {
            auto const s = emit(*lit, random_square(r), random_square(r));
            if (!s) {
                ++lost;
                continue;
            }
            Vec3 const on_ray = s->ray.o + 2.5f * s->ray.d;
            auto const again = emission_density(lit->light(), lit->data, kScene, on_ray, s->ray.d);
            others += std::abs(again.direction / s->pdf_direction - 1) > 1e-4f;
            REQUIRE(s->pdf_direction > 0);
            REQUIRE(s->radiance.is_finite());
            REQUIRE(!s->radiance.is_black());
            REQUIRE(std::abs(length(s->ray.d) - 1) < 1e-5f);
            REQUIRE(s->n == Vec3{0, 0, 0});
            REQUIRE(s->delta_position == at_point);
            REQUIRE(!s->delta_direction);
            if (at_point) {
                REQUIRE(s->ray.o == lit->data.position);
                REQUIRE(again.position == 0);
                REQUIRE(s->pdf_position == 1);
            } else {
                REQUIRE(again.position == doctest::Approx(s->pdf_position).epsilon(1e-4));
            }
            ++o[cells.cell(s->ray.d)];
        }
        CHECK(others == 0);
        CHECK(lost <= n / 10000);
        // A narrow beam has many rays in each cell, so that the quadrature has to be better where texels' edges cut them.
        int const sub = std::holds_alternative<ProjectionLight>(lit->light().kind) ? 96 : 24;
        auto e = cells.integrate(
            [&](Vec3 w) {
                return static_cast<double>(
                    emission_density(lit->light(), lit->data, kScene, kScene.centre, w).direction);
            },
            sub);
        double total = 0;
        for (double const x : e) total += x;
        CHECK(total == doctest::Approx(1).epsilon(2e-3));
        for (double& x : e) x *= (n - lost) / total;
        // Slivers of a cell that lie between the points of the quadrature: that each ray has a density was seen above.
        for (std::size_t i = 0; i < e.size(); ++i)
            if (e[i] == 0 && o[i] > 0)
                e[i] = n * lit->data.peak / (lit->data.flux * static_cast<float>(2 * sub * sub)) *
                       (4 * kPiD / 960);
        auto const c = chi_square(o, e);
        INFO(c);
        // As for environments: the cells' quadrature is not exact where texels' edges cut them.
        CHECK(c.p >= alpha / 10);
        for (float const x : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
            for (float const y : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
                if (auto const s = emit(*lit, {y, x}, {x, y})) {
                    CHECK(is_finite(s->ray.o));
                    CHECK(is_finite(s->ray.d));
                    CHECK((s->pdf_direction > 0 && std::isfinite(s->pdf_direction)));
                    CHECK(s->radiance.is_finite());
                }
    }
}

TEST_CASE("emission: the density is the Jacobian of the map from the square") {
    Lamps const lamps;
    double const h = 0x1p-11;
    for (std::size_t k = 0; k < lamps.at_points; ++k) {
        auto const& name = lamps.cases[k].name;
        auto const& lit = lamps.cases[k].lit;
        CAPTURE(name);
        Random r(6);
        int tried = 0;
        int wrong = 0;
        for (int i = 0; i < 20000; ++i) {
            Vec2 const u{static_cast<float>(r.uniform(0.01, 0.99)),
                         static_cast<float>(r.uniform(0.01, 0.99))};
            auto const hf = static_cast<float>(h);
            auto const s = emit(*lit, {}, u);
            auto const a = emit(*lit, {}, {u.x - hf, u.y}), b = emit(*lit, {}, {u.x + hf, u.y});
            auto const c = emit(*lit, {}, {u.x, u.y - hf}), d = emit(*lit, {}, {u.x, u.y + hf});
            if (!s || !a || !b || !c || !d) continue;
            // All within one cell, so that the map is smooth there.
            auto const near = [&](auto const& x) {
                return std::abs(x->pdf_direction / s->pdf_direction - 1) < 0.02f;
            };
            if (!near(a) || !near(b) || !near(c) || !near(d)) continue;
            ++tried;
            double const area = static_cast<double>(length(cross(b->ray.d - a->ray.d, d->ray.d - c->ray.d)));
            wrong += std::abs(area / (4 * h * h) * static_cast<double>(s->pdf_direction) - 1) > 5e-3;
        }
        CHECK(tried > 1000);
        // Creases of the octahedron, and neighbours with equal densities.
        CHECK(wrong <= tried / 10);
    }
}

TEST_CASE("emission of lights at infinity: even over the disk across the ray, as wide as the scene") {
    Lamps const lamps;
    int const n = samples(400'000, 4'000'000);
    double const area = kPiD * 9;
    for (std::size_t k = lamps.at_points; k < lamps.cases.size(); ++k) {
        auto const& name = lamps.cases[k].name;
        auto const& lit = lamps.cases[k].lit;
        CAPTURE(name);
        bool const distant = !is_infinite(lit->light());
        std::vector<double> o(10 * 16);
        Random r(7);
        for (int i = 0; i < n; ++i) {
            auto const s = emit(*lit, random_square(r), random_square(r));
            REQUIRE(s);
            REQUIRE(s->delta_direction == distant);
            REQUIRE(s->pdf_position * area == doctest::Approx(1));
            Vec3 const from = s->ray.o - kScene.centre;
            REQUIRE(std::abs(dot(from, s->ray.d) + 3) < 1e-4f);
            Vec3 const local = frame_from_z(s->ray.d).to_local(from);
            double const r2 = static_cast<double>(sqr(local.x) + sqr(local.y)) / 9;
            double const phi =
                std::atan2(static_cast<double>(local.y), static_cast<double>(local.x)) / (2 * kPiD) + 0.5;
            int const ring = std::min(9, static_cast<int>(r2 * 10));
            int const sector = std::min(15, static_cast<int>(phi * 16));
            ++o[static_cast<std::size_t>(ring * 16 + sector)];
            if (distant) {
                REQUIRE(s->ray.d == -lit->data.direction);
                REQUIRE(s->pdf_direction == 1);
                auto const again = emission_density(lit->light(), lit->data, kScene, s->ray.o, s->ray.d);
                REQUIRE(again.position == doctest::Approx(s->pdf_position).epsilon(1e-4));
                REQUIRE(again.direction == 0);
            }
        }
        auto const c = chi_square(o, std::vector<double>(160, n / 160.0));
        INFO(c);
        CHECK(c.p >= sidak(4));
        // Past the disk there is no ray.
        Vec3 const beside = kScene.centre + 3.1f * frame_from_z(lit->data.direction).x;
        CHECK(emission_density(lit->light(), lit->data, kScene, beside, lit->data.direction).position == 0);
    }
    // A scene without extent has no disk.
    CHECK_FALSE(sample_emission(
        lamps.cases[lamps.at_points].lit->light(), lamps.cases[lamps.at_points].lit->data,
        lamps.cases[lamps.at_points].lit->assets, {}, {0.5f, 0.5f}, {0.5f, 0.5f}, Wavelengths::rgb()));
}

TEST_CASE("emission: the rays carry all of the power, in every lane of either mode") {
    Lamps const lamps;
    int const n = samples(400'000, 4'000'000);
    auto const modes = {Wavelengths::rgb(), Wavelengths::spectral(0.3f)};
    double const alpha = sidak(static_cast<int>(lamps.cases.size() * 7));
    for (Case const& lamp : lamps.cases)
        for (Wavelengths const& w : modes) {
            auto const& name = lamp.name;
            auto const& lit = lamp.lit;
            CAPTURE(name);
            CAPTURE(w.is_rgb());
            int const lanes = w.is_rgb() ? 3 : 4;
            Spectrum const emission = lit->data.emission.sample(w);
            std::vector<Mean> means(static_cast<std::size_t>(lanes));
            Random r(8);
            for (int i = 0; i < n; ++i) {
                auto const s = emit(*lit, random_square(r), random_square(r), w);
                for (int lane = 0; lane < lanes; ++lane)
                    means[static_cast<std::size_t>(lane)].add(
                        s ? static_cast<double>(s->radiance[lane]) /
                                (static_cast<double>(s->pdf_position) * static_cast<double>(s->pdf_direction))
                          : 0.0);
            }
            bool const picture = is_infinite(lit->light()) && lit->data.table;
            for (int lane = 0; lane < lanes; ++lane) {
                double expected = static_cast<double>(power(lit->light(), lit->data, lit->assets, kScene)) /
                                  static_cast<double>(lit->data.emission.max_value()) *
                                  static_cast<double>(emission[lane]);
                if (picture) {
                    // There power() is an estimate for choosing; the truth by quadrature.
                    SphereCells const cells(40, 80);
                    auto const e = cells.integrate(
                        [&](Vec3 d) { return static_cast<double>(lit->radiance(d, w)[lane]); }, 8);
                    expected = 0;
                    for (double const x : e) expected += x * kPiD * 9;
                }
                Mean const& mean = means[static_cast<std::size_t>(lane)];
                auto const a = agrees(mean, expected, 0.005, alpha);
                INFO(a);
                CHECK(a.powerful);
                // Grey is taken through the table of colours to about 1e-3, and the quadrature is as good as that.
                CHECK(std::abs(a.mean - expected) <= mean.half_width(alpha) + 2e-3 * expected);
            }
        }
}

TEST_CASE("power in lumens is what pictures and tables send out in all, in colours too") {
    Picture const slide("lumens", 12, 18, [](int x, int y) {
        return Vec3{x < 6 ? 0.9f : 0.1f, 0.2f + 0.04f * static_cast<float>(y), y < 9 ? 0.1f : 0.8f};
    });
    Picture const square("lumens2", 8, 8, [](int x, int y) {
        return Vec3{0.1f * static_cast<float>(x), 0.3f, 0.1f * static_cast<float>(y)};
    });
    Mat4 const squeezed = turned() * scale(1, 2, 0.7);
    for (auto const& light :
         {std::pair{LightKind{ProjectionLight{ImageId{0}, 0.8f, 2, 500}}, slide.files()},
          std::pair{LightKind{GoniometricLight{BlackbodySpd{3000}, ImageId{0}, 2, 500}}, square.files()},
          std::pair{LightKind{MeasuredLight{NamedSpd{"stdillum-F2"}, batwing(), 2, 500}},
                    std::vector<ImageFile>{}}}) {
        LightKind const& kind = light.first;
        CAPTURE(kind.index());
        Lit const l(kind, squeezed, light.second);
        Mean flux;
        Random r(9);
        int const n = samples(400'000, 4'000'000);
        for (int i = 0; i < n; ++i) {
            auto const w = Wavelengths::spectral(0.25f * r.unit());
            auto const s = emit(l, {}, random_square(r), w);
            flux.add(s ? static_cast<double>(to_xyz(s->radiance, w).y) / static_cast<double>(s->pdf_direction)
                       : 0.0);
        }
        auto const a = agrees(flux, 1000);
        INFO(a);
        CHECK(a.powerful);
        CHECK(std::abs(a.mean - 1000) <= a.half_width + 3);  // colours by table: 3 in 1000
    }
}

TEST_CASE("what arrives from a light is what it sends out") {
    Lamps const lamps;
    for (std::size_t k = 0; k < lamps.cases.size(); ++k) {
        auto const& name = lamps.cases[k].name;
        auto const& lit = lamps.cases[k].lit;
        CAPTURE(name);
        Random r(10);
        int others = 0;
        for (int i = 0; i < 20000; ++i) {
            auto const s = emit(*lit, random_square(r), random_square(r));
            if (!s) continue;
            if (k >= lamps.at_points) {
                if (!is_infinite(lit->light())) {
                    REQUIRE(lit->sample(kScene.centre, {})->radiance[1] == s->radiance[1]);
                } else {
                    others += std::abs(lit->radiance(-s->ray.d)[1] / s->radiance[1] - 1) > 1e-2f;
                }
                continue;
            }
            float const far = 1 + r.unit();
            auto const there = lit->sample(lit->data.position + far * s->ray.d, random_square(r));
            if (!there) {
                ++others;
                continue;
            }
            REQUIRE(there->delta);
            REQUIRE(there->pdf == 1);
            REQUIRE(length(there->wi + s->ray.d) < 1e-5f);
            others += std::abs(there->radiance[1] * sqr(far) / s->radiance[1] - 1) > 2e-3f;
        }
        CHECK(others <= 20);  // beside the edge of a texel
        if (k < lamps.at_points) CHECK_FALSE(lit->sample(lit->data.position, {}));
    }
}

TEST_CASE("bounds: no light goes beyond the angles, none is stronger, and they are not idle") {
    Lamps const lamps;
    for (std::size_t k = 0; k < lamps.cases.size(); ++k) {
        auto const& name = lamps.cases[k].name;
        auto const& lit = lamps.cases[k].lit;
        CAPTURE(name);
        auto const b = light_bounds(lit->light(), lit->data, lit->assets);
        REQUIRE(b.has_value() == (k < lamps.at_points));
        if (!b) continue;
        CHECK(b->box.lo == lit->data.position);
        CHECK(b->box.hi == lit->data.position);
        CHECK(b->cos_emission < 1);
        float const reach = std::acos(b->cos_normals) + std::acos(b->cos_emission);
        Random r(12);
        float widest = 0;
        float strongest = 0;
        for (int i = 0; i < 200'000; ++i) {
            Vec3 const w = random_direction(r);
            auto const intensity = sent(*lit, w);
            if (intensity.is_black()) continue;
            float const angle = std::acos(clamp(dot(w, b->axis), -1.0f, 1.0f));
            REQUIRE(angle <= reach + 1e-3f);
            for (int lane = 0; lane < 3; ++lane) REQUIRE(intensity[lane] <= b->intensity * 1.001f);
            widest = std::max(widest, angle);
            strongest = std::max(strongest, intensity[0]);
        }
        if (reach < kPi && lit->data.direction_scale == 0) CHECK(widest > 0.7f * reach);
        CHECK(strongest > 0.5f * b->intensity);
    }
}

TEST_CASE("goniometric light: the middle of its picture is up, the corners are down") {
    Picture const p("up", 16, 16, [](int x, int y) {
        bool const middle = x >= 6 && x < 10 && y >= 6 && y < 10;
        bool const corner = (x < 2 || x >= 14) && (y < 2 || y >= 14);
        return middle    ? Vec3{3, 6, 0}
               : corner  ? Vec3{1, 1, 1}
               : x >= 12 ? Vec3{0.5f, 0.5f, 0.5f}
                         : Vec3{0, 0, 0};
    });
    Lit const l(GoniometricLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, 2, -1}, {}, p.files());
    CHECK(luminance_of(sent(l, {0, 1, 0})) == doctest::Approx(6).epsilon(2e-3));  // the average of colours
    CHECK(luminance_of(sent(l, {0, -1, 0})) == doctest::Approx(2).epsilon(2e-3));
    // The picture's x is that of light space.
    CHECK(luminance_of(sent(l, {1, 0, 0})) == doctest::Approx(1).epsilon(2e-3));
    CHECK(sent(l, {-1, 0, 0}).is_black());
    CHECK(sent(l, {0, 0, 1}).is_black());
    Picture const wide("wide", 16, 8, [](int, int) { return Vec3{1, 1, 1}; });
    CHECK_THROWS_WITH_AS(
        Lit(GoniometricLight{RgbIlluminantSpd{{1, 1, 1}}, ImageId{0}, 1, -1}, {}, wide.files()),
        doctest::Contains("must be square"), Error);
}

TEST_CASE("projection light: the shorter side has the angle, the first row is above, the left column at -x") {
    Picture const p("slide2", 32, 16, [](int x, int y) {
        return y < 8 ? (x < 16 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}) : (x < 16 ? Vec3{0, 0, 1} : Vec3{1, 1, 1});
    });
    float const fov = 0.9f;
    Lit const l(ProjectionLight{ImageId{0}, fov, 1, -1}, {}, p.files());
    float const half = std::tan(fov / 2);
    auto const at = [&](double x, double y) {
        return sent(l, normalize(Vec3{static_cast<float>(x) * half, static_cast<float>(y) * half, 1}));
    };
    CHECK(at(-1.9, 0.9)[0] == doctest::Approx(1).epsilon(5e-3));
    CHECK(at(-1.9, 0.9)[1] < 1e-3f);
    CHECK(at(1.9, 0.9)[1] == doctest::Approx(1).epsilon(5e-3));
    CHECK(at(-1.9, -0.9)[2] == doctest::Approx(1).epsilon(5e-3));
    CHECK(luminance_of(at(1.9, -0.9)) == doctest::Approx(1).epsilon(5e-3));
    CHECK(at(0.5, 1.001).is_black());
    CHECK(at(2.001, 0.5).is_black());
    CHECK_FALSE(at(1.999, 0.999).is_black());
    CHECK(sent(l, {0, 0, -1}).is_black());
    CHECK(sent(l, {1, 0, 0}).is_black());
}

TEST_CASE("measured light: candela, bilinear in the angles, straight down first, counterclockwise from +x") {
    IntensityTable t;
    t.vertical = {0, kPi / 4, kPi / 2};
    t.horizontal = {0, kPi / 2, kPi, kTwoPi};
    t.candela = {100, 80, 0, 100, 40, 20, 100, 0, 0, 100, 80, 0};
    Lit const l(MeasuredLight{RgbIlluminantSpd{{1, 1, 1}}, t, 1, -1});
    auto const cd = [&](double vertical, double horizontal) {
        double const a = vertical * kPiD / 180;
        double const b = horizontal * kPiD / 180;
        return luminance_of(
            sent(l, {static_cast<float>(std::sin(a) * std::cos(b)),
                     static_cast<float>(std::sin(a) * std::sin(b)), static_cast<float>(-std::cos(a))}));
    };
    CHECK(luminance_of(sent(l, {0, 0, -1})) == doctest::Approx(100).epsilon(1e-3));
    CHECK(luminance_of(sent(l, {0, 1, 0})) == doctest::Approx(20).epsilon(1e-3));
    CHECK(cd(45, 0) == doctest::Approx(80).epsilon(1e-3));
    CHECK(cd(45, 90) == doctest::Approx(40).epsilon(1e-3));
    CHECK(cd(22.5, 45) == doctest::Approx(80).epsilon(1e-3));
    CHECK(cd(67.5, 45) == doctest::Approx(35).epsilon(1e-3));
    CHECK(cd(45, 359) == doctest::Approx(80 - 80.0 / 180).epsilon(1e-3));
    CHECK(cd(91, 90) == 0);
    CHECK(cd(180, 0) == 0);
    // All the way around at one strength: 4 pi candela are 4 pi lumens each.
    IntensityTable even;
    even.vertical = {0, kPi};
    even.horizontal = {0, kTwoPi};
    even.candela = {7, 7, 7, 7};
    Lit const ball(MeasuredLight{ConstantSpd{1}, even, 1, -1});
    CHECK(static_cast<double>(ball.data.flux) == doctest::Approx(28 * kPiD).epsilon(1e-6));
    // Near the poles the density has all its digits.
    for (float const x : {1e-3f, 1e-5f, 1e-7f})
        for (float const z : {-1.0f, 1.0f})
            CHECK(static_cast<double>(
                      emission_density(ball.light(), ball.data, kScene, {}, normalize(Vec3{x, 0, z}))
                          .direction) *
                      4 * kPiD ==
                  doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("projection light: few large texels send out as much as many small ones") {
    Picture const one("one", 1, 1, [](int, int) { return Vec3{1, 1, 1}; });
    Picture const many("many", 64, 64, [](int, int) { return Vec3{1, 1, 1}; });
    for (float const fov : {0.3f, 2.6f}) {
        Lit const a(ProjectionLight{ImageId{0}, fov, 1, -1}, {}, one.files());
        Lit const b(ProjectionLight{ImageId{0}, fov, 1, -1}, {}, many.files());
        // Of a square window: 4 asin(sin^2 of half its angle).
        double const sine = std::sin(static_cast<double>(fov) / 2);
        CHECK(static_cast<double>(a.data.flux) == doctest::Approx(4 * std::asin(sine * sine)).epsilon(1e-5));
        CHECK(static_cast<double>(b.data.flux) == doctest::Approx(4 * std::asin(sine * sine)).epsilon(1e-5));
    }
}

TEST_CASE("dark pictures and tables send nothing, and nothing breaks") {
    Picture const black("black", 8, 8, [](int, int) { return Vec3{0, 0, 0}; });
    IntensityTable dark = batwing();
    for (float& cd : dark.candela) cd = 0;
    Spd const white = RgbIlluminantSpd{{1, 1, 1}};
    for (auto const& kind :
         {LightKind{GoniometricLight{white, ImageId{0}, 1, 100}},
          LightKind{ProjectionLight{ImageId{0}, 1, 1, 100}}, LightKind{MeasuredLight{white, dark, 1, 100}}}) {
        Lit const l(kind, {}, black.files());
        CHECK(power(l.light(), l.data, l.assets, kScene) == 0);
        Random r(13);
        for (int i = 0; i < 1000; ++i) {
            CHECK_FALSE(emit(l, {}, random_square(r)));
            CHECK(sent(l, random_direction(r)).is_black());
        }
    }
    // Ten million watts are no limit.
    Lit const strong(MeasuredLight{white, batwing(), 1, 1e7f * 683});
    auto const s = emit(strong, {}, {0.3f, 0.4f});
    REQUIRE(s);
    CHECK(s->radiance.is_finite());
}
