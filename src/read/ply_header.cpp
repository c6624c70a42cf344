#include "ply_header.h"

#include "number.h"
#include "shown.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace nephroid {

namespace {

std::optional<PlyType> ply_type(std::string_view word) {
    using enum PlyType;
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames{{{"char", Int8},
                                                                           {"uchar", Uint8},
                                                                           {"short", Int16},
                                                                           {"ushort", Uint16},
                                                                           {"int", Int32},
                                                                           {"uint", Uint32},
                                                                           {"float", Float32},
                                                                           {"double", Float64},
                                                                           {"int8", Int8},
                                                                           {"uint8", Uint8},
                                                                           {"int16", Int16},
                                                                           {"uint16", Uint16},
                                                                           {"int32", Int32},
                                                                           {"uint32", Uint32},
                                                                           {"float32", Float32},
                                                                           {"float64", Float64}}};
    for (auto const& [name, type] : kNames)
        if (word == name) return type;
    return std::nullopt;
}

class HeaderParser {
  public:
    HeaderParser(std::string_view bytes, std::string const& name) : bytes_(bytes), name_(name) {}

    PlyHeader parse() {
        if (next_line() != "ply") fail("the file does not begin with \"ply\"");
        bool has_format = false;
        while (true) {
            rest_ = next_line();
            auto const keyword = word();
            if (keyword == "end_header") break;
            if (keyword == "format") {
                format();
                has_format = true;
            } else if (keyword == "element") {
                element();
            } else if (keyword == "property") {
                property();
            } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
                fail("unknown keyword \"" + quote(keyword) + "\" in the header");
            }
        }
        if (!has_format) fail("the header has no \"format\" line");
        header_.body = at_;
        header_.body_line = line_ + 1;
        for (auto const& e : header_.elements) check_count(e);
        return std::move(header_);
    }

  private:
    static std::string quote(std::string_view s) { return shown(s, 40); }
    [[noreturn]] void fail(std::string const& message) const { fail_at(line_, message); }
    [[noreturn]] void fail_at(std::uint32_t line, std::string const& message) const {
        throw Error(ErrorKind::Input, name_ + ":" + std::to_string(line) + ": " + message);
    }

    std::string_view next_line() {
        ++line_;
        auto const end = bytes_.find('\n', at_);
        if (end == std::string_view::npos) fail("the file ends before \"end_header\"");
        auto line = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }
    std::string_view word() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size()));
        auto const w = rest_.substr(0, rest_.find_first_of(" \t"));
        rest_.remove_prefix(w.size());
        return w;
    }

    void format() {
        constexpr std::array<std::string_view, 3> kFormats{"ascii", "binary_little_endian",
                                                           "binary_big_endian"};
        auto const name = word();
        auto const it = std::find(kFormats.begin(), kFormats.end(), name);
        if (it == kFormats.end())
            fail("format \"" + quote(name) + "\" is not ascii, binary_little_endian or binary_big_endian");
        if (word() != "1.0") fail("only version 1.0 of PLY is known");
        header_.format = static_cast<PlyFormat>(it - kFormats.begin());
    }

    void element() {
        PlyElement e;
        e.name = word();
        auto const text = word();
        auto const count = parse_int(text);
        if (e.name.empty() || !count || *count < 0)
            fail("an element needs a name and a count, not \"" + quote(text) + "\"");
        e.count = static_cast<std::uint64_t>(*count);
        e.line = line_;
        header_.elements.push_back(std::move(e));
    }

    PlyType type() {
        auto const name = word();
        auto const t = ply_type(name);
        if (!t) fail("unknown property type \"" + quote(name) + "\"");
        return *t;
    }

    void property() {
        if (header_.elements.empty()) fail("a property before any element");
        PlyProperty p;
        auto const before = rest_;
        if (word() == "list") {
            p.is_list = true;
            p.count_type = type();
            if (!is_integer(p.count_type)) fail("the length of a list must have an integer type");
        } else {
            rest_ = before;
        }
        p.type = type();
        p.name = word();
        if (p.name.empty()) fail("a property without a name");
        header_.elements.back().properties.push_back(std::move(p));
    }

    /// Every value takes at least one byte of text, and in binary its size: more elements than that are a lie, and must
    /// not be believed when memory is set aside.
    void check_count(PlyElement const& e) const {
        std::uint64_t least = 0;
        for (auto const& p : e.properties)
            least += header_.format == PlyFormat::Ascii ? 2 : size_of(p.is_list ? p.count_type : p.type);
        // The last number of a text may end with the file.
        std::uint64_t const left = bytes_.size() - at_ + 1;
        if (least > 0 && e.count > left / least)
            fail_at(e.line, std::to_string(e.count) + " elements \"" + quote(e.name) +
                                "\" do not fit into the rest of the file");
        if (e.count > 0x7fffffffu && least > 0) fail_at(e.line, "more than 2^31 elements");
    }

    std::string_view bytes_;
    std::string const& name_;
    std::size_t at_ = 0;
    std::uint32_t line_ = 0;
    std::string_view rest_;
    PlyHeader header_;
};

}  // namespace

PlyHeader parse_ply_header(std::string_view bytes, std::string const& name) {
    return HeaderParser(bytes, name).parse();
}

}  // namespace nephroid
