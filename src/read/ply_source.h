// Where the values of a PLY body come from: text or binary. Both answer the same questions.
#pragma once

#include "number.h"
#include "ply_header.h"
#include "shown.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace nephroid {

/// Numbers as words between blanks; line ends are blanks too.
class AsciiSource {
  public:
    AsciiSource(std::string_view bytes, PlyHeader const& header, std::string const& name)
        : rest_(bytes.substr(header.body)), line_(header.body_line), name_(name) {}

    [[noreturn]] void fail(std::string const& message) const {
        throw Error(ErrorKind::Input, name_ + ":" + std::to_string(line_) + ": " + message);
    }
    void begin(PlyElement const& /*element*/, std::uint64_t /*index*/) {}

    double read(PlyType type) {
        auto const w = word();
        if (is_integer(type)) {
            auto const v = parse_int(w);
            if (!v) fail("\"" + shown(w, 40) + "\" is not an integer");
            return static_cast<double>(*v);
        }
        auto const v = parse_double(w);
        if (!v) fail("\"" + shown(w, 40) + "\" is not a finite number");
        return *v;
    }
    void skip(PlyType /*type*/, std::uint64_t count) {
        for (; count > 0; --count) word();
    }
    [[nodiscard]] std::uint64_t most_values(PlyType /*type*/) const { return rest_.size() / 2 + 1; }

  private:
    std::string_view word() {
        std::size_t i = 0;
        for (; i < rest_.size() && (rest_[i] == ' ' || (rest_[i] >= '\t' && rest_[i] <= '\r')); ++i)
            if (rest_[i] == '\n') ++line_;
        std::size_t const begin = i;
        while (i < rest_.size() && !(rest_[i] == ' ' || (rest_[i] >= '\t' && rest_[i] <= '\r'))) ++i;
        auto const w = rest_.substr(begin, i - begin);
        rest_.remove_prefix(i);
        if (w.empty()) fail("the file ends before its elements do");
        return w;
    }

    std::string_view rest_;
    std::uint32_t line_;
    std::string const& name_;
};

class BinarySource {
  public:
    BinarySource(std::string_view bytes, PlyHeader const& header, std::string const& name)
        : p_(bytes.data() + header.body),
          end_(bytes.data() + bytes.size()),
          swap_((header.format == PlyFormat::BigEndian) == (std::endian::native == std::endian::little)),
          name_(name) {}

    [[noreturn]] void fail(std::string const& message) const {
        std::string const at = element_ ? element_->name + " " + std::to_string(index_) + ": " : "";
        throw Error(ErrorKind::Input, name_ + ": " + at + message);
    }
    void begin(PlyElement const& element, std::uint64_t index) { element_ = &element, index_ = index; }

    double read(PlyType type) {
        switch (type) {
            case PlyType::Int8:
                return take<std::int8_t>();
            case PlyType::Uint8:
                return take<std::uint8_t>();
            case PlyType::Int16:
                return take<std::int16_t>();
            case PlyType::Uint16:
                return take<std::uint16_t>();
            case PlyType::Int32:
                return take<std::int32_t>();
            case PlyType::Uint32:
                return take<std::uint32_t>();
            case PlyType::Float32:
                return static_cast<double>(take<float>());
            case PlyType::Float64:
                return take<double>();
        }
        return 0;
    }
    void skip(PlyType type, std::uint64_t count) {
        if (count > most_values(type)) fail("the file ends before its elements do");
        p_ += count * size_of(type);
    }
    [[nodiscard]] std::uint64_t most_values(PlyType type) const {
        return static_cast<std::uint64_t>(end_ - p_) / size_of(type);
    }

  private:
    template <class T>
    T take() {
        if (static_cast<std::size_t>(end_ - p_) < sizeof(T)) fail("the file ends before its elements do");
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), p_, sizeof(T));
        p_ += sizeof(T);
        if (swap_) std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }

    char const* p_;
    char const* end_;
    bool swap_;
    std::string const& name_;
    PlyElement const* element_ = nullptr;
    std::uint64_t index_ = 0;
};

}  // namespace nephroid
