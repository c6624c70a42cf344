// A 128-bit digest of a stream of bytes: MurmurHash3 x64 128 (Austin Appleby, public domain), fed piece by piece.
// It tells scenes apart; it does not resist somebody who looks for collisions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace nephroid {

class Digest {
  public:
    void bytes(void const* data, std::size_t size);
    void word(std::uint64_t w) { bytes(&w, sizeof w); }
    /// The 128 bits, which other digests may be made of.
    [[nodiscard]] std::array<std::uint64_t, 2> words() const;
    /// The same as 32 hexadecimal digits.
    [[nodiscard]] std::string hex() const;

  private:
    void block(unsigned char const* p);

    std::uint64_t h1_ = 0, h2_ = 0, size_ = 0;
    std::array<unsigned char, 16> rest_{};  // the size_ % 16 bytes that do not fill a block yet
};

}  // namespace nephroid
