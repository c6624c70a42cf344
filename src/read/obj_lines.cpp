#include "obj_lines.h"

#include "number.h"
#include "shown.h"

#include "math/error.h"

#include <algorithm>
#include <limits>
#include <system_error>

namespace nephroid {

namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

class LineParser {
  public:
    LineParser(std::string_view text, std::string const& name, std::filesystem::path const& folder)
        : text_(text), name_(name), folder_(folder) {}

    ObjLines parse() {
        if (text_.starts_with("\xfe\xff") || text_.starts_with("\xff\xfe"))
            fail("the file is UTF-16; save it as UTF-8");
        if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
        while (!text_.empty()) {
            take_line();
            statement();
        }
        check_forward_indices();
        return std::move(out_);
    }

  private:
    [[noreturn]] void fail(std::string const& message) const { fail_at(line_, message); }
    [[noreturn]] void fail_at(std::uint32_t line, std::string const& message) const {
        throw Error(ErrorKind::Input, name_ + ":" + std::to_string(line) + ": " + message);
    }

    /// One statement into rest_: a line, joined with those that follow while it ends in a backslash.
    void take_line() {
        line_ = next_line_;
        joined_.clear();
        while (true) {
            auto line = text_.substr(0, text_.find('\n'));
            text_.remove_prefix(std::min(line.size() + 1, text_.size()));
            ++next_line_;
            if (line.ends_with('\r')) line.remove_suffix(1);
            bool const continued = line.ends_with('\\') && !line.starts_with('#');
            if (continued) line.remove_suffix(1);
            if (!continued && joined_.empty()) {
                rest_ = line;
                break;
            }
            joined_.append(line);
            joined_.push_back(' ');
            if (!continued || text_.empty()) {
                rest_ = joined_;
                break;
            }
        }
        if (rest_.find('\0') != std::string_view::npos) fail("a NUL byte; OBJ files are text");
    }

    std::string_view word() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
        auto const w = rest_.substr(0, rest_.find_first_of(kBlanks));
        rest_.remove_prefix(w.size());
        return w;
    }

    float number(char const* of) {
        auto const w = word();
        auto const v = parse_float(w);
        if (!v) fail(std::string(of) + ": \"" + shown(w, 40) + "\" is not a finite number");
        return *v;
    }

    void statement() {
        auto const keyword = word();
        if (keyword == "v") {
            float const x = number("v"), y = number("v"), z = number("v");
            out_.p.emplace_back(x, y, z);
        } else if (keyword == "vn") {
            float const x = number("vn"), y = number("vn"), z = number("vn");
            out_.n.emplace_back(x, y, z);
        } else if (keyword == "vt") {
            // v may be left out.
            float const u = number("vt");
            auto const w = word();
            auto const v = w.empty() ? std::optional<float>(0.0f) : parse_float(w);
            if (!v) fail("vt: \"" + shown(w, 40) + "\" is not a finite number");
            out_.uv.emplace_back(u, *v);
        } else if (keyword == "f") {
            face();
        } else if (keyword == "usemtl") {
            out_.has_materials = true;
        } else if (keyword == "mtllib") {
            out_.has_materials = true;
            material_library();
        }
    }

    /// It would not be read anyway; but a file that names a device is not worth trusting.
    void material_library() {
        for (auto w = word(); !w.empty(); w = word()) {
            std::error_code error;
            auto const status = std::filesystem::status(folder_ / std::string(w), error);
            if (!error && std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
                fail("mtllib \"" + shown(w, 40) + "\" is not a regular file");
        }
    }

    void face() {
        auto const begin = out_.corners.size();
        for (auto w = word(); !w.empty() && !w.starts_with('#'); w = word())
            out_.corners.push_back(corner(w));
        auto const size = out_.corners.size() - begin;
        if (size < 3) {
            ++out_.small_faces;
            out_.corners.resize(begin);
            return;
        }
        out_.face_sizes.push_back(static_cast<std::uint32_t>(size));
    }

    /// p, p/t, p//n or p/t/n
    ObjCorner corner(std::string_view w) {
        ObjCorner c{0, 0, 0};
        std::array<std::size_t, 3> const counts{out_.p.size(), out_.uv.size(), out_.n.size()};
        std::string_view left = w;
        for (std::size_t k = 0; k < 3; ++k) {
            auto const slash = left.find('/');
            auto const part = left.substr(0, slash);
            if (!part.empty() || k == 0) c[k] = index(part, counts[k], k);
            if (slash == std::string_view::npos) return c;
            left.remove_prefix(slash + 1);
        }
        fail("f: \"" + shown(w, 40) + "\" has too many slashes");
    }

    std::uint32_t index(std::string_view text, std::size_t count, std::size_t kind) {
        auto const v = parse_int(text);
        if (!v || *v == 0) fail("f: \"" + shown(text, 40) + "\" is not an index; they count from 1");
        // Negative: from the last one so far.
        auto const absolute = *v > 0 ? *v : static_cast<std::int64_t>(count) + 1 + *v;
        if (absolute < 1 || absolute > std::numeric_limits<std::int32_t>::max())
            fail("f: index " + shown(text, 40) + " is out of range");
        auto const result = static_cast<std::uint32_t>(absolute);
        if (result > largest_[kind]) largest_[kind] = result, largest_line_[kind] = line_;
        return result;
    }

    /// Faces may name vertices that come later, so only now is it known.
    void check_forward_indices() const {
        std::array<std::size_t, 3> const counts{out_.p.size(), out_.uv.size(), out_.n.size()};
        constexpr std::array kNames{"v", "vt", "vn"};
        for (std::size_t k = 0; k < 3; ++k)
            if (largest_[k] > counts[k])
                fail_at(largest_line_[k], "f: index " + std::to_string(largest_[k]) +
                                              " is out of range; there are " + std::to_string(counts[k]) +
                                              " lines " + kNames[k]);
    }

    std::string_view text_;
    std::string const& name_;
    std::filesystem::path const& folder_;
    std::uint32_t line_ = 1, next_line_ = 1;
    std::string joined_;
    std::string_view rest_;
    std::array<std::uint32_t, 3> largest_{}, largest_line_{};
    ObjLines out_;
};

}  // namespace

ObjLines parse_obj_lines(std::string_view text, std::string const& name,
                         std::filesystem::path const& folder) {
    return LineParser(text, name, folder).parse();
}

}  // namespace nephroid
