#include "everything.h"
#include "scene/fields.h"
#include "support.h"

#include <cstring>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// The texts of files in the scene's folder are named as they lie there.
Scene everything(Folder const& folder) {
    Scene s = Everything().s;
    for (ImageFile& image : s.images) image.path = (folder / image.path).string();
    for (Material& m : s.materials)
        if (auto* k = std::get_if<MeasuredMaterial>(&m.kind)) k->file.path = (folder / k->file.path).string();
    return s;
}

void check_round_trip(Scene const& s, Folder const& folder) {
    Scene const back = there_and_back(s, folder / "out.pbrt");
    CHECK(hash(back) == hash(s));
    CHECK(hash(back.settings) == hash(s.settings));
    CHECK(back.settings.spp == s.settings.spp);
    CHECK(back.settings.film.filename == s.settings.film.filename);
    CHECK(back.settings.film.half_float == s.settings.film.half_float);
    // Of what a reader always speaks about, and of nothing else.
    for (Note const& n : back.notes) {
        CAPTURE(n.text);
        bool const known = n.text.find("each instance emits") != std::string::npos ||
                           n.text.find("that of the whole mesh") != std::string::npos ||
                           n.text.find("thin walls have no inside") != std::string::npos;
        CHECK(known);
    }
}

/// Another value for the n-th leaf of `thing` that is a number. False where there are fewer.
template <class T>
bool mutate(T& thing, std::size_t n) {
    std::size_t i = 0;
    bool done = false;
    for_each_leaf(thing, [&](auto const& leaf) {
        using Leaf = std::remove_cvref_t<decltype(leaf)>;
        if constexpr (ScalarType<Leaf>) {
            if (i++ != n) return;
            done = true;
            auto& x = const_cast<Leaf&>(leaf);
            if constexpr (std::is_same_v<Leaf, bool>)
                x = !x;
            else if constexpr (std::is_enum_v<Leaf>)
                x = static_cast<Leaf>(static_cast<int>(x) == 0 ? 1 : 0);
            else if constexpr (std::is_floating_point_v<Leaf>)
                x = x == 0 ? Leaf(0.125) : std::nextafter(x, Leaf(0));
            else
                x = static_cast<Leaf>(x + 1);
        }
    });
    return done;
}

struct Count {
    int kept = 0, refused = 0, invalid = 0;
};
/// Each number of the scene's part in turn has another value: that comes through, or is refused in words.
template <class Part>
Count each_number_counts(Folder const& folder, Scene const& original, Part part) {
    Count count;
    for (std::size_t n = 0;; ++n) {
        CAPTURE(n);
        Scene s = original;
        if (!mutate(part(s), n)) break;
        try {
            validate(s);
        } catch (Error const&) {
            ++count.invalid;
            continue;
        }
        try {
            Scene const back = there_and_back(s, folder / "out.pbrt");
            CHECK(hash(back) == hash(s));
            CHECK(hash(back.settings) == hash(s.settings));
            ++count.kept;
        } catch (Error const& e) {
            CAPTURE(e.what());
            CHECK(std::string(e.what()).find("has no form in pbrt's language") != std::string::npos);
            ++count.refused;
        }
    }
    return count;
}

}  // namespace

TEST_CASE("a scene of everything is read as what was written") {
    Folder const folder;
    Scene const s = everything(folder);
    validate(s);
    check_round_trip(s, folder);
    // From then on the text stays as it is.
    write_pbrt(read_scene(folder / "out.pbrt"), folder / "out.pbrt");
    auto const second = contents(folder / "out.pbrt");
    Scene const again = read_scene(folder / "out.pbrt");
    CHECK(hash(again) == hash(s));
    write_pbrt(again, folder / "out.pbrt");
    CHECK(contents(folder / "out.pbrt") == second);
}

TEST_CASE("every kind of settings is read as what was written") {
    Folder const folder;
    Scene s = everything(folder);
    auto& t = s.settings;
    LightSampling const lights{LightChoice::Uniform, ShapeSampling::Projected};
    PhotonShooting const shooting{12345, 54321, 7, false};
    PhotonEstimates const estimates{17, 0.3f, 0.2f, Kernel::Gaussian, true};
    std::vector<Integrator> const integrators{
        PathIntegrator{},
        PathIntegrator{3, {RouletteKind::None, 0.25f}, true, false, {}, lights},
        WhittedIntegrator{3, lights},
        DirectIntegrator{2, DirectStrategy::Bsdf, HemisphereSampling::Uniform, lights},
        PhotonMapIntegrator{4,
                            shooting,
                            {19, 0.4f, 0.1f, Kernel::Cone, false},
                            0.5f,
                            false,
                            9,
                            3,
                            PhotonView::Radiance,
                            lights},
        PhotonMapIntegrator{},
        SppmIntegrator{6, shooting, estimates, 0.75f, PhotonView::Caustic, lights},
        SppmIntegrator{},
        LightPathIntegrator{8, 999, lights},
        LightPathIntegrator{}};
    for (Integrator const& i : integrators) {
        CAPTURE(i.index());
        t.integrator = i;
        for (ColorMode const color : {ColorMode::Rgb, ColorMode::Spectral}) {
            t.color = color;
            check_round_trip(s, folder);
        }
    }
    for (Filter const& f : std::vector<Filter>{BoxFilter{{0.75f, 1}}, TriangleFilter{{1, 3}},
                                               GaussianFilter{{2, 1.25f}, 0.625f}, MitchellFilter{},
                                               LanczosSincFilter{{3, 5}, 2.5f}}) {
        t.filter = f;
        check_round_trip(s, folder);
    }
    for (Sampler const& m : std::vector<Sampler>{SobolSampler{}, IndependentSampler{}, StratifiedSampler{},
                                                 StratifiedSampler{7, 1, true}}) {
        t.sampler = m;
        check_round_trip(s, folder);
    }
    t.film = {};
    t.seed = 3;
    check_round_trip(s, folder);
    for (CameraKind const& c :
         std::vector<CameraKind>{OrthographicCamera{0.25f, 7}, SphericalCamera{},
                                 SphericalCamera{SphericalMappingKind::EqualArea}, PerspectiveCamera{}}) {
        s.camera.kind = c;
        check_round_trip(s, folder);
    }
    s.camera = Camera{};
    check_round_trip(s, folder);
}

TEST_CASE("each number counts: camera, settings and lights") {
    Folder const folder;
    Scene const s = everything(folder);
    CHECK(each_number_counts(
              folder, s, [](Scene & x) -> auto& { return x.camera; })
              .kept >= 20);
    CHECK(each_number_counts(
              folder, s, [](Scene & x) -> auto& { return x.settings; })
              .kept >= 25);
    Count const lights = each_number_counts(
        folder, s, [](Scene & x) -> auto& { return x.lights; });
    CHECK(lights.kept >= 180);
    CHECK(lights.refused <= 12);  // planes of a lamp that do not close, the sun's own …
    Scene photons = s;
    photons.settings.integrator = PhotonMapIntegrator{4,
                                                      {12345, 54321, 7, false},
                                                      {19, 0.4f, 0.1f, Kernel::Cone, false},
                                                      0.5f,
                                                      false,
                                                      9,
                                                      3,
                                                      PhotonView::Radiance,
                                                      {}};
    CHECK(each_number_counts(
              folder, photons,
              [](Scene & x) -> auto& { return std::get<PhotonMapIntegrator>(x.settings.integrator); })
              .kept >= 16);
}

TEST_CASE("each number counts: textures and materials") {
    Folder const folder;
    Scene const s = everything(folder);
    Count const textures = each_number_counts(
        folder, s, [](Scene & x) -> auto& { return x.textures; });
    CHECK(textures.kept >= 220);
    CHECK(textures.refused <= 60);  // roles that are not their places'
    Count const materials = each_number_counts(
        folder, s, [](Scene & x) -> auto& { return x.materials; });
    CHECK(materials.kept >= 60);
    CHECK(materials.refused <= 20);
}

TEST_CASE("each number counts: the world") {
    Folder const folder;
    Scene const s = everything(folder);
    Count const groups = each_number_counts(
        folder, s, [](Scene & x) -> auto& { return x.groups; });
    CHECK(groups.kept >= 300);
    CHECK(groups.refused <= 20);
}

TEST_CASE("angles that no degrees reach are kept, and degrees where they are") {
    Folder const folder;
    Scene s = everything(folder);
    int in_radians = 0;
    for (int i = 0; i < 200; ++i) {
        auto& fov = std::get<PerspectiveCamera>(s.camera.kind).fov;
        fov = std::nextafter(i == 0 ? 0.6f : fov, 1.0f);
        Scene const back = there_and_back(s, folder / "out.pbrt");
        REQUIRE(std::get<PerspectiveCamera>(back.camera.kind).fov == fov);
        in_radians += contents(folder / "out.pbrt").find("\"float fov.radians\"") != std::string::npos;
    }
    CHECK(in_radians > 0);
    CHECK(in_radians < 100);
    std::get<PerspectiveCamera>(s.camera.kind).fov = radians(40);
    write_pbrt(s, folder / "out.pbrt");
    CHECK(contents(folder / "out.pbrt").find("\"float fov\" 40") != std::string::npos);
}
