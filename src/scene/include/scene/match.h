// Closed families: an operation on a std::variant is a set of overloads, called through match(variant, overloads…).
//
// By a switch, which compilers turn into a jump with the alternatives inlined: libstdc++'s visit does that for up to eleven
// alternatives only, and calls through a table of functions beyond.
#pragma once

#include <utility>
#include <variant>

namespace nephroid {

template <class... F>
struct Overloads : F... {
    using F::operator()...;
};
template <class... F>
Overloads(F...) -> Overloads<F...>;

/// Always inline: what the overloads capture then stays in registers on its way to the functions they call.
template <class Variant, class... F>
[[gnu::always_inline]] inline decltype(auto) match(Variant&& v, F&&... f) {
    constexpr std::size_t kCount = std::variant_size_v<std::remove_cvref_t<Variant>>;
    constexpr std::size_t kMost = 20;
    static_assert(kCount <= kMost, "add a line of cases below");
    Overloads const overloads{std::forward<F>(f)...};
#define NEPHROID_CASE(I) \
    case (I):            \
        if constexpr ((I) < kCount) return overloads(*std::get_if<(I)>(&v));
#define NEPHROID_FIVE_CASES(I) \
    NEPHROID_CASE(I)           \
    NEPHROID_CASE((I) + 1) NEPHROID_CASE((I) + 2) NEPHROID_CASE((I) + 3) NEPHROID_CASE((I) + 4)
    switch (v.index()) {
        NEPHROID_FIVE_CASES(0)
        NEPHROID_FIVE_CASES(5)
        NEPHROID_FIVE_CASES(10)
        NEPHROID_FIVE_CASES(15)
        default:
            __builtin_unreachable();  // a variant of plain structs is never without a value
    }
#undef NEPHROID_FIVE_CASES
#undef NEPHROID_CASE
}

}  // namespace nephroid
