// Ashikhmin and Shirley's lobe over its base: what every model must do, over exponents from 0 to 1e5, and the paper's equations.
#include "bsdf_checks.h"
#include "model/material.h"
#include "model/texture.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

struct Exponents {
    float u, v;
};
Exponents const kExponents[] = {{0, 0},     {1, 1},     {10, 10},  {1000, 1000}, {1e5f, 1e5f},
                                {10, 1000}, {1000, 10}, {0, 1e5f}, {1e4f, 30},   {3, 0.5f}};

AshikhminShirleyBsdf shiny(Exponents n, float diffuse = 0.5f, float specular = 0.3f) {
    return {Spectrum(diffuse), Spectrum(specular), n.u, n.v};
}

/// Equations 4 and 5 as they are printed, in double.
double printed(double rd, double rs, double nu, double nv, Vec3 k1, Vec3 k2) {
    double const x = double(k1.x) + double(k2.x), y = double(k1.y) + double(k2.y),
                 z = double(k1.z) + double(k2.z);
    double const l = std::sqrt(x * x + y * y + z * z), hu = x / l, hv = y / l, hn = z / l;
    double const hk = hu * double(k1.x) + hv * double(k1.y) + hn * double(k1.z);
    double const n1 = double(k1.z), n2 = double(k2.z);
    double const fresnel = rs + (1 - rs) * std::pow(1 - hk, 5);
    double const specular = std::sqrt((nu + 1) * (nv + 1)) / (8 * kPiD) *
                            std::pow(hn, (nu * hu * hu + nv * hv * hv) / (1 - hn * hn)) /
                            (hk * std::max(n1, n2)) * fresnel;
    double const diffuse =
        28 * rd / (23 * kPiD) * (1 - rs) * (1 - std::pow(1 - n1 / 2, 5)) * (1 - std::pow(1 - n2 / 2, 5));
    return specular + diffuse;
}

}  // namespace

TEST_CASE("ashikhmin-shirley: samples fall by the density, over exponents and sides") {
    for (auto const n : kExponents)
        for (float const diffuse : {0.0f, 0.5f}) {
            CAPTURE(n.u);
            CAPTURE(n.v);
            CAPTURE(diffuse);
            BsdfChecks c{.n = samples(20'000, 500'000), .cells = 100, .family = 22 * 20};
            // A ribbon of a lobe needs many cells to be integrated well.
            if (std::max(n.u, n.v) > 50 * (std::min(n.u, n.v) + 1)) {
                c.cells = 1000;
                c.directions = {direction(0.3, 0.9), direction(1.1, 2.3), direction(1.5, 3),
                                -direction(0.7, 1.6)};
            }
            // Of a lobe of exponent 1e5 the floats of wi tell h apart by 1e-7 of 0.003.
            c.same = 2e-3;
            check_samples(shiny(n, diffuse), c);
        }
    BsdfChecks uniform{.n = samples(20'000, 500'000), .cells = 100};
    uniform.how = HemisphereSampling::Uniform;
    check_samples(shiny({20, 80}), uniform);
}

TEST_CASE("ashikhmin-shirley: half vectors are those of equations 9 and 10, at any exponents") {
    Random r(6);
    for (auto const n :
         {Exponents{0, 0}, Exponents{30, 2}, Exponents{1e5f, 1e5f}, Exponents{1e5f, 30}, Exponents{0, 1e5f}})
        for (Vec3 const wo : {Vec3{0, 0, 1}, direction(0.3, 1), -direction(0.9, 2)}) {
            CAPTURE(n.u);
            CAPTURE(n.v);
            double worst = 0;
            std::array<int, 4> quadrants{};
            for (int i = 0; i < 20'000; ++i) {
                Vec2 const u = random_square(r);
                auto const s = sample(shiny(n, 0), wo, 0.5f, u, Mode::Radiance, HemisphereSampling::Cosine);
                if (!s) continue;
                double const x = double(wo.x) + double(s->wi.x), y = double(wo.y) + double(s->wi.y);
                double const z = std::abs(double(wo.z) + double(s->wi.z)),
                             sine2 = (x * x + y * y) / (x * x + y * y + z * z);
                if (sine2 < 1e-9) continue;  // floats do not tell azimuths there
                // The azimuth's share of its quadrant, by eq. 9; the next by eq. 10.
                double const part =
                    std::atan2(std::abs(y) * std::sqrt(n.v + 1.0), std::abs(x) * std::sqrt(n.u + 1.0)) /
                    (kPiD / 2);
                double const exponent = (n.u * x * x + n.v * y * y) / (x * x + y * y);
                double const height = -std::expm1((exponent + 1) / 2 * std::log1p(-sine2));
                int const quadrant = y < 0 ? (x < 0 ? 2 : 3) : (x < 0 ? 1 : 0);
                double const turn = quadrant + (quadrant % 2 ? 1 - part : part);
                ++quadrants[static_cast<std::size_t>(quadrant)];
                double const off = std::abs(turn - 4 * double(u.x));
                worst = std::max({worst, std::min(off, 4 - off), std::abs(height - double(u.y))});
            }
            CHECK(worst < 2e-2);
            for (int const q : quadrants) CHECK(q > 100);
        }
}

TEST_CASE("ashikhmin-shirley: the lobe's density is the Jacobian of its warp") {
    for (auto const n : {Exponents{1, 1}, Exponents{10, 10}, Exponents{100, 5}, Exponents{5, 50}}) {
        CAPTURE(n.u);
        CAPTURE(n.v);
        Bsdf const b = shiny(n, 0);
        for (Vec3 const wo : {direction(0.2, 1), direction(0.8, -2), -direction(0.5, 2.5)})
            check_jacobian(
                [&](Vec2 u) -> std::optional<Vec3> {
                    auto const s = sample(b, wo, 0.5f, u, Mode::Radiance, HemisphereSampling::Cosine);
                    return s ? std::optional(s->wi) : std::nullopt;
                },
                [&](Vec3 wi) { return pdf(b, wo, wi, HemisphereSampling::Cosine); });
    }
}

TEST_CASE("ashikhmin-shirley: f is equations 4 and 5") {
    Random r(1);
    for (auto const n : kExponents) {
        Bsdf const b = shiny(n, 0.7f, 0.2f);
        for (int i = 0; i < 2000; ++i) {
            Vec3 wo = random_direction(r);
            wo.z = std::abs(wo.z);
            auto const s =
                sample(b, wo, r.unit(), random_square(r), Mode::Radiance, HemisphereSampling::Cosine);
            // Where both graze, printed() divides by the difference of two numbers near 1.
            if (!s || s->wi.z < 0.05f || wo.z < 0.05f) continue;
            double const expected = printed(0.7, 0.2, n.u, n.v, wo, s->wi);
            // Half vectors at 1e-6 of the floats, to the power 1e5.
            double const within = 2e-5 + 2e-8 * std::sqrt(n.u + n.v) * 50;
            auto const f = static_cast<double>(evaluate(b, wo, s->wi, Mode::Radiance)[0]);
            CHECK(near(f, expected, within));
        }
    }
}

TEST_CASE("ashikhmin-shirley: reciprocal, and never more light than came in") {
    double most = 0, worst_albedo = 0;
    for (auto const n : kExponents)
        for (float const specular : {0.0f, 0.05f, 0.5f, 1.0f})
            for (float const diffuse : {0.0f, 1.0f}) {
                CAPTURE(n.u);
                CAPTURE(n.v);
                CAPTURE(specular);
                CAPTURE(diffuse);
                Bsdf const b = shiny(n, diffuse, specular);
                if (diffuse > 0 || specular > 0) check_reciprocity(b, {}, 1e-5, 200);
                for (double const theta : {0.01, 0.5, 1.0, 1.3, 1.45, 1.55}) {
                    Vec3 const wo = direction(theta, 0.7);
                    // Stratified, so that a few thousand samples do.
                    Random r(4);
                    double sum = 0;
                    int const side = 32;
                    for (int x = 0; x < side; ++x)
                        for (int y = 0; y < side; ++y) {
                            float const uc = static_cast<float>((x * 13 + y * 7) % side) / side;
                            Vec2 const u{(static_cast<float>(x) + r.unit()) / side,
                                         (static_cast<float>(y) + r.unit()) / side};
                            auto const s = sample(b, wo, uc + r.unit() / side, u, Mode::Radiance,
                                                  HemisphereSampling::Cosine);
                            if (s) sum += throughput(*s) / (side * side);
                        }
                    most = std::max(most, sum);
                    double const said = static_cast<double>(albedo(b, wo)[0]);
                    worst_albedo = std::max(worst_albedo, std::abs(said - sum));
                    CHECK(sum <= 1.02);  // noise of 1024 samples
                }
            }
    MESSAGE("greatest albedo ", most, "; albedo() is off by at most ", worst_albedo);
    CHECK(worst_albedo < 0.04);
    // By quadrature too. A narrow lobe over a base needs many cells.
    BsdfChecks c{.n = samples(20'000, 500'000), .cells = 800, .family = 22 * 6, .within = 0.05};
    c.albedo = 0.04;
    for (auto const n : {Exponents{0, 0}, Exponents{10, 1000}, Exponents{1e4f, 1e4f}}) {
        CAPTURE(n.u);
        check_energy(shiny(n, 1, 0.05f), c);
        check_energy(shiny(n, 1, 0), c);
    }
}

TEST_CASE("ashikhmin-shirley: parameters from textures are brought into their ranges") {
    auto const made = [](float nu, float nv) {
        Scene s;
        AshikhminShirleyMaterial m;
        m.reflectance = add_color(s, {0.25f, 0.5f, 0.75f});
        m.specular = add_color(s, {0.1f, 0.2f, 0.3f});
        m.nu = add_number(s, nu);
        m.nv = add_number(s, nv);
        MaterialId const id = s.add(Material{m});
        Assets const assets(s);
        CHECK(assets.data(id).oriented);
        Bsdf b;
        REQUIRE(make_bsdf(assets, id, {}, Wavelengths::rgb(), b));
        return std::get<AshikhminShirleyBsdf>(b);
    };
    auto const b = made(10, 1000);
    CHECK(b.nu == 10);
    CHECK(b.nv == 1000);
    CHECK(b.reflectance[2] == 0.75f);
    CHECK(b.specular[1] == 0.2f);
    CHECK(made(-3, 1e9f).nu == 0);
    CHECK(made(-3, 1e9f).nv == 1e5f);
}
