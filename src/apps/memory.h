// How much memory there is, and how much a render is going to need: said before it begins, rather than by the system when
// it ends the program.
#pragma once

#include "film/film.h"
#include "scene/scene.h"
#include "transport/render_pass.h"

#include <cstdint>
#include <optional>
#include <string>

namespace nephroid::cli {

struct MemoryNeed {
    std::uint64_t program = 0;  // what is in use now, the scene as read included
    std::uint64_t world = 0;    // what compiling adds
    std::uint64_t film = 0;     // the sums, and what it takes to render and to write them
    std::uint64_t photons = 0;  // maps of a pass, made while those of the pass before are still there
    [[nodiscard]] std::uint64_t total() const;  // saturated
};
/// All but the photons.
MemoryNeed memory_need(Scene const& scene, std::array<int, 4> crop, bool aovs);
/// What photons may take, by how many paths are shot in a pass, as a first guess: how many photons a path leaves is not known yet.
/// 0 for integrators that shoot none.
std::uint64_t photon_need(Settings const& settings);

/// The same once the scene is compiled, when photons can be shot to see how many a path leaves. Throws Error(Limit) where a map would
/// not hold them.
MemoryNeed refined(MemoryNeed need, RenderJob const& job);

/// "8G", "500M", "2GiB", "1000000" bytes. Throws Error(Input).
std::uint64_t parse_bytes(std::string const& option, std::string const& text);
/// What this process can have beyond what it has: the least of what the machine, its control group and `ulimit -v` leave.
std::uint64_t available_memory();
/// Throws Error(Limit) that says what needs how much, what there is, and what to do.
void check_memory(MemoryNeed const& need, std::optional<std::uint64_t> limit);

}  // namespace nephroid::cli
