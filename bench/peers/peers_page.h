// The page that says what was measured.
#pragma once

#include "measure_peers.h"

#include <filesystem>

namespace nephroid::peers {

/// Writes folder/peers.md and folder/peers/*.
void write_peers_page(std::filesystem::path const& folder, std::vector<SceneResult> const& scenes,
                      std::vector<Renderer> const& renderers, Plan const& plan, int threads, bool quick);

}  // namespace nephroid::peers
