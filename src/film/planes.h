// The sums as 64-bit words, in a fixed order and with names: what a film file stores, and what its checksum covers.
#pragma once

#include "film/film.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace nephroid {

inline constexpr std::array kPixelWords{
    "rgb.R",    "rgb.G",   "rgb.B",   "weight",  "square.R",      "square.G",
    "square.B", "cross.R", "cross.G", "cross.B", "weight_square", "samples",
};
inline constexpr std::array kAovWords{
    "albedo.R",   "albedo.G",   "albedo.B",   "Ns.X",       "Ns.Y",       "Ns.Z",
    "N.X",        "N.Y",        "N.Z",        "P.X",        "P.Y",        "P.Z",
    "Z",          "hits",       "direct.R",   "direct.G",   "direct.B",   "caustic.R",
    "caustic.G",  "caustic.B",  "indirect.R", "indirect.G", "indirect.B", "specular.R",
    "specular.G", "specular.B", "radius",     "photons",    "estimates",  "material.pass",
};  // and material.id, 32 bits

// The structs have no padding before their words end, so that word k lies at 8 k bytes.
static_assert(sizeof(PixelSums) == 8 * kPixelWords.size());
static_assert(offsetof(PixelSums, samples) == 8 * (kPixelWords.size() - 1));
static_assert(offsetof(AovSums, material) == 8 * kAovWords.size() &&
              sizeof(AovSums) == 8 * kAovWords.size() + 8);

template <class Sums>
std::uint64_t get_word(Sums const& sums, std::size_t k) {
    std::uint64_t w = 0;
    std::memcpy(&w, reinterpret_cast<unsigned char const*>(&sums) + 8 * k, 8);
    return w;
}
template <class Sums>
void set_word(Sums& sums, std::size_t k, std::uint64_t w) {
    std::memcpy(reinterpret_cast<unsigned char*>(&sums) + 8 * k, &w, 8);
}

/// Order-dependent; each step is a bijection of the state and of the word, so that one changed word always shows, and
/// several do but for a chance of 2^-64.
class Checksum {
  public:
    void word(std::uint64_t w) {
        state_ = std::rotl((state_ ^ w) * 0x9e3779b97f4a7c15u, 29) * 0xbf58476d1ce4e5b9u + 1;
    }
    void text(std::string const& text) {
        word(text.size());
        for (char const c : text) word(static_cast<unsigned char>(c));
    }
    [[nodiscard]] std::uint64_t value() const { return state_ ^ (state_ >> 31); }

  private:
    std::uint64_t state_ = 0x6e657068726f6964u;
};

}  // namespace nephroid
