// `nephroid render --replay pass,x,y`: one sample's path printed, drawn, and laid over the pictures of the render.
#pragma once

#include "commands.h"
#include "targets.h"
#include "transport/replay.h"

#include <optional>
#include <string>
#include <vector>

namespace nephroid::cli {

/// What --replay asks for besides a render. The outputs of the two are told apart by their names.
struct ReplayRequest {
    std::uint64_t pass = 0;
    Vec2i pixel{0, 0};
    std::vector<std::string> files;     // .svg, .json: of the path
    std::vector<std::string> pictures;  // the others; without any nothing is rendered
};

/// Nothing where --replay was not given. Throws Error(Input) for what cannot be meant, Error(Io) for files that cannot be written.
std::optional<ReplayRequest> replay_request(RenderOptions const& o);
/// Throws Error(Input) for pixels and integrators that cannot be replayed.
void check_replay(ReplayRequest const& request, Settings const& settings);
/// The path: its table on stdout, its files written.
PathRecord run_replay(ReplayRequest const& request, RenderJob const& job);

}  // namespace nephroid::cli
