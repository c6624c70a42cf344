// Environments seen through a portal: densities against counts, energy against Lambert's formula, rays sent in through it.
#include "lights.h"

#include <doctest/doctest.h>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

using namespace nephroid;
using namespace nephroid::test;

namespace {

using Corners = std::array<Vec3, 4>;

/// A picture of `side` x `side` texels, equal-area, with a bright spot and black texels.
Picture sky_picture(int side) {
    return Picture("portal", side, side, [side](int x, int y) {
        float const v = x % 9 == 4 ? 0.0f : 1 + static_cast<float>((x * 7 + y * 3) % 11) / 5;
        bool const spot = std::abs(x - 3 * side / 4) < 2 && std::abs(y - side / 2) < 2;
        return spot ? Vec3(200) : v * Vec3{1, 1.2f, 1.4f};
    });
}
double luminance_at(Lit const& l, Vec3 p, Vec3 w) { return luminance_of(l.radiance(p, w)); }

InfiniteLight through(Corners const& corners, bool picture, float scale = 1) {
    InfiniteLight l;
    if (picture) l.image = ImageId{0};
    l.mapping = EnvironmentMapping::EqualArea;
    l.scale = scale;
    l.portal = corners;
    return l;
}

/// 3 x 2, its normal turned away from all axes: light comes from cross(p3 - p0, p1 - p0).
Frame const kFrame = frame_from_z(normalize(Vec3{0.3f, -0.5f, 0.8f}));
Vec3 const kCentre{1, 2, 3};
Vec3 placed(double x, double y, double z) {
    return kCentre + kFrame.from_local({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
}
Corners const kCorners{placed(-1.5, -1, 0), placed(-1.5, 1, 0), placed(1.5, 1, 0), placed(1.5, -1, 0)};

/// In front of the portal: near, far, aside, grazing, in the portal's own plane nearly.
std::vector<Vec3> receivers() {
    std::vector<Vec3> r{placed(0, 0, -1),     placed(0.2, 0.1, -0.01), placed(0.2, -0.3, -0.004),
                        placed(0, 0, -10),    placed(3, -4, -100),     placed(40, 20, -300),
                        placed(5, 0, -0.1),   placed(0, -8, -0.2),     placed(30, 40, -1),
                        placed(1.5, 1, -0.5), placed(-1.5, 0, -0.05),  placed(1.499, 0.999, -0.001),
                        placed(-100, 3, -2),  placed(0, 0, -1000)};
    Random random(21);
    while (r.size() < 22)
        r.push_back(placed(random.uniform(-6, 6), random.uniform(-6, 6), -std::exp(random.uniform(-3, 3))));
    return r;
}

/// A point of the portal by shares of its sides, and d(solid angle) / d(shares) seen from p.
struct Seen {
    Vec3 w;
    double element;
};
Seen seen_from(Vec3 p, double a, double b) {
    Vec3 const to = placed(-1.5 + 3 * a, -1 + 2 * b, 0) - p;
    double const r2 = static_cast<double>(length_squared(to));
    double const height = -static_cast<double>(kFrame.to_local(p - kCentre).z);
    return {normalize(to), 6 * height / (r2 * std::sqrt(r2))};
}
/// Where p's ray along w meets the portal's plane, as shares of its sides.
Vec2 shares(Vec3 p, Vec3 w) {
    Vec3 const o = kFrame.to_local(p - kCentre);
    Vec3 const d = kFrame.to_local(w);
    float const t = -o.z / d.z;
    return {(o.x + t * d.x + 1.5f) / 3, (o.y + t * d.y + 1) / 2};
}

/// Irradiance from a polygon of radiance 1 on a surface at p with normal n, wholly above its horizon: Lambert's formula.
double lambert(Corners const& corners, Vec3 p, Vec3 n) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        auto const unit = [&](Vec3 c) {
            std::array<double, 3> v{};
            double l = 0;
            for (int k = 0; k < 3; ++k)
                v[static_cast<std::size_t>(k)] = static_cast<double>(c[k]) - static_cast<double>(p[k]);
            for (double const x : v) l += x * x;
            for (double& x : v) x /= std::sqrt(l);
            return v;
        };
        auto const a = unit(corners[i]), b = unit(corners[(i + 1) % 4]);
        std::array<double, 3> const c{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                      a[0] * b[1] - a[1] * b[0]};
        double const s = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        double const gamma = std::atan2(s, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
        sum += gamma / s *
               (c[0] * static_cast<double>(n.x) + c[1] * static_cast<double>(n.y) +
                c[2] * static_cast<double>(n.z));
    }
    return std::abs(sum) / 2;
}

}  // namespace

TEST_CASE("through a portal: samples by the density, which integrates to 1 over the portal as it is seen") {
    Picture const picture = sky_picture(64);
    Lit const l(through(kCorners, true, 2), *rotate(40, 1, 1, 0), picture.files());
    int const n = samples(500'000, 4'000'000);
    auto const points = receivers();
    double const alpha = sidak(static_cast<int>(points.size()));
    int const sub = 4;
    for (Vec3 const p : points) {
        Vec3 const local = kFrame.to_local(p - kCentre);
        CAPTURE(local.x);
        CAPTURE(local.y);
        CAPTURE(local.z);
        // Bins by the angles under which the portal's sides are seen; shared out evenly, and cut where the table's cells end, so
        // that the density is smooth within a bin.
        double const h = -static_cast<double>(local.z);
        auto const edges = [&](double at, double half) {
            double const lo = std::atan((-half - at) / h), hi = std::atan((half - at) / h);
            std::vector<double> r;
            for (int i = 0; i <= 16; ++i) r.push_back(lo + (hi - lo) * i / 16);
            for (int i = -32; i <= 32; ++i)
                if (kPiD * i / 64 > lo && kPiD * i / 64 < hi) r.push_back(kPiD * i / 64);
            std::sort(r.begin(), r.end());
            return r;
        };
        auto const xs = edges(static_cast<double>(local.x), 1.5), ys = edges(static_cast<double>(local.y), 1);
        std::size_t const nx = xs.size() - 1, ny = ys.size() - 1;
        auto const bin = [&](std::vector<double> const& r, float share, double at, double half) {
            double const angle = std::atan((static_cast<double>(share) * 2 * half - half - at) / h);
            auto const i = std::upper_bound(r.begin(), r.end(), angle) - r.begin() - 1;
            return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(r) - 2));
        };
        std::vector<double> o(nx * ny), e(nx * ny);
        double total = 0;
        for (std::size_t j = 0; j < ny; ++j)
            for (std::size_t i = 0; i < nx; ++i)
                for (int b = 0; b < sub; ++b)
                    for (int a = 0; a < sub; ++a) {
                        double const tx = xs[i] + (xs[i + 1] - xs[i]) * (a + 0.5) / sub;
                        double const ty = ys[j] + (ys[j + 1] - ys[j]) * (b + 0.5) / sub;
                        Seen const s =
                            seen_from(p, (static_cast<double>(local.x) + h * std::tan(tx) + 1.5) / 3,
                                      (static_cast<double>(local.y) + h * std::tan(ty) + 1) / 2);
                        // d(shares) / d(angles), over a bin's part.
                        double const slopes = h / (3 * sqr(std::cos(tx))) * h / (2 * sqr(std::cos(ty)));
                        e[j * nx + i] += l.pdf(p, s.w) * s.element * slopes * (xs[i + 1] - xs[i]) *
                                         (ys[j + 1] - ys[j]) / (sub * sub);
                    }
        for (double const x : e) total += x;
        CHECK(total == doctest::Approx(1).epsilon(5e-3));
        for (double& x : e) x *= n / total;
        Random r(22);
        int other = 0, outside = 0, dark = 0;
        for (int i = 0; i < n; ++i) {
            auto const s = l.sample(p, random_square(r));
            REQUIRE(s);
            REQUIRE((s->pdf > 0 && std::isfinite(s->pdf)));
            REQUIRE((s->at_infinity && !s->delta));
            Vec2 const share = shares(p, s->wi);
            ++o[bin(ys, share.y, static_cast<double>(local.y), 1) * nx +
                bin(xs, share.x, static_cast<double>(local.x), 1.5)];
            if (i % 8 != 0) continue;
            // The direction's own density; rounding may find the cell next door, or none past the portal's rim, rarely.
            double const again = l.pdf(p, s->wi);
            outside += again == 0;
            other += again > 0 && std::abs(again / static_cast<double>(s->pdf) - 1) > 1e-4;
            if (again > 0)
                dark += std::abs(luminance_at(l, p, s->wi) - luminance_of(s->radiance)) >
                        1e-4 * (1 + luminance_at(l, p, s->wi));
        }
        CHECK(other <= n / 8 / 500);
        CHECK(outside <= n / 8 / 200);
        CHECK(dark == 0);
        auto const c = chi_square(o, e);
        INFO(c);
        CHECK(c.p >= alpha);
    }
}

TEST_CASE("through a portal: nothing behind it, beside it, or in its wall") {
    Picture const picture = sky_picture(64);
    Lit const l(through(kCorners, true), {}, picture.files());
    InfiniteLight open = through(kCorners, true);
    open.portal.reset();
    Lit const sky(open, {}, picture.files());
    Vec3 const outwards = kFrame.from_local({0, 0, 1});
    for (Vec3 const p : {placed(0, 0, 1), placed(0, 0, 1e-3), placed(9, 0, 50)}) {
        CHECK_FALSE(l.sample(p, {0.3f, 0.6f}));
        CHECK(l.pdf(p, outwards) == 0);
        CHECK(luminance_at(l, p, outwards) == 0);
    }
    Random r(23);
    int inside = 0;
    for (int i = 0; i < 40000; ++i) {
        Vec3 const p = placed(r.uniform(-4, 4), r.uniform(-4, 4), -std::exp(r.uniform(-4, 2)));
        Vec3 const w = random_direction(r);
        float const up = kFrame.to_local(w).z;
        Vec2 const at = shares(p, w);
        float const rim = std::min(std::min(at.x, 1 - at.x), std::min(at.y, 1 - at.y));
        if (std::abs(rim) < 1e-4f) continue;
        bool const in = up > 0 && rim > 0;
        inside += in;
        REQUIRE((l.pdf(p, w) > 0) == in);
        REQUIRE(luminance_at(l, p, w) == (in ? luminance_at(sky, p, w) : 0));
    }
    CHECK(inside > 1000);
}

TEST_CASE(
    "irradiance through a portal from a sky of one colour is Lambert's formula, by a picture or without "
    "one") {
    int const n = samples(100'000, 2'000'000);
    auto const path = (std::filesystem::temp_directory_path() /
                       ("nephroid_portal_even_" + std::to_string(::getpid()) + ".pfm"))
                          .string();
    Image even(PixelFormat::Float, 64, 64, {"R", "G", "B"});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) even.set(x, y, c, 0.5f);
    write_pfm(path, even);
    Lit const by_picture(through(kCorners, true, 6), {}, {{path, "", {}}});
    Lit const without(through(kCorners, false, 3));
    std::filesystem::remove(path);
    double const alpha = sidak(2 * 22);
    for (Lit const* l : {&by_picture, &without})
        for (Vec3 const p : receivers()) {
            CAPTURE(kFrame.to_local(p - kCentre).z);
            // Faces the wall: all of the portal is above the horizon.
            Vec3 const normal = kFrame.from_local({0, 0, 1});
            Random r(24);
            Mean mean;
            for (int i = 0; i < n; ++i) {
                auto const s = l->sample(p, random_square(r));
                REQUIRE(s);
                mean.add(luminance_of(s->radiance) * static_cast<double>(dot(s->wi, normal)) /
                         static_cast<double>(s->pdf));
            }
            // Not so where the portal is within rounding of the receiver.
            auto const a = agrees(mean, 3 * lambert(kCorners, p, normal), 0.01, alpha);
            INFO(a);
            CHECK(a.powerful);
            CHECK((a.equal || std::abs(a.mean / a.expected - 1) < 2e-4));
        }
}

TEST_CASE(
    "rays sent in through a portal carry its power, and what they bring to a disk is what the disk sees") {
    Picture const picture = sky_picture(64);
    Lit const l(through(kCorners, true, 2), *rotate(40, 1, 1, 0), picture.files());
    InfiniteLight open = through(kCorners, true, 2);
    open.portal.reset();
    Lit const sky(open, *rotate(40, 1, 1, 0), picture.files());
    BoundingSphere const scene{placed(0, 0, -2), 7};
    int const n = samples(400'000, 4'000'000);
    // Power: area times the integral of radiance * cos over the half space.
    double flux = 0;
    int const k = 1200;
    for (int j = 0; j < k; ++j)
        for (int i = 0; i < k; ++i) {
            double const c = std::sqrt((i + 0.5) / k);  // d(cos^2) / 2 = cos d(cos)
            flux +=
                luminance_at(sky, {}, kFrame.from_local(direction(std::acos(c), 2 * kPiD * (j + 0.5) / k))) *
                kPiD / (static_cast<double>(k) * k);
        }
    flux *= 6;
    // A disk of radius 1, two below the portal and aside, that faces it askew.
    Vec3 const centre = placed(0.5, 0.3, -2);
    Frame const disk = frame_from_z(normalize(kFrame.from_local({0.2f, -0.1f, 1})));
    Random r(25);
    Mean power_mean, caught, seen;
    int other = 0, missed = 0;
    for (int i = 0; i < n; ++i) {
        auto const s = sample_emission(l.light(), l.data, l.assets, scene, random_square(r), random_square(r),
                                       Wavelengths::rgb());
        double weight = 0, hit = 0;
        if (s) {
            REQUIRE((s->pdf_position > 0 && s->pdf_direction > 0));
            weight = luminance_of(s->radiance) / static_cast<double>(s->pdf_position * s->pdf_direction);
            // It starts outside the scene, and passes the portal.
            REQUIRE(dot(s->ray.o - scene.centre, s->ray.d) <= -0.999f * scene.radius);
            Vec2 const at = shares(s->ray.o, -s->ray.d);
            REQUIRE((at.x > -1e-4f && at.x < 1.0001f && at.y > -1e-4f && at.y < 1.0001f));
            // Found again from a point of the ray.
            auto const d = emission_density(l.light(), l.data, scene, s->ray.o + 5.0f * s->ray.d, s->ray.d);
            missed += d.position == 0;
            other += std::abs(static_cast<double>(d.direction / s->pdf_direction) - 1) > 1e-4;
            if (d.position > 0) REQUIRE(d.position == doctest::Approx(s->pdf_position).epsilon(1e-4));
            Vec3 const o = disk.to_local(s->ray.o - centre), w = disk.to_local(s->ray.d);
            Vec3 const x = o - o.z / w.z * w;
            if (w.z < 0 && x.x * x.x + x.y * x.y < 1) hit = weight;
        }
        power_mean.add(weight);
        caught.add(hit);
        // The other way: from points of the disk.
        Vec2 const on = square_to_disk(random_square(r));
        Vec3 const p = centre + disk.from_local({on.x, on.y, 0});
        auto const b = l.sample(p, random_square(r));
        seen.add(b ? luminance_of(b->radiance) *
                         std::max(0.0, static_cast<double>(dot(b->wi, disk.from_local({0, 0, 1})))) /
                         static_cast<double>(b->pdf) * kPiD
                   : 0.0);
    }
    CHECK(other <= n / 500);
    CHECK(missed <= n / 5000);
    auto const a = agrees(power_mean, flux, 0.01, 1e-6);
    INFO(a);
    CHECK(a.powerful);
    CHECK(std::abs(a.mean - flux) <= a.half_width + 0.003 * flux);  // the quadrature's own error
    CHECK(static_cast<double>(power(l.light(), l.data, l.assets, scene)) ==
          doctest::Approx(flux).epsilon(0.05));
    INFO(caught.mean(), " +- ", caught.half_width(), ", ", seen.mean(), " +- ", seen.half_width());
    CHECK(caught.half_width() < (kSanitizerShare > 1 ? 0.06 : 0.02) * seen.mean());
    CHECK(std::abs(caught.mean() - seen.mean()) <= std::hypot(caught.half_width(), seen.half_width()));
    // Without a picture it is exact.
    Lit const plain(through(kCorners, false, 3));
    CHECK(
        static_cast<double>(power(plain.light(), plain.data, plain.assets, scene)) ==
        doctest::Approx(3 * kPiD * 6 * static_cast<double>(plain.data.emission.scaled(1 / 3.0f).max_value()))
            .epsilon(2e-3));
    // Not along the wall, not from inside.
    CHECK(emission_density(l.light(), l.data, scene, kCentre, kFrame.from_local({0, 0, 1})).direction == 0);
    CHECK(
        emission_density(l.light(), l.data, scene, placed(4, 0, 0), kFrame.from_local({0, 0, -1})).position ==
        0);
}

TEST_CASE("a portal and a receiver scaled by a power of two give the same bits") {
    Picture const picture = sky_picture(64);
    Random r(26);
    for (float const s : {0x1p-40f, 0x1p30f}) {
        Corners small = kCorners;
        for (Vec3& c : small) c *= s;
        Lit const a(through(kCorners, true), {}, picture.files());
        Lit const b(through(small, true), {}, picture.files());
        for (Vec3 const p : receivers())
            for (int i = 0; i < 20; ++i) {
                Vec2 const u = random_square(r);
                auto const x = a.sample(p, u), y = b.sample(p * s, u);
                REQUIRE((x && y));
                REQUIRE(x->wi == y->wi);
                REQUIRE(x->pdf == y->pdf);
                REQUIRE(a.pdf(p, x->wi) == b.pdf(p * s, x->wi));
            }
    }
}

TEST_CASE("a portal's samples at extreme numbers, and a black picture") {
    Picture const picture = sky_picture(64);
    Lit const l(through(kCorners, true), {}, picture.files());
    for (Vec3 const p : receivers())
        for (float const x : {0.0f, 0x1p-32f, 0x1p-24f, 0.5f, 1 - 0x1p-24f})
            for (float const y : {0.0f, 0x1p-32f, 0x1p-24f, 0.5f, 1 - 0x1p-24f})
                if (auto const s = l.sample(p, {x, y})) {
                    CHECK(is_finite(s->wi));
                    CHECK((s->pdf > 0 && std::isfinite(s->pdf)));
                    CHECK(s->radiance.is_finite());
                    CHECK(std::abs(length(s->wi) - 1) < 1e-6f);
                }
    Corners bent = kCorners;
    bent[2] = placed(1.5, 1, 0.5);
    CHECK_THROWS_AS(Lit(through(bent, false)), Error);
}
