// A replayed path for programs.
#pragma once

#include "transport/replay.h"

#include <nlohmann/json.hpp>

namespace nephroid::cli {

/// All of the record: vertices by their labels (path_words.h), contributions in the path's lanes and as linear sRGB. Numbers that are
/// none become null.
nlohmann::json to_json(RenderJob const& job, PathRecord const& record);

}  // namespace nephroid::cli
