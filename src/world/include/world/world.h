// A scene, compiled: immutable, shared by all threads. The only room that names Embree (in its .cpp files alone).
#pragma once

#include "math/bounds.h"
#include "model/assets.h"
#include "model/camera.h"
#include "model/light.h"
#include "scene/scene.h"
#include "world/hit.h"
#include "world/light_lanes.h"
#include "world/ray_packet.h"
#include "world/shadow.h"

#include <array>
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

class RayCaster;   // Embree
class LightTable;  // all lights, and how one is chosen
struct LightEntry;
struct WorldParts;
struct TraceSums;  // world/floor.h

/// A ray of light, and who sent it.
struct LightRay {
    EmissionSample emission;  // ray.o lies on the surface: move it off by p_error
    std::uint32_t light = 0;  // of all that there are to choose from (WorldCounts::lights)
    float choice = 0;         // the probability of having chosen it; 1 where the densities contain it
    float side = 1;           // of a surface that shines on both sides: the share of this one
    bool unseen = false;      // a surface that shines, but is not there: no ray finds it

    /// Where the ray begins.
    [[nodiscard]] Ray start() const {
        EmissionSample const& e = emission;
        return {e.n == Vec3(0) ? e.ray.o : offset_ray_origin(e.ray.o, e.p_error, e.n, e.ray.d), e.ray.d};
    }
    /// Power that the ray stands for, when one is sent.
    [[nodiscard]] Spectrum power() const {
        EmissionSample const& e = emission;
        float const cosine = e.n == Vec3(0) ? 1.0f : abs_dot(e.n, e.ray.d);
        return e.radiance * (cosine / (e.pdf_position * e.pdf_direction * choice));
    }
};

/// Something that shines, as its user knows it: an emitting object with all of its parts and appearances, or a light without a
/// surface.
struct LightSource {
    char const* kind;  // "area", or the light's type
    SourceLocation where;
};

/// A part of a surface that may throw caustics, in the world: all of it is within `reach` of the hull of the points.
struct CasterPiece {
    std::array<Vec3, 4> p;
    float reach = 0;
};

/// Triangles that neither shine nor let anything pass, of a diffuse material of one colour (MaterialData::plain).
struct PlainMesh {
    TriangleMesh const* mesh = nullptr;
    bool flip = false;
    RuntimeSpectrum reflectance;
};

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
    /// The same, to be completed by surface().
    bool intersect(Ray const& ray, float t_max, RayKind kind, RayStats& stats, RawHit& hit) const;
    /// … of camera rays side by side. What a ray meets does not depend on those beside it.
    void intersect(RayPacket const& rays, RayStats& stats, std::array<RawHit, kLanes>& hits) const;
    /// The surface that was hit; false where there was none.
    bool surface(RawHit const& found, SurfaceHit& hit) const;
    /// What a hit is on where nothing has to be asked but where it is and what colour it has; null elsewhere. Then surface() may be left out.
    [[nodiscard]] PlainMesh const* plain_mesh(RawHit const& found) const {
        if (!found.found || found.instance != kNoInstance) return nullptr;
        PlainMesh const& plain = plain_meshes_[found.geometry];
        return plain.mesh ? &plain : nullptr;
    }
    /// How much of the surface is there at a hit, by its alpha: the probability with which a ray that comes by meets it, above 0.
    [[nodiscard]] float presence(SurfaceHit const& hit) const;
    /// The scene's object that was hit: one of its groups', whichever its appearance.
    [[nodiscard]] Object const& object_at(SurfaceHit const& hit) const;
    /// The share of light that gets from one surface point to the other (or to the light at infinity): 0 where something solid
    /// is between them, less than 1 behind mixes with interfaces. Both ends are moved off their surfaces by their error bounds.
    float transmittance(SurfaceHit const& from, LightSample const& to, RayStats& stats) const;
    /// Of eight shadow rays at once: the lanes in whose way there is nothing solid.
    [[nodiscard]] LaneMask unoccluded(RayPacket const& rays, RayStats& stats) const;
    /// Are there surfaces that let a share of light through? Then transmittance() knows more than unoccluded().
    [[nodiscard]] bool passes_partly() const;

    /// Some material has an interior that paths must know they are in.
    [[nodiscard]] bool encloses() const { return encloses_; }

    // --- emission ---------------------------------------------------------------------------------------------------------
    /// Radiance that the surface itself emits towards w.
    Spectrum emitted(SurfaceHit const& hit, Vec3 w, Wavelengths const& lambda) const;
    /// Radiance of everything infinitely far away, as it arrives at p along w.
    Spectrum environment(Vec3 p, Vec3 w, Wavelengths const& lambda) const;
    /// … of one infinite light.
    Spectrum environment(LightId light, Vec3 p, Vec3 w, Wavelengths const& lambda) const;
    [[nodiscard]] std::vector<LightId> const& infinite_lights() const;
    /// False where nothing on the ray's way emits, whatever is in between: who asks for emission alone need not look.
    [[nodiscard]] bool may_meet_emission(Ray const& ray) const;

    /// Whether sample_light looks at u_choose at all.
    [[nodiscard]] bool chooses_lights() const;
    /// One light chosen (u_choose), one direction to it from the receiver (u). The pdf is by solid angle and contains the
    /// probability of the choice; for delta lights it is that probability alone. Nothing when the light cannot reach it.
    std::optional<LightSample> sample_light(Receiver const& to, LightSampling how, double u_choose, Vec2 u,
                                            Wavelengths const& lambda) const;
    /// Whether the world is lit by one flat surface alone, that shines everywhere the same.
    [[nodiscard]] bool has_lone_flat_light() const;
    /// The samples of that one for eight receivers, by the numbers u; lanes not in `used` mean nothing. The bits of sample_light(). Some
    /// lanes are left to wait, and filled by a later call or by sample_waiting() in the end.
    void sample_lone_flat_light(ReceiverLanes const& to, LaneMask used, LightSampling how, Vec2Lanes const& u,
                                LightSampleLanes& sample, WaitingReceivers& waiting) const;
    void sample_waiting(WaitingReceivers& waiting) const;
    /// The density with which sample_light(to) would have found the emitting point `hit` seen along w.
    float light_pdf(SurfaceHit const& hit, Receiver const& to, LightSampling how, Vec3 w) const;
    /// … or the infinite light along w.
    float infinite_light_pdf(LightId light, Receiver const& to, LightSampling how, Vec3 w) const;

    /// Light on its way from a source, for tracing forward. The source is chosen by power.
    std::optional<LightRay> sample_emission(double u_choose, Vec2 u_position, Vec2 u_direction,
                                            Wavelengths const& lambda) const;
    /// The rays of the one light (has_lone_flat_light) for eight paths; the bits of sample_emission().
    void emit_lone_flat_light(Vec2Lanes const& u_position, Vec2Lanes const& u_direction,
                              EmittedLanes& emitted) const;
    /// The densities with which sample_emission sends light from an emitting point along w, the choice of the light in `position`.
    EmissionDensity emission_density(SurfaceHit const& from, Vec3 w) const;
    /// … or from an infinite light through p along w (the direction in which it travels).
    EmissionDensity emission_density(LightId light, Vec3 p, Vec3 w) const;
    /// Power of all lights in W, of the spectrum's largest value: what sample_emission chooses by.
    float total_power() const;
    /// The light (LightRay::light) that sample_emission chooses, whether or not it then sends anything. None without any power.
    std::optional<std::uint32_t> light_chosen_by(double u_choose) const;
    /// Whatever shines, and which of them a light (LightRay::light) belongs to.
    [[nodiscard]] std::vector<LightSource> light_sources() const;
    [[nodiscard]] std::uint32_t source_of(std::uint32_t light) const;

    // --- emission towards a place -----------------------------------------------------------------------------------------
    /// Light of one light, 0 … counts().lights - 1, as sample_emission sends it or, with `ball`, towards a ball: the densities are
    /// those of this way, the choice is 1. Nothing where that light sends none.
    std::optional<LightRay> emit(std::uint32_t light, BoundingSphere const* ball, Vec2 u_position,
                                 Vec2 u_direction, Wavelengths const& lambda) const;
    /// The density with which another ball (or none) would have sent that ray: by position for a light at infinity, given the
    /// direction; else by direction, given the position. The other of the two densities is the same for all balls.
    float aimed_density(LightRay const& ray, BoundingSphere const* ball) const;
    /// False where no ray from that light can meet the ball.
    bool may_reach(std::uint32_t light, BoundingSphere const& ball) const;
    [[nodiscard]] bool is_boundless(std::uint32_t light) const;
    [[nodiscard]] bool has_surface(std::uint32_t light) const;
    /// W, of the spectrum's largest value.
    float power_of(std::uint32_t light) const;
    /// Surfaces that may scatter (near-)specularly, in pieces.
    [[nodiscard]] std::vector<CasterPiece> casters() const;
    /// Boxes of the bodies that paths have to know they are in, one a material.
    [[nodiscard]] std::vector<Bounds3> const& bodies() const { return bodies_; }

  private:
    friend World compile(Scene scene);
    [[nodiscard]] std::uint32_t entry_of(SurfaceHit const& hit) const;
    friend TraceSums trace_only(World const& world, std::span<RecordedRay const> rays);
    World();
    void complete(RawHit const& raw, SurfaceHit& hit) const;
    float passing_share(Ray ray, float t_max, RayStats& stats) const;
    std::optional<LightSample> sample_light_without_surface(LightId id, float pmf, Vec3 p, Vec2 u,
                                                            Wavelengths const& lambda) const;
    std::optional<LightRay> emit_without_surface(std::uint32_t light, BoundingSphere const* ball,
                                                 Vec2 u_position, Vec2 u_direction,
                                                 Wavelengths const& lambda) const;
    std::optional<LightRay> emit_from_surface(std::uint32_t light, BoundingSphere const* ball,
                                              Vec2 u_position, Vec2 u_direction,
                                              Wavelengths const& lambda) const;
    std::optional<LightSample> sample_area_light(LightEntry const& entry, float pmf, Receiver const& to,
                                                 ShapeSampling how, Vec2 u, Wavelengths const& lambda) const;

    std::unique_ptr<Scene> scene_;
    std::unique_ptr<Assets> assets_;
    std::unique_ptr<RayCaster> caster_;
    std::unique_ptr<LightTable> lights_;
    std::unique_ptr<WorldParts> parts_;
    std::vector<PlainMesh>
        plain_meshes_;  // by the records of the world's own objects; without a mesh: it is not plain
    Bounds3 bounds_;
    Bounds3
        emitting_;  // everything that emits, with room for rounding; all of space where something at infinity does
    bool encloses_ = false;
    std::vector<Bounds3> bodies_;
    WorldCounts counts_;
    std::string hash_;
};

/// Validates, reads pictures, bakes transforms, flattens nested instances and builds the acceleration structure.
/// Throws Error with file:line. Notes about what was dropped are added to the compiled scene's notes.
World compile(Scene scene);

}  // namespace nephroid
