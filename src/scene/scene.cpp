#include "scene/scene.h"

namespace nephroid {

ImageId Scene::add(ImageFile const& image) {
    auto& id = image_ids[{image.path, image.encoding}];
    // The list may have been shortened since, and others put in the place.
    bool const known = id.value < images.size() && images[id.value].path == image.path &&
                       images[id.value].encoding == image.encoding;
    if (known) return id;
    images.push_back(image);
    return id = ImageId{last(images)};
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
