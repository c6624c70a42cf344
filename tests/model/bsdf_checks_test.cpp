// The checks of scattering models, checked: they pass what is right, and notice what is a little wrong.
#include "bsdf_checks.h"

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("bsdf checks: diffuse and smooth models pass") {
    BsdfChecks c{.n = samples(20'000, 1'000'000)};
    for (auto const how : {HemisphereSampling::Cosine, HemisphereSampling::Uniform}) {
        c.how = how;
        check_samples(DiffuseBsdf{Spectrum(0.5f)}, c);
    }
    check_reciprocity(DiffuseBsdf{Spectrum(0.5f)});
    check_energy(DiffuseBsdf{Spectrum(0.5f)}, {.n = c.n, .albedo = 1e-5});
    for (float const eta : {1.5f, 1 / 1.5f}) {
        check_samples(DielectricBsdf{Spectrum(eta), false}, c);
        check_energy(DielectricBsdf{Spectrum(eta), false}, {.n = 2000, .albedo = 1e-5});
    }
}

TEST_CASE("bsdf checks: a narrow lobe has its cells, and a density 5% too wide is noticed") {
    // Normals of alpha 0.001 about an axis anywhere, by the density of their own.
    for (Vec3 const axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, direction(1.2, 3.0), direction(1.569, -2)}) {
        Frame const frame = frame_from_z(axis);
        Microfacets const narrow{1e-3f, 1e-3f}, wider{1.05e-3f, 1.05e-3f};
        auto const draw = [&](Random& r) -> std::optional<Vec3> {
            return frame.from_local(sample_microfacet(narrow, {0, 0, 1}, random_square(r)));
        };
        auto const density = [&](Microfacets const& m) {
            return [&frame, m](Vec3 w) { return microfacet_pdf(m, {0, 0, 1}, frame.to_local(w)); };
        };
        auto const right = chi_square_of(draw, density(narrow), {axis}, 100'000, 200, 11);
        INFO(right.chi, ", nothing ", right.nothing_expected);
        CHECK(right.chi.p > sidak(4));
        CHECK(right.chi.dof > 100);
        CHECK(right.nothing_expected < 100);
        CHECK(chi_square_of(draw, density(wider), {axis}, 100'000, 200, 11).chi.p < 1e-6);
        // A lobe of the density that is never drawn from.
        auto const twice = [&](Vec3 w) {
            return 0.9f * microfacet_pdf(narrow, {0, 0, 1}, frame.to_local(w)) +
                   0.1f * microfacet_pdf(narrow, {0, 0, 1}, frame.to_local(-w));
        };
        CHECK(chi_square_of(draw, twice, {axis, -axis}, 100'000, 200, 11).chi.p < 1e-9);
    }
}
