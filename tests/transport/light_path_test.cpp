// Light tracing: power sent out by the lights and seen by the camera is what the camera finds by looking for it.
#include "layers.h"
#include "scenes.h"
#include "tilted_floor.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

LightPathIntegrator light_paths(int max_depth, int paths) {
    LightPathIntegrator l;
    l.max_depth = max_depth;
    l.paths = paths;
    return l;
}

/// Every pixel and channel, beauty and classes of light, path tracing against light tracing: Welch's test. A failure reruns once with
/// new seeds and ten times the samples. Pixels must be known to `within` of the picture's mean.
void check_same_picture(World const& world, Settings const& s, int max_depth, int paths_per_pass,
                        std::uint64_t camera_passes, double within = 0.06) {
    Settings camera = s, light = s;
    std::uint64_t light_passes = full() ? 10 : 1;
    if (full()) camera_passes *= 10;
    if (kSanitizerShare > 1) within *= 4, camera_passes = (camera_passes + 4) / 5, paths_per_pass /= 5;
    camera.integrator = path(max_depth);
    light.integrator = light_paths(max_depth, paths_per_pass);
    auto a = measure_layers(world, camera, camera_passes, 1);
    auto b = measure_layers(world, light, light_passes, 2);
    double mean = 0;
    for (auto const& m : a) mean += m.beauty[1].mean() / static_cast<double>(a.size());
    double widest = 0;
    auto const different = [&](double alpha, bool say) {
        int count = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t k = 0; k <= kLightClasses; ++k) {
                    bool const beauty = k == kLightClasses;
                    Mean const& by_camera = beauty ? a[i].beauty[c] : a[i].light[k][c];
                    Mean const& by_light = beauty ? b[i].beauty[c] : b[i].light[k][c];
                    auto const one = compare(by_light, by_camera, mean);
                    widest = std::max(widest, one.width);
                    count += one.p < alpha;
                    if (!say) continue;
                    CHECK_MESSAGE(one.p >= alpha, "pixel ", i, ", channel ", c, ", class ", k, ": ",
                                  by_light.mean(), " by light, ", by_camera.mean(),
                                  " by camera, p = ", one.p);
                }
        return count;
    };
    if (different(sidak(static_cast<int>(a.size()) * 3 * 5), false) > 0) {
        a = measure_layers(world, camera, camera_passes * 10, 3);
        b = measure_layers(world, light, light_passes * 10, 4);
        different(std::min(1e-3, sidak(static_cast<int>(a.size()) * 3 * 5)), true);
    }
    CHECK(widest <= within * (kSanitizerShare > 1 ? 1.5 : 1));
}

std::vector<std::pair<std::string, CameraKind>> all_cameras() {
    return {{"perspective", PerspectiveCamera{1.4f, 0, 1e6f}},
            {"lens", PerspectiveCamera{1.4f, 0.15f, 0.8f}},
            {"orthographic", OrthographicCamera{}},
            {"orthographic lens", OrthographicCamera{0.1f, 0.8f}},
            {"lat-long", SphericalCamera{SphericalMappingKind::EquiRectangular}},
            {"equal area", SphericalCamera{SphericalMappingKind::EqualArea}}};
}

MaterialId rough_metal(Scene& s, float alpha) {
    ConductorMaterial m;
    m.reflectance = spectrum(s, RgbAlbedoSpd{{0.9f, 0.7f, 0.4f}});
    m.roughness = {s.add(Texture{ConstantFloatTexture{alpha}, {}}), {}, false};
    return material(s, m);
}

/// A box with surfaces of many kinds, none of them smooth, and a lamp below its ceiling.
Scene box_of_surfaces() {
    Scene s;
    auto const wall = [&](Vec3 o, Vec3 u, Vec3 v, MaterialId m) { add(s, Quad{o, u, v}, m); };
    MaterialId const grey = diffuse(s, 0.6f);
    wall({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, grey);
    wall({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}, grey);
    wall({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}, diffuse(s, Vec3{0.6f, 0.1f, 0.1f}));
    wall({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, diffuse(s, Vec3{0.1f, 0.5f, 0.1f}));
    CoatedDiffuseMaterial coated;
    coated.reflectance = spectrum(s, ConstantSpd{0.5f});
    coated.coat.roughness = {s.add(Texture{ConstantFloatTexture{0.4f}, {}}), {}, false};
    coated.coat.thickness = s.add(Texture{ConstantFloatTexture{0.01f}, {}});
    wall({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, material(s, coated));
    add(s, Sphere{0.35f, -0.35f, 0.35f}, rough_metal(s, 0.4f)).to_group = translate(-0.4, 0.3, -0.6);
    DiffuseTransmissionMaterial leaf;
    leaf.reflectance = spectrum(s, ConstantSpd{0.3f});
    leaf.transmittance = spectrum(s, ConstantSpd{0.5f});
    add(s, Quad{{0.1f, 0, -0.5f}, {0.7f, 0.1f, 0}, {0, 0.1f, 0.7f}}, material(s, leaf));
    add(s, Quad{{-0.4f, -0.2f, 0.9f}, {0, 0.6f, 0}, {0.8f, 0, 0}}).light = white(4, true);
    return s;
}

}  // namespace

TEST_CASE("a furnace seen by every camera through every filter: L_e (1 - R^N) / (1 - R), N = depth + 1") {
    for (auto const& [name, kind] : all_cameras()) {
        CAPTURE(name);
        Scene s;
        add(s, box_mesh({-1, -1, -1}, {1, 1, 1}, true), diffuse(s, 0.5f)).light = white(1);
        s.camera.kind = kind;
        s.camera.to_world = translate(0.1, 0.2, -0.3) * rotation(30, 1, 2, 0);
        if (name.starts_with("orthographic")) s.camera.screen_window = {{-0.4f, 0.4f, -0.4f, 0.4f}};
        World const world = compile(std::move(s));
        for (Filter const& filter :
             {Filter{BoxFilter{}}, Filter{GaussianFilter{}}, Filter{MitchellFilter{}}}) {
            CAPTURE(filter.index());
            Settings how = settings(light_paths(2, samples(10'000, 400'000)), 3, 3);
            how.filter = filter;
            auto const means = measure_layers(world, how, 1);
            double mean = 0;
            for (auto const& m : means) {
                mean += m.beauty[1].mean() / 9;
                auto const a = agrees(m.beauty[1], 1.75, 0.08 * (kSanitizerShare > 1 ? 4 : 1), sidak(9 * 18));
                CHECK_MESSAGE(a, a);
            }
            CHECK(mean == doctest::Approx(1.75).epsilon(0.01 * (kSanitizerShare > 1 ? 4 : 1)));
        }
    }
}

TEST_CASE("mirror caustic: a light at (0,0,1), a mirror at x = 1, and every point of the floor") {
    Scene s;
    add(s, floor_quad(1), diffuse(s, 0.5f));
    add(s, Quad{{1, -9, 0}, {0, 18, 0}, {0, 0, 9}}, mirror(s, 1.0f));
    s.add(point_light({0, 0, 1}, 1));
    look_parallel(s, {0.5f, 0, 0.9f}, {0, 0, -1}, 0.4f);
    World const world = compile(std::move(s));
    Settings const how = settings(light_paths(3, samples(60'000, 600'000)), 3, 3);
    auto const means = measure_layers(world, how, 2);
    // E = cos / d^2 of the light, and of its image at (2, 0, 1); their means over each pixel. Which way the camera's x points
    // does not matter: pixels are found by looking.
    auto const irradiance = [](double x, double y, double light_x) {
        return std::pow((x - light_x) * (x - light_x) + y * y + 1, -1.5);
    };
    CHECK(irradiance(0.5, 0, 0) == doctest::Approx(0.715542).epsilon(1e-5));
    CHECK(irradiance(0.5, 0, 2) == doctest::Approx(0.170677).epsilon(1e-5));
    Settings const job_settings = how;
    RenderJob const job(world, job_settings);
    for (int py = 0; py < 3; ++py)
        for (int px = 0; px < 3; ++px) {
            double direct = 0, caustic = 0;
            for (int j = 0; j < 20; ++j)
                for (int i = 0; i < 20; ++i) {
                    Vec2 const film{static_cast<float>(px + (i + 0.5) / 20),
                                    static_cast<float>(py + (j + 0.5) / 20)};
                    Vec3 const o = job.camera().ray(film, {0, 0}).ray.o;
                    double const x = static_cast<double>(o.x), y = static_cast<double>(o.y);
                    direct += irradiance(x, y, 0) / 400;
                    caustic += irradiance(x, y, 2) / 400;
                }
            auto const& light = means[static_cast<std::size_t>(py * 3 + px)].light;
            double const alpha = sidak(18);
            double const room = kSanitizerShare > 1 ? 4 : 1;
            auto const a = agrees(light[0][1], direct * 0.5 / kPiD, 0.02 * room, alpha);
            CHECK_MESSAGE(a, a);
            auto const b = agrees(light[1][1], caustic * 0.5 / kPiD, 0.03 * room, alpha);
            CHECK_MESSAGE(b, b);
            CHECK(light[2][1].mean() + light[3][1].mean() == 0);
        }
}

TEST_CASE("a box of many surfaces, seen by path tracing and by light tracing, class by class") {
    for (auto const& [name, kind] : all_cameras()) {
        CAPTURE(name);
        Scene s = box_of_surfaces();
        s.camera.kind = kind;
        look(s, {0.05f, -0.75f, 0.1f}, {0, 1, -0.1f});
        if (name.starts_with("orthographic")) s.camera.screen_window = {{-0.9f, 0.9f, -0.8f, 0.8f}};
        World const world = compile(std::move(s));
        Settings how = settings(path(1), 3, 3);
        how.filter = GaussianFilter{};
        bool const parallel = name.starts_with("orthographic");
        check_same_picture(world, how, 4, 40'000, 600, parallel ? 0.3 : 0.15);
    }
}

TEST_CASE("lights of all kinds, alpha, shading normals and interfaces") {
    Scene s;
    add(s, tilted_floor(1), diffuse(s, Vec3{0.8f, 0.6f, 0.4f}));
    // Half there, and half in places.
    CheckerboardTexture checks;
    checks.mapping = UvMapping{4, 4, 0, 0};
    checks.tex1 = s.add(Texture{ConstantFloatTexture{1}, {}});
    checks.tex2 = s.add(Texture{ConstantFloatTexture{0.3f}, {}});
    TriangleMesh screen =
        rectangle({-0.6f, -0.6f, 0.5f}, {0.2f, -0.6f, 0.5f}, {0.2f, 0.4f, 0.4f}, {-0.6f, 0.4f, 0.4f});
    screen.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add(s, screen, diffuse(s, 0.5f)).alpha = s.add(Texture{checks, {}});
    add(s, Sphere{0.3f, -0.3f, 0.3f}, material(s, InterfaceMaterial{})).to_group = translate(0.5, 0.3, 0.4);
    // A veil between the camera and the rest, half of which lets everything through.
    MaterialId const veil = material(s, MixMaterial{diffuse(s, 0.2f), material(s, InterfaceMaterial{}),
                                                    s.add(Texture{ConstantFloatTexture{0.5f}, {}})});
    add(s, Quad{{-1, -1, 1.5f}, {1.2f, 0, 0}, {0, 2, 0}}, veil);
    Object& lamp = add(s, Sphere{0.15f, -0.15f, 0.15f});
    lamp.light = white(6);
    lamp.to_group = translate(0.5, 0.3, 0.4);
    s.add(point_light({-0.5f, 0.5f, 1}, 0.5f));
    SpotLight spot;
    spot.from = {0.6f, -0.6f, 1.2f};
    spot.to = {0, 0, 0};
    s.add(Light{spot, {}, {}});
    DistantLight sun;
    sun.from = {0.3f, 0.2f, 1};
    sun.to = {0, 0, 0};
    s.add(Light{sun, {}, {}});
    s.add(sky(0.3f));
    look_parallel(s, {0, 0, 2}, {0, 0, -1}, 0.9f);
    World const world = compile(std::move(s));
    for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
        Settings how = settings(path(1), 3, 3);
        how.color = color;
        check_same_picture(world, how, 3, 60'000, 600, 0.08);
    }
}

TEST_CASE(
    "a camera in a body that absorbs: Beer's law along the connection, and radiance that grows by the index "
    "squared") {
    for (bool const outside : {false, true}) {
        Scene s;
        DielectricMaterial m;
        m.eta = ConstantSpd{1.3f};
        m.roughness = {s.add(Texture{ConstantFloatTexture{0.5f}, {}}), {}, false};
        m.interior.absorption = RgbUnboundedSpd{{0.2f, 0.8f, 2.0f}};
        m.interior.priority = 1;
        add(s, Box{{-1, -1, -1}, {1, 1, 1}}, material(s, m));
        add(s, floor_quad(0.8f, -0.7f), diffuse(s, 0.7f));
        if (outside) {
            // Shines through the wall that the camera looks at.
            s.add(point_light({0.2f, 2.5f, 0.3f}, 3));
        } else {
            Object& lamp = add(s, Sphere{0.2f, -0.2f, 0.2f});
            lamp.light = white(5);
            lamp.to_group = translate(0.3, 0.2, 0.5);
        }
        look(s, {0, -0.8f, 0.2f}, {0, 0.2f, -0.2f});
        s.camera.kind = PerspectiveCamera{1.5f, 0, 1e6f};
        World const world = compile(std::move(s));
        check_same_picture(world, settings(path(1), 3, 3), outside ? 1 : 3, 60'000, 300,
                           outside ? 0.5 : 0.12);
    }
}

TEST_CASE("every pass alone is right, and no pass knows of the others or of the crop") {
    Scene s = box_of_surfaces();
    s.camera.kind = PerspectiveCamera{1.4f, 0, 1e6f};
    look(s, {0.05f, -0.95f, 0.1f}, {0, 1, -0.1f});
    World const world = compile(std::move(s));
    Settings how = settings(light_paths(4, 3000), 9, 7);
    how.filter = MitchellFilter{};
    how.color = ColorMode::Spectral;
    how.film.aovs = true;
    RayStats stats;
    RenderJob const job(world, how);
    Film whole = job.make_film();
    for (std::uint64_t const i : {3, 1}) render_pass(job, i, whole, stats);
    how.film.crop = {{2, 7, 1, 6}};
    RenderJob const cropped(world, how);
    Film part = cropped.make_film();
    for (std::uint64_t const i : {3, 1}) render_pass(cropped, i, part, stats);
    double sum = 0;
    for (int y = 1; y < 6; ++y)
        for (int x = 2; x < 7; ++x) {
            CHECK(whole.pixel(x, y).rgb == part.pixel(x, y).rgb);
            CHECK(whole.aov(x, y).light == part.aov(x, y).light);
            CHECK(part.pixel(x, y).samples == 2);
            CHECK(part.pixel(x, y).weight == 2);
            sum += part.pixel(x, y).rgb[1];
        }
    CHECK(sum > 0);
    // Passes are different samples.
    Film one = job.make_film(), other = job.make_film();
    render_pass(job, 3, one, stats);
    render_pass(job, 1, other, stats);
    int equal = 0;
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x) equal += one.pixel(x, y).rgb == other.pixel(x, y).rgb;
    CHECK(equal < 8);
    // Without layers the picture has the same bits.
    how.film.aovs = false;
    RenderJob const plain(world, how);
    Film beauty = plain.make_film();
    for (std::uint64_t const i : {3, 1}) render_pass(plain, i, beauty, stats);
    for (int y = 1; y < 6; ++y)
        for (int x = 2; x < 7; ++x) CHECK(beauty.pixel(x, y).rgb == part.pixel(x, y).rgb);
}

TEST_CASE("the number of paths is what the settings say; a stop is heard, and progress told") {
    Scene s = box_of_surfaces();
    look(s, {0.05f, -0.95f, 0.1f}, {0, 1, -0.1f});
    World const world = compile(std::move(s));
    auto const camera_rays = [&](int paths) {
        Settings const how = settings(light_paths(1, paths), 20, 10);
        RenderJob const job(world, how);
        auto const work = prepare_pass(job, 0, {});
        return work->report.rays.rays[0] + work->report.rays.rays[1];
    };
    CHECK(camera_rays(-1) == 200);
    CHECK(camera_rays(1234) == 1234);
    CHECK(camera_rays(0) == 0);
    Settings const how = settings(light_paths(1, 400'000), 20, 10);
    RenderJob const job(world, how);
    std::vector<double> shares;
    PrepareControl control;
    control.on_progress = [&](double share) { shares.push_back(share); };
    CHECK(prepare_pass(job, 0, control));
    REQUIRE(shares.size() >= 3);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.back() == 1);
    std::atomic<bool> stop{false};
    control.stop = &stop;
    control.on_progress = [&](double) { stop = true; };
    CHECK_FALSE(prepare_pass(job, 0, control));
}

TEST_CASE("a limit on the largest component is one on what a path says of a pixel") {
    Scene s;
    add(s, floor_quad(0.5f)).light = white(3, true);
    look_parallel(s, {0, 0, 2}, {0, 0, -1}, 0.5f);
    World const world = compile(std::move(s));
    RayStats stats;
    for (float const limit : {1.5f, 6.0f}) {
        Settings how = settings(light_paths(0, 4), 2, 2);
        how.film.max_component = limit;
        RenderJob const job(world, how);
        Film film = job.make_film();
        for (std::uint64_t i = 0; i < 200; ++i) render_pass(job, i, film, stats);
        // Each of four paths falls on one of four pixels, half of them on the other side of the lamp: 6 for each that is seen.
        double mean = 0;
        for (int i = 0; i < 4; ++i) mean += film.pixel(i % 2, i / 2).rgb[1] / 800;
        CHECK(mean == doctest::Approx(limit / 2).epsilon(0.05));
    }
}

TEST_CASE("corners: no lights, lights that send nothing, no bounces, black") {
    auto const picture = [](Scene s, int max_depth) {
        look_parallel(s, {0, 0, 2}, {0, 0, -1}, 0.5f);
        World const world = compile(std::move(s));
        auto const means = measure_layers(world, settings(light_paths(max_depth, 500), 1, 1), 1);
        return means[0].beauty[1].mean();
    };
    Scene dark;
    add(dark, floor_quad(1), diffuse(dark, 0.5f));
    CHECK(picture(dark, 5) == 0);
    CHECK(picture(Scene{}, 5) == 0);
    Scene lamp;
    add(lamp, floor_quad(0.5f)).light = white(3, true);
    CHECK(picture(lamp, 0) == doctest::Approx(3).epsilon(0.02));
    lamp.world().objects.back().light = white(0);
    CHECK(picture(lamp, 0) == 0);
    // A mirror takes no connection.
    Scene mirrored;
    add(mirrored, floor_quad(1), mirror(mirrored, 1.0f));
    mirrored.add(point_light({0, 0, 1}, 1));
    CHECK(picture(mirrored, 5) == 0);
    // A surface that shines but is not there (alpha 0) is not seen.
    Scene ghost;
    add(ghost, floor_quad(1, -1), diffuse(ghost, 0.5f));
    Object& o = add(ghost, floor_quad(0.2f, 0.5f));
    o.light = white(3, true);
    o.alpha = ghost.add(Texture{ConstantFloatTexture{0}, {}});
    CHECK(picture(ghost, 0) == 0);
    CHECK(picture(ghost, 1) > 0);
}
