#include "scene/digest.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace nephroid {

static_assert(std::endian::native == std::endian::little, "digests are compared between machines");

namespace {

constexpr std::uint64_t kC1 = 0x87c37b91114253d5u;
constexpr std::uint64_t kC2 = 0x4cf5ad432745937fu;

std::uint64_t scramble1(std::uint64_t k) { return std::rotl(k * kC1, 31) * kC2; }
std::uint64_t scramble2(std::uint64_t k) { return std::rotl(k * kC2, 33) * kC1; }

std::uint64_t avalanche(std::uint64_t k) {
    k = (k ^ (k >> 33)) * 0xff51afd7ed558ccdu;
    k = (k ^ (k >> 33)) * 0xc4ceb9fe1a85ec53u;
    return k ^ (k >> 33);
}

}  // namespace

void Digest::block(unsigned char const* p) {
    std::uint64_t k1 = 0, k2 = 0;
    std::memcpy(&k1, p, 8);
    std::memcpy(&k2, p + 8, 8);
    h1_ ^= scramble1(k1);
    h1_ = (std::rotl(h1_, 27) + h2_) * 5 + 0x52dce729u;
    h2_ ^= scramble2(k2);
    h2_ = (std::rotl(h2_, 31) + h1_) * 5 + 0x38495ab5u;
}

void Digest::bytes(void const* data, std::size_t size) {
    if (size == 0) return;
    auto const* p = static_cast<unsigned char const*>(data);
    std::size_t const pending = size_ % 16;
    size_ += size;
    if (pending != 0) {
        std::size_t const n = std::min(size, 16 - pending);
        std::memcpy(rest_.data() + pending, p, n);
        p += n, size -= n;
        if (pending + n < 16) return;
        block(rest_.data());
    }
    for (; size >= 16; p += 16, size -= 16) block(p);
    std::memcpy(rest_.data(), p, size);
}

std::array<std::uint64_t, 2> Digest::words() const {
    std::array<unsigned char, 16> tail{};
    std::memcpy(tail.data(), rest_.data(), size_ % 16);
    std::uint64_t k1 = 0, k2 = 0;
    std::memcpy(&k1, tail.data(), 8);
    std::memcpy(&k2, tail.data() + 8, 8);
    std::uint64_t a = h1_ ^ scramble1(k1) ^ size_;
    std::uint64_t b = h2_ ^ scramble2(k2) ^ size_;
    a += b, b += a;
    a = avalanche(a), b = avalanche(b);
    a += b, b += a;
    return {a, b};
}

std::string Digest::hex() const {
    std::string text;
    for (std::uint64_t const h : words())
        for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[(h >> shift) & 15u];
    return text;
}

}  // namespace nephroid
