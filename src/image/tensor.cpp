#include "image/tensor.h"

#include "codecs.h"
#include "image/file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace nephroid {

namespace {

using codec::Cursor;

std::uint64_t little_endian(codec::Bytes bytes) {
    std::uint64_t v = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) v = v << 8 | static_cast<std::uint64_t>(bytes[i]);
    return v;
}
std::uint64_t number(Cursor& in, std::size_t bytes) { return little_endian(in.take(bytes)); }

/// Bytes of one number of each type: nothing, u8, i8, u16, i16, u32, i32, u64, i64, f16, f32, f64.
constexpr std::size_t kBytes[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};

constexpr std::uint64_t kMostFields = 1000;  // measured materials have a dozen

}  // namespace

TensorFile::TensorFile(std::filesystem::path const& path) : path_(path.string()), bytes_(read_file(path)) {
    Cursor in(bytes_, path_);
    constexpr char kMagic[] = "tensor_file";  // with its 0
    if (bytes_.size() < sizeof(kMagic) || std::memcmp(bytes_.data(), kMagic, sizeof(kMagic)) != 0)
        fail("is no tensor file; name a .bsdf file of the RGL database");
    in.take(sizeof(kMagic));
    std::uint8_t const major = in.byte();
    std::uint8_t const minor = in.byte();
    if (major != 1 || minor != 0)
        fail("is a tensor file of version " + std::to_string(major) + "." + std::to_string(minor) +
             "; version 1.0 can be read");
    auto const n = number(in, 4);
    if (n > kMostFields)
        fail("says that it has " + std::to_string(n) + " fields; at most " + std::to_string(kMostFields) +
             " are read");
    for (std::uint64_t i = 0; i < n; ++i) {
        Field f;
        codec::Bytes const name = in.take(number(in, 2));
        f.name.assign(reinterpret_cast<char const*>(name.data()), name.size());
        std::size_t const rank = number(in, 2);
        std::uint8_t const type = in.byte();
        if (type == 0 || type > static_cast<std::uint8_t>(Type::Last))
            fail("the field \"" + f.name + "\" is of an unknown type; get a complete copy");
        f.type = static_cast<Type>(type);
        auto const offset = number(in, 8);
        // Never more than the file holds: a product that would be is found before it overflows.
        std::uint64_t const most = bytes_.size() / kBytes[type];
        std::uint64_t count = 1;
        for (std::size_t k = 0; k < rank; ++k) {
            auto const extent = number(in, 8);
            if (extent != 0 && count > most / extent)
                fail("the field \"" + f.name +
                     "\" says that it is larger than the file; get a complete copy");
            count *= extent;
            f.shape.push_back(extent);
        }
        if (offset > bytes_.size() || count * kBytes[type] > bytes_.size() - offset)
            fail("the field \"" + f.name + "\" reaches beyond the end of the file; get a complete copy");
        f.offset = offset;
        f.count = count;
        if (has(f.name)) fail("the field \"" + f.name + "\" is there twice; get a complete copy");
        fields_.push_back(std::move(f));
    }
}

TensorFile::Field const* TensorFile::find(std::string_view name) const {
    for (Field const& f : fields_)
        if (f.name == name) return &f;
    return nullptr;
}

TensorFile::Field const& TensorFile::field(std::string_view name, Type type, std::size_t rank) const {
    Field const* const f = find(name);
    std::string const quoted = "the field \"" + std::string(name) + "\"";
    if (!f) fail(quoted + " is missing; name a .bsdf file of the RGL database");
    if (f->type != type || f->shape.size() != rank)
        fail(quoted + " must be an array of " + std::to_string(rank) +
             (type == Type::Float32 ? " dimensions of 32-bit floats" : " dimensions of bytes"));
    return *f;
}

std::vector<float> TensorFile::floats(Field const& field) const {
    std::vector<float> r(field.count);
    if (r.empty()) return r;
    std::memcpy(r.data(), bytes_.data() + field.offset, r.size() * sizeof(float));
    if constexpr (std::endian::native == std::endian::big)
        for (float& x : r)
            x = std::bit_cast<float>(static_cast<std::uint32_t>(
                little_endian(codec::Bytes(reinterpret_cast<std::byte const*>(&x), sizeof(x)))));
    if (!std::all_of(r.begin(), r.end(), [](float x) { return std::isfinite(x); }))
        fail("the field \"" + field.name + "\" holds a value that is no number; get a complete copy");
    return r;
}

void TensorFile::fail(std::string const& what) const { codec::fail(path_, what); }

}  // namespace nephroid
