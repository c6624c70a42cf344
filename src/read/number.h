// Numbers as scene files write them: locale-free and fast.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace nephroid {

/// Decimal or 0x hexadecimal, all of `s`; a leading + is allowed. Nothing for junk, NaN, Inf and what overflows; what
/// underflows is 0.
std::optional<double> parse_double(std::string_view s);
std::optional<float> parse_float(std::string_view s);
/// Decimal digits with an optional sign; nothing for anything else and for overflow.
std::optional<std::int64_t> parse_int(std::string_view s);

}  // namespace nephroid
