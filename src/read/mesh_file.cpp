#include "mesh_file.h"

#include "shown.h"

#include <algorithm>
#include <cctype>

namespace nephroid {

std::string inner_extension(std::filesystem::path const& path) {
    auto const lower = [](std::string s) {
        std::transform(s.begin(), s.end(), s.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        return s;
    };
    auto const last = lower(path.extension().string());
    return last == ".gz" ? lower(path.stem().extension().string()) : last;
}

bool is_mesh_file(std::filesystem::path const& path) {
    auto const extension = inner_extension(path);
    return extension == ".ply" || extension == ".obj";
}

MeshFile read_mesh(Context& context, SourceLocation where, std::filesystem::path const& path) {
    auto const bytes = context.read_named(where, "mesh file", path);
    auto const name = shown(path.string(), 1000);
    auto const extension = inner_extension(path);
    if (extension == ".obj") return parse_obj(bytes, name, path.parent_path());
    // A name that says nothing: PLY can be told by its first word.
    if (extension != ".ply" && !bytes.starts_with("ply\n") && !bytes.starts_with("ply\r"))
        context.fail(where,
                     "mesh file \"" + name +
                         "\" is neither called .ply or .obj, nor does it begin with \"ply\"; rename it");
    return parse_ply(bytes, name);
}

}  // namespace nephroid
