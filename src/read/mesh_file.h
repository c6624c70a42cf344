// Triangle meshes in files of their own: PLY and OBJ.
#pragma once

#include "context.h"

#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

struct MeshFile {
    TriangleMesh mesh;
    std::vector<std::string> notes;  // each begins with the file's name
};

/// By extension (with or without .gz), or by content where that says nothing; `where` names it.
MeshFile read_mesh(Context& context, SourceLocation where, std::filesystem::path const& path);
bool is_mesh_file(std::filesystem::path const& path);
/// The extension in lower case, looking through .gz.
std::string inner_extension(std::filesystem::path const& path);

/// Stanford PLY: ASCII, little or big endian. Faces are cut into fans of triangles.
MeshFile parse_ply(std::string_view bytes, std::string const& name);
/// Wavefront OBJ: positions, texture coordinates, normals and faces; everything else is passed over.
/// `folder` is where its material libraries would be: they are not read.
MeshFile parse_obj(std::string_view text, std::string const& name, std::filesystem::path const& folder);

}  // namespace nephroid
