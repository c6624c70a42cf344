// What a run did: rays, memory, time. A short table for people, JSON for programs.
#pragma once

#include "render/render.h"
#include "world/world.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace nephroid::cli {

struct RunStatistics {
    double read_seconds = 0, compile_seconds = 0, render_seconds = 0, write_seconds = 0;
    RayStats rays;
    WorldMemory memory;
    WorldCounts counts;
    std::size_t image_files = 0;
    std::size_t film_bytes = 0;
    std::uint64_t passes = 0, samples = 0;
    std::uint64_t dropped = 0, rejected = 0;  // of the whole film
    int threads = 0;
    PhotonReport photons;                     // of integrators that shoot them
    std::vector<std::string> photon_sources;  // names of World::light_sources(), as far as they are known
};

std::string table(RunStatistics const& s);
nlohmann::json to_json(RunStatistics const& s);
/// Names of files are bytes, and JSON is UTF-8: what is not is replaced. Indentation as nlohmann::json::dump has it.
std::string json_text(nlohmann::json const& json, int indentation = -1);
std::string bytes_text(std::size_t bytes);
/// Per second; 0 where no time went by.
double rate(std::uint64_t n, double seconds);

}  // namespace nephroid::cli
