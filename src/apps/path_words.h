// A replayed path in words: a table to read.
#pragma once

#include "transport/replay.h"

#include <cstddef>
#include <string>

namespace nephroid::cli {

/// Vertex `index` of a record as it is called: x1, x2, … (x0 is the camera).
std::string vertex_label(std::size_t index);
/// "0.12 0.5 0.031": three digits each.
std::string numbers_text(Vec3 v);
/// Throughput in the lanes that count: r g b, or at the path's four wavelengths (only the hero, where the others have ended).
std::string beta_text(Spectrum beta, Wavelengths const& lambda);
/// "specular transmission"
std::string kind_text(Scattering const& s);
std::string end_text(PathEnd end);
std::string class_text(LightClass c);
/// "sphere, box.pbrt:12; dielectric \"glass\", box.pbrt:9"
std::string surface_text(Scene const& scene, PathVertex const& v);

/// Lines; lights are under the vertex that asked for them. Colours are linear sRGB as the film's sensor has them.
std::string path_table(RenderJob const& job, PathRecord const& record);

}  // namespace nephroid::cli
