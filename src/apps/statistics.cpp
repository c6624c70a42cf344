#include "statistics.h"

#include "photon_statistics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nephroid::cli {

std::string bytes_text(std::size_t bytes) {
    auto const b = static_cast<double>(bytes);
    if (b < 1024) return fmt::format("{} B", bytes);
    if (b < 1024.0 * 1024) return fmt::format("{:.1f} KiB", b / 1024);
    if (b < 1024.0 * 1024 * 1024) return fmt::format("{:.1f} MiB", b / (1024.0 * 1024));
    return fmt::format("{:.2f} GiB", b / (1024.0 * 1024 * 1024));
}

std::string json_text(nlohmann::json const& json, int indentation) {
    return json.dump(indentation, ' ', false, nlohmann::json::error_handler_t::replace);
}

double rate(std::uint64_t n, double seconds) { return seconds > 0 ? static_cast<double>(n) / seconds : 0; }

namespace {
constexpr char const* kKinds[3] = {"camera", "bounce", "shadow"};
}  // namespace

std::string table(RunStatistics const& s) {
    std::string t;
    t +=
        fmt::format("time    read {:.2f} s, compile {:.2f} s, render {:.2f} s, write {:.2f} s ({} threads)\n",
                    s.read_seconds, s.compile_seconds, s.render_seconds, s.write_seconds, s.threads);
    t += "rays   ";
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        all += s.rays.rays[i];
        t += fmt::format(" {} {:.2f} M ({:.2f} M/s){}", kKinds[i], static_cast<double>(s.rays.rays[i]) / 1e6,
                         rate(s.rays.rays[i], s.render_seconds) / 1e6, i < 2 ? "," : "\n");
    }
    t += fmt::format("        {:.2f} M/s in all, {:.1f} a sample, {:.2f} M samples/s\n",
                     rate(all, s.render_seconds) / 1e6,
                     s.samples ? static_cast<double>(all) / static_cast<double>(s.samples) : 0.0,
                     rate(s.samples, s.render_seconds) / 1e6);
    t += fmt::format(
        "memory  meshes {}, acceleration {}, images {} in {} files, spectra {}, lights {}, instances {}, "
        "film {}\n",
        bytes_text(s.memory.meshes), bytes_text(s.memory.bvh), bytes_text(s.memory.images), s.image_files,
        bytes_text(s.memory.spectra), bytes_text(s.memory.lights), bytes_text(s.memory.instances),
        bytes_text(s.film_bytes));
    t += photon_table(s);
    if (s.dropped > 0)
        t += fmt::format("DROPPED {} samples that were not finite: the picture is tainted\n", s.dropped);
    if (s.rejected > 0)
        t += fmt::format("REFUSED {} rays that were not finite: the picture is tainted\n", s.rejected);
    return t;
}

nlohmann::json to_json(RunStatistics const& s) {
    nlohmann::json j;
    j["seconds"] = {{"read", s.read_seconds},
                    {"compile", s.compile_seconds},
                    {"render", s.render_seconds},
                    {"write", s.write_seconds}};
    for (std::size_t i = 0; i < 3; ++i)
        j["rays"][kKinds[i]] = {{"count", s.rays.rays[i]},
                                {"per_second", rate(s.rays.rays[i], s.render_seconds)}};
    j["rays"]["rejected"] = s.rays.rejected;
    j["bytes"] = {{"meshes", s.memory.meshes}, {"acceleration", s.memory.bvh},
                  {"images", s.memory.images}, {"spectra", s.memory.spectra},
                  {"lights", s.memory.lights}, {"instances", s.memory.instances},
                  {"film", s.film_bytes}};
    j["world"] = {{"objects", s.counts.objects},   {"triangles", s.counts.triangles},
                  {"analytic", s.counts.analytic}, {"instances", s.counts.instances},
                  {"lights", s.counts.lights},     {"image_files", s.image_files}};
    if (shot_photons(s)) j["photons"] = photons_to_json(s);
    j["threads"] = s.threads;
    j["passes"] = s.passes;
    j["samples"] = s.samples;
    j["dropped"] = s.dropped;
    j["rejected"] = s.rejected;
    return j;
}

}  // namespace nephroid::cli
