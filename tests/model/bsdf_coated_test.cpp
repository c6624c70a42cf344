// Coats. The walks against formulas where there are some (a smooth coat over a diffuse base, single scattering, mirrors), against
// themselves (samples against values, reciprocity, f and density independent), and the closed forms against the walks.
#include "bsdf_checks.h"
#include "model/material.h"
#include "sampling/warp.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Fewer samples under sanitizers: wider intervals.
constexpr double kRoom = kSanitizerShare > 1 ? 4 : 1;

auto const kCosine = HemisphereSampling::Cosine;

CoatLayer coat(float alpha, float thickness = 0.01f, float medium = 0) {
    CoatLayer l;
    l.facets.ax = l.facets.ay = alpha;
    l.thickness = thickness;
    l.albedo = Spectrum(medium);
    return l;
}
CoatedDiffuseBsdf over_diffuse(CoatLayer const& l, float rho = 0.8f) { return {l, Spectrum(rho), 0}; }
/// Copper in the green and in the red under a coat of 1.5.
CoatedConductorBsdf over_copper(CoatLayer const& l, float alpha, bool red = false) {
    CoatedConductorBsdf b{l, Spectrum(red ? 0.14f : 0.75f), Spectrum(red ? 2.45f : 1.6f), {}, 0};
    b.facets.ax = b.facets.ay = alpha;
    return b;
}
/// A draw of another walk each time; its throughput is added to one of two means.
template <class B>
void add_sample(B& b, Vec3 wo, Random& r, Mean& spread, Mean& delta) {
    if constexpr (requires { b.seed; }) b.seed = static_cast<std::uint32_t>(r.bits());
    float const uc = r.unit();
    auto const s = sample(b, wo, uc, random_square(r), Mode::Radiance, kCosine);
    double const t = s ? throughput(*s) : 0;
    spread.add(s && s->delta ? 0 : t);
    delta.add(s && s->delta ? t : 0);
}
/// f by many seeds, or exactly.
template <class B>
Mean value(B b, Vec3 wo, Vec3 wi, Random& r, int n) {
    Mean m;
    for (int i = 0; i < n; ++i) {
        if constexpr (requires { b.seed; }) b.seed = static_cast<std::uint32_t>(r.bits());
        m.add(static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[0]));
    }
    return m;
}
/// p-value of two means being the same.
double same(Mean const& a, Mean const& b) {
    double const error = std::hypot(a.standard_error(), b.standard_error());
    double const off = std::max(0.0, std::abs(a.mean() - b.mean()) - 1e-5 * std::abs(a.mean()));
    return off == 0 ? 1 : student_p(off / error, static_cast<double>(std::min(a.count(), b.count()) - 1));
}
std::vector<Vec3> few() {
    return {direction(0, 0), direction(0.7, 1), direction(1.3, -2), direction(2.2, 2)};
}

template <class F>
void for_all_walks(F const& f) {
    for (float const alpha : {0.0f, 0.3f})
        for (float const medium : {0.0f, 0.9f}) {
            CoatLayer l = coat(alpha, medium > 0 ? 0.5f : 0.01f, medium);
            l.g = 0.4f;
            INFO("coat ", alpha, ", medium ", medium);
            f(over_diffuse(l), 1);
            for (float const base : {0.0f, 0.4f}) {
                INFO("base ", base);
                f(over_copper(l, base), 2);
            }
        }
}

}  // namespace

TEST_CASE("coats: samples carry what values integrate to") {
    Random r(11);
    for_all_walks([&](auto b, int) {
        if (traits(b).delta) return;
        for (Vec3 const wo : few()) {
            Mean spread, delta, values;
            int const n = samples(40'000, 2'000'000);
            for (int i = 0; i < n; ++i) add_sample(b, wo, r, spread, delta);
            for (int i = 0; i < n; ++i) {
                b.seed = static_cast<std::uint32_t>(r.bits());
                // Half of the directions uniformly by their cosine, half about the mirrored one, where lobes are.
                Vec3 const mirrored{-wo.x, -wo.y, wo.z};
                Vec2 const u = random_square(r);
                Vec3 wi = i % 2 ? square_to_cosine_hemisphere(u)
                                : frame_from_z(mirrored).from_local(square_to_cosine_hemisphere(
                                      {0.5f + (u.x - 0.5f) * 0.6f, 0.5f + (u.y - 0.5f) * 0.6f}));
                if (i % 2 && wo.z < 0) wi = -wi;
                double const about = static_cast<double>(dot(wi, mirrored));
                Vec2 const back = cosine_hemisphere_to_square(frame_from_z(mirrored).to_local(wi));
                bool const inside =
                    about > 0 && std::abs(back.x - 0.5f) < 0.3f && std::abs(back.y - 0.5f) < 0.3f;
                double const cosine = std::abs(static_cast<double>(wi.z));
                double const density =
                    0.5 * cosine / kPiD * (wi.z * wo.z > 0) + (inside ? 0.5 * about / (kPiD * 0.36) : 0.0);
                values.add(density > 0 ? static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[0]) *
                                             cosine / density
                                       : 0);
            }
            INFO("wo.z ", wo.z, ": samples ", spread.mean(), " +- ", spread.standard_error(), ", values ",
                 values.mean(), " +- ", values.standard_error());
            CHECK(same(spread, values) >= sidak(4 * 11));
            CHECK(spread.mean() + delta.mean() <= 1);
            CHECK(values.half_width() <= kRoom * (0.04 * values.mean() + 0.003));
        }
    });
}

TEST_CASE("coats: the mean over seeds is reciprocal, and importance scatters as radiance does") {
    Random r(12);
    for_all_walks([&](auto const& b, int) {
        if (traits(b).delta) return;
        for (auto const& [a, c] : {std::pair{direction(0.3, 0), direction(0.8, 2.5)},
                                   std::pair{direction(1.3, 1), direction(0.9, -2)}}) {
            int const n = samples(30'000, 1'000'000);
            Mean const there = value(b, a, c, r, n), back = value(b, c, a, r, n);
            INFO(there.mean(), " +- ", there.standard_error(), ", ", back.mean(), " +- ",
                 back.standard_error());
            CHECK(same(there, back) >= sidak(2 * 11));
            CHECK(evaluate(b, a, c, Mode::Importance)[0] == evaluate(b, a, c, Mode::Radiance)[0]);
            // Both sides look alike, and nothing passes.
            CHECK(evaluate(b, -a, -c, Mode::Radiance)[0] == evaluate(b, a, c, Mode::Radiance)[0]);
            CHECK(evaluate(b, a, -c, Mode::Radiance).is_black());
        }
    });
}

TEST_CASE("coats: f and the density are estimated apart, and depend on nothing but their keys") {
    Random r(13);
    auto b = over_diffuse(coat(0.3f));
    Vec3 const wo = direction(0.5, 0), wi = direction(0.8, 2.5);
    std::vector<double> f, p;
    for (int i = 0; i < samples(60'000, 500'000); ++i) {
        b.seed = static_cast<std::uint32_t>(r.bits());
        f.push_back(static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[0]));
        p.push_back(static_cast<double>(pdf(b, wo, wi, kCosine)));
        CHECK(f.back() == static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[0]));
    }
    Mean fm, pm;
    for (std::size_t i = 0; i < f.size(); ++i) fm.add(f[i]), pm.add(p[i]);
    CHECK(pm.variance() > 0);
    Mean product, control;
    for (std::size_t i = 0; i < f.size(); ++i) {
        product.add((f[i] - fm.mean()) * (p[i] - pm.mean()));
        control.add((f[i] - fm.mean()) * (f[i] - fm.mean()));
    }
    CHECK(product.p(0) >= 0.01);
    CHECK(product.half_width() < kRoom * 0.05 * std::sqrt(fm.variance() * pm.variance()));
    CHECK(control.p(0) < 1e-9);
}

TEST_CASE("coats: multiple importance sampling with the estimated density is unbiased") {
    Random r(14);
    for_all_walks([&](auto b, int) {
        if (traits(b).delta) return;
        Vec3 const wo = direction(0.6, 0.3);
        // A light that covers a part of the sky.
        auto const light = [](Vec3 w) { return w.x < 0 && w.z > 0 ? 1 + static_cast<double>(w.y) : 0.0; };
        Mean plain, mis;
        for (int i = 0; i < samples(60'000, 1'000'000); ++i) {
            b.seed = static_cast<std::uint32_t>(r.bits());
            float const uc = r.unit();
            auto const s = sample(b, wo, uc, random_square(r), Mode::Radiance, kCosine);
            Vec3 const wl = square_to_uniform_hemisphere(random_square(r));
            double sum = 0;
            bool const spread = s && !s->delta;
            if (spread) {
                CHECK(s->proportional);
                float const w = power_heuristic(pdf(b, wo, s->wi, kCosine), kUniformHemispherePdf);
                sum += throughput(*s) * light(s->wi) * static_cast<double>(w);
            }
            float const w = power_heuristic(kUniformHemispherePdf, pdf(b, wo, wl, kCosine));
            sum += static_cast<double>(evaluate(b, wo, wl, Mode::Radiance)[0] * wl.z * w /
                                       kUniformHemispherePdf) *
                   light(wl);
            mis.add(sum);
            plain.add(spread ? throughput(*s) * light(s->wi) : 0);
        }
        INFO("plain ", plain.mean(), " +- ", plain.standard_error(), ", mis ", mis.mean(), " +- ",
             mis.standard_error());
        CHECK(same(plain, mis) >= sidak(11));
        CHECK(mis.half_width() <= kRoom * (0.05 * mis.mean() + 0.003));
    });
}

TEST_CASE("coats: extreme numbers, grazing directions") {
    for_all_walks([](auto const& b, int) {
        BsdfChecks c{.n = samples(500, 20'000), .by_density = false};
        c.within = 1;
        // Under a smooth coat there are deltas of many probabilities, which that does not count.
        if (!b.coat.facets.smooth()) check_samples(b, c);
    });
}

TEST_CASE("walks under a smooth coat over a diffuse base have the closed form's mean") {
    Random r(15);
    for (float const eta : {1.3f, 2.0f})
        for (float const thickness : {0.01f, 0.3f})
            for (int depth : {1, 10}) {
                CoatLayer l = coat(0, thickness);
                l.eta = eta;
                l.max_depth = static_cast<std::uint8_t>(depth);
                auto b = over_diffuse(l, 0.9f);
                PlasticBsdf const p{Spectrum(0.9f),
                                    Spectrum(1),
                                    eta,
                                    {},
                                    true,
                                    false,
                                    static_cast<std::uint8_t>((depth + 1) / 2),
                                    thickness};
                Vec3 const wo = direction(0.9, 0), wi = direction(0.4, 2);
                Mean const m = value(b, wo, wi, r, samples(40'000, 1'000'000));
                // The tables' own error is not held against the walks.
                auto const expected = static_cast<double>(evaluate(p, wo, wi, Mode::Radiance)[0]);
                INFO("eta ", eta, ", thickness ", thickness, ", depth ", depth, ": ", m.mean(), " +- ",
                     m.standard_error(), ", closed ", expected);
                double const off = std::max(0.0, std::abs(m.mean() - expected) - 1e-3 * expected);
                CHECK((off == 0 || student_p(off / m.standard_error(), 1e4) >= sidak(8)));
                CHECK(m.half_width() < kRoom * 0.01 * expected);
                Mean spread, delta;
                for (int i = 0; i < samples(40'000, 1'000'000); ++i) add_sample(b, wo, r, spread, delta);
                auto const all = static_cast<double>(albedo(p, wo)[0]);
                CHECK(std::abs(spread.mean() + delta.mean() - all) <
                      4 * std::hypot(spread.standard_error(), delta.standard_error()) + 1e-3 * all);
            }
}

TEST_CASE("coats: what loses nothing returns all light but what max_depth cuts off") {
    Random r(16);
    for (Vec3 const wo : {direction(0, 0), direction(1.2, 0)}) {
        auto const f = static_cast<double>(fresnel_dielectric(wo.z, 1.5f));
        for (int meetings : {1, 5, 100}) {
            // White under a smooth coat: (1 - F) K^n is on its way when it is cut off.
            CoatLayer l = coat(0, 0);
            l.max_depth = static_cast<std::uint8_t>(2 * meetings);
            auto b = over_diffuse(l, 1);
            Mean all;
            for (int i = 0; i < samples(60'000, 1'000'000); ++i) {
                Mean spread, delta;
                add_sample(b, wo, r, spread, delta);
                all.add(spread.mean() + delta.mean());
            }
            auto const a = agrees(all, 1 - (1 - f) * std::pow(0.5963, meetings), 0.02, sidak(6));
            INFO("meetings ", meetings, ": ", a);
            CHECK(a);
        }
        // A mirror of eta = 1 and k such that R = 0.9999: all turns between two mirrors.
        CoatLayer l = coat(0, 0);
        CoatedConductorBsdf mirror = over_copper(l, 0);
        mirror.eta = Spectrum(1);
        mirror.k = Spectrum(200);
        Mean spread, delta;
        for (int i = 0; i < 20'000; ++i) add_sample(mirror, wo, r, spread, delta);
        CHECK(traits(mirror).delta);
        CHECK(delta.mean() == doctest::Approx(1).epsilon(2e-3));
        ClosedCoatedConductorBsdf const closed{mirror.eta, mirror.k, {}, {}, 1.5f, 0};
        CHECK(albedo(closed, wo)[0] == doctest::Approx(1).epsilon(2e-3));
    }
}

TEST_CASE("coats: between two mirrors f counts the turns that samples make") {
    Random r(31);
    for (int const depth : {1, 2, 3, 4}) {
        CAPTURE(depth);
        CoatLayer l = coat(0, 1, 1);
        l.max_depth = static_cast<std::uint8_t>(depth);
        CoatedConductorBsdf b = over_copper(l, 0);
        b.eta = Spectrum(1);
        b.k = Spectrum(200);
        Mean values, spread, delta;
        Vec3 const wo = direction(0.7, 1);
        for (int i = 0; i < samples(100'000, 2'000'000); ++i) {
            add_sample(b, wo, r, spread, delta);
            Vec3 const wi = square_to_uniform_hemisphere(random_square(r));
            b.seed = static_cast<std::uint32_t>(r.bits());
            values.add(static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[0] * wi.z) * 2 * kPiD);
        }
        CHECK(same(values, spread) > sidak(4));
        CHECK(values.standard_error() < 0.01 * values.mean());
    }
}

TEST_CASE("coats: the branch of a smooth coat is what samples send into the mirrored direction") {
    Random r(32);
    auto const check = [&](auto const& b, bool smooth) {
        for (Vec3 const wo : few()) {
            DeltaBranches const branches = delta_branches(b, wo, Mode::Radiance);
            CHECK_FALSE(branches.transmitted);
            REQUIRE(branches.reflected.has_value() == smooth);
            if (!smooth) continue;
            CHECK(branches.reflected->wi == Vec3{-wo.x, -wo.y, wo.z});
            Mean spread, delta;
            for (int i = 0; i < samples(20'000, 500'000); ++i) {
                auto copy = b;
                add_sample(copy, wo, r, spread, delta);
            }
            CHECK(std::abs(delta.mean() - throughput(*branches.reflected)) <
                  5 * delta.standard_error() + 1e-4);
        }
    };
    for (float const medium : {0.0f, 0.9f}) {
        check(over_diffuse(coat(0, 0.3f, medium)), true);
        check(over_diffuse(coat(0.3f, 0.3f, medium)), false);
        check(over_copper(coat(0, 0.3f, medium), 0), true);
        check(over_copper(coat(0, 0.3f, medium), 0.3f), true);
        check(over_copper(coat(0.3f, 0.3f, medium), 0), false);
    }
    CoatedConductorBsdf const copper = over_copper(coat(0), 0);
    for (float const base : {0.0f, 0.3f})
        check(ClosedCoatedConductorBsdf{copper.eta, copper.k, {}, {.ax = base, .ay = base}, 1.5f, 0.01f},
              true);
    check(PlasticBsdf{Spectrum(0.5f), Spectrum(0.7f)}, true);
    check(PlasticBsdf{Spectrum(0.5f), Spectrum(0.7f), 1.5f, {.ax = 0.2f, .ay = 0.2f}}, false);
}

TEST_CASE("coats: a scene scaled by a power of two has the same walks, another place has others") {
    Scene s;
    CoatedDiffuseMaterial m{add_color(s, {0.5f, 0.5f, 0.5f}), {}};
    m.coat.model = CoatModel::Stochastic;
    MaterialId const id = s.add(Material{m, "", {}});
    Assets const assets(s);
    auto const seed_at = [&](Vec3 p) {
        TexturePoint at;
        at.p = p;
        Bsdf b;
        REQUIRE(make_bsdf(assets, id, at, Wavelengths::rgb(), b));
        return std::get<CoatedDiffuseBsdf>(b).seed;
    };
    Vec3 const p{0.3f, -1.7f, 0};
    for (float const k : {0x1p-13f, 0x1p20f}) CHECK(seed_at(p * k) == seed_at(p));
    CHECK(seed_at({0.3f, 1.7f, 0}) != seed_at(p));
    CHECK(seed_at({0.30001f, -1.7f, 0}) != seed_at(p));
}

TEST_CASE("coats: one scattering in a thin cloud over black") {
    // Chandrasekhar 1960, eq. 3.2: f = albedo p / (mu + mu') (1 - exp(-tau (1/mu + 1/mu'))), p = 1 / 4 pi.
    Random r(17);
    CoatLayer l = coat(0, 0.7f, 0.8f);
    l.eta = 1;
    l.max_depth = 1;
    auto const b = over_diffuse(l, 0);
    for (auto const& [wo, wi] :
         {std::pair{direction(0.3, 0), direction(0.9, 2)}, std::pair{direction(1.3, 0), direction(0.2, 1)}}) {
        auto const mo = static_cast<double>(wo.z), mi = static_cast<double>(wi.z);
        double const expected = 0.8 / (4 * kPiD) / (mo + mi) * (1 - std::exp(-0.7 * (1 / mo + 1 / mi)));
        auto const a = agrees(value(b, wo, wi, r, samples(60'000, 1'000'000)), expected, 0.02, sidak(2));
        INFO(a);
        CHECK(a);
    }
}

// --- closed forms -----------------------------------------------------------------------------------------------------------------
namespace {

ClosedCoatedConductorBsdf closed_copper(float coat_alpha, Vec2 base, float eta = 1.5f) {
    ClosedCoatedConductorBsdf b;
    b.eta = Spectrum(0.14f, 0.75f, 0.8f, 1.0f);
    b.k = Spectrum(2.45f, 1.6f, 1.7f, 5.0f);
    b.coat.ax = b.coat.ay = coat_alpha;
    b.base.ax = base.x;
    b.base.ay = base.y;
    b.coat_eta = eta;
    b.depth = 0.01f;
    return b;
}
template <class B>
double sampled_albedo(B b, Vec3 wo, int n) {
    Random r(18);
    Mean spread, delta;
    for (int i = 0; i < n; ++i) add_sample(b, wo, r, spread, delta);
    return spread.mean() + delta.mean();
}

}  // namespace

TEST_CASE("closed coated conductor: samples by the density, reciprocity, energy") {
    for (float const coat : {0.0f, 0.05f, 0.3f, 1.0f})
        for (Vec2 const base : {Vec2{0, 0}, {0.001f, 0.001f}, {0.05f, 0.05f}, {0.4f, 0.1f}, {1, 1}}) {
            auto const b = closed_copper(coat, base);
            INFO("coat ", coat, ", base ", base.x, " ", base.y);
            BsdfChecks c{.n = samples(5'000, 1'000'000), .cells = 60, .family = 20 * 22};
            c.directions = {direction(0, 0), direction(0.7, 1), direction(1.3, -2), direction(2.2, 2),
                            direction(1.55, 1)};
            check_samples(b, c);
            if (traits(b).delta) continue;
            check_reciprocity(b, c, 2e-5, 400);
            c.within = 0.2;
            c.directions.pop_back();  // where little but the coat's reflection is drawn
            check_energy(b, c);
        }
}

TEST_CASE("closed forms stay within 2% of the walks' albedo where they are the default") {
    int const n = samples(25'000, 400'000);
    double const room = 0.02 + (full() ? 0.003 : 0.012 * kRoom);  // what the walks' noise may add
    double worst_diffuse = 0, worst_metal = 0;
    for (double const mu : {1.0, 0.5, 0.2, 0.05}) {
        Vec3 const wo = direction(std::acos(mu), 0.3);
        for (float const eta : {1.3f, 1.5f, 2.0f})
            for (float const alpha : {0.0f, 0.05f, 0.2f, 0.5f, 1.0f})
                for (float const rho : {0.2f, 0.8f}) {
                    CoatLayer l = coat(alpha);
                    l.eta = eta;
                    PlasticBsdf const p{Spectrum(rho), Spectrum(1), eta, l.facets, true, false, 5, 0.01f};
                    double const walks = sampled_albedo(over_diffuse(l, rho), wo, n);
                    double const off = sampled_albedo(p, wo, n) / walks - 1;
                    worst_diffuse = std::max(worst_diffuse, std::abs(off));
                    INFO("diffuse, mu ", mu, ", eta ", eta, ", alpha ", alpha, ", rho ", rho, ": ", off);
                    CHECK(std::abs(off) <= room);
                }
        for (float const eta : {1.3f, 1.5f, 2.0f})
            for (float const alpha : {0.0f, 0.1f, 0.15f})
                for (float const base : {0.05f, 0.16f, 0.4f, 1.0f})
                    for (bool const red : {false, true}) {
                        if (base < 1.6f * alpha) continue;
                        CoatLayer l = coat(alpha);
                        l.eta = eta;
                        auto const b = over_copper(l, base, red);
                        ClosedCoatedConductorBsdf const c{b.eta, b.k, l.facets, b.facets, eta, 0.01f};
                        double const off = sampled_albedo(c, wo, n) / sampled_albedo(b, wo, n) - 1;
                        worst_metal = std::max(worst_metal, std::abs(off));
                        INFO("metal, mu ", mu, ", eta ", eta, ", coat ", alpha, ", base ", base, ", red ",
                             red, ": ", off);
                        CHECK(std::abs(off) <= room);
                    }
    }
    MESSAGE("worst: over diffuse ", worst_diffuse, ", over copper ", worst_metal);
}

TEST_CASE("which form a coat takes") {
    Scene s;
    TextureId const grey = add_color(s, {0.5f, 0.5f, 0.5f});
    auto const made = [&](auto const& material) {
        Scene scene = s;
        MaterialId const id = scene.add(Material{material, "", {}});
        Assets const assets(scene);
        Bsdf b;
        REQUIRE(make_bsdf(assets, id, {}, Wavelengths::rgb(), b));
        return b;
    };
    CoatedDiffuseMaterial d{grey, {}};
    CHECK(std::holds_alternative<PlasticBsdf>(made(d)));
    d.coat.model = CoatModel::Stochastic;
    CHECK(std::holds_alternative<CoatedDiffuseBsdf>(made(d)));
    // A medium inside is for walks.
    for (CoatModel const model : {CoatModel::Automatic, CoatModel::ClosedForm}) {
        CoatedDiffuseMaterial cloudy{grey, {}};
        cloudy.coat.albedo = grey;
        cloudy.coat.model = model;
        CHECK(std::holds_alternative<CoatedDiffuseBsdf>(made(cloudy)));
    }
    // Nor does the closed form know how much a boundary of such an index reflects back.
    CoatedDiffuseMaterial dense{grey, {}};
    dense.coat.eta = ConstantSpd{4.0f};
    CHECK(std::holds_alternative<CoatedDiffuseBsdf>(made(dense)));
    CoatedConductorMaterial m;
    m.conductor.reflectance = grey;
    auto const smooth = made(m);
    REQUIRE(std::holds_alternative<ClosedCoatedConductorBsdf>(smooth));
    CHECK(is_delta(smooth));
    // The coat's index is divided out: eta = 1 / 1.5, and k makes 0.5 in vacuum.
    auto const& metal = std::get<ClosedCoatedConductorBsdf>(smooth);
    CHECK(metal.eta[0] == doctest::Approx(1 / 1.5));
    CHECK(metal.k[0] == doctest::Approx(2 / 1.5).epsilon(1e-3));
    CHECK(metal.bounces == 5);
    // Rough: closed as far as copper was measured, walks over what is whiter.
    m.conductor.roughness.u = add_number(s, 0.2f);
    CHECK(std::holds_alternative<ClosedCoatedConductorBsdf>(made(m)));
    m.conductor.reflectance = add_color(s, {0.5f, 0.99f, 0.5f});
    CHECK(std::holds_alternative<CoatedConductorBsdf>(made(m)));
    m.conductor.reflectance = grey;
    m.coat.roughness.u = add_number(s, 0.5f);
    CHECK(std::holds_alternative<CoatedConductorBsdf>(made(m)));
    m.coat.model = CoatModel::ClosedForm;
    CHECK(std::holds_alternative<ClosedCoatedConductorBsdf>(made(m)));
}
