// What became of the photons of a run: per map, per light, and per way in which a path can end.
#pragma once

#include "statistics.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace nephroid::cli {

/// Of all lights.
PhotonCounts total_of(std::vector<PhotonCounts> const& by_source);
/// The integrator shoots photons into maps.
bool shot_photons(RunStatistics const& s);
/// Some lines for people; empty where none were shot.
std::string photon_table(RunStatistics const& s);
nlohmann::json photons_to_json(RunStatistics const& s);

}  // namespace nephroid::cli
