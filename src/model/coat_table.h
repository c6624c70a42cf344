// Looks up what tools/coat_table.cpp computed (coat_format.h). Between nodes all is linear, beyond them the last node holds.
#pragma once

#include "coat_format.h"

namespace nephroid {

/// The indices that the table covers.
inline bool coat_table_covers(float eta) { return eta >= CoatTable::kEtaLo && eta <= CoatTable::kEtaHi; }
/// Mean ways through a layer of optical depth `depth` under a rough boundary.
float coat_way_down(float eta, float alpha, float mu, float depth);
float coat_way_back(float eta, float alpha, float depth);
float coat_way_out(float eta, float alpha, float depth);

/// The lobes of a coat over a perfect mirror, for light from mu.
CoatTable::Lobes coat_lobes(float eta, float coat, float base, float mu);

}  // namespace nephroid
