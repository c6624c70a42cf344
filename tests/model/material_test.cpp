// From materials to scattering values, where textures hold what no material means: infinities, and NaN that their sums make.
#include "model/material.h"
#include "bsdf_checks.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Textures of floats and of spectra that are +infinity, -infinity and NaN.
struct Wild {
    std::vector<TextureId> floats, spectra;
};
Wild wild(Scene& s) {
    auto const add = [&](TextureKind kind) { return s.add(Texture{std::move(kind), {}}); };
    TextureId const huge = add(ConstantFloatTexture{1e38f}), half = add(ConstantFloatTexture{0.5f});
    TextureId const minus = add(ConstantFloatTexture{-1});
    TextureId const light = add(ConstantSpectrumTexture{ConstantSpd{1e38f}, SpectrumRole::Unbounded});
    Wild w;
    for (bool const spectral : {false, true}) {
        ScaleTexture scaled;
        scaled.tex = spectral ? light : huge;
        scaled.scale = huge;
        TextureId const plus_infinity = add(scaled);
        scaled.tex = plus_infinity;
        scaled.scale = minus;
        TextureId const minus_infinity = add(scaled);
        MixTexture mixed;
        mixed.tex1 = plus_infinity, mixed.tex2 = minus_infinity, mixed.amount = half;
        TextureId const no_number = add(mixed);
        std::vector<TextureId>& list = spectral ? w.spectra : w.floats;
        list = {plus_infinity, minus_infinity, no_number};
    }
    return w;
}

}  // namespace

TEST_CASE("textures of NaN and infinities make scattering values that are numbers") {
    Scene s;
    Wild const w = wild(s);
    std::vector<MaterialId> made;
    auto const add = [&](MaterialKind kind) { made.push_back(s.add(Material{std::move(kind), "", {}})); };
    for (std::size_t i = 0; i < 3; ++i) {
        TextureId const x = w.floats[i], c = w.spectra[i];
        Roughness rough;
        rough.u = rough.v = x;
        add(DiffuseMaterial{c});
        ConductorMaterial metal;
        metal.eta = metal.k = c;
        add(metal);
        metal.roughness = rough;
        add(metal);
        ConductorMaterial mirror;
        mirror.reflectance = c;
        mirror.roughness = rough;
        add(mirror);
        DielectricMaterial glass;
        glass.roughness = rough;
        add(glass);
        for (CoatModel const model : {CoatModel::Stochastic, CoatModel::ClosedForm}) {
            CoatedDiffuseMaterial lacquer{c, {}};
            lacquer.coat.roughness = rough;
            lacquer.coat.thickness = lacquer.coat.g = x;
            lacquer.coat.model = model;
            add(lacquer);
            lacquer.coat.albedo = c;
            add(lacquer);
            CoatedConductorMaterial coated;
            coated.conductor = metal;
            coated.coat = lacquer.coat;
            add(coated);
        }
        DiffuseTransmissionMaterial sheet;
        sheet.reflectance = sheet.transmittance = c;
        add(sheet);
        AshikhminShirleyMaterial phong;
        phong.reflectance = phong.specular = c;
        phong.nu = phong.nv = x;
        add(phong);
        PlasticMaterial plastic;
        plastic.reflectance = plastic.specular = c;
        plastic.roughness = rough;
        add(plastic);
        MetallicRoughnessMaterial gltf;
        gltf.base_color = gltf.specular.color = gltf.sheen.color = c;
        gltf.metallic = gltf.roughness = gltf.specular.factor = gltf.transmission.factor = x;
        gltf.clearcoat = {x, x};
        gltf.sheen.roughness = gltf.anisotropy.strength = x;
        for (bool const thin : {true, false}) {
            gltf.transmission.thin = thin;
            add(gltf);
        }
    }
    Assets const assets(s);
    Random r(5);
    for (MaterialId const id : made)
        for (int i = 0; i < 50; ++i) {
            CAPTURE(id.value);
            Wavelengths const lambda = i % 2 ? Wavelengths::rgb() : Wavelengths::spectral(r.unit());
            Bsdf b;
            REQUIRE(make_bsdf(assets, id, {}, lambda, b));
            Vec3 const wo = random_direction(r), wi = random_direction(r);
            CHECK(evaluate(b, wo, wi, Mode::Radiance).is_finite());
            CHECK(std::isfinite(pdf(b, wo, wi, HemisphereSampling::Cosine)));
            float const uc = r.unit();
            auto const sampled =
                sample(b, wo, uc, random_square(r), Mode::Radiance, HemisphereSampling::Cosine);
            if (!sampled) continue;
            CHECK(is_finite(sampled->wi));
            CHECK((sampled->f * (abs_cos_theta(sampled->wi) / sampled->pdf)).is_finite());
        }
}
