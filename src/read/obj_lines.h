// The lines of an OBJ file that make a mesh, checked: the loader behind them trusts its input.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

/// One corner of a face: indices of its position, texture coordinates and normal, 1-based as in the file; 0 = not given.
using ObjCorner = std::array<std::uint32_t, 3>;

struct ObjLines {
    std::vector<Vec3> p;
    std::vector<Vec2> uv;
    std::vector<Vec3> n;
    std::vector<ObjCorner> corners;
    std::vector<std::uint32_t> face_sizes;  // at least 3 each; their corners follow one another
    std::size_t small_faces = 0;            // of fewer than three corners, left out
    bool has_materials = false;
};

/// Throws Error(Input) as name:line for numbers that are none, indices out of range, NUL bytes and UTF-16. Statements
/// that make no mesh are passed over. A material library is not opened, but one that is no regular file is refused.
ObjLines parse_obj_lines(std::string_view text, std::string const& name, std::filesystem::path const& folder);

}  // namespace nephroid
