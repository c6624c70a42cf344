// How many of a kind are done at once where many are: what AVX2, which every build asks for, holds of floats.
#pragma once

#include <cstddef>

namespace nephroid {

inline constexpr std::size_t kLanes = 8;

}  // namespace nephroid
