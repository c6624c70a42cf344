// Daylight: the paper's formulas, computed here once more in double; densities; what arrives and what is sent out.
#include "lights.h"
#include "model/light.h"
#include "spectrum/color.h"
#include "support.h"

#include <doctest/doctest.h>

#include <string>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// A scene with one light, made ready.
struct Day {
    Scene scene;
    Assets assets;
    LightData data;

    explicit Day(SunSkyLight const& kind, Mat4 const& to_world = {}) {
        scene.add(Light{kind, to_world, {}});
        assets = Assets(scene);
        data = prepare(scene.lights[0], assets);
    }
    Day(Day const&) = delete;
    Day& operator=(Day const&) = delete;
    [[nodiscard]] Light const& light() const { return scene.lights[0]; }
    [[nodiscard]] std::optional<LightSample> sample(Vec2 u) const {
        return sample_light(light(), data, assets, {}, u, Wavelengths::rgb());
    }
    [[nodiscard]] Spectrum radiance(Vec3 w, Wavelengths const& l = Wavelengths::rgb()) const {
        return environment_radiance(light(), data, assets, {}, w, l);
    }
    [[nodiscard]] double pdf(Vec3 w) const {
        return static_cast<double>(environment_pdf(light(), data, {}, w));
    }
    /// Watts, as lights are chosen by.
    [[nodiscard]] double watts(BoundingSphere const& s) const {
        return static_cast<double>(power(light(), data, assets, s));
    }
};

SunSkyLight day(float turbidity, double elevation_degrees, bool sun = true, bool sky = true) {
    SunSkyLight l;
    l.turbidity = turbidity;
    double const e = elevation_degrees * kPiD / 180;
    l.sun_direction = {static_cast<float>(0.6 * std::cos(e)), static_cast<float>(0.8 * std::cos(e)),
                       static_cast<float>(std::sin(e))};
    l.sun = sun;
    l.sky = sky;
    return l;
}

/// As the film sees spectral radiance.
struct Xyz {
    double x = 0, y = 0, z = 0;
};
template <class F>
Xyz spectral_xyz(F const& f) {
    Xyz sum;
    int const n = 2000;
    for (int i = 0; i < n; ++i) {
        auto const w = Wavelengths::spectral(0.25f * (static_cast<float>(i) + 0.5f) / n);
        Vec3 const v = to_xyz(f(w), w);
        sum.x += static_cast<double>(v.x) / n, sum.y += static_cast<double>(v.y) / n,
            sum.z += static_cast<double>(v.z) / n;
    }
    return sum;
}

/// Preetham, Shirley & Smits 1999, appendix A.2, as it is printed: x, y, Y (kcd/m^2) of direction w.
Xyz paper(double t, Vec3 sun, Vec3 w) {
    auto const angle = [](Vec3 a, Vec3 b) {
        double const ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
        double const c = ax * bx + ay * by + az * bz;
        return std::acos(std::clamp(
            c / std::sqrt((ax * ax + ay * ay + az * az) * (bx * bx + by * by + bz * bz)), -1.0, 1.0));
    };
    double const s = angle(sun, {0, 0, 1}), theta = angle(w, {0, 0, 1}), gamma = angle(w, sun);
    double const chi = (4.0 / 9.0 - t / 120) * (kPiD - 2 * s);
    double const zenith_y = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    double const s2 = s * s, s3 = s2 * s, t2 = t * t;
    double const zenith_cx = t2 * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                             t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                             (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
    double const zenith_cy = t2 * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                             t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                             (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
    auto const relative = [&](double a, double b, double c, double d, double e) {
        auto const f = [&](double th, double g) {
            return (1 + a * std::exp(b / std::cos(th))) *
                   (1 + c * std::exp(d * g) + e * std::cos(g) * std::cos(g));
        };
        return f(theta, gamma) / f(0, s);
    };
    return {zenith_cx * relative(-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
                                 -0.0641 * t - 0.8989, -0.0033 * t + 0.0452),
            zenith_cy * relative(-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
                                 -0.0441 * t - 1.6537, -0.0109 * t + 0.0529),
            zenith_y * relative(0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                                0.1206 * t - 2.5771, -0.0670 * t + 0.3703)};
}

/// Integral of f over the upper hemisphere, by the midpoint rule in the cosine and the azimuth; finer at the horizon.
template <class F>
double hemisphere(F const& f, int n = 300) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            double const v = (i + 0.5) / n, c = v * v;
            sum += f(direction(std::acos(c), 2 * kPiD * (k + 0.5) / n)) * 2 * v;
        }
    return sum * 2 * kPiD / (n * n);
}

double const kReal = 0.2665 * kPiD / 180;  // the sun's radius

}  // namespace

TEST_CASE("sky: luminance and colour of the zenith and elsewhere are the paper's") {
    for (float const t : {1.7f, 2.0f, 3.0f, 6.0f, 10.0f})
        for (double const elevation : {0.0, 5.0, 30.0, 60.0, 90.0}) {
            auto const kind = day(t, elevation, false);
            Day const d(kind);
            for (Vec3 const w : {Vec3{0, 0, 1}, direction(1.5, 2), direction(0.8, 1), direction(0.8, 4)}) {
                CAPTURE(t);
                CAPTURE(elevation);
                CAPTURE(w.z);
                auto const [x, y, luminance] = paper(static_cast<double>(t), kind.sun_direction, w);
                Xyz const s = spectral_xyz([&](Wavelengths const& l) { return d.radiance(w, l); });
                double const sum = s.x + s.y + s.z;
                CHECK(s.y == doctest::Approx(luminance).epsilon(2e-3));
                // The daylight components' weights are fitted: colours are met to two thousandths.
                CHECK(std::abs(s.x / sum - x) < 2e-3);
                CHECK(std::abs(s.y / sum - y) < 2e-3);
                auto const rgb = d.radiance(w);
                CHECK(std::min({rgb[0], rgb[1], rgb[2]}) >= 0);
                // Where sRGB holds the colour, its luminance too.
                if (std::min({rgb[0], rgb[1], rgb[2]}) > 0)
                    CHECK(luminance_of(rgb) == doctest::Approx(luminance).epsilon(1e-3));
            }
        }
}

TEST_CASE("sky: blue away from the sun, paler at the horizon, bright around the sun, black below") {
    auto const kind = day(2.5f, 40, false);
    Day const d(kind);
    auto const blueness = [&](Vec3 w) {
        auto const c = d.radiance(w);
        return static_cast<double>(c[2]) / static_cast<double>(c[0]);
    };
    Vec3 const sun = kind.sun_direction;
    Vec3 const away = normalize(Vec3{-sun.x, -sun.y, sun.z});
    Vec3 const horizon = normalize(Vec3{-sun.y, sun.x, 0.02f});
    CHECK(blueness(away) > 1.5);
    CHECK(blueness(horizon) < blueness(away));
    CHECK(luminance_of(d.radiance(horizon)) > luminance_of(d.radiance(away)));
    CHECK(luminance_of(d.radiance(sun)) > 2 * luminance_of(d.radiance(away)));
    for (Vec3 const w : {Vec3{1, 0, 0}, Vec3{0, 0, -1}, normalize(Vec3{1, 1, -1e-6f})}) {
        CHECK(d.radiance(w).is_black());
        CHECK(d.radiance(w, Wavelengths::spectral(0.1f)).is_black());
    }
    // Scale is a factor.
    auto twice = kind;
    twice.scale = 2;
    CHECK(Day(twice).radiance(away)[1] == doctest::Approx(2 * d.radiance(away)[1]));
}

TEST_CASE("sky: positive and finite over the whole range of turbidities and suns") {
    Random r(1);
    for (float t = 1.7f; t <= 10.01f; t += 0.83f)
        for (double elevation = 0; elevation <= 90; elevation += 7.5) {
            Day const d(day(std::min(t, 10.0f), elevation, false));
            for (int i = 0; i < 200; ++i) {
                double const c = i % 3 ? r.uniform() : 1e-4 * r.uniform();
                Vec3 const w = direction(std::acos(c), r.uniform(0, 7));
                auto const l = Wavelengths::spectral(r.unit());
                auto const s = d.radiance(w, l);
                REQUIRE(s.is_finite());
                // Red horizons lie beyond the daylight components, whose violet end would be negative there.
                for (int k = 0; k < 4; ++k) REQUIRE((s[k] > 0 || (s[k] == 0 && l.lambda(k) < 440)));
                REQUIRE(d.pdf(w) > 0);
            }
        }
}

TEST_CASE("sun: radiance by the paper's appendix, at a wavelength without, and with, ozone and water") {
    // Radiance above the atmosphere, W m^-2 sr^-1 nm^-1, and coefficients, from the table.
    struct Row {
        double nm, above, ozone, water;
    };
    for (Row const& row : {Row{400, 21127.5, 0, 0}, Row{550, 25503.8, 0.085, 0}, Row{600, 24631.5, 0.125, 0},
                           Row{720, 19427.2, 0.014, 1.0}})
        for (double const t : {2.0, 5.0})
            for (double const elevation : {10.0, 60.0, 90.0}) {
                double const zenith = 90 - elevation;
                double const m =
                    1 / (std::cos(zenith * kPiD / 180) + 0.15 * std::pow(93.885 - zenith, -1.253));
                double const um = row.nm / 1000;
                double const rayleigh = std::exp(-0.008735 * std::pow(um, -4.08) * m);
                double const beta = 0.04608365822050 * t - 0.04586025928522;
                double const aerosol = std::exp(-beta * std::pow(um, -1.3) * m);
                double const ozone = std::exp(-row.ozone * 0.35 * m);
                double const w = row.water * 2 * m;
                double const water = std::exp(-0.2385 * w / std::pow(1 + 20.07 * w, 0.45));
                Day const d(day(static_cast<float>(t), elevation, true, false));
                // 683 lm/W at the peak, and thousands: kcd/m^2.
                double const expected = 0.683 * row.above * rayleigh * aerosol * ozone * water;
                CAPTURE(row.nm);
                CAPTURE(elevation);
                CHECK(d.data.emission.at(static_cast<float>(row.nm)) ==
                      doctest::Approx(expected).epsilon(2e-4));
            }
    // A clear day's noon: direct light of about 100 klx.
    Day const noon(day(2, 90, true, false));
    double const klx = luminance_of(noon.radiance({0, 0, 1})) * kPiD * std::pow(std::sin(kReal), 2);
    CHECK(klx > 85);
    CHECK(klx < 125);
}

TEST_CASE("sun: irradiance is radiance times projected solid angle, and the same for a larger sun") {
    double const n = samples(200'000, 1'000'000);
    for (float const radius : {static_cast<float>(kReal), 0.03f, 0.3f}) {
        auto kind = day(3, 35, true, false);
        kind.sun_radius = radius;
        Day const d(kind);
        double const r = static_cast<double>(radius);
        Vec3 const sun = normalize(kind.sun_direction);
        double const l = luminance_of(d.radiance(sun));
        Random random(3);
        Mean e, facing;
        for (int i = 0; i < n; ++i) {
            auto const s = d.sample(random_square(random));
            if (!s) continue;
            CHECK(static_cast<double>(s->pdf) ==
                  doctest::Approx(1 / (4 * kPiD * std::pow(std::sin(r / 2), 2))).epsilon(1e-4));
            double const x = luminance_of(s->radiance) / static_cast<double>(s->pdf);
            e.add(x * static_cast<double>(s->wi.z));
            facing.add(x * static_cast<double>(dot(s->wi, sun)));
        }
        REQUIRE(static_cast<double>(e.count()) > n * 0.999);
        auto const a =
            agrees(e, l * kPiD * std::pow(std::sin(r), 2) * std::sin(35 * kPiD / 180), 0.002, sidak(3));
        INFO(a);
        CHECK((a.powerful && std::abs(a.mean - a.expected) < a.half_width + 2e-4 * a.expected));
        // Within (1 + cos r) / 2, the mean cosine of the cone, all sizes give the same.
        static double first = 0;
        double const total = l * 4 * kPiD * std::pow(std::sin(r / 2), 2);
        if (first == 0) first = total;
        CHECK(total == doctest::Approx(first).epsilon(1e-4));
        // Sharp edges.
        Vec3 const across = frame_from_z(sun).x;
        auto const at = [&](double angle) {
            return d.radiance(normalize(sun * static_cast<float>(std::cos(angle)) +
                                        across * static_cast<float>(std::sin(angle))));
        };
        CHECK(luminance_of(at(r * 0.999)) == doctest::Approx(l));
        CHECK(at(r * 1.001).is_black());
    }
}

TEST_CASE("daylight: samples by the density, which integrates to 1; the sun gets its share") {
    struct Case {
        float turbidity;
        double elevation;
        Mat4 place;
        double determinant;
    };
    Case const cases[] = {{1.7f, 3, Mat4{}, 1},
                          {2.5f, 45, turned(), 1},
                          {6, 80, turned() * scale(1, 1, 3), 3},
                          {10, 0, Mat4{}, 1}};
    double const alpha = sidak(2 * 4);
    int const n = samples(1'000'000, 4'000'000);
    for (Case const& c : cases) {
        CAPTURE(c.turbidity);
        CAPTURE(c.elevation);
        auto kind = day(c.turbidity, c.elevation);
        kind.sun_radius = 0.02f;  // so that chance alone would find it now and then
        Day const both(kind, c.place);
        kind.sun = false;
        Day const sky(kind, c.place);
        Transform const to_world = *make_transform(c.place);
        Vec3 const sun = normalize(kind.sun_direction);
        // Everything is counted in light space, where the horizon is an edge of cells: d(world) / d(local) = |det| / |M l|^3.
        auto const local = [&](Vec3 w) { return normalize(to_world.vector_inverse(w)); };
        auto const in_sun = [&](Vec3 l) { return length(l - sun) <= 2 * std::sin(0.01f); };
        auto const sky_pdf = [&](Vec3 l) {
            Vec3 const w = to_world.vector(l);
            return sky.pdf(normalize(w)) * c.determinant / std::pow(static_cast<double>(length(w)), 3);
        };
        // Away from the sun only the sky's density is left: it says what the sun's share is.
        Vec3 const away = normalize(to_world.vector(normalize(Vec3{-sun.x, -sun.y, sun.z + 0.3f})));
        double const share = 1 - both.pdf(away) / sky.pdf(away);
        CHECK(share > 0.12);
        CHECK(share < 0.88);
        SphereCells const cells(24, 48);
        std::vector<double> o(cells.size() + 1);
        Random r(4);
        for (int i = 0; i < n; ++i) {
            auto const s = both.sample(random_square(r));
            REQUIRE(s);
            REQUIRE((s->pdf > 0 && std::isfinite(s->pdf)));
            REQUIRE(std::abs(length(s->wi) - 1) < 1e-5f);
            REQUIRE(s->at_infinity);
            REQUIRE(static_cast<double>(s->pdf) == doctest::Approx(both.pdf(s->wi)).epsilon(1e-4));
            REQUIRE(s->radiance[1] == doctest::Approx(both.radiance(s->wi)[1]).epsilon(1e-4));
            Vec3 const l = local(s->wi);
            ++o[in_sun(l) ? cells.size() : cells.cell(l)];
        }
        // Densities of the sky are integrated finely with the sun's disk left out, which has a bin of its own.
        double inside = 0;
        auto e = cells.integrate(
            [&](Vec3 l) {
                bool const sunny = in_sun(l);
                double const p = sky_pdf(l);
                if (sunny) inside += p / (32.0 * 32);
                return sunny ? 0.0 : p;
            },
            32);
        inside *= 4 * kPiD / static_cast<double>(cells.size());
        double total = inside;
        for (double const x : e) total += x;
        CHECK(total == doctest::Approx(1).epsilon(2e-3));
        for (double& x : e) x *= n * (1 - share) / total;
        e.push_back(n * (share + (1 - share) * inside / total));
        auto const chi = chi_square(o, e);
        INFO(chi);
        CHECK(chi.p >= alpha / 10);
        // No number is too large or too small.
        for (float const x : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
            for (float const y : {0.0f, 0x1p-32f, 0.5f, 1 - 0x1p-24f})
                if (auto const s = both.sample({x, y})) {
                    CHECK(is_finite(s->wi));
                    CHECK((s->pdf > 0 && std::isfinite(s->pdf)));
                    CHECK(s->radiance.is_finite());
                }
    }
}

TEST_CASE("daylight: a horizontal surface gets by samples what quadrature says") {
    int const n = samples(400'000, 2'000'000);
    double const alpha = sidak(2);
    for (bool const low : {false, true}) {
        auto kind = day(low ? 6 : 2.2f, low ? 8 : 50);
        Day const both(kind);
        kind.sun = false;
        Day const sky(kind);
        double const diffuse =
            hemisphere([&](Vec3 w) { return luminance_of(sky.radiance(w)) * static_cast<double>(w.z); });
        Vec3 const sun = normalize(kind.sun_direction);
        double const direct = (luminance_of(both.radiance(sun)) - luminance_of(sky.radiance(sun))) * kPiD *
                              std::pow(std::sin(kReal), 2) * static_cast<double>(sun.z);
        Random r(5);
        Mean e;
        for (int i = 0; i < n; ++i) {
            auto const s = both.sample(random_square(r));
            e.add(s ? luminance_of(s->radiance) * std::max(0.0, static_cast<double>(s->wi.z)) /
                          static_cast<double>(s->pdf)
                    : 0.0);
        }
        auto const a = agrees(e, diffuse + direct, 0.01, alpha);
        INFO(a);
        INFO("sky ", diffuse, " klx, sun ", direct, " klx");
        CHECK(a.powerful);
        CHECK(std::abs(a.mean - a.expected) < a.half_width + 5e-4 * a.expected);
        CHECK(diffuse > 3);
        CHECK(diffuse < 60);
    }
}

TEST_CASE("daylight sent out: all that passes the scene's disk, and the densities of each ray") {
    BoundingSphere const scene{{1, 2, 3}, 4};
    int const n = samples(400'000, 2'000'000);
    for (Mat4 const& place : {Mat4{}, turned()}) {
        auto kind = day(3, 30);
        Day const both(kind, place);
        kind.sun = false;
        Day const sky(kind, place);
        Day const level(kind);
        double const sky_light = hemisphere([&](Vec3 w) { return luminance_of(level.radiance(w)); });
        Vec3 const sun = normalize(kind.sun_direction);
        Vec3 const there = normalize(make_transform(place)->vector(sun));
        double const sun_light = (luminance_of(both.radiance(there)) - luminance_of(sky.radiance(there))) *
                                 4 * kPiD * std::pow(std::sin(kReal / 2), 2);
        double const disk = kPiD * 16;
        Random r(6);
        Mean sum;
        for (int i = 0; i < n; ++i) {
            Vec2 const a = random_square(r);
            auto const s = sample_emission(both.light(), both.data, both.assets, scene, a, random_square(r),
                                           Wavelengths::rgb());
            if (!s) {
                sum.add(0);
                continue;
            }
            sum.add(luminance_of(s->radiance) / static_cast<double>(s->pdf_position) /
                    static_cast<double>(s->pdf_direction));
            if (i % 64) continue;
            auto const density = emission_density(both.light(), both.data, scene, s->ray.o, s->ray.d);
            CHECK(density.position == doctest::Approx(s->pdf_position).epsilon(1e-4));
            CHECK(density.direction == doctest::Approx(s->pdf_direction).epsilon(1e-4));
            // Backwards it is the light that is seen there.
            CHECK(both.radiance(-s->ray.d)[1] == doctest::Approx(s->radiance[1]).epsilon(1e-4));
        }
        auto const a = agrees(sum, disk * (sky_light + sun_light), 0.01);
        INFO(a);
        CHECK(a.powerful);
        CHECK(std::abs(a.mean - a.expected) < a.half_width + 5e-4 * a.expected);
        // What lights are chosen by: a white sky of the same light counts as much.
        Scene other;
        InfiniteLight white;
        white.scale = static_cast<float>(sky_light / (4 * kPiD));
        other.add(Light{white, {}, {}});
        Assets assets(other);
        auto const data = prepare(other.lights[0], assets);
        CHECK(sky.watts(scene) / static_cast<double>(power(other.lights[0], data, assets, scene)) ==
              doctest::Approx(1).epsilon(0.01));
        CHECK_FALSE(light_bounds(both.light(), both.data, both.assets));
    }
    // Of a setting sun one half is there.
    auto kind = day(3, 0, true, false);
    kind.sun_radius = 0.1f;
    Day const half(kind);
    auto const whole = [&] {
        Random r(7);
        double sum = 0;
        for (int i = 0; i < 20000; ++i)
            if (auto const s = half.sample(random_square(r)))
                sum += luminance_of(s->radiance) / static_cast<double>(s->pdf) / 20000;
        return sum;
    }();
    double const full = luminance_of(half.radiance(direction(kPiD / 2 - 0.01, std::atan2(0.8, 0.6)))) * 4 *
                        kPiD * std::pow(std::sin(0.05), 2);
    CHECK(whole / full == doctest::Approx(0.5).epsilon(0.03));
}
