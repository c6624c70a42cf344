// A set of pass numbers (below 2^64 - 1), kept as sorted disjoint half-open intervals that do not touch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid {

struct PassRange {
    std::uint64_t begin = 0, end = 0;  // half-open
    bool operator==(PassRange const&) const = default;
};

class PassSet {
  public:
    PassSet() = default;
    explicit PassSet(PassRange r) { insert(r); }

    void insert(std::uint64_t i) { insert(PassRange{i, i + 1}); }
    void insert(PassRange r);
    void insert(PassSet const& other);
    [[nodiscard]] bool contains(std::uint64_t i) const;
    [[nodiscard]] bool intersects(PassSet const& other) const;
    [[nodiscard]] PassSet intersection(PassSet const& other) const;
    [[nodiscard]] bool empty() const { return ranges_.empty(); }
    [[nodiscard]] std::uint64_t count() const;
    [[nodiscard]] std::vector<PassRange> const& ranges() const { return ranges_; }
    /// The passes of `wanted` that are not in this set.
    [[nodiscard]] PassSet missing(PassRange wanted) const;
    /// "0:64,128:160"; "" when empty.
    [[nodiscard]] std::string text() const;
    /// The inverse of text(), in any order; throws Error(Input).
    static PassSet parse(std::string const& text);
    bool operator==(PassSet const&) const = default;

  private:
    std::vector<PassRange> ranges_;
};

}  // namespace nephroid
