// Textures and materials: hand-made scenes, small pictures on disk.
#include "model/texture.h"

#include "image/write.h"
#include "model/material.h"
#include "support.h"

#include <doctest/doctest.h>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// 2 x 2 texels, linear: row 0 (the top) red, green; row 1 blue, gray 0.5.
Image four_colors() {
    Image i(PixelFormat::Float, 2, 2, {"R", "G", "B"});
    float const texels[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            for (int c = 0; c < 3; ++c) i.set(x, y, c, texels[2 * y + x][c]);
    return i;
}

void check_rgb(Spectrum s, float r, float g, float b, float tolerance = 2e-3f) {
    CAPTURE(s[0]);
    CAPTURE(s[1]);
    CAPTURE(s[2]);
    CHECK(std::abs(s[0] - r) <= tolerance);
    CHECK(std::abs(s[1] - g) <= tolerance);
    CHECK(std::abs(s[2] - b) <= tolerance);
    CHECK(s[3] == 0);
}

TexturePoint at(float u, float v) {
    TexturePoint p;
    p.uv = {u, v};
    return p;
}

Bsdf bsdf_of(Assets const& assets, MaterialId id, TexturePoint const& at, Wavelengths const& lambda) {
    Bsdf bsdf;
    REQUIRE(make_bsdf(assets, id, at, lambda, bsdf));
    return bsdf;
}

}  // namespace

TEST_CASE("constants, scale and mix") {
    Scene s;
    auto const two = add_number(s, 2), quarter = add_number(s, 0.25f), zero = add_number(s, 0),
               one = add_number(s, 1);
    auto const red = add_color(s, {0.8f, 0.1f, 0.2f}), blue = add_color(s, {0, 0.3f, 0.9f});
    auto const scaled = s.add(Texture{ScaleTexture{red, quarter}, {}});
    auto const mixed = s.add(Texture{MixTexture{red, blue, quarter}, {}});
    auto const first = s.add(Texture{MixTexture{red, blue, zero}, {}});
    auto const second = s.add(Texture{MixTexture{red, blue, one}, {}});
    auto const number = s.add(Texture{MixTexture{two, one, quarter}, {}});
    auto const product = s.add(Texture{ScaleTexture{two, quarter}, {}});
    auto const nothing = s.add(Texture{ScaleTexture{red, zero}, {}});
    Assets const a(s);
    auto const rgb = Wavelengths::rgb();
    check_rgb(evaluate_spectrum(a, red, at(0, 0), rgb), 0.8f, 0.1f, 0.2f, 1e-6f);
    check_rgb(evaluate_spectrum(a, scaled, at(0, 0), rgb), 0.2f, 0.025f, 0.05f, 1e-6f);
    check_rgb(evaluate_spectrum(a, mixed, at(0, 0), rgb), 0.6f, 0.15f, 0.375f, 1e-6f);
    check_rgb(evaluate_spectrum(a, first, at(0, 0), rgb), 0.8f, 0.1f, 0.2f, 1e-6f);
    check_rgb(evaluate_spectrum(a, second, at(0, 0), rgb), 0, 0.3f, 0.9f, 1e-6f);
    CHECK(evaluate_spectrum(a, nothing, at(0, 0), rgb).is_black());
    CHECK(evaluate_float(a, number, at(0, 0)) == 1.75f);
    CHECK(evaluate_float(a, product, at(0, 0)) == 0.5f);
    CHECK(evaluate_float(a, two, at(0, 0)) == 2);
    CHECK(a.data(red).flat);
    CHECK_FALSE(a.data(mixed).flat);
    // Spectral mode: a mix is the mix of the spectra at each wavelength.
    auto const w = Wavelengths::spectral(0.3f);
    Spectrum const x = evaluate_spectrum(a, red, at(0, 0), w), y = evaluate_spectrum(a, blue, at(0, 0), w);
    for (int i = 0; i < 4; ++i)
        CHECK(evaluate_spectrum(a, mixed, at(0, 0), w)[i] == doctest::Approx(0.75f * x[i] + 0.25f * y[i]));
}

TEST_CASE("checkerboards: parity of the cell, below zero too, in two and three dimensions") {
    Scene s;
    auto const one = add_number(s, 1), zero = add_number(s, 0);
    CheckerboardTexture board;
    board.tex1 = one, board.tex2 = zero;
    board.mapping = UvMapping{4, 2, 0, 0};
    auto const flat = s.add(Texture{board, {}});
    board.dimension = 3;
    board.world_to_texture = scale(2, 1, 1);
    auto const solid = s.add(Texture{board, {}});
    Assets const a(s);
    CHECK(evaluate_float(a, flat, at(0.1f, 0.1f)) == 1);
    CHECK(evaluate_float(a, flat, at(0.3f, 0.1f)) == 0);
    CHECK(evaluate_float(a, flat, at(0.3f, 0.6f)) == 1);
    CHECK(evaluate_float(a, flat, at(0.1f, 0.6f)) == 0);
    CHECK(evaluate_float(a, flat, at(-0.1f, 0.1f)) == 0);
    CHECK(evaluate_float(a, flat, at(-0.1f, -0.1f)) == 1);
    CHECK(evaluate_float(a, solid, at_point({0.1f, 0.1f, 0.1f})) == 1);
    CHECK(evaluate_float(a, solid, at_point({0.6f, 0.1f, 0.1f})) == 0);
    CHECK(evaluate_float(a, solid, at_point({0.6f, 1.1f, 0.1f})) == 1);
    CHECK(evaluate_float(a, solid, at_point({0.6f, 1.1f, -0.1f})) == 0);
}

TEST_CASE("images: orientation, wraps, scale, inversion, encodings") {
    Folder const folder;
    write_png(folder.file("four.png"), four_colors());
    Scene s;
    auto const add_image = [&](std::string const& encoding) {
        return s.add(ImageFile{folder.file("four.png"), encoding, {}});
    };
    auto const make = [&](ImageId image, auto const& change) {
        ImageTexture t;
        t.image = image;
        t.filter = FilterMode::Point;
        change(t);
        return s.add(Texture{t, {}});
    };
    auto const same = [](ImageTexture&) {};
    ImageId const srgb = add_image(""), linear = add_image("linear"), gamma = add_image("gamma 2");
    CHECK(srgb == add_image(""));  // read once
    auto const plain = make(srgb, same);
    auto const raw = make(linear, same);
    auto const squared = make(gamma, same);
    auto const bilinear = make(srgb, [](ImageTexture& t) { t.filter = FilterMode::Bilinear; });
    auto const black = make(srgb, [](ImageTexture& t) { t.wrap = WrapMode::Black; });
    auto const clamped = make(srgb, [](ImageTexture& t) { t.wrap = WrapMode::Clamp; });
    auto const inverted = make(srgb, [](ImageTexture& t) { t.invert = true; });
    auto const scaled = make(srgb, [](ImageTexture& t) { t.scale = 0.5f, t.is_spectrum = true; });
    auto const bright = make(srgb, [](ImageTexture& t) { t.scale = 3, t.role = SpectrumRole::Unbounded; });
    auto const both = make(srgb, [](ImageTexture& t) { t.scale = 3, t.invert = true; });
    auto const mapped = make(srgb, [](ImageTexture& t) { t.mapping = UvMapping{2, 1, 0.5f, 0.5f}; });
    Assets const a(s);
    auto const rgb = Wavelengths::rgb();
    auto const look = [&](TextureId id, float u, float v) { return evaluate_spectrum(a, id, at(u, v), rgb); };
    // v runs up: (0,0) is the lower left corner.
    check_rgb(look(plain, 0.25f, 0.75f), 1, 0, 0);
    check_rgb(look(plain, 0.75f, 0.75f), 0, 1, 0);
    check_rgb(look(plain, 0.25f, 0.25f), 0, 0, 1);
    check_rgb(look(plain, 0.75f, 0.25f), 0.5f, 0.5f, 0.5f, 4e-3f);
    // The stored byte of linear 0.5 in sRGB is 188.
    float const stored = 188 / 255.0f;
    check_rgb(look(raw, 0.75f, 0.25f), stored, stored, stored, 1e-6f);
    check_rgb(look(squared, 0.75f, 0.25f), stored * stored, stored * stored, stored * stored, 1e-5f);
    // Repeats, blacks out, clamps.
    check_rgb(look(plain, 1.25f, 0.75f), 1, 0, 0);
    check_rgb(look(plain, -0.25f, 0.75f), 0, 1, 0);
    check_rgb(look(plain, 0.25f, 1.25f), 0, 0, 1);
    check_rgb(look(black, 1.25f, 0.75f), 0, 0, 0);
    check_rgb(look(black, 0.25f, 0.75f), 1, 0, 0);
    check_rgb(look(clamped, 1.25f, 0.75f), 0, 1, 0);
    check_rgb(look(clamped, -3, 0.75f), 1, 0, 0);
    check_rgb(look(clamped, 0.25f, 7), 1, 0, 0);
    // Bilinear: the four meet in the middle; at a texel's centre it is alone.
    check_rgb(look(bilinear, 0.5f, 0.5f), 0.375f, 0.375f, 0.375f, 4e-3f);
    check_rgb(look(bilinear, 0.25f, 0.75f), 1, 0, 0);
    check_rgb(look(bilinear, 0.5f, 0.75f), 0.5f, 0.5f, 0);
    check_rgb(look(inverted, 0.25f, 0.75f), 0, 1, 1);
    check_rgb(look(scaled, 0.25f, 0.75f), 0.5f, 0, 0);
    check_rgb(look(bright, 0.25f, 0.75f), 3, 0, 0);
    check_rgb(look(both, 0.25f, 0.75f), 0, 1, 1);  // 1 - 3 is cut at 0
    // (2u + 0.5, v + 0.5): (0.125, 0.25) -> (0.75, 0.75).
    check_rgb(look(mapped, 0.125f, 0.25f), 0, 1, 0);
    // As a number: the mean of the three, and its inverse.
    CHECK(evaluate_float(a, plain, at(0.25f, 0.75f)) == doctest::Approx(1 / 3.0).epsilon(1e-5));
    CHECK(evaluate_float(a, inverted, at(0.25f, 0.75f)) == doctest::Approx(2 / 3.0).epsilon(1e-5));
    CHECK(evaluate_float(a, both, at(0.25f, 0.75f)) == doctest::Approx(0).epsilon(1e-5));
    // Albedos are clamped to 1.
    auto const rgb_mode = rgb_to_spectrum({2, 0.5f, -1}, SpectrumRole::Albedo, rgb);
    CHECK(rgb_mode[0] == 1);
    CHECK(rgb_mode[2] == 0);
    CHECK(rgb_to_spectrum({2, 0.5f, 0}, SpectrumRole::Unbounded, rgb)[0] == 2);
    // A footprint as wide as the picture sees its mean.
    TexturePoint wide = at(0.3f, 0.4f);
    wide.duv_dx = {1, 0}, wide.duv_dy = {0, 1};
    check_rgb(evaluate_spectrum(a, bilinear, wide, rgb), 0.375f, 0.375f, 0.375f, 8e-3f);
}

TEST_CASE("images that cannot be read, or are encoded in an unknown way, are errors that name their place") {
    Scene s;
    s.files = {"scene.pbrt"};
    s.add(ImageFile{"/nowhere/none.png", "", {0, 7}});
    CHECK_THROWS_WITH_AS(Assets{s}, doctest::Contains("scene.pbrt:7"), Error);
    Folder const folder;
    write_png(folder.file("a.png"), four_colors());
    Scene t;
    t.files = {"scene.pbrt"};
    t.add(ImageFile{folder.file("a.png"), "gamma x", {0, 9}});
    CHECK_THROWS_WITH_AS(Assets{t}, doctest::Contains("scene.pbrt:9"), Error);
}

TEST_CASE("mappings: spherical, cylindrical, planar, each from the world to its texture space") {
    Folder const folder;
    // 64 x 64: red is s, green is t (from the top), at texel centres.
    Image ramp(PixelFormat::Float, 64, 64, {"R", "G", "B"});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            ramp.set(x, y, 0, (static_cast<float>(x) + 0.5f) / 64);
            ramp.set(x, y, 1, (static_cast<float>(y) + 0.5f) / 64);
        }
    write_pfm(folder.file("ramp.pfm"), ramp);
    Scene s;
    ImageId const image = s.add(ImageFile{folder.file("ramp.pfm"), "", {}});
    auto const make = [&](TextureMapping const& m) {
        ImageTexture t;
        t.image = image, t.mapping = m, t.filter = FilterMode::Point, t.role = SpectrumRole::Unbounded;
        return s.add(Texture{t, {}});
    };
    auto const spherical = make(SphericalMapping{translate(-1, -2, -3)});
    auto const cylindrical = make(CylindricalMapping{translate(-1, -2, -3)});
    auto const planar = make(PlanarMapping{scale(2, 1, 1), {0.1f, 0, 0}, {0, 0.2f, 0.1f}, 0.25f, 0.5f});
    Assets const a(s);
    auto const look = [&](TextureId id, Vec3 p) {
        Spectrum const v = evaluate_spectrum(a, id, at_point(p), Wavelengths::rgb());
        return Vec2{v[0], 1 - v[1]};
    };
    auto const near = [](Vec2 v, double x, double y) {
        CHECK(static_cast<double>(v.x) == doctest::Approx(x).epsilon(0.02));
        CHECK(static_cast<double>(v.y) == doctest::Approx(y).epsilon(0.02));
    };
    Random r(1);
    for (int i = 0; i < 500; ++i) {
        double const theta = r.uniform(0.4, 2.7), phi = r.uniform(0.5, 6), size = r.uniform(0.5, 3);
        Vec3 const p = Vec3{1, 2, 3} + direction(theta, phi) * static_cast<float>(size);
        // pbrt: s is the polar angle over pi, t the azimuth over 2 pi.
        Vec2 const v = look(spherical, p);
        CHECK(std::abs(static_cast<double>(v.x) - theta / kPiD) < 0.01);
        CHECK(std::abs(static_cast<double>(v.y) - phi / (2 * kPiD)) < 0.01);
        double const around = std::fmod(phi + kPiD, 2 * kPiD) / (2 * kPiD), z = r.uniform(0.1, 0.9);
        if (around < 0.02 || around > 0.98) continue;
        Vec2 const c =
            look(cylindrical, {1 + 2 * static_cast<float>(std::cos(phi)),
                               2 + 2 * static_cast<float>(std::sin(phi)), 3 + static_cast<float>(z)});
        CHECK(std::abs(static_cast<double>(c.x) - around) < 0.01);
        CHECK(std::abs(static_cast<double>(c.y) - z) < 0.01);
    }
    near(look(planar, {1, 1, 1}), 0.45, 0.8);
    near(look(planar, {2, -1, 0}), 0.65, 0.3);
}

TEST_CASE("mixed materials: chosen as often as the amount says, and the random number goes on uniform") {
    Scene s;
    auto const white = add_color(s, {1, 1, 1});
    MaterialId const a = s.add(Material{DiffuseMaterial{white}, "", {}}),
                     b = s.add(Material{DielectricMaterial{}, "", {}}),
                     c = s.add(Material{InterfaceMaterial{}, "", {}});
    MaterialId const inner = s.add(Material{MixMaterial{a, b, add_number(s, 0.3f)}, "", {}});
    MaterialId const outer = s.add(Material{MixMaterial{c, inner, add_number(s, 0.6f)}, "", {}});
    MaterialId const mirrored = s.add(Material{MixMaterial{inner, c, add_number(s, 0.4f)}, "", {}});
    MaterialId const never = s.add(Material{MixMaterial{a, b, add_number(s, 0)}, "", {}});
    MaterialId const always = s.add(Material{MixMaterial{a, b, add_number(s, 5)}, "", {}});
    Assets const assets(s);
    Random r(1);
    int const n = samples(1'000'000, 4'000'000);
    std::vector<double> o(3);
    for (int i = 0; i < n; ++i) {
        double u = r.uniform();
        MaterialId const id = resolve_mix(assets, outer, {}, u);
        REQUIRE((u >= 0 && u < 1));
        ++o[id == a ? 0 : id == b ? 1 : 2];
    }
    CHECK(chi_square(o, std::vector<double>{0.6 * 0.7 * n, 0.6 * 0.3 * n, 0.4 * n}).p >= 0.01);
    // The same with the inner mix on the other side.
    std::vector<double> p(3);
    for (int i = 0; i < n; ++i) {
        double u = r.uniform();
        MaterialId const id = resolve_mix(assets, mirrored, {}, u);
        ++p[id == a ? 0 : id == b ? 1 : 2];
    }
    CHECK(chi_square(p, std::vector<double>{0.6 * 0.7 * n, 0.6 * 0.3 * n, 0.4 * n}).p >= 0.01);
    for (double const start : {0.0, 0.5, 1 - 0x1p-53}) {
        auto const resolved = [&](MaterialId id) {
            double u = start;
            return resolve_mix(assets, id, {}, u);
        };
        CHECK(resolved(never) == a);
        CHECK(resolved(always) == b);
        CHECK(resolved(a) == a);
    }
    CHECK(interface_share(assets, outer, {}) == doctest::Approx(0.4));
    CHECK(interface_share(assets, mirrored, {}) == doctest::Approx(0.4));
    CHECK(interface_share(assets, c, {}) == 1);
    CHECK(interface_share(assets, never, {}) == 0);
    CHECK(assets.data(outer).passes);
    CHECK_FALSE(assets.data(inner).passes);
}

TEST_CASE("materials become scattering values") {
    Scene s;
    auto const color = add_color(s, {0.8f, 0.4f, 0.2f});
    MaterialId const diffuse = s.add(Material{DiffuseMaterial{color}, "", {}});
    MaterialId const glass = s.add(Material{DielectricMaterial{ConstantSpd{1.7f}}, "", {}});
    MaterialId const flint = s.add(Material{DielectricMaterial{NamedSpd{"glass-SF11"}}, "", {}});
    MaterialId const partial =
        s.add(Material{DielectricMaterial{TabulatedSpd{{500, 600}, {1.6f, 1.5f}}}, "", {}});
    MaterialId const thin = s.add(Material{ThinDielectricMaterial{ConstantSpd{1.4f}}, "", {}});
    auto const eta = s.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.2f}, SpectrumRole::Unbounded}, {}});
    auto const k = s.add(Texture{ConstantSpectrumTexture{ConstantSpd{3}, SpectrumRole::Unbounded}, {}});
    MaterialId const metal = s.add(Material{ConductorMaterial{eta, k, {}}, "", {}});
    MaterialId const tinted = s.add(Material{ConductorMaterial{{}, {}, color}, "", {}});
    MaterialId const interface = s.add(Material{InterfaceMaterial{}, "", {}});
    Assets const a(s);
    auto const rgb = Wavelengths::rgb();
    auto const w = Wavelengths::spectral(0.4f);
    check_rgb(std::get<DiffuseBsdf>(bsdf_of(a, diffuse, {}, rgb)).reflectance, 0.8f, 0.4f, 0.2f, 1e-6f);
    auto const g = std::get<DielectricBsdf>(bsdf_of(a, glass, {}, w));
    CHECK(g.eta[0] == 1.7f);
    CHECK_FALSE(g.dispersive);
    auto const f = std::get<DielectricBsdf>(bsdf_of(a, flint, {}, w));
    CHECK(f.dispersive);
    for (int i = 0; i < 4; ++i) CHECK((f.eta[i] > 1.74f && f.eta[i] < 1.9f));
    // Shorter waves are bent more.
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            if (w.lambda(i) < w.lambda(j) - 5) CHECK(f.eta[i] > f.eta[j]);
    // A table keeps its end values outside its wavelengths.
    auto const short_table = std::get<DielectricBsdf>(bsdf_of(a, partial, {}, Wavelengths::spectral(0.001f)));
    for (int i = 0; i < 4; ++i) CHECK((short_table.eta[i] >= 1.5f && short_table.eta[i] <= 1.6f));
    auto const in_rgb = std::get<DielectricBsdf>(bsdf_of(a, flint, {}, rgb));
    CHECK_FALSE(in_rgb.dispersive);
    for (int i = 1; i < 4; ++i) CHECK(in_rgb.eta[i] == in_rgb.eta[0]);
    CHECK(std::get<ThinDielectricBsdf>(bsdf_of(a, thin, {}, w)).eta[2] == 1.4f);
    auto const m = std::get<ConductorBsdf>(bsdf_of(a, metal, {}, w));
    CHECK(m.eta[1] == doctest::Approx(0.2));
    CHECK(m.k[1] == doctest::Approx(3));
    // A conductor given by its reflectance reflects that much at normal incidence.
    Spectrum const r = albedo(bsdf_of(a, tinted, {}, rgb), {0, 0, 1});
    CHECK(r[0] == doctest::Approx(0.8).epsilon(1e-4));
    CHECK(r[1] == doctest::Approx(0.4).epsilon(1e-4));
    CHECK(r[2] == doctest::Approx(0.2).epsilon(1e-4));
    Bsdf none;
    CHECK_FALSE(make_bsdf(a, interface, {}, w, none));
    CHECK_FALSE(a.data(diffuse).textured);
}
