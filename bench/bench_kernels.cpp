// Kernels one by one: what each number, direction, texel and ray costs. Arguments come from tables of 4096 entries, so that
// neither the branch predictor nor the optimiser knows them. `--benchmark_filter=…` chooses among them.
#include "film/film.h"
#include "measured_maker.h"
#include "model/camera.h"
#include "model/filter.h"
#include "model/fresnel.h"
#include "model/material.h"
#include "read/read.h"
#include "sampling/distribution.h"
#include "sampling/path_sampler.h"
#include "sampling/warp.h"
#include "scenes.h"
#include "spectrum/color.h"
#include "spectrum/uplift.h"
#include "world/world.h"

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace nephroid;

namespace {

constexpr std::size_t kArguments = 4096;

float uniform(std::uint64_t i, std::uint64_t use) {
    return to_unit_float(static_cast<std::uint32_t>(hash_keys(i, use)));
}
template <class F>
auto table(F const& f) {
    std::vector<decltype(f(std::uint64_t{}))> t;
    for (std::uint64_t i = 0; i < kArguments; ++i) t.push_back(f(i));
    return t;
}
std::vector<Vec2> const& squares() {
    static auto const t = table([](std::uint64_t i) { return Vec2{uniform(i, 1), uniform(i, 2)}; });
    return t;
}
std::vector<Vec3> const& upper_directions() {
    static auto const t = table([](std::uint64_t i) {
        return square_to_cosine_hemisphere({uniform(i, 3), uniform(i, 4)});
    });
    return t;
}
std::vector<Vec3> const& directions() {
    static auto const t = table([](std::uint64_t i) {
        return square_to_uniform_sphere({uniform(i, 5), uniform(i, 6)});
    });
    return t;
}
Wavelengths wavelengths(ColorMode mode) {
    return mode == ColorMode::Rgb ? Wavelengths::rgb() : Wavelengths::spectral(0.37f);
}

/// Times f(argument) over a table.
template <class Arguments, class F>
void over(benchmark::State& state, Arguments const& arguments, F f) {
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(f(arguments[i++ % kArguments]));
    state.SetItemsProcessed(state.iterations());
}
template <class Arguments, class F>
void add(std::string const& name, Arguments const& arguments, F f) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&arguments, f](benchmark::State& state) { over(state, arguments, f); });
}

// ---- sampling --------------------------------------------------------------------------------------------------------------

void sampling() {
    static auto const numbers = table([](std::uint64_t i) { return i; });
    static Sequence const sobol{SequenceKind::Sobol, 7, 4, 4, true};
    static Sequence const stratified{SequenceKind::Stratified, 7, 4, 4, true};
    static Sequence const independent{SequenceKind::Independent, 7, 4, 4, true};
    struct Named {
        char const* name;
        Sequence const* sequence;
    };
    for (auto const [name, sequence] :
         {Named{"sobol", &sobol}, {"stratified", &stratified}, {"independent", &independent}}) {
        add(std::string("sampler/start/") + name, numbers,
            [s = sequence](std::uint64_t i) { return PathSampler(*s, 0, i, i & 63); });
        add(std::string("sampler/1d/") + name, numbers,
            [p = PathSampler(*sequence, 0, 5, 9)](std::uint64_t i) mutable {
                p.at(static_cast<std::uint32_t>(i));
                return p.next_1d();
            });
        add(std::string("sampler/2d/") + name, numbers,
            [p = PathSampler(*sequence, 0, 5, 9)](std::uint64_t i) mutable {
                p.at(static_cast<std::uint32_t>(i));
                return p.next_2d();
            });
    }
    add("hash/mix64", numbers, [](std::uint64_t i) { return mix64(i); });
    add("hash/keys3", numbers, [](std::uint64_t i) { return hash_keys(i, 1, 2); });

    add("warp/disk", squares(), [](Vec2 u) { return square_to_disk(u); });
    add("warp/cosine_hemisphere", squares(), [](Vec2 u) { return square_to_cosine_hemisphere(u); });
    add("warp/uniform_sphere", squares(), [](Vec2 u) { return square_to_uniform_sphere(u); });
    add("warp/uniform_cone", squares(), [](Vec2 u) { return square_to_uniform_cone(u, 0.1f); });
    add("warp/triangle", squares(), [](Vec2 u) { return square_to_triangle(u); });
    add("warp/equal_area_to_sphere", squares(), [](Vec2 u) { return equal_area_square_to_sphere(u); });
    add("warp/equal_area_to_square", directions(), [](Vec3 w) { return equal_area_sphere_to_square(w); });

    static auto const weights = table([](std::uint64_t i) { return uniform(i, 8); });
    static AliasTable const alias{weights};
    static auto const field = [] {
        std::vector<float> f(512 * 256);
        for (std::size_t i = 0; i < f.size(); ++i) f[i] = std::pow(uniform(i, 9), 8.0f);
        return f;
    }();
    static Distribution2D const sky(field, 512, 256);
    add("alias_table/sample/4096", squares(), [](Vec2 u) { return alias.sample(u.x); });
    add("distribution2d/sample/512x256", squares(), [](Vec2 u) {
        float pdf = 0;
        Vec2 const p = sky.sample(u, &pdf);
        return p.x + p.y + pdf;
    });
    add("distribution2d/pdf/512x256", squares(), [](Vec2 p) { return sky.pdf(p); });

    struct NamedFilter {
        char const* name;
        Filter filter;
    };
    for (auto const& [name, filter] : {NamedFilter{"box", BoxFilter{}},
                                       {"triangle", TriangleFilter{}},
                                       {"gaussian", GaussianFilter{}},
                                       {"mitchell", MitchellFilter{}},
                                       {"sinc", LanczosSincFilter{}}})
        add(std::string("filter/") + name, squares(),
            [s = FilterSampler(filter)](Vec2 u) { return s.sample(u); });
}

// ---- colour ----------------------------------------------------------------------------------------------------------------

void color() {
    static auto const colors = table([](std::uint64_t i) {
        return Vec3{uniform(i, 11), uniform(i, 12), uniform(i, 13)};
    });
    static SpectrumStore store;
    static RuntimeSpectrum const albedo =
        store.compile(RgbAlbedoSpd{{0.7f, 0.3f, 0.2f}}, SpectrumRole::Albedo);
    static RuntimeSpectrum const light =
        store.compile(RgbIlluminantSpd{{1, 0.8f, 0.6f}}, SpectrumRole::Illuminant);
    static RuntimeSpectrum const metal = store.compile(NamedSpd{"metal-Cu-eta"}, SpectrumRole::Unbounded);
    add("spectrum/srgb_to_sigmoid", colors, [](Vec3 c) { return srgb_to_sigmoid(c); });
    add("spectrum/wavelengths", squares(), [](Vec2 u) { return Wavelengths::spectral(u.x); });
    static auto const lambdas = table([](std::uint64_t i) { return Wavelengths::spectral(uniform(i, 14)); });
    add("spectrum/sample/rgb", lambdas,
        [w = Wavelengths::rgb()](Wavelengths const&) { return albedo.sample(w); });
    add("spectrum/sample/sigmoid", lambdas, [](Wavelengths const& w) { return albedo.sample(w); });
    add("spectrum/sample/dense", lambdas, [](Wavelengths const& w) { return metal.sample(w); });
    add("spectrum/sample/illuminant", lambdas, [](Wavelengths const& w) { return light.sample(w); });
    add("spectrum/to_linear_srgb", lambdas,
        [](Wavelengths const& w) { return to_linear_srgb(Spectrum(0.5f), w); });

    static Film film({64, 64}, {0, 64, 0, 64}, false, {});
    add("film/add", squares(), [](Vec2 u) {
        return film.add(static_cast<int>(u.x * 64), static_cast<int>(u.y * 64), Vec3{u.x, u.y, 1}, 1.0f);
    });
}

// ---- surfaces --------------------------------------------------------------------------------------------------------------

/// Every scattering model, as a scene file asks for it.
struct NamedMaterial {
    char const* name;
    char const* parameters;  // of Material, the type first
};
constexpr NamedMaterial kMaterials[] = {
    {"diffuse", R"("diffuse")"},
    {"diffusetransmission", R"("diffusetransmission")"},
    {"dielectric", R"("dielectric")"},
    {"thindielectric", R"("thindielectric")"},
    {"conductor", R"("conductor")"},
    {"rough_conductor", R"("conductor" "float roughness" 0.1)"},
    {"rough_conductor/beckmann", R"("conductor" "float roughness" 0.1 "string distribution" "beckmann")"},
    {"rough_conductor/blinn", R"("conductor" "float roughness" 0.1 "string distribution" "blinn")"},
    {"rough_conductor/multiscatter", R"("conductor" "float roughness" 0.1 "bool multiscatter" true)"},
    {"rough_dielectric", R"("dielectric" "float roughness" 0.1)"},
    {"rough_dielectric/beckmann", R"("dielectric" "float roughness" 0.1 "string distribution" "beckmann")"},
    {"rough_dielectric/blinn", R"("dielectric" "float roughness" 0.1 "string distribution" "blinn")"},
    {"rough_dielectric/multiscatter", R"("dielectric" "float roughness" 0.1 "bool multiscatter" true)"},
    {"coateddiffuse/closed", R"("coateddiffuse" "float roughness" 0.1 "string layers" "closed")"},
    {"coateddiffuse/stochastic", R"("coateddiffuse" "float roughness" 0.1 "string layers" "stochastic")"},
    {"coatedconductor/closed", R"("coatedconductor" "float interface.roughness" 0.01
        "float conductor.roughness" 0.1 "string layers" "closed")"},
    {"coatedconductor/stochastic", R"("coatedconductor" "float interface.roughness" 0.01
        "float conductor.roughness" 0.1 "string layers" "stochastic")"},
    {"plastic", R"("plastic" "float roughness" 0.1)"},
    {"ashikhminshirley", R"("ashikhminshirley")"},
    {"measured", R"("measured" "string filename" "made.bsdf")"},
    {"metallicroughness/plastic", R"("metallicroughness" "float metallic" 0 "float roughness" 0.5)"},
    {"metallicroughness/metal", R"("metallicroughness" "float roughness" 0.5)"},
    {"metallicroughness/glass", R"("metallicroughness" "float metallic" 0 "float roughness" 0.5
        "float transmission" 1 "bool thinwalled" false)"},
    {"metallicroughness/coat_and_sheen", R"("metallicroughness" "float metallic" 0 "float roughness" 0.5
        "float clearcoat" 1 "rgb sheencolor" [1 1 1] "float sheenroughness" 0.5)"}};

std::vector<std::pair<std::string, Bsdf>> models() {
    // A measured material is made by the recipe of the tests of that model, and read once: the file may go.
    test::MadeFile const made(test::measure(test::MeasuredPlan{}).file());
    std::string text = "WorldBegin\n";
    for (NamedMaterial const& m : kMaterials)
        text += "Material " + std::string(m.parameters) + "\nShape \"sphere\"\n";
    if (auto const at = text.find("made.bsdf"); at != std::string::npos) text.replace(at, 9, made.path());
    static World const world = compile(read_pbrt_string(text, "materials", ""));  // tables stay there
    std::vector<std::pair<std::string, Bsdf>> list;
    auto const& objects = world.scene().world().objects;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        Bsdf bsdf;
        make_bsdf(world.assets(), objects[i].material, {}, Wavelengths::spectral(0.3f), bsdf);
        list.emplace_back(kMaterials[i].name, bsdf);
    }
    return list;
}

void scattering() {
    add("fresnel/dielectric", upper_directions(), [](Vec3 w) { return fresnel_dielectric(w.z, 1.5f); });
    add("fresnel/conductor", upper_directions(), [](Vec3 w) { return fresnel_conductor(w.z, 0.2f, 3.9f); });
    add("fresnel/conductor/4_lanes", upper_directions(), [](Vec3 w) {
        return fresnel_conductor(w.z, Spectrum(0.2f, 0.3f, 0.5f, 1.1f), Spectrum(3.9f, 3.0f, 2.5f, 2.2f));
    });

    for (auto const& [name, bsdf] : models()) {
        Vec3 const wo{0.6f, 0, 0.8f};
        add("bsdf/sample/" + name, squares(), [b = bsdf, wo](Vec2 u) {
            return sample(b, wo, u.x, u, Mode::Radiance, HemisphereSampling::Cosine);
        });
        add("bsdf/evaluate/" + name, upper_directions(),
            [b = bsdf, wo](Vec3 wi) { return evaluate(b, wo, wi, Mode::Radiance); });
        add("bsdf/pdf/" + name, upper_directions(),
            [b = bsdf, wo](Vec3 wi) { return pdf(b, wo, wi, HemisphereSampling::Cosine); });
    }
    add("frame/from_z", directions(), [](Vec3 n) { return frame_from_z(n); });
}

/// The scene's textures, and one of each kind that it has not.
Scene with_all_textures(Scene scene) {
    auto const add = [&](TextureKind kind) { return scene.add(Texture{std::move(kind), {}}); };
    TextureId const red =
        add(ConstantSpectrumTexture{RgbAlbedoSpd{{0.8f, 0.1f, 0.1f}}, SpectrumRole::Albedo});
    TextureId const gray = add(ConstantSpectrumTexture{ConstantSpd{0.5f}, SpectrumRole::Albedo});
    add(DirectionMixTexture{red, gray, {0, 1, 1}});
    add(BilerpTexture{{}, red, gray, gray, red});
    add(DotsTexture{UvMapping{14, 7, 0, 0}, red, gray});
    add(FbmTexture{});
    add(WrinkledTexture{});
    add(WindyTexture{});
    add(MarbleTexture{});
    return scene;
}

void textures() {
    static World const world = compile(with_all_textures(read_scene(bench::scene_file("shapes.pbrt"))));
    static auto const points = table([](std::uint64_t i) {
        TexturePoint t;
        t.uv = {uniform(i, 21), uniform(i, 22)};
        t.p = {uniform(i, 23), uniform(i, 24), uniform(i, 25)};
        t.duv_dx = {0.004f, 0.001f};
        t.duv_dy = {0.001f, 0.002f};
        t.dpdx = {0.004f, 0.001f, 0};
        t.dpdy = {0, 0.001f, 0.002f};
        return t;
    });
    auto const& textures = world.scene().textures;
    std::array<bool, std::variant_size_v<TextureKind>> seen{};
    constexpr std::array kNames{"constant_float", "constant_spectrum",
                                "imagemap",       "checkerboard",
                                "scale",          "mix",
                                "directionmix",   "bilerp",
                                "dots",           "fbm",
                                "wrinkled",       "windy",
                                "marble"};
    static_assert(kNames.size() == std::variant_size_v<TextureKind>);
    for (std::uint32_t i = 0; i < textures.size(); ++i) {
        std::size_t const kind = textures[i].kind.index();
        if (std::exchange(seen[kind], true) || kind == 0) continue;
        for (ColorMode const mode : {ColorMode::Rgb, ColorMode::Spectral})
            add(std::string("texture/") + kNames[kind] + (mode == ColorMode::Rgb ? "/rgb" : "/spectral"),
                points, [id = TextureId{i}, w = wavelengths(mode)](TexturePoint const& p) {
                    return evaluate_spectrum(world.assets(), id, p, w);
                });
    }
    static Image noise(PixelFormat::U8, 512, 512, {"R", "G", "B"}, Encoding::srgb());
    for (std::size_t i = 0; i < noise.u8().size(); ++i) noise.u8()[i] = static_cast<std::uint8_t>(mix64(i));
    static Pyramid const pyramid(noise);
    struct Named {
        char const* name;
        TextureFilter filter;
    };
    for (auto const [name, filter] : {Named{"point", TextureFilter::Point},
                                      {"bilinear", TextureFilter::Bilinear},
                                      {"trilinear", TextureFilter::Trilinear},
                                      {"ewa", TextureFilter::Ewa}})
        add(std::string("pyramid/512/") + name, points, [f = filter](TexturePoint const& p) {
            return pyramid.lookup_rgb(p.uv, f, Wrap::Repeat, p.duv_dx, p.duv_dy);
        });
}

// ---- worlds ----------------------------------------------------------------------------------------------------------------

/// Rays as a render has them: from the camera, and from where those end into the hemisphere.
struct Rays {
    World world;
    std::vector<Ray> camera, bounce;
    std::vector<SurfaceHit> hits;
};

void rays_of(std::string const& name, std::shared_ptr<Rays> const& r) {
    auto const camera = PreparedCamera::make(r->world.scene().camera, {64, 64});
    RayStats stats;
    for (std::uint64_t i = 0; r->hits.size() < kArguments && i < 64 * kArguments; ++i) {
        Ray const ray = camera->ray({64 * uniform(i, 31), 64 * uniform(i, 32)}, {0, 0}).ray;
        SurfaceHit hit;
        if (!r->world.intersect(ray, kInfinity, RayKind::Camera, stats, hit)) continue;
        Frame const frame = frame_from_z(face_forward(hit.s.ns, -ray.d));
        r->camera.push_back(ray);
        r->bounce.push_back(
            hit.spawn(frame.from_local(square_to_cosine_hemisphere({uniform(i, 33), uniform(i, 34)}))));
        r->hits.push_back(hit);
    }
    auto const intersect = [r](Ray const& ray) {
        RayStats s;
        SurfaceHit hit;
        r->world.intersect(ray, kInfinity, RayKind::Bounce, s, hit);
        return hit.t;
    };
    add("world/intersect/camera/" + name, r->camera, intersect);
    add("world/intersect/bounce/" + name, r->bounce, intersect);
    add("camera/ray/" + name, squares(), [c = *camera](Vec2 u) { return c.ray(u * 64.0f, u); });
    for (ColorMode const mode : {ColorMode::Rgb, ColorMode::Spectral}) {
        std::string const suffix = name + (mode == ColorMode::Rgb ? "/rgb" : "/spectral");
        add("world/sample_light/" + suffix, r->hits,
            [r, w = wavelengths(mode), i = 0u](SurfaceHit const& hit) mutable {
                Vec2 const u = squares()[i++ % kArguments];
                return r->world.sample_light(Receiver{hit.s.p}, {}, u.y, u, w);
            });
    }
    auto lights = std::make_shared<std::vector<LightSample>>();
    for (std::size_t i = 0; i < r->hits.size(); ++i)
        lights->push_back(
            r->world
                .sample_light(Receiver{r->hits[i].s.p}, {}, squares()[i].y, squares()[i], Wavelengths::rgb())
                .value_or(LightSample{}));
    add("world/transmittance/" + name, r->hits, [r, lights, i = 0u](SurfaceHit const& hit) mutable {
        RayStats s;
        return r->world.transmittance(hit, (*lights)[i++ % kArguments], s);
    });
}

}  // namespace

int main(int argc, char** argv) {
    sampling();
    color();
    scattering();
    textures();
    rays_of("cornell", std::make_shared<Rays>(
                           Rays{compile(read_scene(bench::scene_file("cornell-box.pbrt"))), {}, {}, {}}));
    rays_of("mesh", std::make_shared<Rays>(Rays{compile(bench::bumpy_ball_under_sky(300)), {}, {}, {}}));
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
