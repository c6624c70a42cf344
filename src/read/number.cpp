#include "number.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

namespace nephroid {

namespace {

/// Without its plus sign; empty when another sign follows it.
std::string_view strip_plus(std::string_view s) {
    if (s.empty() || s[0] != '+') return s;
    s.remove_prefix(1);
    return !s.empty() && (s[0] == '+' || s[0] == '-') ? std::string_view{} : s;
}

template <class T>
std::optional<T> parse_hex(std::string_view s) {
    bool const negative = s[0] == '-';
    if (negative) s.remove_prefix(1);
    std::uint64_t value = 0;
    auto const [end, status] = std::from_chars(s.data() + 2, s.data() + s.size(), value, 16);
    if (s.size() == 2 || status != std::errc{} || end != s.data() + s.size()) return std::nullopt;
    return negative ? -static_cast<T>(value) : static_cast<T>(value);
}

bool looks_hex(std::string_view s) {
    if (!s.empty() && s[0] == '-') s.remove_prefix(1);
    return s.size() > 2 && s[0] == '0' && (s[1] == 'x' || s[1] == 'X');
}

template <class T>
std::optional<T> parse_real(std::string_view s) {
    s = strip_plus(s);
    if (looks_hex(s)) return parse_hex<T>(s);
    T value = 0;
    auto const [end, status] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (end != s.data() + s.size() || s.empty()) return std::nullopt;
    if (status == std::errc::result_out_of_range) {
        // from_chars does not say on which side; strtod does. Rare, so the copy does not matter.
        double const wide = std::strtod(std::string(s).c_str(), nullptr);
        if (!(std::abs(wide) < 1)) return std::nullopt;
        return static_cast<T>(wide);
    }
    if (status != std::errc{} || !std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace

std::optional<double> parse_double(std::string_view s) { return parse_real<double>(s); }
std::optional<float> parse_float(std::string_view s) { return parse_real<float>(s); }

std::optional<std::int64_t> parse_int(std::string_view s) {
    s = strip_plus(s);
    std::int64_t value = 0;
    auto const [end, status] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (s.empty() || status != std::errc{} || end != s.data() + s.size()) return std::nullopt;
    return value;
}

}  // namespace nephroid
