// The header of a PLY file: which elements follow, with which properties.
#pragma once

#include "math/error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };
inline std::size_t size_of(PlyType t) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(t)];
}
inline bool is_integer(PlyType t) { return t < PlyType::Float32; }

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    bool is_list = false;
    PlyType count_type = PlyType::Uint8;  // of a list
};
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::uint32_t line = 0;
};
enum class PlyFormat : std::uint8_t { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    std::size_t body = 0;         // offset of the first byte after the header
    std::uint32_t body_line = 1;  // its line
};

/// Throws Error(Input) as name:line. Element counts are checked against what the rest of the file can hold.
PlyHeader parse_ply_header(std::string_view bytes, std::string const& name);

}  // namespace nephroid
