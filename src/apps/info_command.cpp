#include "commands.h"
#include "console.h"
#include "memory.h"
#include "names.h"
#include "read/read.h"
#include "scene/match.h"
#include "statistics.h"
#include "world/world.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>

namespace nephroid::cli {

namespace {

template <class List>
std::map<std::string, int> tally(List const& list) {
    std::map<std::string, int> counts;
    for (auto const& x : list) ++counts[name_of(x.kind)];
    return counts;
}
std::string text_of(std::map<std::string, int> const& counts) {
    std::string t;
    for (auto const& [name, n] : counts) t += fmt::format("{}{} {}", t.empty() ? "" : ", ", n, name);
    return t.empty() ? "none" : t;
}
std::string text_of(SettingWords const& words) {
    std::string t;
    for (auto const& [key, value] : words) t += fmt::format("{}{} {}", t.empty() ? "" : ", ", key, value);
    return t;
}

}  // namespace

int run(InfoOptions const& o) {
    Scene scene = read_scene(o.scene);
    FilmSettings const& film = scene.settings.film;
    auto const crop = film.crop.value_or(std::array<int, 4>{0, film.resolution.x, 0, film.resolution.y});
    MemoryNeed need = memory_need(scene, crop, film.aovs);
    check_memory({need.program, need.world, 0, 0}, std::nullopt);  // no film is made here
    need.photons = photon_need(scene.settings);
    World const world = compile(std::move(scene));
    Scene const& s = world.scene();
    Settings const& settings = s.settings;
    int const depth = match(settings.integrator, [](auto const& i) { return i.max_depth; });
    if (o.json) {
        nlohmann::json j;
        j["scene_hash"] = world.scene_hash();
        j["settings_hash"] = hash(settings);
        j["resolution"] = {settings.film.resolution.x, settings.film.resolution.y};
        j["camera"] = name_of(s.camera.kind);
        j["integrator"] = name_of(settings.integrator);
        j["max_depth"] = depth;
        j["sampler"] = name_of(settings.sampler);
        j["samples_per_pixel"] = settings.spp;
        j["color"] = settings.color == ColorMode::Rgb ? "rgb" : "spectral";
        if (SettingWords const words = photon_words(settings.integrator); !words.empty())
            j["photons"] = words;
        j["materials"] = tally(s.materials);
        j["lights"] = tally(s.lights);
        j["triangles"] = world.counts().triangles;
        j["objects"] = world.counts().objects;
        j["instances"] = world.counts().instances;
        j["textures"] = s.textures.size();
        j["image_files"] = world.assets().image_files();
        j["image_bytes"] = world.memory().images;
        j["bytes"] = world.memory().total();
        j["estimated_bytes"] = {
            {"world", need.world}, {"film", need.film}, {"photons", need.photons}, {"total", need.total()}};
        j["notes"] = nlohmann::json::array();
        for (Note const& n : s.notes) j["notes"].push_back({{"where", s.locate(n.where)}, {"text", n.text}});
        print("{}\n", json_text(j, 2));
        return kGood;
    }
    WorldCounts const& c = world.counts();
    WorldMemory const m = world.memory();
    Bounds3 const& b = world.bounds();
    print("{}\n", o.scene);
    print("film        {} x {} pixels, {}\n", settings.film.resolution.x, settings.film.resolution.y,
          settings.color == ColorMode::Rgb ? "rgb" : "spectral");
    print("camera      {}\n", name_of(s.camera.kind));
    print("integrator  {}, maxdepth {}; sampler {}, {} samples a pixel\n", name_of(settings.integrator),
          depth, name_of(settings.sampler), settings.spp);
    if (std::string const photons = text_of(photon_words(settings.integrator)); !photons.empty())
        print("photons     {}\n", photons);
    print("geometry    {} objects: {} triangles in meshes, {} analytic; {} instances\n", c.objects,
          c.triangles, c.analytic, c.instances);
    if (!b.empty())
        print("bounds      ({:.6g} {:.6g} {:.6g}) to ({:.6g} {:.6g} {:.6g})\n", b.lo.x, b.lo.y, b.lo.z,
              b.hi.x, b.hi.y, b.hi.z);
    print("materials   {}\n", text_of(tally(s.materials)));
    print("textures    {}; pictures {} in {} {}\n", s.textures.size(), bytes_text(m.images),
          world.assets().image_files(), world.assets().image_files() == 1 ? "file" : "files");
    print("lights      {}; {} to choose from in all\n", text_of(tally(s.lights)), c.lights);
    print("memory      {}: meshes {}, acceleration {}, images {}, lights {}\n", bytes_text(m.total()),
          bytes_text(m.meshes), bytes_text(m.bvh), bytes_text(m.images), bytes_text(m.lights));
    print("estimate    {} to render: {} to compile the scene, {} for the film{}\n", bytes_text(need.total()),
          bytes_text(need.world), bytes_text(need.film),
          need.photons > 0 ? fmt::format(", {} for photons", bytes_text(need.photons)) : std::string());
    print("scene hash  {}\n", world.scene_hash());
    if (s.notes.empty()) {
        print("notes       none: everything is rendered as written\n");
    } else {
        print("notes       {}:\n", s.notes.size());
        for (Note const& n : s.notes) print("  {}: {}\n", s.locate(n.where), n.text);
    }
    return kGood;
}

}  // namespace nephroid::cli
