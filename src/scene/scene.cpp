#include "scene/scene.h"

#include <algorithm>

namespace nephroid {

ImageId Scene::add(ImageFile const& image) {
    // Linear search: scenes name hundreds of pictures, not millions, and a map beside the list would have to be kept in
    // step with a public member.
    auto const same = [&](ImageFile const& other) {
        return other.path == image.path && other.encoding == image.encoding;
    };
    auto const found = std::find_if(images.begin(), images.end(), same);
    if (found != images.end()) return ImageId{static_cast<std::uint32_t>(found - images.begin())};
    images.push_back(image);
    return ImageId{last(images)};
}

std::string Scene::locate(SourceLocation where) const {
    if (where.file >= files.size()) return "scene";
    if (where.line == 0) return files[where.file];
    return files[where.file] + ":" + std::to_string(where.line);
}

void Scene::fail(SourceLocation where, std::string const& message) const {
    throw Error(ErrorKind::Input, locate(where) + ": " + message);
}

}  // namespace nephroid
