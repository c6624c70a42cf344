// Closed families: an operation on a std::variant is a set of overloads, called through match(variant, overloads…).
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

template <class Variant, class... F>
decltype(auto) match(Variant&& v, F&&... f) {
    return std::visit(Overloads{std::forward<F>(f)...}, std::forward<Variant>(v));
}

}  // namespace nephroid
