// The files that a scene names, and those that are written beside it.
#include "writer.h"

#include "scene/digest.h"
#include "scene/file_path.h"

#include <algorithm>
#include <system_error>

namespace nephroid {

namespace fs = std::filesystem;

/// Relative to the scene's folder where the two lie in one tree, so that they may be moved together; else
/// absolute.
std::string Writer::file_name(std::string const& path) const {
    std::error_code error;
    fs::path const file = without_detours(fs::absolute(path, error));
    fs::path const folder = without_detours(fs::absolute(path_, error)).parent_path();
    auto const common = std::distance(
        folder.begin(), std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first);
    fs::path const relative = file.lexically_relative(folder);
    constexpr auto kOwnTree = 3;  // the root, and two folders: nobody moves those
    bool const below = !relative.empty() && *relative.begin() != "..";
    // A folder that is a link is not left by "..".
    bool const same = fs::weakly_canonical(folder / relative, error) == fs::weakly_canonical(file, error);
    return (below || common >= kOwnTree) && same ? relative.string() : file.string();
}

std::string Writer::picture(ImageId id, std::string const& encoding, SourceLocation where) const {
    ImageFile const& image = scene_[id];
    if (image.encoding != encoding)
        refuse(where, "a picture whose encoding is \"" + image.encoding + "\" where it can only be \"" +
                          encoding + "\"");
    return file_name(image.path);
}

std::string Writer::part(std::string const& kind, std::string const& extension, std::string bytes) {
    Digest d;
    d.bytes(bytes.data(), bytes.size());
    std::string const name =
        (path_.stem().string() + "_files/") + kind + '-' + d.hex().substr(0, 16) + extension;
    parts_.try_emplace(name, SceneText::File{path_.parent_path() / name, std::move(bytes)});
    return name;
}

std::string Writer::unique(std::set<std::string>& taken, std::string const& wanted) {
    std::string name = wanted;
    for (int i = 2; !taken.insert(name).second; ++i) name = wanted + ' ' + std::to_string(i);
    return name;
}

}  // namespace nephroid
