#pragma once
#include "model/shape.h"
namespace nephroid {
enum class EmittingSides : std::uint8_t { Front, Back, Both };
struct SeenSample { Vec3 p{0,0,0}, p_error{0,0,0}, n{0,0,1}; Vec2 uv{0,0}; float pdf = 0; };
struct NotSeen { bool sample(Vec2, SeenSample&) const { return false; } float pdf(Vec3) const { return 0; } };
template <class S> std::optional<NotSeen> seen(S const&, Vec3, EmittingSides) { return std::nullopt; }
template <class S> std::optional<Vec2> invert_area(S const&, std::uint32_t, Vec3, Vec2 uv) { return uv; }
}
