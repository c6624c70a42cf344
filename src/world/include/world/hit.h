// Where a ray met the world, and what counts rays.
#pragma once

#include "math/ray.h"
#include "model/surface.h"
#include "scene/id.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid {

inline constexpr std::uint32_t kNoInstance = 0xFFFFFFFFu;

/// What a surface does to light that goes straight on.
enum class Passage : std::uint8_t {
    Solid,
    Partly,    // a mix with an interface in it: chance decides
    Interface  // light passes as if nothing were there
};

/// What the intersector says of a nearest hit, before any geometry is looked at.
struct RawHit {
    float t = 0, u = 0, v = 0;
    Vec3 local{0, 0, 0};  // of an analytic shape: the point in its own space
    std::uint32_t geometry = 0, primitive = 0, instance = kNoInstance;
    bool found = false;
};

/// A surface point in world space and what it belongs to.
struct SurfaceHit {
    SurfacePoint s;
    float t = 0;                           // along the ray, in lengths of its direction
    Vec2 hit_uv{0, 0};                     // the intersector's own coordinates
    std::uint32_t record = 0;              // which object
    std::uint32_t part = 0;                // its triangle, face or patch
    std::uint32_t instance = kNoInstance;  // which appearance of its group
    MaterialId material;
    bool emits = false;
    Passage passage = Passage::Solid;

    /// A ray that leaves in direction w (math/ray.h).
    [[nodiscard]] Ray spawn(Vec3 w) const { return {offset_ray_origin(s.p, s.p_error, s.ng, w), w}; }
};

enum class RayKind : std::uint8_t { Camera, Bounce, Shadow };

struct RecordedRay {
    Ray ray;
    float t_max;
    RayKind kind;
    int lane = -1;  // in its packet, where it was traced in one
};

/// Counters of one worker; added up in the end, so that threads share nothing.
struct RayStats {
    std::array<std::uint64_t, 3> rays{};  // by RayKind
    std::uint64_t hits = 0;
    std::uint64_t rejected = 0;                    // rays that were not finite and were not traced
    std::vector<RecordedRay>* recorder = nullptr;  // for benchmarks: every ray, in order

    void add(RayStats const& b) {
        for (std::size_t i = 0; i < rays.size(); ++i) rays[i] += b.rays[i];
        hits += b.hits;
        rejected += b.rejected;
    }
};

}  // namespace nephroid
