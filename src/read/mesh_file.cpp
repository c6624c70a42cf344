#include "mesh_file.h"

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
    auto const extension = inner_extension(path);
    if (!is_mesh_file(path))
        context.fail(where, "mesh file \"" + path.string() + "\": only .ply and .obj are read");
    auto const bytes = context.read_named(where, "mesh file", path);
    if (extension == ".ply") return parse_ply(bytes, path.string());
    return parse_obj(bytes, path.string(), path.parent_path());
}

}  // namespace nephroid
