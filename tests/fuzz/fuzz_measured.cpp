// Any bytes are a measured material, whose values and densities are finite and not negative, or an Error that names the file.
#include "fuzz.h"

#include "math/error.h"
#include "model/bsdf.h"
#include "model/material.h"

#include <cmath>
#include <cstdlib>

void nephroid::fuzz(std::string_view bytes) {
    TemporaryFile const file(bytes, ".bsdf");
    Scene scene;
    MeasuredMaterial material;
    material.file.path = file.path().string();
    MaterialId const id = scene.add(Material{material});
    try {
        Assets const assets(scene);
        for (Wavelengths const& lambda : {Wavelengths::rgb(), Wavelengths::spectral(0.4f)}) {
            Bsdf b;
            if (!make_bsdf(assets, id, {}, lambda, b)) std::abort();
            auto const good = [](Spectrum f) {
                for (int i = 0; i < 4; ++i)
                    if (!(f[i] >= 0.0f) || !std::isfinite(f[i])) return false;
                return true;
            };
            auto const how = HemisphereSampling::Cosine;
            for (Vec3 const wo :
                 {Vec3{0, 0, 1}, Vec3{0.6f, 0, 0.8f}, Vec3{-0.48f, 0.64f, -0.6f}, Vec3{0, -1, 1e-6f}}) {
                if (!good(albedo(b, wo))) std::abort();
                for (float const u : {0.0f, 0.3f, 0.99999994f})
                    if (auto const s = sample(b, wo, 0, {u, 1.0f - u - 0x1p-24f}, Mode::Radiance, how))
                        if (!(s->pdf > 0.0f) || !std::isfinite(s->pdf) || !good(s->f)) std::abort();
                Vec3 const wi{0.36f, -0.48f, std::copysign(0.8f, wo.z)};
                float const density = pdf(b, wo, wi, how);
                if (!(density >= 0.0f) || !std::isfinite(density)) std::abort();
                if (!good(evaluate(b, wo, wi, Mode::Radiance))) std::abort();
                if (!good(evaluate(b, wo, wi, Mode::Importance))) std::abort();
            }
        }
    } catch (Error const& e) {
        if (std::string(e.what()).find(file.path().string()) == std::string::npos) std::abort();
    }
}
