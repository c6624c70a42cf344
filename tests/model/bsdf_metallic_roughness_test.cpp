// glTF's metallic-roughness model: what holds for every model, the specification's formulas, and its
// materials' ranges.
#include "model/bsdf_metallic_roughness.h"

#include "bsdf_checks.h"
#include "model/material.h"
#include "model/schlick.h"
#include "model/sheen.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

using Model = MetallicRoughnessBsdf;

Model model(float roughness, float metallic = 0) {
    Model b;
    b.base_color = Spectrum(0.9f, 0.5f, 0.2f, 0.7f);
    b.metallic = metallic;
    b.facets.ax = b.facets.ay = sqr(roughness);
    b.facets.multiscatter = true;
    return b;
}
Model white(float roughness, float metallic = 0) {
    Model b = model(roughness, metallic);
    b.base_color = Spectrum(1.0f);
    return b;
}
Model glass(float roughness, bool solid, float transmission = 1) {
    Model b = model(roughness);
    b.transmission = transmission;
    b.solid = solid;
    return b;
}
Model brushed(Model b, float strength, float rotation) {
    b.facets.ax = lerp(sqr(strength), b.facets.ay, 1.0f);
    if (!b.facets.smooth()) b.facets.ay = max(b.facets.ay, 1e-4f);  // as make() does
    b.axis_x = std::cos(rotation);
    b.axis_y = std::sin(rotation);
    return b;
}
Model with_sheen(Model b, float alpha, Spectrum color = Spectrum(0.8f, 0.3f, 0.5f, 0.1f)) {
    b.sheen_color = color;
    b.sheen_top = color.max();
    b.sheen_alpha = alpha;
    return b;
}
Model coated(Model b, float roughness, float factor = 1) {
    b.clearcoat = factor;
    b.clearcoat_alpha = sqr(roughness);
    return b;
}
/// Nothing but what transmits.
Model window(float roughness, bool solid) {
    Model b = glass(roughness, solid);
    b.base_color = Spectrum(1.0f);
    b.f0 = Spectrum(0.0f);
    b.f0_top = 0;
    b.f90 = 0;
    b.facets.multiscatter = false;
    return b;
}
Model in_everything(float roughness, bool solid) {
    return brushed(coated(with_sheen(glass(roughness, solid, 0.6f), 0.2f), 0.3f, 0.7f), 0.5f, 0.4f);
}

struct Case {
    std::string name;
    Model b;
    [[nodiscard]] float eta() const { return b.solid ? b.eta : 1.0f; }
};
std::vector<Case> cases() {
    Model tinted = model(0.4f, 0.3f);
    tinted.f0 = Spectrum(0.03f, 0.1f, 0.3f, 0.05f);
    tinted.f0_top = 0.3f;
    tinted.f90 = 0.8f;
    return {{"metal", model(0.3f, 1)},
            {"sharp metal", model(0.1f, 1)},
            {"plastic, half metal", tinted},
            {"thin", glass(0.4f, false)},
            {"solid", glass(0.4f, true)},
            {"solid, half diffuse", glass(0.7f, true, 0.5f)},
            {"brushed", brushed(model(0.3f, 1), 0.6f, 0.7f)},
            {"sheen", with_sheen(model(0.6f), 0.1f)},
            {"rough coat", coated(model(0.5f, 0.5f), 0.3f, 0.8f)},
            {"mirror coat on rough base", coated(model(0.5f), 0, 0.8f)},
            {"mirror coat on mirror and diffuse", coated(model(0), 0, 0.8f)},
            {"clear glass", glass(0, true)},
            {"clear pane, half diffuse", glass(0, false, 0.5f)},
            {"everything, thin", in_everything(0.5f, false)},
            {"everything, solid", in_everything(0.5f, true)}};
}

Vec3 mirror(Vec3 w) { return {-w.x, -w.y, w.z}; }
double d(float x) { return static_cast<double>(x); }

/// Albedo from wo by samples in strata (whose error is less than the mean's own); importance: refraction
/// squeezes nothing.
Mean furnace(Bsdf const& b, Vec3 wo, int side = 100) {
    Random r(7);
    Mean mean;
    for (int i = 0; i < side; ++i)
        for (int k = 0; k < side; ++k) {
            Vec2 const u{(static_cast<float>(i) + r.unit()) / static_cast<float>(side),
                         (static_cast<float>(k) + r.unit()) / static_cast<float>(side)};
            auto const s = sample(b, wo, r.unit(), u, Mode::Importance, HemisphereSampling::Cosine);
            mean.add(s ? throughput(*s) : 0);
        }
    return mean;
}

}  // namespace

TEST_CASE("metallic-roughness: samples by the density, from all sides") {
    for (Case const& c : cases()) {
        CAPTURE(c.name);
        BsdfChecks checks{.n = samples(20'000, 400'000), .cells = 200, .eta = c.eta(), .same = 1e-3};
        checks.directions = {direction(0.0, 0), direction(0.6, 1.2), direction(1.2, 4), direction(1.5, 2),
                             direction(1.565, 3)};
        std::size_t const n = checks.directions.size();
        for (std::size_t i = 1; i < n; ++i) checks.directions.push_back(-checks.directions[i]);
        checks.family = static_cast<int>(cases().size() * checks.directions.size());
        check_samples(c.b, checks);
    }
    // Uniform hemispheres where a diffuse part is drawn.
    BsdfChecks uniform{.n = samples(10'000, 400'000), .cells = 100, .how = HemisphereSampling::Uniform};
    check_samples(model(0.5f), uniform);
}

TEST_CASE("metallic-roughness: the density is the Jacobian of the warp") {
    auto const by_itself = [](Model const& b, Vec3 wo, double within) {
        check_jacobian(
            [&](Vec2 u) -> std::optional<Vec3> {
                auto const s = sample(b, wo, 0.5f, u, Mode::Radiance, HemisphereSampling::Cosine);
                return s ? std::optional(s->wi) : std::nullopt;
            },
            [&](Vec3 wi) { return pdf(b, wo, wi, HemisphereSampling::Cosine); }, within);
    };
    Model sheen = with_sheen(window(0, false), 0.2f);
    sheen.transmission = 0;
    sheen.base_color = Spectrum(0.0f);
    for (Vec3 const wo : {direction(0.4, 1), direction(1.1, -2), direction(2.2, 0.3)}) {
        for (float const roughness : {0.3f, 0.6f, 1.0f}) {
            CAPTURE(roughness);
            Model metal = model(roughness, 1);
            metal.facets.multiscatter = false;
            by_itself(metal, wo, 2e-3);
            by_itself(brushed(metal, 0.5f, 0.3f), wo, 2e-3);
            by_itself(window(roughness, false), wo, 2e-3);
            if (wo.z > 0) by_itself(window(roughness, true), wo, 2e-3);
        }
        by_itself(sheen, wo, 1e-3);
    }
}

TEST_CASE("metallic-roughness: reciprocity, also through boundaries") {
    for (Case const& c : cases()) {
        if (traits(c.b).delta) continue;
        CAPTURE(c.name);
        BsdfChecks checks{.eta = c.eta()};
        // Of importance, refraction squeezes nothing: the adjoint of radiance (see adjoint.h).
        check_reciprocity(c.b, checks, 5e-4);
    }
}

// --- energy ------------------------------------------------------------------------------------------------
TEST_CASE("metallic-roughness: the white furnace is white, where the model says so") {
    // All that a white surface of these kinds takes in comes out: metal, specular over diffuse, thin walls,
    // and solids, up to the tables' error.
    Vec3 const from[] = {direction(0, 0),     direction(0.5, 1),   direction(1.0, -2), direction(1.3, 0.8),
                         direction(1.3, 1.6), direction(1.5, 2.5), direction(1.53, 0), direction(1.565, 1)};
    double worst = 0, worst_grazing = 0;
    auto const look = [&](Model const& b, std::string const& name) {
        for (Vec3 wo : from)
            for (bool const inside : {false, true}) {
                if (inside && !b.solid) continue;
                if (inside) wo = -wo;
                Mean const e = furnace(b, wo);
                CAPTURE(name);
                CAPTURE(wo.z);
                CAPTURE(e.mean());
                bool const grazing = std::abs(wo.z) < 0.03f;
                double const off = std::max(0.0, std::abs(e.mean() - 1) - 3 * e.standard_error());
                double& w = grazing ? worst_grazing : worst;
                w = std::max(w, off);
                CHECK(off <= 0.004);
                CHECK(e.standard_error() < 0.012);
            }
    };
    for (float const r : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f})
        for (float const strength : {0.0f, 0.5f, 1.0f}) {
            auto const name = " " + std::to_string(r) + ", strength " + std::to_string(strength);
            look(brushed(white(r, 1), strength, 0.3f), "metal" + name);
            Model pane = white(r);
            pane.transmission = 1;
            look(brushed(pane, strength, 0.3f), "pane" + name);
            look(brushed(white(r), strength, 0.3f), "plastic" + name);
            if (strength > 0) continue;
            look(white(r, 0.5f), "half metal" + name);
            pane.transmission = 0.4f;
            look(pane, "half pane" + name);
            Model same = pane;
            same.solid = true;
            same.eta = 1;
            same.f0 = Spectrum(0.0f);
            same.f0_top = 0;
            look(same, "unbent" + name);
            for (float const eta : {1.2f, 1.5f, 2.4f})
                for (float const factor : {1.0f, 0.3f}) {
                    Model solid = white(r);
                    solid.transmission = 1;
                    solid.solid = true;
                    solid.eta = eta;
                    solid.f90 = factor;
                    solid.f0_top = sqr((eta - 1) / (eta + 1)) * factor;
                    solid.f0 = Spectrum(solid.f0_top);
                    look(solid, "solid " + std::to_string(eta) + name);
                }
        }
    MESSAGE("white furnace: off by ", worst, " at most, ", worst_grazing, " at mu < 0.03");
}

TEST_CASE("metallic-roughness: no more light than came in, whatever is put together") {
    Random r(11);
    double most = 0, most_grazing = 0;
    int const n = samples(300, 3000);
    for (int i = 0; i < n; ++i) {
        auto const one_of = [&](std::initializer_list<float> v) {
            return v.begin()[r.below(static_cast<std::uint32_t>(v.size()))];
        };
        Model b = white(one_of({0, 0.1f, 0.3f, 0.6f, 1}), one_of({0, 0, 0.5f, 1}));
        b.transmission = one_of({0, 0.5f, 1});
        b.solid = r.unit() < 0.5f;
        b.eta = one_of({1, 1.2f, 1.5f, 2.4f});
        float const f = sqr((b.eta - 1) / (b.eta + 1)) * one_of({0, 1, 3});
        b.f90 = one_of({0, 0.5f, 1});
        b.f0 = Spectrum(min(f, 1)) * b.f90;
        b.f0_top = b.f0[0];
        b = brushed(b, one_of({0, 0.5f, 1}), r.unit());
        if (r.unit() < 0.5f) b = coated(b, one_of({0, 0.2f, 0.6f, 1}), one_of({0.3f, 1}));
        if (r.unit() < 0.5f) b = with_sheen(b, one_of({0.005f, 0.03f, 0.2f, 1}), Spectrum(one_of({0.3f, 1})));
        for (int k = 0; k < 2; ++k) {
            Vec3 wo = random_direction(r);
            if (k == 0) wo = normalize(Vec3{wo.x, wo.y, 0.06f * wo.z});
            Mean const mean = furnace(b, wo, 60);
            double const e = mean.mean() - 3 * mean.standard_error();
            CAPTURE(b.facets.ax);
            CAPTURE(b.facets.ay);
            CAPTURE(b.metallic);
            CAPTURE(b.transmission);
            CAPTURE(b.solid);
            CAPTURE(b.eta);
            CAPTURE(b.clearcoat);
            CAPTURE(b.clearcoat_alpha);
            CAPTURE(b.sheen_top);
            CAPTURE(b.sheen_alpha);
            CAPTURE(wo.z);
            CAPTURE(mean.mean());
            CHECK(e <= (std::abs(wo.z) < 0.03f ? 1.02 : 1.006));
            double& m = std::abs(wo.z) < 0.03f ? most_grazing : most;
            m = std::max(m, e);
        }
    }
    MESSAGE("most that came back: ", most, ", at mu < 0.03: ", most_grazing);
}

TEST_CASE("metallic-roughness: energy by quadrature, and what is said to be the albedo") {
    for (Case const& c : cases()) {
        CAPTURE(c.name);
        BsdfChecks checks{.n = samples(20'000, 200'000), .eta = c.eta()};
        for (Vec3 const wo : {direction(0.3, 1), direction(1.2, 2), direction(2.0, 0.3)}) {
            auto const a = directional_albedo(c.b, wo, checks, checks.n);
            CAPTURE(wo.z);
            CAPTURE(a.quadrature);
            CAPTURE(a.delta);
            CHECK(a.total() <= 1.001);
            CHECK(a.total() > 0.1);
            CHECK(std::abs(a.sampled.mean() - a.quadrature) <= 4 * a.sampled.standard_error() + 1e-3);
            // Above the surface, where no facet refracts and no layer dims: the albedo is right.
            if (!c.b.solid && !c.b.has_sheen() && !(c.b.clearcoat > 0))
                CHECK(std::abs(d(albedo(c.b, wo)[0]) - a.total()) < 0.01);
        }
    }
    // Anisotropic rough solids are the one kind that is not made up for: by how much they darken.
    for (float const roughness : {0.2f, 0.5f}) {
        Model b = brushed(white(roughness), 0.5f, 0.3f);
        b.transmission = 1;
        b.solid = true;
        double const out = furnace(b, direction(0.5, 0)).mean(), in = furnace(b, direction(2.6, 0)).mean();
        MESSAGE("anisotropic solid ", roughness, ": ", out, " from outside, ", in, " from inside");
        CHECK((out > 0.95 && out <= 1.001));
        CHECK((in > 0.8 && in <= 1.001));
    }
}

TEST_CASE("tables: albedos of facets and of sheen are those of their lobes") {
    Random r(3);
    double isotropic = 0, anisotropic = 0;
    for (int i = 0; i < 200; ++i) {
        Microfacets m;
        m.ax = std::pow(0.05f + 0.95f * r.unit(), 2.0f);
        m.ay = i % 2 ? m.ax : m.ax * std::pow(r.unit(), 2.0f) + 1e-3f;
        if (m.ay > m.ax) m.ay = m.ax;
        Vec3 wo = random_direction(r);
        wo.z = std::abs(wo.z) + (i % 4 < 2 ? 0.05f : 0.0f);
        wo = normalize(wo);
        double one = 0, edge = 0;
        int const n = 100;
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                Vec3 const wm = sample_microfacet(
                    m, wo, {(static_cast<float>(a) + 0.5f) / n, (static_cast<float>(b) + 0.5f) / n});
                Vec3 const wi = wm * (2 * dot(wo, wm)) - wo;
                if (!(wi.z > 0)) continue;
                double const g = d(microfacet_g(m, wo, wi) / microfacet_g1(m, wo)) / (n * n);
                one += g;
                edge += g * d(schlick_weight(dot(wo, wm)));
            }
        SchlickAlbedo const t = schlick_albedo(m, wo);
        double& w = m.ax == m.ay ? isotropic : anisotropic;
        w = std::max({w, std::abs(d(t.one) - one), std::abs(d(t.edge) - edge)});
        CHECK(t.edge <= t.one);
    }
    MESSAGE("facets: off by ", isotropic, ", anisotropic ones by ", anisotropic);
    CHECK(isotropic < 0.004);
    CHECK(anisotropic < 0.015);

    double over = 0;
    for (float const alpha : {0.005f, 0.02f, 0.07f, 0.2f, 1.0f})
        for (float const mu : {0.01f, 0.1f, 0.3f, 0.8f}) {
            Vec3 const wo{std::sqrt(1 - mu * mu), 0, mu};
            double sum = 0;
            int const n = 400;
            for (int i = 0; i < n; ++i)
                for (int k = 0; k < n; ++k) {
                    double const x = (i + 0.5) / n, z = x * x, phi = (k + 0.5) / n * kPiD;
                    Vec3 const wi = direction(std::acos(z), phi);
                    sum += d(sheen_brdf(alpha, wo, wi)) * z * 2 * x * 2 * kPiD / n / n;
                }
            CAPTURE(alpha);
            CAPTURE(mu);
            double const said = d(sheen_albedo(alpha, mu));
            CHECK(sum <= said + 0.01);
            // From 0.07 on the lobe is the paper's, and so is its albedo.
            if (alpha >= 0.07f) CHECK(std::abs(sum - said) < 0.01);
            over = std::max(over, sum - said);
        }
    MESSAGE("sheen: at most ", over, " above its table");
}

// --- the specification's formulas --------------------------------------------------------------------------
TEST_CASE("metallic-roughness: Appendix B's formulas, by hand in double") {
    Random r(5);
    auto const dot3 = [](Vec3 a, Vec3 b) { return d(a.x) * d(b.x) + d(a.y) * d(b.y) + d(a.z) * d(b.z); };
    for (int i = 0; i < 2000; ++i) {
        Vec3 v = random_direction(r), l = random_direction(r);
        v.z = std::abs(v.z);
        l.z = std::abs(l.z);
        if (v.z < 0.02f || l.z < 0.02f) continue;
        Vec3 const h = normalize(v + l);
        double const alpha = r.uniform(0.05, 1), strength = i % 2 ? r.uniform() : 0.0;
        double const at = alpha + (1 - alpha) * strength * strength, ab = alpha,
                     turn = strength > 0 ? 0.8 : 0;
        Vec3 const t{static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), 0};
        Vec3 const bi{-t.y, t.x, 0};
        // D_GGX_anisotropic and V_GGX_anisotropic of KHR_materials_anisotropy.
        double const a2 = at * ab;
        double const fx = ab * dot3(t, h), fy = at * dot3(bi, h), fz = a2 * d(h.z);
        double const w2 = a2 / (fx * fx + fy * fy + fz * fz);
        double const D = a2 * w2 * w2 / kPiD;
        auto const len = [&](Vec3 w) { return std::hypot(at * dot3(t, w), ab * dot3(bi, w), d(w.z)); };
        double const V = 0.5 / (d(l.z) * len(v) + d(v.z) * len(l));
        double const weight = std::pow(1 - std::abs(dot3(v, h)), 5);

        Model b = model(1, 1);
        b.facets = {static_cast<float>(at), static_cast<float>(ab)};
        b.axis_x = t.x;
        b.axis_y = t.y;
        // metal_brdf = specular_brdf * (baseColor + (1 - baseColor) * (1 - |VdotH|)^5)
        Spectrum const f = evaluate(b, v, l, Mode::Radiance);
        for (int k = 0; k < 4; ++k) {
            double const f0 = d(b.base_color[k]);
            REQUIRE(d(f[k]) == doctest::Approx(V * D * (f0 + (1 - f0) * weight)).epsilon(2e-3));
        }
        // The dielectric's layer, with nothing below; specular factor and colour as KHR_materials_specular
        // has them.
        Model g = b;
        g.metallic = 0;
        g.base_color = Spectrum(0.0f);
        g.f90 = 0.7f;
        g.f0 = Spectrum(0.04f, 0.1f, 0.3f, 0.02f) * 0.7f;
        g.f0_top = 0.21f;
        Spectrum const s = evaluate(g, v, l, Mode::Radiance);
        for (int k = 0; k < 4; ++k) {
            double const f0 = d(g.f0[k]);
            REQUIRE(d(s[k]) == doctest::Approx(V * D * (f0 + (0.7 - f0) * weight)).epsilon(2e-3));
        }
        // KHR_materials_transmission: the same lobe on the other side, (1 - F) baseColor of it.
        Model p = b;
        p.metallic = 0;
        p.transmission = 1;
        Spectrum const through = evaluate(p, v, {l.x, l.y, -l.z}, Mode::Radiance);
        for (int k = 0; k < 4; ++k)
            REQUIRE(d(through[k]) ==
                    doctest::Approx(V * D * (1 - (0.04 + 0.96 * weight)) * d(b.base_color[k])).epsilon(2e-3));
        // Charlie, alone.
        Model c = g;
        c.f0 = Spectrum(0.0f);
        c.f0_top = c.f90 = 0;
        double const as = 0.1 + 0.9 * r.unit();
        c = with_sheen(c, static_cast<float>(as));
        auto const fit = [&](double x) {
            double const q = (1 - as) * (1 - as);
            auto const mix = [&](double lo, double hi) { return lo + (hi - lo) * q; };
            return mix(21.5473, 25.3245) / (1 + mix(3.82987, 3.32435) * std::pow(x, mix(0.19823, 0.16801))) +
                   mix(-1.97760, -1.27393) * x + mix(-4.32054, -4.85967);
        };
        auto const lambda = [&](double x) {
            return x < 0.5 ? std::exp(fit(x)) : std::exp(2 * fit(0.5) - fit(1 - x));
        };
        double const ds = (2 + 1 / as) * std::pow(1 - d(h.z) * d(h.z), 0.5 / as) / (2 * kPiD);
        double const vs = 1 / ((1 + lambda(d(v.z)) + lambda(d(l.z))) * 4 * d(v.z) * d(l.z));
        REQUIRE(d(evaluate(c, v, l, Mode::Radiance)[1]) == doctest::Approx(0.3 * ds * vs).epsilon(5e-3));
    }
    // Why diffuse light is not weighed by 1 - F(v.h) as there: a smooth white surface seen at n.v = 0.01.
    Vec3 const grazing = direction(std::acos(0.01), 0);
    Mean diffuse;
    for (int i = 0; i < 20'000; ++i) {
        Vec3 l = random_direction(r);
        l.z = std::abs(l.z);
        double const f = 0.04 + 0.96 * std::pow(1 - dot3(grazing, normalize(grazing + l)), 5);
        diffuse.add((1 - f) * 2 * d(l.z));
    }
    CHECK(diffuse.mean() + 0.04 + 0.96 * std::pow(0.99, 5) > 1.85);
    // A surface that is neither specular nor metal is Lambert's.
    Model lambert = model(0.5f);
    lambert.f0 = Spectrum(0.0f);
    lambert.f0_top = lambert.f90 = 0;
    CHECK(evaluate(lambert, direction(0.3, 0), direction(1.0, 2), Mode::Radiance)[1] ==
          doctest::Approx(0.5 / kPiD).epsilon(1e-5));
}

TEST_CASE("metallic-roughness: white metal is the rough conductor that reflects all") {
    Random r(9);
    for (bool const multiscatter : {false, true})
        for (float const alpha : {0.05f, 0.3f, 1.0f}) {
            Model b = white(1, 1);
            b.facets = {.ax = alpha, .ay = alpha, .multiscatter = multiscatter};
            // eta = k = 0: the limit that reflects everything.
            RoughConductorBsdf const c{Spectrum(0.0f), Spectrum(0.0f), b.facets};
            for (int i = 0; i < 500; ++i) {
                Vec3 const wo = random_direction(r), wi = random_direction(r);
                double const is = d(evaluate(b, wo, wi, Mode::Radiance)[0]);
                double const should = d(evaluate(c, wo, wi, Mode::Radiance)[0]);
                // What makes up for multiple reflection comes from two tables, made apart.
                double const apart = multiscatter ? 0.005 / std::max(std::abs(d(wi.z)), 0.01) : 0;
                CHECK(std::abs(is - should) <= apart + 1e-4 * should);
            }
        }
}

TEST_CASE("metallic-roughness: layers take what they reflect from what is below") {
    Vec3 const wo = direction(0.8, 0.3), wi = direction(1.1, 2.0);
    Model const base = model(0.5f);
    double const f = d(evaluate(base, wo, wi, Mode::Radiance)[0]);
    // A mirror coat adds nothing off its direction: 1 - F at the more grazing of the two directions is left.
    double const cos_i = d(wi.z);
    double const left = 1 - 0.8 * (0.04 + 0.96 * std::pow(1 - cos_i, 5));
    CHECK(d(evaluate(coated(base, 0, 0.8f), wo, wi, Mode::Radiance)[0]) ==
          doctest::Approx(f * left).epsilon(1e-4));
    auto const mirrored = delta_branches(coated(base, 0, 0.8f), wo, Mode::Radiance).reflected;
    REQUIRE(mirrored);
    CHECK(throughput(*mirrored) ==
          doctest::Approx(0.8 * (0.04 + 0.96 * std::pow(1 - d(wo.z), 5))).epsilon(1e-4));
    CHECK(length(mirrored->wi - mirror(wo)) < 1e-6f);
    // Sheen: 1 - max(color) E; the darker lanes are dimmed as much as the brightest.
    Model const velvet = with_sheen(base, 0.3f, Spectrum(0.5f, 0.0f, 0.1f, 0.2f));
    double const e = std::max(d(sheen_albedo(0.3f, wo.z)), d(sheen_albedo(0.3f, wi.z)));
    CHECK(d(evaluate(velvet, wo, wi, Mode::Radiance)[1]) ==
          doctest::Approx(d(evaluate(base, wo, wi, Mode::Radiance)[1]) * (1 - 0.5 * e)).epsilon(1e-4));
    // A solid's layers are outside.
    Model inside = glass(0.5f, true);
    CHECK(evaluate(coated(inside, 0.3f), -wo, -wi, Mode::Radiance)[0] ==
          evaluate(inside, -wo, -wi, Mode::Radiance)[0]);
}

TEST_CASE(
    "metallic-roughness: clear glass is a smooth dielectric, but for Schlick's approximation and its tint") {
    for (float const eta : {1.33f, 1.5f, 2.0f}) {
        Model b = glass(0, true);
        b.base_color = Spectrum(0.5f, 1, 0.2f, 0.9f);
        b.eta = eta;
        b.f0_top = sqr((eta - 1) / (eta + 1));
        b.f0 = Spectrum(b.f0_top);
        CHECK(is_delta(Bsdf{b}));
        CHECK_FALSE(traits(b).spreads_through);
        for (Vec3 const wo : outgoing())
            for (auto const mode : {Mode::Radiance, Mode::Importance}) {
                auto const is = delta_branches(b, wo, mode);
                auto const should = delta_branches(DielectricBsdf{Spectrum(eta), false}, wo, mode);
                CAPTURE(wo.z);
                REQUIRE(is.reflected.has_value() == should.reflected.has_value());
                REQUIRE(is.transmitted.has_value() == should.transmitted.has_value());
                // Schlick is off by 0.06 at most for eta <= 2.
                CHECK(std::abs(throughput(*is.reflected, 1) - throughput(*should.reflected, 1)) < 0.06);
                CHECK(length(is.reflected->wi - should.reflected->wi) < 1e-6f);
                if (!is.transmitted) {
                    CHECK(throughput(*is.reflected, 1) == doctest::Approx(1));
                    continue;
                }
                double const scale = mode == Mode::Radiance ? 1 / std::pow(d(is.transmitted->eta), 2) : 1;
                CHECK(is.transmitted->eta == should.transmitted->eta);
                CHECK(length(is.transmitted->wi - should.transmitted->wi) < 1e-6f);
                CHECK(throughput(*is.reflected, 1) + throughput(*is.transmitted, 1) / scale ==
                      doctest::Approx(1).epsilon(1e-4));
                // Once a surface.
                CHECK(throughput(*is.transmitted, 0) ==
                      doctest::Approx(0.5 * throughput(*is.transmitted, 1)).epsilon(1e-4));
            }
    }
    // A pane does not bend.
    Vec3 const wo = direction(1.0, 2);
    auto const pane = delta_branches(glass(0, false), wo, Mode::Radiance);
    REQUIRE(pane.transmitted);
    CHECK(length(pane.transmitted->wi + wo) < 1e-6f);
    CHECK(pane.transmitted->eta == 1);
    CHECK(throughput(*pane.transmitted, 0) ==
          doctest::Approx(0.9 * (1 - 0.04 - 0.96 * std::pow(1 - d(wo.z), 5))).epsilon(1e-4));
    // As roughness vanishes the rough solid becomes the clear one: the mean direction and the light.
    Model const b = glass(0.04f, true);
    auto const clear = delta_branches(glass(0, true), wo, Mode::Radiance);
    Random r(1);
    Mean light;
    for (int i = 0; i < 20'000; ++i) {
        auto const s = sample(b, wo, r.unit(), random_square(r), Mode::Radiance, HemisphereSampling::Cosine);
        bool const transmitted = s && s->transmitted;
        light.add(transmitted ? throughput(*s) : 0);
        if (transmitted) CHECK(s->eta == 1.5f);
        if (transmitted && i < 100) CHECK(length(s->wi - clear.transmitted->wi) < 0.05f);
    }
    CHECK(agrees(light, throughput(*clear.transmitted), 0.02, 0.01));
}

TEST_CASE("metallic-roughness: dispersion is Cauchy's, and the hero's alone") {
    // n_F - n_C = (n_d - 1) / V_d, at the Fraunhofer lines.
    for (float const abbe : {20.0f, 55.0f}) {
        float const dispersion = 20 / abbe;
        CHECK(cauchy_index(1.5f, dispersion, 587.6f) == doctest::Approx(1.5).epsilon(1e-5));
        CHECK(d(cauchy_index(1.5f, dispersion, 486.1f)) - d(cauchy_index(1.5f, dispersion, 656.3f)) ==
              doctest::Approx(0.5 / d(abbe)).epsilon(2e-3));
    }
    CHECK(cauchy_index(1.1f, 30, 800) == 1);
}

// --- from materials ----------------------------------------------------------------------------------------
namespace {

Bsdf made(Scene& s, MetallicRoughnessMaterial const& m, Wavelengths const& lambda) {
    MaterialId const id = s.add(Material{m, "", {}});
    Assets const assets(s);
    Bsdf b;
    REQUIRE(make_bsdf(assets, id, {}, lambda, b));
    return b;
}
Model made_model(Scene& s, MetallicRoughnessMaterial const& m,
                 Wavelengths const& lambda = Wavelengths::rgb()) {
    return std::get<Model>(made(s, m, lambda));
}
MetallicRoughnessMaterial plain(Scene& s) {
    MetallicRoughnessMaterial m;
    m.base_color = add_color(s, {0.9f, 0.5f, 0.2f});
    return m;
}

}  // namespace

TEST_CASE("metallic-roughness: defaults and ranges of the material") {
    Scene s;
    // glTF's defaults: metal, rough.
    Model const plainest = made_model(s, plain(s));
    CHECK(plainest.metallic == 1);
    CHECK(plainest.facets.ax == 1);
    CHECK(plainest.facets.multiscatter);
    CHECK(plainest.base_color[0] == doctest::Approx(0.9));
    CHECK(plainest.base_color[3] == 0);
    CHECK(plainest.f0[0] == doctest::Approx(0.04));
    CHECK(plainest.clearcoat == 0);
    CHECK_FALSE(plainest.has_sheen());
    CHECK_FALSE(plainest.solid);

    // A texture may hold anything.
    for (float const wild : {-3.0f, 0.0f, 1e-8f, 1e-3f, 0.5f, 1.0f, 10.0f, 1e30f}) {
        MetallicRoughnessMaterial m = plain(s);
        TextureId const t = add_number(s, wild);
        float const c = clamp(wild, 0, 1);  // colours are checked before
        m.metallic = m.roughness = m.specular.factor = m.transmission.factor = t;
        m.clearcoat = {t, t};
        m.sheen = {add_color(s, {c, 1, 0}), t};
        m.anisotropy = {t, 1};
        m.specular.color = add_color(s, {c, c, c});
        for (bool const thin : {true, false})
            for (float const ior : {0.0f, 1.0f, 1.0005f, 1.5f, 100.0f}) {
                m.transmission.thin = thin;
                m.index = {ior, 0.5f};
                m.metallic = add_number(s, wild > 0.6f ? 0.5f : wild);
                CAPTURE(wild);
                CAPTURE(ior);
                CAPTURE(thin);
                Bsdf const b = made(s, m, ior == 1.5f ? Wavelengths::spectral(0.3f) : Wavelengths::rgb());
                Model const& k = std::get<Model>(b);
                CHECK((k.metallic >= 0 && k.metallic <= 1));
                CHECK((k.facets.ax >= k.facets.ay && k.facets.ax <= 1));
                CHECK((k.facets.smooth() || k.facets.ay >= 1e-4f));
                check_samples(b, {.n = 200, .directions = {}});  // extreme numbers alone
                CHECK(furnace(b, direction(0.7, 1), 30).mean() < 1.05);
                CHECK(furnace(b, direction(2.2, 1), 30).mean() < 1.05);
            }
    }
    // Roughness 0 and nearly 0 is a mirror, and clear glass is nothing but delta parts.
    for (float const r : {0.0f, 1e-8f, 0.03f}) {
        MetallicRoughnessMaterial m = plain(s);
        m.roughness = add_number(s, r);
        CHECK(is_delta(made(s, m, Wavelengths::rgb())));
        m.metallic = add_number(s, 0);
        CHECK_FALSE(is_delta(made(s, m, Wavelengths::rgb())));
        m.transmission.factor = add_number(s, 1);
        m.transmission.thin = false;
        CHECK(is_delta(made(s, m, Wavelengths::rgb())));
    }
    // alpha = roughness^2, and anisotropy lengthens it along the turned axis.
    MetallicRoughnessMaterial m = plain(s);
    m.roughness = add_number(s, 0.5f);
    m.anisotropy = {add_number(s, 0.6f), 0.5f};
    Model const brushed = made_model(s, m);
    CHECK(brushed.facets.ay == doctest::Approx(0.25));
    CHECK(brushed.facets.ax == doctest::Approx(0.25 + 0.75 * 0.36));
    CHECK(brushed.axis_x == doctest::Approx(std::cos(0.5)));
    CHECK(brushed.axis_y == doctest::Approx(std::sin(0.5)));
}

TEST_CASE("metallic-roughness: index, specular colour and dispersion of the material") {
    Scene s;
    MetallicRoughnessMaterial m = plain(s);
    m.metallic = add_number(s, 0);
    m.specular = {add_number(s, 0.5f), add_color(s, {0.2f, 0.6f, 1})};
    m.index.ior = 2;
    Model const b = made_model(s, m);
    // f0 = ((ior - 1) / (ior + 1))^2 color, at most 1; both ends times the factor.
    for (int i = 0; i < 3; ++i)
        CHECK(b.f0[i] == doctest::Approx(0.5 / 9 * (i == 0 ? 0.2 : i == 1 ? 0.6 : 1.0)).epsilon(1e-4));
    CHECK(b.f0_top == doctest::Approx(0.5 / 9).epsilon(1e-4));
    CHECK(b.f90 == 0.5f);
    // Spectrally, the top is the same for all wavelengths.
    for (float const u : {0.01f, 0.13f, 0.2f})
        CHECK(made_model(s, m, Wavelengths::spectral(u)).f0_top == b.f0_top);
    // ior 0: F is 1 before the colour, and light that is let through is not bent.
    m.index.ior = 0;
    m.specular.factor = {};
    m.transmission = {add_number(s, 1), false, {}};
    Model const infinite = made_model(s, m);
    CHECK(infinite.f0[1] == doctest::Approx(0.6).epsilon(1e-4));
    CHECK(infinite.eta == 1);

    // Dispersion: the hero's index by Cauchy, in solids only, and never in rgb.
    m.index = {1.5f, 1.0f};
    m.specular = {};
    for (float const u : {0.05f, 0.1f, 0.2f}) {
        auto const lambda = Wavelengths::spectral(u);
        Model const glass = made_model(s, m, lambda);
        CHECK(glass.eta == cauchy_index(1.5f, 1, lambda.lambda(0)));
        CHECK(traits(glass).hero_only);
        CHECK(glass.f0[0] == doctest::Approx(0.04));
    }
    CHECK(made_model(s, m).eta == 1.5f);
    CHECK_FALSE(traits(made_model(s, m)).hero_only);
    m.transmission.thin = true;
    CHECK_FALSE(traits(made_model(s, m, Wavelengths::spectral(0.1f))).hero_only);
    CHECK(sizeof(Bsdf) <= 144);
}
