// Measured materials: files made of a formula give the formula back, are sampled by their density, and carry the same light both
// ways; files that are wrong say so.
#include "bsdf_checks.h"
#include "measured_maker.h"
#include "model/material.h"
#include "model/texture.h"
#include "spectrum/color.h"
#include "spectrum/runtime.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// A file, read, with all that its Bsdf points to.
struct Loaded {
    MadeFile file;
    Scene scene;
    MaterialId id;
    Assets assets;

    explicit Loaded(TensorMaker const& t) : file(t.file()), id(add()), assets(scene) {}
    MaterialId add() {
        MeasuredMaterial m;
        m.file.path = file.path();
        return scene.add(Material{m});
    }
    [[nodiscard]] Bsdf bsdf(Wavelengths const& lambda) const {
        Bsdf b;
        REQUIRE(make_bsdf(assets, id, {}, lambda, b));
        return b;
    }
};

MeasuredPlan isotropic() { return {}; }
MeasuredPlan anisotropic(int symmetry = 1) {
    MeasuredPlan p;
    p.metal = {0.2, 0.5};
    p.phi.clear();
    int const n = 24 / symmetry;
    for (int i = 0; i <= n; ++i) p.phi.push_back(static_cast<float>(-kPiD + 2 * kPiD * i / 24));
    p.theta.clear();
    for (int i = 0; i < 10; ++i) p.theta.push_back(static_cast<float>(1.5 * i / 9));
    p.normals = 48;
    p.samples = 20;
    return p;
}

/// Relative errors against the formula over pairs that samples find, sorted.
std::vector<double> errors(Bsdf const& b, MeasuredMetal const& metal, double reflectance, double steepest) {
    Random r(8);
    std::vector<double> e;
    for (int i = 0; i < 20'000; ++i) {
        Vec3 const wo = direction(r.uniform(0, steepest), r.uniform(0, 2 * kPiD));
        auto const s = sample(b, wo, 0, random_square(r), Mode::Radiance, HemisphereSampling::Cosine);
        if (!s || static_cast<double>(s->wi.z) < std::cos(steepest)) continue;
        double const expected = reflectance * metal.f(wo, s->wi);
        e.push_back(std::abs(static_cast<double>(s->f[0]) / expected - 1));
    }
    std::sort(e.begin(), e.end());
    return e;
}
double quantile(std::vector<double> const& sorted, double q) {
    return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

std::string error_of(std::string const& bytes) {
    MadeFile const file(bytes, "broken.bsdf");
    Scene s;
    s.files.push_back("made.pbrt");
    MeasuredMaterial m;
    m.file.path = file.path();
    m.file.where = {0, 7};
    s.add(Material{m});
    try {
        Assets const assets(s);
    } catch (Error const& e) {
        std::string const what = e.what();
        CHECK(what.find("made.pbrt:7: ") == 0);
        CHECK(what.find(file.path() + ": ") != std::string::npos);
        return what.substr(what.find(file.path()) + file.path().size() + 2);
    }
    return "";
}

}  // namespace

TEST_CASE("measured: a file of a formula gives the formula back") {
    Wavelengths const lambda = Wavelengths::spectral(0.3f);
    for (auto const& plan : {isotropic(), anisotropic(), anisotropic(2), anisotropic(4)}) {
        Loaded const l(measure(plan));
        auto const e = errors(l.bsdf(lambda), plan.metal,
                              MeasuredMetal::reflectance(static_cast<double>(lambda.lambda(0))), 1.2);
        MESSAGE("phi_i x ", plan.phi.size(), ": error median ", quantile(e, 0.5), ", 90% ", quantile(e, 0.9),
                ", 99% ", quantile(e, 0.99));
        REQUIRE(e.size() > 10'000);
        CHECK(quantile(e, 0.5) < 0.01);
        CHECK(quantile(e, 0.9) < 0.05);
    }
}

TEST_CASE("measured: samples fall by the density, and what is drawn is what is said") {
    Wavelengths const lambda = Wavelengths::spectral(0.6f);
    BsdfChecks c{.n = samples(20'000, 500'000), .family = 22 * 3};
    for (auto const& plan : {isotropic(), anisotropic(), anisotropic(4)}) {
        Loaded const l(measure(plan));
        check_samples(l.bsdf(lambda), c);
    }
}

TEST_CASE("measured: importance is the adjoint of radiance, and reciprocity as near as the tables") {
    Wavelengths const lambda = Wavelengths::spectral(0.6f);
    for (auto const& plan : {isotropic(), anisotropic()}) {
        Loaded const l(measure(plan));
        Bsdf const b = l.bsdf(lambda);
        Random r(9);
        std::vector<double> off;
        for (int i = 0; i < 5000; ++i) {
            Vec3 const wo = direction(r.uniform(0, 1.2), r.uniform(0, 2 * kPiD)) * (i % 2 ? 1.0f : -1.0f);
            auto const s = sample(b, wo, 0, random_square(r), i % 3 ? Mode::Radiance : Mode::Importance,
                                  HemisphereSampling::Cosine);
            if (!s || std::abs(s->wi.z) < 0.35f) continue;
            Spectrum const there = evaluate(b, wo, s->wi, Mode::Radiance);
            Spectrum const back = evaluate(b, s->wi, wo, Mode::Radiance);
            for (int k = 0; k < 4; ++k) {
                REQUIRE(evaluate(b, s->wi, wo, Mode::Importance)[k] == there[k]);
                REQUIRE(evaluate(b, wo, s->wi, Mode::Importance)[k] == back[k]);
            }
            off.push_back(std::abs(static_cast<double>(there[1] / back[1]) - 1));
        }
        std::sort(off.begin(), off.end());
        MESSAGE("f(o, i) / f(i, o) - 1: median ", quantile(off, 0.5), ", 90% ", quantile(off, 0.9));
        CHECK(quantile(off, 0.5) < 0.02);
        CHECK(quantile(off, 0.9) < 0.1);
    }
}

TEST_CASE("measured: energy, and the table of albedos") {
    Wavelengths const lambda = Wavelengths::spectral(0.6f);
    for (auto const& plan : {isotropic(), anisotropic()}) {
        Loaded const l(measure(plan));
        Bsdf const b = l.bsdf(lambda);
        BsdfChecks c{.n = samples(20'000, 500'000), .family = 22 * 2, .within = 0.03};
        c.directions.clear();
        for (double const theta : {0.0, 0.25, 0.6, 0.9, 1.2, 1.4})
            for (float const side : {1.0f, -1.0f}) c.directions.push_back(direction(theta, 2 * theta) * side);
        c.albedo = 0.03;
        check_energy(b, c);
        // And it is the formula's.
        double const reflectance = MeasuredMetal::reflectance(static_cast<double>(lambda.lambda(0)));
        for (double const theta : {0.25, 0.9, 1.4}) {
            Vec3 const wo = direction(theta, 1);
            double sum = 0;
            int const n = 400;
            for (int x = 0; x < n; ++x)
                for (int y = 0; y < n; ++y) {
                    double const z = (x + 0.5) / n;
                    sum += plan.metal.f(wo, direction(std::acos(z), 2 * kPiD * (y + 0.5) / n)) * z * 2 *
                           kPiD / (n * n);
                }
            auto const a = directional_albedo(b, wo, c, 1000).total();
            MESSAGE("theta_o ", theta, ": albedo ", a, ", of the formula ", reflectance * sum);
            // Between the last nodes of theta_i, and where spectra is cut by the horizon, less.
            CHECK(near(a, reflectance * sum, theta < 1 ? 0.01 : 0.06));
        }
    }
}

TEST_CASE("measured: linear between wavelengths, kept beyond them; rgb is their colour under D65") {
    MeasuredPlan plan;
    plan.theta = {0, 0.5f, 1};
    plan.wavelengths = {420, 500, 550, 700};
    Loaded const l(measure(plan));
    Vec3 const wo = direction(0.4, 1), wi = direction(0.3, -1.4);
    auto const at = [](double lambda) {
        return MeasuredMetal::reflectance(std::clamp(lambda, 420.0, 700.0));
    };
    for (float const u : {0.0f, 0.2f, 0.7f}) {
        Wavelengths const w = Wavelengths::spectral(u);
        Spectrum const f = evaluate(l.bsdf(w), wo, wi, Mode::Radiance);
        for (int i = 1; i < 4; ++i)
            CHECK(static_cast<double>(f[i] / f[0]) ==
                  doctest::Approx(at(static_cast<double>(w.lambda(i))) / at(static_cast<double>(w.lambda(0))))
                      .epsilon(1e-4));
    }
    TabulatedSpd spd;
    for (int i = 360; i <= 830; ++i) {
        spd.lambda.push_back(static_cast<float>(i));
        spd.value.push_back(static_cast<float>(at(i)));
    }
    SpectrumStore store;
    Vec3 const rgb = store.compile(spd, SpectrumRole::Albedo).rgb();
    Spectrum const f = evaluate(l.bsdf(Wavelengths::rgb()), wo, wi, Mode::Radiance);
    CHECK(static_cast<double>(f[0] / f[1]) == doctest::Approx(rgb.x / rgb.y).epsilon(1e-4));
    CHECK(static_cast<double>(f[2] / f[1]) == doctest::Approx(rgb.z / rgb.y).epsilon(1e-4));
    CHECK(f[3] == 0);
    CHECK(static_cast<double>(f[1] / rgb.y) == doctest::Approx(plan.metal.f(wo, wi)).epsilon(0.05));
    Spectrum const all = albedo(l.bsdf(Wavelengths::rgb()), wo);
    CHECK(static_cast<double>(all[0] / all[1]) == doctest::Approx(rgb.x / rgb.y).epsilon(1e-4));
}

TEST_CASE("measured: files of rgb, in both modes") {
    MeasuredPlan plan;
    plan.rgb = true;
    Loaded const l(measure(plan));
    Vec3 const wo = direction(0.4, 1), wi = direction(0.3, -1.4);
    Spectrum const f = evaluate(l.bsdf(Wavelengths::rgb()), wo, wi, Mode::Radiance);
    CHECK(static_cast<double>(f[0] / f[1]) == doctest::Approx(0.8 / 0.5).epsilon(1e-4));
    CHECK(static_cast<double>(f[2] / f[1]) == doctest::Approx(0.2 / 0.5).epsilon(1e-4));
    CHECK(static_cast<double>(f[1]) == doctest::Approx(0.5 * plan.metal.f(wo, wi)).epsilon(0.05));
    // As spectra they have that colour, under the light that has none.
    Vec3 sum{0, 0, 0};
    int const n = 400;
    for (int i = 0; i < n; ++i) {
        Wavelengths const w = Wavelengths::spectral((static_cast<float>(i) + 0.5f) / (4 * n));
        Spectrum const g = evaluate(l.bsdf(w), wo, wi, Mode::Radiance);
        sum += to_linear_srgb(g * l.assets.neutral_illuminant().sample(w), w) / static_cast<float>(n);
    }
    for (int i = 0; i < 3; ++i) CHECK(sum[i] == doctest::Approx(f[i]).epsilon(0.02));
}

TEST_CASE("measured: a file is read once, and belongs to the scene's frame") {
    MadeFile const file(measure(isotropic()).file());
    Scene s;
    MeasuredMaterial m;
    m.file.path = file.path();
    MaterialId const a = s.add(Material{m}), b = s.add(Material{m});
    Assets const assets(s);
    CHECK(assets.data(a).measured == assets.data(b).measured);
    CHECK(assets.data(a).measured);
    CHECK(assets.data(a).oriented);
    CHECK(sizeof(MeasuredBsdf) <= 64);
}

TEST_CASE("measured: without the Jacobian the numbers are f |cos| themselves") {
    auto t = measure(isotropic());
    t["jacobian"].bytes[0] = 0;
    Loaded const l(t);
    Bsdf const b = l.bsdf(Wavelengths::rgb());
    Loaded const with(measure(isotropic()));
    Vec3 const wo = direction(0.4, 1), wi = direction(0.3, -1.4);
    double const ratio =
        static_cast<double>(evaluate(with.bsdf(Wavelengths::rgb()), wo, wi, Mode::Radiance)[1]) /
        static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[1]);
    MeasuredMetal const metal;
    CHECK(ratio == doctest::Approx(metal.d(normalize(wo + wi)) / (4 * metal.sigma(wo))).epsilon(0.02));
}

TEST_CASE("measured: wrong files are refused with what is wrong") {
    MeasuredPlan plan;
    plan.theta = {0, 0.5f, 1};
    plan.normals = 8;
    plan.samples = 4;
    auto const good = measure(plan);
    CHECK(error_of(good.file()).empty());
    auto const refused = [&](auto const& change, char const* what) {
        auto t = good;
        change(t);
        std::string const error = error_of(t.file());
        INFO(what, " not in: ", error);
        CHECK(error.find(what) != std::string::npos);
    };
    for (char const* const name :
         {"jacobian", "phi_i", "theta_i", "ndf", "sigma", "vndf", "luminance", "wavelengths"})
        refused([&](TensorMaker& t) { t.drop(name); }, name);
    refused([](TensorMaker& t) { t.drop("spectra"); }, "neither a field \"spectra\" nor \"rgb\"");
    // The description is for people.
    auto silent = good;
    silent.drop("description");
    CHECK(error_of(silent.file()).empty());
    auto const floats = [](TensorMaker& t, char const* name, std::vector<float> const& x) {
        std::uint64_t const n = x.size();
        t.drop(name);
        t.add(name, {n}, x);
    };
    refused([&](TensorMaker& t) { floats(t, "theta_i", {0, 1, 0.5f}); }, "each larger");
    refused([&](TensorMaker& t) { floats(t, "theta_i", {0, 0.5f, 0.5f}); }, "each larger");
    refused([&](TensorMaker& t) { floats(t, "theta_i", {0, 30, 60}); }, "in radians");
    refused([&](TensorMaker& t) { floats(t, "theta_i", {-0.1f, 0.5f, 1}); }, "in radians");
    refused([&](TensorMaker& t) { floats(t, "theta_i", {}); }, "each larger");
    refused([&](TensorMaker& t) { floats(t, "phi_i", {0, 1, 2}); }, "phi_i");
    refused([&](TensorMaker& t) { floats(t, "wavelengths", {500, 400, 600, 700}); }, "each larger");
    refused([&](TensorMaker& t) { floats(t, "wavelengths", {400, 600}); }, "spectra");
    refused([&](TensorMaker& t) { floats(t, "wavelengths", {-1, 500, 600, 700}); }, "above 0");
    float const nan = std::nanf("");
    for (char const* const name : {"theta_i", "ndf", "sigma", "vndf", "luminance", "wavelengths", "spectra"})
        refused([&](TensorMaker& t) { std::memcpy(t[name].bytes.data() + 4, &nan, 4); }, "no number");
    // Shapes that lie: larger than the file, beyond 64 bits, of other slices, without room to interpolate.
    refused([](TensorMaker& t) { t["spectra"].shape[3] = 1 << 20; }, "larger than the file");
    refused([](TensorMaker& t) { t["ndf"].shape = {1ull << 33, 1ull << 33}; }, "larger than the file");
    refused([](TensorMaker& t) { t["ndf"].shape = {~0ull, ~0ull}; }, "larger than the file");
    refused([](TensorMaker& t) { t["ndf"].shape = {0, ~0ull}; }, "ndf");
    refused([](TensorMaker& t) { t["spectra"].shape[2] += 1; }, "spectra");
    refused([](TensorMaker& t) { t["vndf"].shape = {3, 1, 8, 8}; }, "vndf");
    refused([](TensorMaker& t) { t["vndf"].shape = {1, 3, 64, 1}; }, "vndf");
    refused([](TensorMaker& t) { t["luminance"].shape = {1, 3, 16}; }, "luminance");
    refused([](TensorMaker& t) { t["luminance"].type = 6; }, "luminance");
    refused([](TensorMaker& t) { t["luminance"].type = 77; }, "unknown type");
    refused([](TensorMaker& t) { t.add("ndf", {1, 1}, {1.0f}); }, "twice");
    refused([](TensorMaker& t) { t["jacobian"].shape = {0}; }, "jacobian");
    // Every way of being cut off, and what is none at all.
    std::string const whole = good.file();
    for (std::size_t n = 0; n < whole.size(); n += n < 700 ? 1 : 97)
        CHECK_FALSE(error_of(whole.substr(0, n)).empty());
    CHECK(error_of("PF 1 1").find("no tensor file") != std::string::npos);
    std::string other = whole;
    other[12] = 2;
    CHECK(error_of(other).find("version 2.0") != std::string::npos);
    other = whole;
    other[17] = 127;
    CHECK(error_of(other).find("fields") != std::string::npos);
}
