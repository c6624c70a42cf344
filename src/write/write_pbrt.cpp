#include "write/write.h"

namespace nephroid {

std::vector<Note> write_pbrt(Scene const& /*scene*/, std::filesystem::path const& /*path*/,
                             WriteOptions const& /*options*/) {
    return {};
}

}  // namespace nephroid
