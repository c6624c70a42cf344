// Ids instead of pointers: an index into the list of its kind in Scene. The default is "none".
#pragma once

#include <cstdint>
#include <string>

namespace nephroid {

template <class Tag>
struct Id {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::uint32_t value = kNone;

    [[nodiscard]] bool valid() const { return value != kNone; }
    bool operator==(Id const&) const = default;
};

using TextureId = Id<struct TextureTag>;
using MaterialId = Id<struct MaterialTag>;
using ImageId = Id<struct ImageTag>;
using GroupId = Id<struct GroupTag>;
using ObjectId = Id<struct ObjectTag>;
using LightId = Id<struct LightTag>;
using MediumId = Id<struct MediumTag>;

/// Where something was said: an index into Scene::files and a line (1-based; 0 = the whole file).
struct SourceLocation {
    std::uint32_t file = 0xFFFFFFFFu;
    std::uint32_t line = 0;
};

}  // namespace nephroid
