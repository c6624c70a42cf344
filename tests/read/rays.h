// Shorthand of the tests of .ray files.
#pragma once

#include "helpers.h"

namespace nephroid::test {

/// The text is what follows the header, which is line 1: it begins on line 2.
inline Scene read_ray_bytes(std::string const& bytes) {
    Folder const folder;
    return read_scene(folder.write("t.ray", bytes));
}
inline Scene read_ray(std::string const& text) { return read_ray_bytes("SBT-raytracer 1.1\n" + text); }

/// From the file's name on.
inline std::string error_in_ray_bytes(std::string const& bytes) {
    auto const message = error_of([&] { read_ray_bytes(bytes); });
    auto const at = message.rfind("/t.ray");
    return at == std::string::npos ? message : message.substr(at + 1);
}
inline std::string error_in_ray(std::string const& text) {
    return error_in_ray_bytes("SBT-raytracer 1.1\n" + text);
}
/// What is read is also what validate() takes.
inline Scene valid_ray(std::string const& text) {
    Scene scene = read_ray(text);
    drop_degenerate(scene);
    validate(scene);
    return scene;
}

}  // namespace nephroid::test
