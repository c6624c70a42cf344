#include "read/read.h"

#include "bytes.h"
#include "mesh_file.h"
#include "mesh_scene.h"
#include "pbrt_reader.h"
#include "ray_reader.h"

namespace nephroid {

Scene read_scene(std::filesystem::path const& path) {
    auto const extension = inner_extension(path);
    if (extension != ".pbrt" && extension != ".ray" && !is_mesh_file(path))
        throw Error(ErrorKind::Input,
                    path.string() + ": unknown kind of scene; .pbrt, .ray, .ply and .obj are read");
    if (is_mesh_file(path)) return mesh_scene(path);
    auto const file = read_bytes(path);
    if (!file.problem.empty())
        throw Error(file.too_long ? ErrorKind::Limit : ErrorKind::Io, path.string() + ": " + file.problem);
    if (extension == ".ray") return RayReader(file.bytes, path.string(), path.parent_path()).read();
    return PbrtReader().read(file.bytes, path.string(), path.parent_path(), path);
}

Scene read_pbrt_string(std::string_view text, std::string name, std::filesystem::path folder) {
    return PbrtReader().read(text, std::move(name), folder, {});
}

}  // namespace nephroid
