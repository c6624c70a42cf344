// A scene that has every alternative of every variant at least once, with no field as it is by default.
#pragma once

#include "scene/scene.h"

namespace nephroid::test {

struct Everything {
    Scene s;

    SourceLocation at() { return {0, ++line}; }
    TextureId number(float x) { return s.add(Texture{ConstantFloatTexture{x}, at()}); }
    TextureId texture(TextureKind kind) { return s.add(Texture{std::move(kind), at()}); }
    TextureId colour(Spd spd, SpectrumRole role = SpectrumRole::Albedo) {
        return texture(ConstantSpectrumTexture{std::move(spd), role});
    }
    TextureId metal(Spd spd) { return colour(std::move(spd), SpectrumRole::Unbounded); }
    ImageId picture(std::string const& name, std::string const& encoding = "") {
        return s.add(ImageFile{name, encoding, at()});
    }
    MaterialId material(MaterialKind kind, std::string const& name = "") {
        return s.add(Material{std::move(kind), name, at()});
    }
    Object& object(Shape shape, MaterialId m) {
        s.world().objects.push_back({.shape = std::move(shape), .material = m, .where = at()});
        return s.world().objects.back();
    }

    Everything() {
        s.files = {"everything.pbrt"};
        s.camera = {PerspectiveCamera{0.7123456f, 0.125f, 3.5f},
                    turned(0.3),
                    std::array<float, 4>{-1.5f, 1.25f, -1, 0.875f},
                    1.625f,
                    0.75f,
                    at()};
        settings();
        textures();
        materials();
        lights();
        shapes();
    }

    /// No matrix whose inverse's inverse is the same bits.
    static Mat4 turned(double angle) {
        return translate(1.1, -2.3, 0.7) * *rotate(angle * 57.3, 1, 2, 3) * scale(1.3, 0.9, 1.7);
    }

    void settings() {
        Settings& t = s.settings;
        t.filter = MitchellFilter{{1.75f, 2.25f}, 0.4f, 0.3f};
        t.sampler = StratifiedSampler{3, 5, false};
        t.spp = 7;
        t.seed = 0xfedcba9876543210u;
        t.color = ColorMode::Rgb;
        t.integrator =
            PathIntegrator{9,    {RouletteKind::Fixed, 0.375f}, false,
                           true, HemisphereSampling::Uniform,   {LightChoice::Power, ShapeSampling::Area}};
        t.film = {{640, 360},
                  std::array<int, 4>{10, 630, 20, 350},
                  "named \"so\".exr",
                  125,
                  5600,
                  12.5f,
                  false,
                  true,
                  at()};
    }

    TextureId noise, spotted, picture_of_numbers;  // a float, a spectrum, a float
    void textures() {
        ImageId const chart = picture("chart \"1\".png", "sRGB");
        TextureId const map = texture(ImageTexture{chart, UvMapping{2, 3, 0.25f, 0.5f}, WrapMode::Clamp,
                                                   FilterMode::Ewa, 4, 0.5f, true});
        picture_of_numbers = texture(ImageTexture{.image = picture("sub/numbers.exr", "gamma 1.8"),
                                                  .mapping = SphericalMapping{turned(0.4)},
                                                  .wrap = WrapMode::Octahedral,
                                                  .is_spectrum = false});
        TextureId const squares = texture(CheckerboardTexture{
            CylindricalMapping{turned(0.5)}, {}, 2, map, colour(RgbAlbedoSpd{{0.2f, 0.3f, 0.4f}})});
        TextureId const cubes =
            texture(CheckerboardTexture{{}, turned(0.6), 3, squares, colour(ConstantSpd{0.15f})});
        TextureId const fbm = texture(FbmTexture{turned(0.7), 5, 0.4f});
        TextureId const wrinkled = texture(WrinkledTexture{turned(0.8), 6, 0.3f});
        TextureId const windy = texture(WindyTexture{turned(0.9)});
        TextureId const scaled = texture(ScaleTexture{cubes, fbm});
        TextureId const mixed =
            texture(MixTexture{scaled, texture(MarbleTexture{turned(1.0), 7, 0.6f, 1.5f, 0.25f}), windy});
        TextureId const direction = texture(
            DirectionMixTexture{mixed, colour(NamedSpd{"metal-Ag-k"}), normalize(Vec3{0.3f, -0.5f, 0.8f})});
        spotted =
            texture(DotsTexture{PlanarMapping{turned(1.1), {1, 2, 3}, {3, 2, 2}, 0.125f, 0.75f}, direction,
                                colour(TabulatedSpd{{400, 500.5f, 700}, {0.1f, 0.6f, 0.3f}})});
        noise = texture(BilerpTexture{UvMapping{0.5f, 0.25f, 0.125f, 1}, number(0.1f), wrinkled, number(0.3f),
                                      picture_of_numbers});
    }

    Roughness rough(float u, float v, Distribution d = TrowbridgeReitz(), bool remap = false) {
        return {number(u), number(v), remap, d, true};
    }
    static constexpr Distribution TrowbridgeReitz() { return Distribution::TrowbridgeReitz; }

    std::vector<MaterialId> made;
    void materials() {
        auto const add = [&](MaterialKind kind, std::string const& name = "") {
            made.push_back(material(std::move(kind), name));
        };
        auto const albedo = [&] { return colour(RgbAlbedoSpd{{0.25f, 0.5f, 0.75f}}); };
        Coat const coat{ConstantSpd{1.33f},   rough(0.2f, 0.3f), number(0.02f), albedo(), number(0.4f), 12, 3,
                        CoatModel::Stochastic};
        add(DiffuseMaterial{spotted}, "the \\ same");
        add(DielectricMaterial{TabulatedSpd{{400, 600, 800}, {1.6f, 1.5f, 1.45f}},
                               rough(0.1f, 0.2f, Distribution::Beckmann),
                               {RgbUnboundedSpd{{0.5f, 1.5f, 2.5f}}, 3}},
            "the \\ same");
        add(DielectricMaterial{ConstantSpd{1.4f}, {}, {ConstantSpd{0.75f}, 2}});
        add(ConductorMaterial{metal(NamedSpd{"metal-Ag-eta"}),
                              metal(RgbUnboundedSpd{{1, 2, 3}}),
                              {},
                              {noise, {}, true, Distribution::Blinn, false}});
        add(ConductorMaterial{{}, {}, albedo(), rough(0.25f, 0.25f)});
        add(ThinDielectricMaterial{NamedSpd{"glass-BK7"}});
        add(InterfaceMaterial{});
        add(CoatedDiffuseMaterial{colour(BlackbodySpd{4000}), coat});
        add(CoatedConductorMaterial{{metal(ConstantSpd{0.5f}),
                                     metal(ConstantSpd{2.5f}),
                                     {},
                                     rough(0.3f, 0.15f, Distribution::Blinn, true)},
                                    coat});
        add(DiffuseTransmissionMaterial{albedo(), colour(ConstantSpd{0.375f}), 0.9f});
        add(MeasuredMaterial{{"paint.bsdf", at()}});
        add(AshikhminShirleyMaterial{albedo(), colour(ConstantSpd{0.1f}), number(50), noise});
        add(PlasticMaterial{albedo(), colour(ConstantSpd{0.9f}), ConstantSpd{1.6f}, rough(0.4f, 0.1f),
                            false});
        add(MetallicRoughnessMaterial{albedo(),
                                      number(0.25f),
                                      number(0.5f),
                                      {1.4f, 0.3f},
                                      {number(0.8f), albedo()},
                                      {number(0.6f), false, {RgbUnboundedSpd{{0.1f, 0.2f, 0.3f}}, 4}},
                                      {number(0.7f), number(0.2f)},
                                      {albedo(), number(0.35f)},
                                      {number(0.45f), 0.7654321f},
                                      false});
        s.materials[made[0].value].displacement = noise;
        s.materials[made[3].value].normal_map = {picture("normals.png", "linear"), 0.5f};
        add(MixMaterial{made[0], made[1], picture_of_numbers});
        add(MixMaterial{made[14], made[2], number(0.75f)});
    }

    void light(LightKind kind, double angle) { s.add(Light{std::move(kind), turned(angle), at()}); }
    void lights() {
        light(PointLight{BlackbodySpd{3000}, 2, 100, {1, 2, 3}}, 1.2);
        light(SpotLight{NamedSpd{"stdillum-A"}, 3, 200, {1, 0, 2}, {2, 3, 1}, 0.6123456f, 0.1234567f}, 1.3);
        light(DistantLight{TabulatedSpd{{300, 800}, {1, 2}}, 4, 50, {2, 1, 0}, {3, 3, 3}}, 1.4);
        light(InfiniteLight{ConstantSpd{0.5f},
                            {},
                            EnvironmentMapping::BySize,
                            0.5f,
                            20,
                            std::array<Vec3, 4>{Vec3{0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}}},
              1.5);
        light(
            InfiniteLight{
                .image = picture("sky.exr"), .mapping = EnvironmentMapping::LatLong, .scale = 0.25f},
            1.6);
        light(GoniometricLight{RgbIlluminantSpd{{1, 0.5f, 0.25f}, RgbWhite::AcesD60}, picture("lamp.exr"), 5,
                               300},
              1.7);
        light(ProjectionLight{picture("slide.png"), 0.8123457f, 6, 400}, 1.8);
        light(MeasuredLight{RgbIlluminantSpd{{0.5f, 0.75f, 1}},
                            {{0, 0.5123457f, 3.0123456f},
                             {0, 1.2345678f, 4.5f, kTwoPi},
                             {1, 2.5f, 3, 4, 5.75f, 6, 7, 8, 9, 1, 2.5f, 3}},
                            7,
                            500},
              1.9);
        light(SunSkyLight{4, {1, 2, 3}, 0.0123456f, 8, true, true}, 2.0);
    }

    void shapes() {
        Object& mesh = object(TriangleMesh{{{0, 0, 0}, {1.1f, 0, 0}, {0, 1.3f, 0}, {1, 1, 0.1f}},
                                           {{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}, {1, 0, 0}},
                                           {{0, 0}, {1, 0}, {0, 1}, {0.9f, 0.8f}},
                                           {{0, 1, 2}, {1, 3, 2}}},
                              made[0]);
        mesh.light = AreaLight{RgbIlluminantSpd{{1, 0.5f, 0.25f}}, {}, {}, 2, 60, true, at()};
        mesh.to_group = turned(2.1);
        Object& patch = object(BilinearMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5f}},
                                            {{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}, {1, 0, 0}},
                                            {{0, 0}, {1, 0}, {0, 1}, {1, 0.75f}},
                                            {{0, 1, 2, 3}}},
                               made[1]);
        patch.light = AreaLight{.image = picture("glow.png"), .scale = 3, .where = at()};
        patch.reverse_orientation = true;
        LoopSubdivision tetrahedron{
            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}, 2};
        object(tetrahedron, made[2]).alpha = noise;
        Object& sphere = object(Sphere{1.5f, -1.25f, 1.125f, 5.1234567f}, made[3]);
        sphere.light =
            AreaLight{.texture = texture(ImageTexture{
                          .image = picture("glow2.exr"), .scale = 2, .role = SpectrumRole::Unbounded}),
                      .scale = 4,
                      .where = at()};
        object(Cylinder{0.5f, -0.75f, 2, 4.1234567f}, made[4]).alpha = number(0.5f);
        Object& disk = object(Disk{0.25f, 2, 0.5f, 3.1234567f}, made[5]);
        disk.light = AreaLight{.radiance = RgbIlluminantSpd{{1, 1, 1}, RgbWhite::AcesD60}, .where = at()};
        disk.alpha = number(0);
        object(Box{{-1, -2, -3}, {1, 2, 4}}, made[15]).alpha = number(1);
        object(Quad{{1, 2, 3}, {0.5f, 0, 0.25f}, {0, 3, 1}}, made[14]);
        for (std::size_t i = 6; i < 14; ++i)
            object(Sphere{.radius = 0.5f + 0.1f * static_cast<float>(i), .z_min = -9, .z_max = 9}, made[i]);

        GroupId const leaf =
            s.add(Group{"leaf",
                        {{.shape = tetrahedron, .to_group = turned(2.2), .material = made[0], .where = at()}},
                        {},
                        at()});
        AffineRows const rows{{{1, 0.25f, 0, 3}, {0, 0.5f, 0, 1}, {0.125f, 0, 2, -1}}};
        GroupId const branch = s.add(
            Group{"leaf",
                  {{.shape = Sphere{}, .material = made[1], .light = AreaLight{.power = 5}, .where = at()}},
                  {{leaf, rows, at()}, {leaf}},
                  at()});
        s.world().instances = {{branch, rows, at()}, {leaf, rows, at()}};
    }

  private:
    std::uint32_t line = 0;
};

}  // namespace nephroid::test
