// A scene, compiled: immutable, shared by all threads. The only room that names Embree (in its .cpp files alone).
#pragma once

#include "math/bounds.h"
#include "model/assets.h"
#include "model/camera.h"
#include "model/light.h"
#include "scene/scene.h"
#include "world/hit.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid {

/// Memory by what holds it, bytes.
struct WorldMemory {
    std::size_t meshes = 0, bvh = 0, images = 0, spectra = 0, lights = 0, instances = 0;
    [[nodiscard]] std::size_t total() const { return meshes + bvh + images + spectra + lights + instances; }
};

struct WorldCounts {
    std::uint64_t objects = 0, triangles = 0, analytic = 0, instances = 0, lights = 0, infinite_lights = 0;
};

class RayCaster;  // Embree
struct RawHit;
class LightTable;  // all lights, and how one is chosen
struct LightEntry;
struct WorldParts;
struct TraceSums;  // world/floor.h

class World {
  public:
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    [[nodiscard]] Scene const& scene() const { return *scene_; }
    [[nodiscard]] Assets const& assets() const { return *assets_; }
    [[nodiscard]] Bounds3 const& bounds() const { return bounds_; }
    [[nodiscard]] WorldCounts const& counts() const { return counts_; }
    [[nodiscard]] WorldMemory memory() const;
    /// hash(scene) of what was compiled.
    [[nodiscard]] std::string const& scene_hash() const { return hash_; }

    // --- rays -----------------------------------------------------------------------------------------------------------
    /// Nearest hit with 0 < t <= t_max. The direction need not be a unit vector.
    bool intersect(Ray const& ray, float t_max, RayKind kind, RayStats& stats, SurfaceHit& hit) const;
    /// The share of light that gets from one surface point to the other (or to the light at infinity): 0 where something solid
    /// is between them, less than 1 behind mixes with interfaces. Both ends are moved off their surfaces by their error bounds.
    float transmittance(SurfaceHit const& from, LightSample const& to, RayStats& stats) const;

    // --- emission ---------------------------------------------------------------------------------------------------------
    /// Radiance that the surface itself emits towards w.
    Spectrum emitted(SurfaceHit const& hit, Vec3 w, Wavelengths const& lambda) const;
    /// Radiance of everything infinitely far away, as it arrives at p along w.
    Spectrum environment(Vec3 p, Vec3 w, Wavelengths const& lambda) const;
    /// … of one infinite light.
    Spectrum environment(LightId light, Vec3 p, Vec3 w, Wavelengths const& lambda) const;
    [[nodiscard]] std::vector<LightId> const& infinite_lights() const;

    /// Whether sample_light looks at u_choose at all.
    [[nodiscard]] bool chooses_lights() const;
    /// One light chosen (u_choose), one direction to it from the receiver (u). The pdf is by solid angle and contains the
    /// probability of the choice; for delta lights it is that probability alone. Nothing when the light cannot reach it.
    std::optional<LightSample> sample_light(Receiver const& to, LightSampling how, double u_choose, Vec2 u,
                                            Wavelengths const& lambda) const;
    /// The density with which sample_light(to) would have found the emitting point `hit` seen along w.
    float light_pdf(SurfaceHit const& hit, Receiver const& to, LightSampling how, Vec3 w) const;
    /// … or the infinite light along w.
    float infinite_light_pdf(LightId light, Receiver const& to, LightSampling how, Vec3 w) const;

  private:
    friend World compile(Scene scene);
    friend TraceSums trace_only(World const& world, std::span<RecordedRay const> rays);
    World();
    void complete(RawHit const& raw, SurfaceHit& hit) const;
    float passing_share(Ray ray, float t_max, RayStats& stats) const;
    std::optional<LightSample> sample_light_without_surface(LightId id, float pmf, Vec3 p, Vec2 u,
                                                            Wavelengths const& lambda) const;
    std::optional<LightSample> sample_area_light(LightEntry const& entry, float pmf, Receiver const& to,
                                                 ShapeSampling how, Vec2 u, Wavelengths const& lambda) const;

    std::unique_ptr<Scene> scene_;
    std::unique_ptr<Assets> assets_;
    std::unique_ptr<RayCaster> caster_;
    std::unique_ptr<LightTable> lights_;
    std::unique_ptr<WorldParts> parts_;
    Bounds3 bounds_;
    WorldCounts counts_;
    std::string hash_;
};

/// Validates, reads pictures, bakes transforms, flattens nested instances and builds the acceleration structure.
/// Throws Error with file:line. Notes about what was dropped are added to the compiled scene's notes.
World compile(Scene scene);

}  // namespace nephroid
