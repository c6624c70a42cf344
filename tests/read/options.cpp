// Camera, film, filter, sampler, integrator, options: defaults and parameters.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {
Settings settings(std::string const& text) { return read(text + "\nWorldBegin").settings; }
Camera camera(std::string const& text) { return read(text + "\nWorldBegin").camera; }
}  // namespace

TEST_CASE("defaults are pbrt-v4's") {
    auto const scene = read("WorldBegin");
    auto const& s = scene.settings;
    CHECK(s.spp == 16);
    CHECK(s.seed == 0);
    CHECK(as<PathIntegrator>(s.integrator).max_depth == 5);
    CHECK(as<GaussianFilter>(s.filter).radius == Vec2{1.5f, 1.5f});
    as<SobolSampler>(s.sampler);
    CHECK(s.film.resolution == Vec2i{1280, 720});
    CHECK(s.color == ColorMode::Spectral);
    CHECK(as<PerspectiveCamera>(scene.camera.kind).fov == doctest::Approx(kPiOver2));
    CHECK(is_identity(scene.camera.to_world));
    CHECK(scene.materials.empty());
    CHECK(notes(scene).empty());
}

TEST_CASE("cameras") {
    auto const p =
        camera(R"(Camera "perspective" "float fov" 60 "float lensradius" 0.1 "float focaldistance" 5
        "float frameaspectratio" 2 "float screenwindow" [-1 2 -3 4] "float shutteropen" 0.25 "float shutterclose" 0.75)");
    CHECK(as<PerspectiveCamera>(p.kind).fov == doctest::Approx(kPi / 3));
    CHECK(as<PerspectiveCamera>(p.kind).lens_radius == 0.1f);
    CHECK(as<PerspectiveCamera>(p.kind).focal_distance == 5);
    CHECK(p.frame_aspect_ratio == 2.0f);
    CHECK(p.screen_window == std::array<float, 4>{-1, 2, -3, 4});
    CHECK(p.exposure_time == 0.5f);
    CHECK(as<OrthographicCamera>(camera("Camera \"orthographic\" \"float lensradius\" 2").kind).lens_radius ==
          2);
    CHECK(as<SphericalCamera>(camera("Camera \"spherical\"").kind).mapping ==
          SphericalMappingKind::EqualArea);
    CHECK(as<SphericalCamera>(camera("Camera \"spherical\" \"string mapping\" \"equirectangular\"").kind)
              .mapping == SphericalMappingKind::EquiRectangular);
    auto const realistic = read("Camera \"realistic\" \"string lensfile\" \"x.dat\" WorldBegin");
    as<PerspectiveCamera>(realistic.camera.kind);
    CHECK(contains(notes(realistic), "t.pbrt:1: Camera \"realistic\": lens systems are not rendered yet"));

    for (char const* fov : {"0", "180", "-10"})
        CHECK(contains(error_in(std::string("Camera \"perspective\" \"float fov\" ") + fov),
                       "\"fov\" must be above 0 and below 180"));
    CHECK(contains(error_in("Camera \"perspective\" \"float shutteropen\" 2"),
                   "\"shutterclose\" must be after"));
    CHECK(contains(error_in("Camera \"perspective\" \"float screenwindow\" [1 2]"), "needs four values"));
    CHECK(contains(error_in("Camera \"environment\""), "in pbrt-v4 it is \"spherical\""));
    CHECK(contains(error_in("Camera \"perspectiv\""), "did you mean \"perspective\"?"));
}

TEST_CASE("film") {
    auto const f =
        settings(
            R"(Film "gbuffer" "integer xresolution" 100 "integer yresolution" 50 "string filename" "a.exr"
        "float iso" 200 "float whitebalance" 5000 "float maxcomponentvalue" 10 "bool savefp16" false "float diagonal" 35)")
            .film;
    CHECK(f.resolution == Vec2i{100, 50});
    CHECK(f.filename == "a.exr");
    CHECK(f.iso == 200);
    CHECK(f.white_balance == 5000);
    CHECK(f.max_component == 10);
    CHECK_FALSE(f.half_float);
    CHECK(f.aovs);
    CHECK_FALSE(f.crop.has_value());

    // ceil(100 * 0.101) = 11, ceil(100 * 0.5) = 50, ceil(50 * 0.01) = 1; 1.5 is clamped.
    CHECK(settings("Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 \"float cropwindow\" "
                   "[0.101 0.5 0.01 1.5]")
              .film.crop == std::array<int, 4>{11, 50, 1, 50});
    CHECK(settings("Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 \"integer "
                   "pixelbounds\" [10 20 30 60]")
              .film.crop == std::array<int, 4>{10, 20, 30, 50});
    CHECK(contains(error_in("Film \"rgb\" \"float cropwindow\" [0.5 0.5 0 1]"), "the crop holds no pixel"));
    CHECK(contains(error_in("Film \"rgb\" \"integer xresolution\" 0"),
                   "t.pbrt:1: Film \"rgb\": \"xresolution\""));
    CHECK(contains(error_in("Film \"rgb\" \"integer xresolution\" 2000000000"), "the limit is 2^31 pixels"));
    CHECK(contains(error_in("Film \"image\""), "in pbrt-v4 it is \"rgb\""));
    CHECK(contains(notes(read("Film \"rgb\" \"string sensor\" \"nikon_d850\" WorldBegin")),
                   "sensor \"nikon_d850\""));
    CHECK(contains(notes(read("Film \"spectral\" \"integer nbuckets\" 8 WorldBegin")), "spectral buckets"));
}

TEST_CASE("what is wrong with the settings is said with its place") {
    auto const refused = [](std::string const& text, std::string const& message) {
        auto const error = error_of([&] { validate(read("\n" + text + "\nWorldBegin")); });
        CAPTURE(error);
        CHECK(error.starts_with("t.pbrt:2: " + message));
    };
    refused("Film \"rgb\" \"float iso\" 0", "the film's ISO speed");
    refused("Film \"rgb\" \"float whitebalance\" -1", "the white balance");
    refused("Film \"rgb\" \"float maxcomponentvalue\" 0", "the largest component");
    refused("Film \"rgb\" \"integer xresolution\" 70000 \"integer yresolution\" 1",
            "the picture may be at most");
    refused("Sampler \"stratified\" \"integer xsamples\" 32768 \"integer ysamples\" 32768",
            "the stratified sampler");
}

TEST_CASE("filters") {
    CHECK(as<BoxFilter>(settings("PixelFilter \"box\"").filter).radius == Vec2{0.5f, 0.5f});
    CHECK(as<BoxFilter>(settings("PixelFilter \"box\" \"float xradius\" 1 \"float yradius\" 2").filter)
              .radius == Vec2{1, 2});
    CHECK(as<TriangleFilter>(settings("PixelFilter \"triangle\"").filter).radius == Vec2{2, 2});
    CHECK(as<GaussianFilter>(settings("PixelFilter \"gaussian\" \"float sigma\" 0.25").filter).sigma ==
          0.25f);
    CHECK(as<MitchellFilter>(settings("PixelFilter \"mitchell\" \"float B\" 0").filter).b == 0);
    CHECK(as<MitchellFilter>(settings("PixelFilter \"mitchell\"").filter).c == 1.0f / 3.0f);
    CHECK(as<LanczosSincFilter>(settings("PixelFilter \"sinc\"").filter).tau == 3);
    CHECK(contains(error_in("PixelFilter \"box\" \"float xwidth\" 1"), "in pbrt-v4 it is \"xradius\""));
    CHECK(contains(error_in("PixelFilter \"gauss\""), "unknown pixel filter"));
    // Each becomes a table: of a size that fits, and not of zeros.
    for (char const* filter : {"\"box\" \"float xradius\" 1e30", "\"triangle\" \"float yradius\" 65",
                               "\"gaussian\" \"float xradius\" 1e-30", "\"gaussian\" \"float sigma\" 1e-30",
                               "\"gaussian\" \"float sigma\" 1e30", "\"sinc\" \"float tau\" 1e-30",
                               "\"mitchell\" \"float B\" 1e30"}) {
        CAPTURE(filter);
        auto const message =
            error_of([&] { validate(read("\nPixelFilter " + std::string(filter) + " WorldBegin")); });
        CAPTURE(message);
        CHECK(message.starts_with("t.pbrt:2: the "));
        CHECK(contains(message, "filter"));
    }
    validate(read("PixelFilter \"gaussian\" \"float xradius\" 64 \"float yradius\" 64 WorldBegin"));
}

TEST_CASE("samplers") {
    for (char const* name : {"zsobol", "sobol", "paddedsobol", "pmj02bn", "halton"}) {
        CAPTURE(name);
        auto const s =
            settings("Sampler \"" + std::string(name) + "\" \"integer pixelsamples\" 7 \"integer seed\" 9");
        as<SobolSampler>(s.sampler);
        CHECK(s.spp == 7);
        CHECK(s.seed == 9);
    }
    CHECK(contains(notes(read("Sampler \"halton\" WorldBegin")), "info:"));
    CHECK(notes(read("Sampler \"zsobol\" \"string randomization\" \"fastowen\" WorldBegin")).empty());
    auto const s = settings(
        "Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5 \"bool jitter\" false");
    CHECK(s.spp == 15);
    CHECK(as<StratifiedSampler>(s.sampler).x_strata == 3);
    CHECK(as<StratifiedSampler>(s.sampler).y_strata == 5);
    CHECK_FALSE(as<StratifiedSampler>(s.sampler).jitter);
    as<IndependentSampler>(settings("Sampler \"independent\"").sampler);
    for (char const* n : {"0", "-1"})
        CHECK(contains(error_in(std::string("Sampler \"sobol\" \"integer pixelsamples\" ") + n),
                       "must be above 0"));
    CHECK(contains(error_in("Sampler \"random\""), "in pbrt-v4 write \"independent\""));
}

TEST_CASE("integrators") {
    auto const p = as<PathIntegrator>(
        settings(R"(Integrator "path" "integer maxdepth" 9 "string roulette" "fixed" "float alpha" 0.75
        "bool samplelights" false "bool mis" false "string hemisphere" "uniform")")
            .integrator);
    CHECK(p.max_depth == 9);
    CHECK(p.roulette.kind == RouletteKind::Fixed);
    CHECK(p.roulette.alpha == 0.75f);
    CHECK_FALSE(p.sample_lights);
    CHECK_FALSE(p.sample_bsdf_mis);
    CHECK(p.hemisphere == HemisphereSampling::Uniform);
    CHECK(as<PathIntegrator>(settings("Integrator \"path\" \"integer segments\" 3").integrator).max_depth ==
          2);
    CHECK(as<PathIntegrator>(settings("Integrator \"path\" \"string roulette\" \"none\"").integrator)
              .roulette.kind == RouletteKind::None);
    CHECK(as<WhittedIntegrator>(settings("Integrator \"whitted\" \"integer maxdepth\" 3").integrator)
              .max_depth == 3);
    CHECK(as<DirectIntegrator>(settings("Integrator \"directlighting\"").integrator).max_depth == 5);
    CHECK(notes(read("Integrator \"volpath\" \"string lightsampler\" \"power\" WorldBegin")).empty());
    CHECK(contains(notes(read("Integrator \"path\" \"bool regularize\" true WorldBegin")), "\"regularize\""));
    auto const walk = as<PathIntegrator>(settings("Integrator \"randomwalk\"").integrator);
    CHECK_FALSE(walk.sample_lights);
    CHECK(walk.roulette.kind == RouletteKind::None);
    for (char const* name : {"bdpt", "mlt", "ao", "function", "simplevolpath"}) {
        CAPTURE(name);
        auto const scene = read("Integrator \"" + std::string(name) +
                                "\" \"integer maxdepth\" 8 \"float whatever\" 1 WorldBegin");
        CHECK(as<PathIntegrator>(scene.settings.integrator).max_depth == 8);
        CHECK(contains(notes(scene), "is not available yet: \"path\" stands in"));
        CHECK(scene.notes.size() == 1);
    }
    CHECK(contains(error_in("Integrator \"path\" \"integer maxdepth\" -1"), "must not be negative"));
    for (char const* n : {"0", "-1", "-2147483648"})
        CHECK(contains(error_in("Integrator \"path\" \"integer segments\" " + std::string(n)),
                       "t.pbrt:1: Integrator \"path\": \"segments\" must be at least 1"));
    CHECK(contains(error_in("Integrator \"path\" \"string roulette\" \"russian\""),
                   "use one of \"throughput\", \"fixed\", \"none\""));
    CHECK(contains(error_in("Integrator \"path\" \"float alpha\" 0"), "\"alpha\" must be above 0"));
}

TEST_CASE("options") {
    CHECK(settings("Option \"seed\" 5").seed == 5);
    CHECK(settings("Option \"integer seed\" [6]").seed == 6);
    CHECK(settings("Option \"seed\" 5 Sampler \"sobol\" \"integer seed\" 7").seed == 7);
    CHECK(settings("Option \"string color\" \"rgb\"").color == ColorMode::Rgb);
    CHECK(settings("Option \"string color\" \"spectral\"").color == ColorMode::Spectral);
    CHECK(contains(error_in("Option \"color\" \"cmyk\""), "t.pbrt:1: Option \"color\": \"cmyk\" is not"));
    CHECK(contains(error_in("Option \"seed\" \"x\""), "is not an integer"));
    for (char const* name : {"disablepixeljitter", "disable-wavelength-jitter", "rendercoordsys",
                             "forcediffuse", "pixelstats", "wavefront", "msereferenceimage"}) {
        CAPTURE(name);
        CHECK(contains(notes(read("Option \"" + std::string(name) + "\" true WorldBegin")),
                       "has no effect here"));
    }
    CHECK(contains(notes(read("Option \"sede\" 1 WorldBegin")),
                   "is unknown and ignored (did you mean \"seed\"?)"));
}

TEST_CASE("colour spaces") {
    auto const albedo = [](std::string const& text) {
        auto const scene =
            read_world("Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5] ColorSpace " + text +
                       " Material \"diffuse\" \"rgb reflectance\" [0.2 0.6 0.3] Shape \"sphere\"");
        auto const& t =
            texture_of<ConstantSpectrumTexture>(scene, material_of<DiffuseMaterial>(scene).reflectance);
        return as<RgbAlbedoSpd>(t.value).rgb;
    };
    CHECK(albedo("\"srgb\"") == Vec3{0.2f, 0.6f, 0.3f});
    // Rec. 2020 to Rec. 709, ITU-R BT.2087-0 inverted: row 1 of the matrix is 1.660491 -0.587641 -0.072850.
    auto const wide = albedo("\"rec2020\"");
    CHECK(wide.x == doctest::Approx(0));  // 1.66 * 0.2 - 0.588 * 0.6 - 0.073 * 0.3 < 0: clipped
    CHECK(wide.y == doctest::Approx(-0.124550f * 0.2f + 1.132900f * 0.6f - 0.008349f * 0.3f).epsilon(1e-4));
    CHECK(wide.z == doctest::Approx(-0.018151f * 0.2f - 0.100579f * 0.6f + 1.118730f * 0.3f).epsilon(1e-4));
    CHECK(albedo("\"dci-p3\"") != Vec3{0.2f, 0.6f, 0.3f});
    CHECK(albedo("\"aces2065-1\"") != Vec3{0.2f, 0.6f, 0.3f});
    CHECK(albedo("\"ACES2065-1\"") == albedo("\"aces2065-1\""));
    CHECK(contains(error_in_world("ColorSpace \"rec2021\""), "did you mean \"rec2020\"?"));
    // A light is white of its space, by default and as rgb; only ACES has another white.
    auto const lights = read_world(
        "LightSource \"point\" ColorSpace \"rec2020\" LightSource \"point\" ColorSpace "
        "\"aces2065-1\" LightSource \"point\" LightSource \"point\" \"rgb I\" [1 1 1]"
        " LightSource \"infinite\" \"string filename\" \"/sky.exr\"");
    // Pictures are sRGB wherever they are named.
    CHECK(as<RgbIlluminantSpd>(as<InfiniteLight>(lights.lights.at(4).kind).radiance).white == RgbWhite::D65);
    auto const light = [&](std::size_t i) {
        return as<RgbIlluminantSpd>(as<PointLight>(lights.lights.at(i).kind).intensity);
    };
    CHECK(light(0).white == RgbWhite::D65);
    CHECK(light(1).white == RgbWhite::D65);
    for (std::size_t i : {2, 3}) {
        CHECK(light(i).white == RgbWhite::AcesD60);
        for (int k = 0; k < 3; ++k) CHECK(light(i).rgb[k] == doctest::Approx(1).epsilon(1e-4));
    }
    CHECK(contains(notes(read("ColorSpace \"rec2020\"\nFilm \"rgb\" WorldBegin")),
                   "t.pbrt:2: the ColorSpace at Film"));
    // A block gives it back.
    auto const scene = read_world(
        "AttributeBegin ColorSpace \"rec2020\" AttributeEnd LightSource \"point\" \"rgb I\" [1 0 0]");
    CHECK(as<RgbIlluminantSpd>(as<PointLight>(scene.lights[0].kind).intensity).rgb == Vec3{1, 0, 0});
    auto const clipped = read_world("Material \"diffuse\" \"rgb reflectance\" [-1 2 0.5]");
    CHECK(contains(notes(clipped), "t.pbrt:2: parameter \"rgb reflectance\" is outside [0,1]"));
}
