#include "portable.h"

#include "scene/affine_rows.h"
#include "scene/match.h"

#include <functional>
#include <utility>

namespace nephroid {

namespace {

/// Where the settings are, as far as they are anywhere: in formats without an integrator, the scene's file.
SourceLocation place_of(Settings const& s, Scene const& scene) {
    return s.integrator_where.file < scene.files.size() ? s.integrator_where : SourceLocation{0, 0};
}

/// What pbrt-v4 has of each integrator.
Integrator nearest(Scene& scene, Settings const& s) {
    auto const note = [&](char const* text) { scene.note(place_of(s, scene), text); };
    auto const light_choice = [](auto const& i) { return LightSampling{i.lights.choice}; };
    return match(
        s.integrator,
        [&](PathIntegrator const& i) {
            bool const ours = i.roulette.kind != RouletteKind::Throughput || !i.sample_lights ||
                              !i.sample_bsdf_mis || i.hemisphere != HemisphereSampling::Cosine ||
                              i.lights.shapes != ShapeSampling::SolidAngle;
            if (ours) note("how \"path\" draws its samples is pbrt-v4's own way");
            return Integrator{PathIntegrator{.max_depth = i.max_depth, .lights = light_choice(i)}};
        },
        [&](WhittedIntegrator const& i) {
            note("\"whitted\" is replaced by \"path\", which finds indirect light as well");
            return Integrator{PathIntegrator{.max_depth = i.max_depth, .lights = light_choice(i)}};
        },
        [&](DirectIntegrator const& i) {
            note("\"direct\" is replaced by \"path\", which finds indirect light as well");
            return Integrator{PathIntegrator{.max_depth = i.max_depth, .lights = light_choice(i)}};
        },
        [&](PhotonMapIntegrator const& i) {
            note("\"photonmap\" is replaced by \"sppm\", with the same photons in each pass");
            if (i.estimates.radius == 0)
                note("pbrt-v4's \"sppm\" begins with a radius of 1: give it one that suits");
            SppmIntegrator p;
            p.shooting.global_paths = i.shooting.global_paths > 0 ? i.shooting.global_paths : -1;
            p.estimates.radius = i.estimates.radius;
            return Integrator{p};
        },
        [&](SppmIntegrator const& i) {
            if (i.estimates.radius == 0)
                note("pbrt-v4's \"sppm\" begins with a radius of 1: give it one that suits");
            SppmIntegrator p;
            p.max_depth = p.shooting.max_depth = i.max_depth;
            p.shooting.global_paths = i.shooting.global_paths;
            p.estimates.radius = i.estimates.radius;
            return Integrator{p};
        },
        [](LightPathIntegrator const& i) {
            return Integrator{LightPathIntegrator{.max_depth = i.max_depth}};
        });
}

}  // namespace

void make_portable(Settings& s, Scene& scene) {
    s.integrator = nearest(scene, s);
    if (s.color == ColorMode::Rgb) scene.note(place_of(s, scene), "colours are spectra in pbrt-v4, not rgb");
    s.color = ColorMode::Spectral;
    s.color_given = false;
    auto const most = static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
    if (s.seed > most) {
        scene.note(SourceLocation{0, 0}, "the seed is cut to the 32 bits that pbrt-v4 has for it");
        s.seed &= most;
    }
}

void take_groups_apart(Scene& scene) {
    std::vector<bool> whole;
    for (Group const& g : scene.groups) {
        bool emits = false;
        for (Object const& o : g.objects) emits = emits || o.light;
        whole.push_back(!emits && g.instances.empty());
    }
    Group world{scene.world().name, {}, {}, scene.world().where};
    bool first = true;
    std::function<void(Group const&, Mat4 const&)> const add = [&](Group const& g, Mat4 const& to_world) {
        for (Object o : g.objects) {
            o.to_group = to_world * o.to_group;
            world.objects.push_back(std::move(o));
        }
        for (Instance const& i : g.instances) {
            Mat4 const m = to_world * matrix_of(i.to_parent);
            if (!whole[i.group.value]) {
                if (std::exchange(first, false))
                    scene.note(
                        i.where,
                        "pbrt-v4 has no instances of instances, nor of lights: such groups are taken apart");
                add(scene[i.group], m);
                continue;
            }
            Instance copy = i;
            copy.to_parent = rows_of(m);
            world.instances.push_back(copy);
        }
    };
    add(scene.world(), Mat4{});
    scene.world() = std::move(world);
}

Scene portable_scene(Scene scene) {
    make_portable(scene.settings, scene);
    make_textures_portable(scene);
    make_materials_portable(scene);
    take_groups_apart(scene);
    make_objects_portable(scene);
    make_lights_portable(scene);
    return scene;
}

}  // namespace nephroid
