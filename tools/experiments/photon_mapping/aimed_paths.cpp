// What aiming at mirrors and glass is worth: caustic photons stored per path.
#include "runs.h"
#include "sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::experiment {

namespace {

/// A room of 10 x 8 x 4 with a lamp at its ceiling and a glass ball of radius 0.1 in a corner.
std::string big_room() {
    return R"(Option "string color" "rgb"
Film "rgb" "integer xresolution" 64 "integer yresolution" 48
Scale -1 1 1
LookAt 0 -3.5 2  4 3 0.2  0 0 1
Camera "perspective" "float fov" 50
WorldBegin
AttributeBegin
AreaLightSource "diffuse" "rgb L" [ 10 10 10 ]
Shape "quad" "point3 origin" [ -0.5 -0.5 3.99 ] "vector3 u" [ 0 1 0 ] "vector3 v" [ 1 0 0 ]
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.6 0.6 ]
Shape "box" "point3 lo" [ -5 -4 0 ] "point3 hi" [ 5 4 4 ]
Material "dielectric" "float eta" 1.5
AttributeBegin
Translate 4.6 3.6 0.11
Shape "sphere" "float radius" 0.1
AttributeEnd
)";
}

/// Caustic photons of so many paths, and their power in all (the first channel) with its standard error.
struct Cast {
    std::uint64_t stored = 0, paths = 0;
    double power = 0, error = 0;
};
Cast cast(Setup const& setup, bool aim, std::uint64_t paths) {
    RenderJob const job(
        setup.world,
        with(setup.settings, fmt::format("Integrator \"photonmap\" \"integer causticphotons\" {} "
                                         "\"bool aim\" {} \"float radius\" 1\nSampler \"independent\"",
                                         paths, aim)));
    auto const shot = shoot(job, ShotKind::Caustic, 0, paths, {});
    Cast c{shot->photons.size(), paths, 0, 0};
    double square = 0;
    for (Photon const& p : shot->photons) {
        double const power = static_cast<double>(p.power()[0]);
        c.power += power, square += power * power;
    }
    c.error = std::sqrt(std::max(0.0, square - c.power * c.power / static_cast<double>(paths)));
    return c;
}

}  // namespace

void aimed_paths(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "Of the paths that a lamp sends anywhere, few meet what casts caustics. Aimed ones are sent "
        "towards what reflects or refracts alone, and carry less: in the mean the same light. The room is "
        "one of 10 × 8 × 4 with a glass ball of radius 0.1 in a corner.");
    page.code("Integrator \"photonmap\" \"bool aim\" true|false");
    constexpr std::uint64_t kPlain = 10;  // times as many: few of them are stored
    std::uint64_t const paths = lab.quick ? 20000 : 400000;
    struct Scene {
        std::string name;
        Setup setup;
    };
    std::vector<Scene> scenes;
    scenes.push_back({"the room", faithful(big_room(), ".")});
    for (char const* name : {"cornell-spheres", "cornell-mirror-boxes", "cup", "ring", "goblet", "pool"})
        scenes.push_back(
            {fmt::format("`scenes/{}.pbrt`", name), sized_file(std::string(name) + ".pbrt", 64, 48)});
    std::vector<std::vector<std::string>> rows;
    for (Scene const& s : scenes) {
        Cast const plain = cast(s.setup, false, kPlain * paths), aimed = cast(s.setup, true, paths);
        auto const share = [&](Cast const& c) {
            return static_cast<double>(c.stored) / static_cast<double>(c.paths);
        };
        bool const any = plain.stored > 0;
        double const ratio = any ? aimed.power / plain.power : 0;
        rows.push_back(
            {s.name, number(share(plain)), number(share(aimed)),
             any ? number(share(aimed) / share(plain)) : "no photon",
             any ? with_error(ratio, ratio * std::hypot(aimed.error / aimed.power, plain.error / plain.power))
                 : "no photon"});
    }
    page.table({fmt::format("{} paths, {} aimed", thousands(kPlain * paths), thousands(paths)),
                "stored per path", "… aimed", "gain", "power, aimed ÷ not aimed"},
               rows);
    page.text(
        "The last column should be 1, to its standard error, nearly all of which is of the few photons "
        "that are stored without aim.");
}

}  // namespace nephroid::experiment
