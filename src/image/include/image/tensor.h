// Files of named arrays of numbers, as measured materials come in: EPFL's "tensor file", version 1.0. Little-endian:
//   "tensor_file\0"   version 1, 0   u32 number of fields
//   per field: u16 length, name; u16 rank; u8 type; u64 offset of its numbers in the file; u64 extent x rank, slowest first
// The file is kept as it is read, and a field is looked at when it is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

class TensorFile {
  public:
    enum class Type : std::uint8_t {
        UInt8 = 1,
        Float32 = 10,
        Last = 11
    };  // those that are asked for, and the last there is
    struct Field {
        std::string name;
        Type type = Type::UInt8;
        std::vector<std::size_t> shape;  // slowest first
        std::size_t offset = 0, count = 0;
    };

    /// Throws Error(Io) if it cannot be read, Error(Input) "path: what, and what to do" if it is no such file, is cut off, or names
    /// two fields alike.
    explicit TensorFile(std::filesystem::path const& path);

    [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
    /// Throws Error(Input) where there is no such field, or it is not of that type and rank.
    [[nodiscard]] Field const& field(std::string_view name, Type type, std::size_t rank) const;
    /// The numbers of a Float32 field, each of them finite: Error(Input) else.
    [[nodiscard]] std::vector<float> floats(Field const& field) const;
    [[nodiscard]] std::uint8_t byte(Field const& field, std::size_t i) const {
        return static_cast<std::uint8_t>(bytes_[field.offset + i]);
    }
    /// Throws Error(Input) "path: what".
    [[noreturn]] void fail(std::string const& what) const;

  private:
    [[nodiscard]] Field const* find(std::string_view name) const;

    std::string path_;
    std::vector<std::byte> bytes_;
    std::vector<Field> fields_;
};

}  // namespace nephroid
