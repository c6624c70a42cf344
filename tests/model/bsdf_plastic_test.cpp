// A diffuse base under a dielectric boundary: the checks of every model, the smooth boundary against its formula in double precision,
// and what becomes of all light where nothing absorbs.
#include "bsdf_checks.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

Vec2 const kRoughness[] = {{0, 0},       {0.001f, 0.001f}, {0.01f, 0.01f}, {0.05f, 0.05f},
                           {0.1f, 0.1f}, {0.3f, 0.3f},     {1, 1},         {0.05f, 0.4f}};

PlasticBsdf plastic(Vec2 alpha, float eta = 1.5f) {
    PlasticBsdf b;
    b.reflectance = Spectrum(0.2f, 0.5f, 0.7f, 0.9f);
    b.specular = Spectrum(1);
    b.eta = eta;
    b.facets.ax = alpha.x;
    b.facets.ay = alpha.y;
    return b;
}
/// Less grazing than where the diffuse part is hardly ever drawn.
std::vector<Vec3> lit() {
    std::vector<Vec3> w = outgoing();
    std::erase_if(w, [](Vec3 v) { return std::abs(v.z) < 1e-3f; });
    return w;
}
std::vector<Vec3> four() {
    return {direction(0, 0), direction(0.7, 1), direction(1.3, -2), direction(2.2, 2)};
}
template <class F>
void for_all(F const& f) {
    for (float const eta : {1.5f, 2.0f})
        for (Vec2 const a : kRoughness) {
            INFO("eta ", eta, ", alpha ", a.x, " ", a.y);
            f(plastic(a, eta));
        }
}

double refracted(double mu, double eta) { return std::sqrt(1 - (1 - mu * mu) / (eta * eta)); }
double fresnel(double mu, double eta) {
    double const t = refracted(mu, eta);
    double const s = (mu - eta * t) / (mu + eta * t), p = (eta * mu - t) / (eta * mu + t);
    return (s * s + p * p) / 2;
}
/// 2 integral F(mu) exp(-2 depth / mu) mu dmu from inside, by way of the directions outside where there is no total reflection.
double reflected_inside(double eta, double depth) {
    int const n = 20'000;
    double sum = 0, critical = std::sqrt(1 - 1 / (eta * eta));
    for (int i = 0; i < n; ++i) {
        double const x = (i + 0.5) / n;
        double const mu = refracted(x, eta);  // mu dmu = x dx / eta^2
        sum += 2 * fresnel(x, eta) * std::exp(-2 * depth / mu) * x / (eta * eta * n);
        sum += 2 * std::exp(-2 * depth / (critical * x)) * critical * critical * x / n;
    }
    return sum;
}

}  // namespace

TEST_CASE("plastic: samples by the density, value, extreme numbers") {
    for_all([](PlasticBsdf const& b) {
        check_samples(b,
                      {.n = samples(5'000, 1'000'000), .cells = 60, .directions = lit(), .family = 16 * 22});
    });
    for (auto const how : {HemisphereSampling::Cosine, HemisphereSampling::Uniform})
        check_samples(plastic({0.2f, 0.1f}), {.family = 44, .how = how});
}

TEST_CASE("plastic: the density of each part is the Jacobian of its warp") {
    for_all([](PlasticBsdf b) {
        for (bool const mirror : {true, false}) {
            // With one part alone the other is never chosen. (The cosine warp has creases.)
            b.reflectance = Spectrum(mirror ? 0.0f : 0.5f);
            b.specular = Spectrum(mirror ? 1.0f : 0.0f);
            if (mirror && b.facets.ax < 0.03f) continue;
            for (Vec3 const wo : {direction(0.3, 1), direction(1.2, 2), direction(2.2, -2)})
                check_jacobian(
                    [&](Vec2 u) -> std::optional<Vec3> {
                        auto const s = sample(b, wo, 0.5f, u, Mode::Radiance, HemisphereSampling::Uniform);
                        return s ? std::optional(s->wi) : std::nullopt;
                    },
                    [&](Vec3 wi) { return pdf(b, wo, wi, HemisphereSampling::Uniform); });
        }
    });
}

TEST_CASE("plastic: reciprocity, energy, albedo()") {
    for_all([](PlasticBsdf b) {
        for (bool const nonlinear : {true, false}) {
            b.nonlinear = nonlinear;
            check_reciprocity(b, {}, 1e-5, 1000);
            check_energy(b, {.n = samples(10'000, 500'000),
                             .directions = four(),
                             .family = 2 * 16 * 4,
                             .lane = 2,
                             .within = 0.06,
                             // albedo() does not know along which of two roughnesses light comes.
                             .albedo = b.facets.ax == b.facets.ay ? 0.01 : 0.1});
        }
    });
    PlasticBsdf layered = plastic({0.2f, 0.2f});
    layered.bounces = 5;
    layered.depth = 0.05f;
    check_reciprocity(layered);
    check_energy(
        layered,
        {.n = samples(20'000, 500'000), .directions = four(), .lane = 3, .within = 0.06, .albedo = 0.01});
}

TEST_CASE("plastic, smooth: the closed formula; K = 0.5963 at 1.5") {
    CHECK(reflected_inside(1.5, 0) == doctest::Approx(0.5963).epsilon(2e-4));
    Random r(5);
    for (double const eta : {1.3, 1.5, 2.0})
        for (double const depth : {0.0, 0.01, 0.2}) {
            double const k = reflected_inside(eta, depth);
            for (int bounces : {0, 1, 5})
                for (int i = 0; i < 20; ++i) {
                    Vec3 wo = random_direction(r), wi = random_direction(r);
                    if (wo.z * wi.z < 0) wi.z = -wi.z;
                    PlasticBsdf b = plastic({0, 0}, static_cast<float>(eta));
                    b.depth = static_cast<float>(depth);
                    b.bounces = static_cast<std::uint8_t>(bounces);
                    auto const through = [&](Vec3 w) {
                        double const mu = std::abs(static_cast<double>(w.z));
                        return (1 - fresnel(mu, eta)) * std::exp(-depth / refracted(mu, eta));
                    };
                    for (int lane = 0; lane < 4; ++lane) {
                        auto const rho = static_cast<double>(b.reflectance[lane]);
                        double const missing = bounces > 0 ? std::pow(rho * k, bounces) : 0;
                        double const expected = through(wo) * through(wi) * rho * (1 - missing) /
                                                (1 - rho * k) / (kPiD * eta * eta);
                        CHECK(near(static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[lane]), expected,
                                   2e-3));
                    }
                }
        }
}

TEST_CASE("plastic: a white base under a smooth boundary loses nothing; linear and nonlinear agree there") {
    for (float const eta : {1.1f, 1.5f, 2.4f})
        for (bool const nonlinear : {true, false}) {
            PlasticBsdf b = plastic({0, 0}, eta);
            b.reflectance = Spectrum(1);
            b.nonlinear = nonlinear;
            for (Vec3 const wo : outgoing()) CHECK(albedo(b, wo)[0] == doctest::Approx(1).epsilon(2e-3));
        }
    // Linear: what is inside keeps the base's colour.
    PlasticBsdf b = plastic({0, 0});
    b.nonlinear = false;
    Vec3 const wo = direction(0.5, 1), wi = direction(1, -1);
    Spectrum const f = evaluate(b, wo, wi, Mode::Radiance);
    CHECK(f[1] / f[0] == doctest::Approx(2.5f));
    b.nonlinear = true;
    Spectrum const g = evaluate(b, wo, wi, Mode::Radiance);
    CHECK(g[1] / g[0] > 2.8f);
    CHECK(g[0] < f[0]);
}
