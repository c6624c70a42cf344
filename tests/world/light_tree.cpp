// The tree by which one of many lights is chosen: a distribution at every receiver, that leaves out no light that matters.
#include "world/light_tree.h"

#include "statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace nephroid;
using nephroid::test::chi_square;
using nephroid::test::Random;
using nephroid::test::sidak;

namespace {

Vec3 direction(Random& r) {
    float const z = 2 * r.unit() - 1;
    float const phi = kTwoPi * r.unit();
    float const s = safe_sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}
Vec3 point(Random& r, float size) { return size * (Vec3{r.unit(), r.unit(), r.unit()} - 0.5f); }

/// Spots, surfaces of one side and of two, bulbs; small ones and large ones, some of them dark.
std::vector<LightBounds> lights(Random& r, int n) {
    std::vector<LightBounds> all;
    for (int i = 0; i < n; ++i) {
        LightBounds b;
        Vec3 const p = point(r, 10);
        b.box.add(p);
        if (i % 3) b.box.add(p + point(r, i % 2 ? 0.1f : 2.0f));
        b.axis = direction(r);
        b.intensity = i % 7 == 5 ? 0.0f : std::exp(6 * r.unit());
        switch (i % 4) {
            case 0:
                break;  // a bulb
            case 1:
                b.cos_normals = 1, b.cos_emission = 0, b.two_sided = true;
                break;
            case 2:
                b.cos_normals = 1, b.cos_emission = 0;
                break;
            default:
                b.cos_normals = std::cos(0.7f * r.unit()), b.cos_emission = std::cos(2.5f * r.unit());
        }
        all.push_back(b);
    }
    return all;
}

Receiver receiver(Random& r, int i) {
    Receiver to;
    to.p = point(r, i % 2 ? 12.0f : 200.0f);
    if (i % 3) {
        to.n = direction(r);
        to.both_sides = i % 3 == 1;
    }
    return to;
}

/// Whether light of a point of the bounds can get there.
bool reaches(LightBounds const& b, Vec3 from, Receiver const& to) {
    if (!(b.intensity > 0)) return false;
    Vec3 const w = normalize(to.p - from);
    float const theta = std::acos(clamp(b.two_sided ? abs_dot(b.axis, w) : dot(b.axis, w), -1.0f, 1.0f));
    if (theta > std::acos(b.cos_normals) + std::acos(b.cos_emission) - 1e-3f) return false;
    if (to.n == Vec3(0)) return true;
    float const cosine = -dot(to.n, w);
    return (to.both_sides ? std::abs(cosine) : cosine) > 1e-3f;
}

}  // namespace

TEST_CASE("light tree: pmf sums to 1, is what sample() does, and is above 0 where light arrives") {
    Random r(3);
    int const sizes[] = {1, 2, 3, 17, 300};
    int impossible = 0;
    int tests = 0;
    double worst = 1;
    double mean_sum = 0;
    int sums = 0;
    for (int const n : sizes) {
        auto const all = lights(r, n);
        LightTree const tree(all);
        for (int i = 0; i < 24; ++i) {
            Receiver const to = receiver(r, i);
            std::vector<double> pmf;
            double sum = 0;
            for (std::uint32_t k = 0; k < all.size(); ++k) {
                pmf.push_back(static_cast<double>(tree.pmf(to, k)));
                sum += pmf.back();
                CHECK((all[k].intensity > 0 || pmf.back() == 0));
                for (int corner = 0; corner < 8; ++corner)
                    if (reaches(all[k], all[k].box.corner(corner), to) && !(pmf.back() > 0)) ++impossible;
            }
            if (sum == 0) {
                CHECK_FALSE(tree.sample(to, r.unit()).has_value());
                continue;
            }
            // What a node may send and none of its lights does is drawn in vain.
            CHECK(sum <= 1 + 1e-5);
            mean_sum += sum;
            ++sums;
            auto const draws = static_cast<int>(test::samples(30000, 300000));
            std::vector<double> counts(all.size() + 1);
            for (int k = 0; k < draws; ++k) {
                auto const c = tree.sample(to, static_cast<double>(r.unit()));
                counts[c ? c->light : all.size()] += 1;
                if (!c) continue;
                CHECK(static_cast<double>(c->pmf) == doctest::Approx(pmf[c->light]).epsilon(1e-5));
            }
            pmf.push_back(sum < 1 - 1e-5 ? 1 - sum : 0.0);
            for (double& p : pmf) p *= draws;
            int possible = 0;
            for (double const p : pmf) possible += p >= 5;
            if (possible < 2) continue;
            worst = std::min(worst, chi_square(counts, pmf).p);
            ++tests;
        }
    }
    CHECK(impossible == 0);
    CHECK(tests > 50);
    CHECK(mean_sum / sums > 0.99);
    CHECK(worst >= sidak(tests));
}

TEST_CASE("light tree: the ends of the unit interval, and scenes of any size") {
    Random r(5);
    auto all = lights(r, 100);
    LightTree const tree(all);
    for (int const power : {-13, 20}) {
        float const k = std::ldexp(1.0f, power);
        auto scaled = all;
        for (LightBounds& b : scaled) b.box = {b.box.lo * k, b.box.hi * k}, b.intensity *= k * k;
        LightTree const other(scaled);
        for (int i = 0; i < 100; ++i) {
            Receiver const to = receiver(r, i);
            Receiver far = to;
            far.p *= k;
            for (double const u : {0.0, static_cast<double>(r.unit()), 1 - 0x1p-53}) {
                auto const a = tree.sample(to, u);
                auto const b = other.sample(far, u);
                REQUIRE(a.has_value() == b.has_value());
                if (!a) continue;
                CHECK(a->light == b->light);
                CHECK(a->pmf == b->pmf);
                CHECK(a->pmf > 0);
            }
        }
    }
}

TEST_CASE("light tree: lights in one place, in a row that doubles, too bright for floats, and none") {
    CHECK(LightTree(std::vector<LightBounds>{}).empty());
    CHECK(LightTree(std::vector<LightBounds>(5)).empty());  // dark ones
    std::vector<LightBounds> same(1000);
    std::vector<LightBounds> row(200);
    std::vector<LightBounds> bright(50);
    for (std::size_t i = 0; i < same.size(); ++i) same[i].box.add(Vec3{1, 2, 3}), same[i].intensity = 1;
    for (std::size_t i = 0; i < row.size(); ++i)
        row[i].box.add(Vec3{std::ldexp(1.0f, static_cast<int>(i) - 100), 0, 0}), row[i].intensity = 1;
    for (std::size_t i = 0; i < bright.size(); ++i)
        bright[i].box.add(Vec3{static_cast<float>(i), 0, 0}), bright[i].intensity = 1e30f;
    for (auto const* all : {&same, &row, &bright}) {
        LightTree const tree(*all);
        for (Vec3 const p : {Vec3{0, 0, 1}, Vec3{1, 2, 3}, Vec3{5, 0, 0}}) {
            double sum = 0;
            for (std::uint32_t k = 0; k < all->size(); ++k)
                sum += static_cast<double>(tree.pmf(Receiver{p}, k));
            // In the very place of all lights none can send anything.
            if (all == &same && p == Vec3{1, 2, 3})
                CHECK(sum == 0);
            else
                CHECK(sum == doctest::Approx(1).epsilon(1e-4));
        }
    }
}
