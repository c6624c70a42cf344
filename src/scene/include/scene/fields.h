// The fields of plain structs, without naming them: what hash() and validate() walk over, so that a field added to a
// struct later is hashed and checked by itself.
//
// How the number of fields is known: T{{}, {}, {}} compiles just as long as there are no more braces than fields, because
// every field of a scene can be made from {}. The structured binding that follows has to have exactly as many names as
// there are fields, so a wrong count would be an error of the compiler, never a field left out.
#pragma once

#include "math/transform.h"
#include "math/vec.h"
#include "scene/id.h"

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace nephroid {

namespace detail {
template <class T>
inline constexpr bool is_vector = false;
template <class T, class A>
inline constexpr bool is_vector<std::vector<T, A>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_variant = false;
template <class... T>
inline constexpr bool is_variant<std::variant<T...>> = true;
template <class T>
inline constexpr bool is_glm = false;
template <int N, class T, glm::qualifier Q>
inline constexpr bool is_glm<glm::vec<N, T, Q>> = true;
template <class T>
inline constexpr bool is_id = false;
template <class Tag>
inline constexpr bool is_id<Id<Tag>> = true;
}  // namespace detail

template <class T>
concept VectorType = detail::is_vector<T>;
template <class T>
concept ArrayType = detail::is_array<T>;
template <class T>
concept OptionalType = detail::is_optional<T>;
template <class T>
concept VariantType = detail::is_variant<T>;
template <class T>
concept GlmType = detail::is_glm<T>;
template <class T>
concept IdType = detail::is_id<T>;
template <class T>
concept ScalarType = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// A struct of public fields and nothing else to take it apart by.
template <class T>
concept PlainStruct = std::is_class_v<T> && std::is_aggregate_v<T> && !ArrayType<T>;

/// f(field) for each field of t, in the order of their declaration.
template <PlainStruct T, class F>
constexpr void for_each_field(T const& t, F&& f) {
    // clang-format off
    static_assert(!requires { T{{},{},{},{},{},{},{},{},{},{},{},{},{}}; }, "more than 12 fields: add a line below");
    if constexpr (requires { T{{},{},{},{},{},{},{},{},{},{},{},{}}; }) { auto const& [a,b,c,d,e,g,h,i,j,k,l,m] = t; f(a),f(b),f(c),f(d),f(e),f(g),f(h),f(i),f(j),f(k),f(l),f(m); }
    else if constexpr (requires { T{{},{},{},{},{},{},{},{},{},{},{}}; }) { auto const& [a,b,c,d,e,g,h,i,j,k,l] = t; f(a),f(b),f(c),f(d),f(e),f(g),f(h),f(i),f(j),f(k),f(l); }
    else if constexpr (requires { T{{},{},{},{},{},{},{},{},{},{}}; }) { auto const& [a,b,c,d,e,g,h,i,j,k] = t; f(a),f(b),f(c),f(d),f(e),f(g),f(h),f(i),f(j),f(k); }
    else if constexpr (requires { T{{},{},{},{},{},{},{},{},{}}; }) { auto const& [a,b,c,d,e,g,h,i,j] = t; f(a),f(b),f(c),f(d),f(e),f(g),f(h),f(i),f(j); }
    else if constexpr (requires { T{{},{},{},{},{},{},{},{}}; }) { auto const& [a,b,c,d,e,g,h,i] = t; f(a),f(b),f(c),f(d),f(e),f(g),f(h),f(i); }
    else if constexpr (requires { T{{},{},{},{},{},{},{}}; }) { auto const& [a,b,c,d,e,g,h] = t; f(a),f(b),f(c),f(d),f(e),f(g),f(h); }
    else if constexpr (requires { T{{},{},{},{},{},{}}; }) { auto const& [a,b,c,d,e,g] = t; f(a),f(b),f(c),f(d),f(e),f(g); }
    else if constexpr (requires { T{{},{},{},{},{}}; }) { auto const& [a,b,c,d,e] = t; f(a),f(b),f(c),f(d),f(e); }
    else if constexpr (requires { T{{},{},{},{}}; }) { auto const& [a,b,c,d] = t; f(a),f(b),f(c),f(d); }
    else if constexpr (requires { T{{},{},{}}; }) { auto const& [a,b,c] = t; f(a),f(b),f(c); }
    else if constexpr (requires { T{{},{}}; }) { auto const& [a,b] = t; f(a),f(b); }
    else if constexpr (requires { T{{}}; }) { auto const& [a] = t; f(a); }
    else static_assert(std::is_empty_v<T>, "a field that cannot be made from {}");
    // clang-format on
}

/// f(leaf) for every number, enumerator, id and string anywhere inside x.
template <class T, class F>
constexpr void for_each_leaf(T const& x, F&& f) {
    if constexpr (ScalarType<T> || IdType<T> || std::same_as<T, std::string>) {
        f(x);
    } else if constexpr (GlmType<T>) {
        for (int i = 0; i < T::length(); ++i) f(x[i]);
    } else if constexpr (VectorType<T> || ArrayType<T>) {
        for (auto const& element : x) for_each_leaf(element, f);
    } else if constexpr (OptionalType<T>) {
        if (x) for_each_leaf(*x, f);
    } else if constexpr (VariantType<T>) {
        std::visit([&f](auto const& alternative) { for_each_leaf(alternative, f); }, x);
    } else {
        for_each_field(x, [&f](auto const& field) { for_each_leaf(field, f); });
    }
}

}  // namespace nephroid
