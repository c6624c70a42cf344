// Text from files as messages show it: short, and without bytes that would act on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nephroid {

/// `text` with control characters as \n, \t or \xNN; what is longer than `most` bytes ends in an ellipsis.
std::string shown(std::string_view text, std::size_t most = 80);

}  // namespace nephroid
