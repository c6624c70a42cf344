// The walk that all integrators share: a path that grows from the camera, one scattering at a time.
//
// Estimator (PBRT 4th ed., 13.2): L = sum over vertices of beta * (emission seen + light sampled), where beta is the product
// of f |cos| / pdf along the way. Emission is found in two ways, by scattering into it and by sampling a light; the power
// heuristic weighs them (Veach 1997, 9.2.4), so that each path counts once.
#pragma once

#include "film/film.h"
#include "math/frame.h"
#include "model/material.h"
#include "sampling/path_sampler.h"
#include "sampling/warp.h"
#include "transport/interiors.h"
#include "transport/light_class.h"
#include "transport/render_pass.h"
#include "world/world.h"

namespace nephroid {

/// Streams keep the numbers of different uses of a pass apart.
namespace stream {
inline constexpr std::uint64_t kCamera = 0, kGlobalPhotons = 1, kCausticPhotons = 2, kLightPaths = 3,
                               kWavelengths = 4, kPilot = 5;
}  // namespace stream

/// Dimensions of the sampler: the camera's, then a stride for every vertex of the path, so that a vertex draws the same numbers
/// whatever was drawn before it.
namespace dimension {
inline constexpr std::uint32_t kFilm = 0, kLens = 1, kWavelength = 2;
// Of a light path instead: which light (and towards which caster), where on it, whereto.
inline constexpr std::uint32_t kSource = 0, kSourcePoint = 1, kSourceDirection = 2;
// … and, of those that are drawn into the picture, the wavelengths, and the camera as the source sees it.
inline constexpr std::uint32_t kPathWavelength = 4, kSourceLens = 5, kSourcePixel = 6;
inline constexpr std::uint32_t kFirstVertex = 8, kPerVertex = 8;
inline constexpr std::uint32_t kMix = 0, kLightChoice = 1, kLight = 2, kLobe = 3, kDirection = 4,
                               kRoulette = 5;
// Of a light path's vertex, where no light is sampled.
inline constexpr std::uint32_t kCameraPixel = kLightChoice, kCameraLens = kLight;
inline std::uint32_t of(std::uint32_t vertex, std::uint32_t which) {
    return kFirstVertex + kPerVertex * vertex + which;
}
}  // namespace dimension

struct PhotonMaps;
class NearestPhotons;
class PathTrace;    // path_trace.h
class ShadowQueue;  // shadow_queue.h

/// What a walk needs from outside; one per light path, or per place in a batch of camera samples.
struct PathContext {
    RenderJob const& job;
    World const& world;
    Wavelengths lambda;
    PathSampler& sampler;
    RayStats& stats;
    HemisphereSampling hemisphere = HemisphereSampling::Cosine;
    LightSampling lights;
    PhotonMaps const* photons = nullptr;  // of the pass
    NearestPhotons* nearest = nullptr;    // room for a query
    bool tainted = false;                 // a throughput was not a number: the sample does not count
    PathTrace* trace = nullptr;           // writes down what happens, where somebody asked for it
    RawHit const* camera_hit = nullptr;   // what the camera's ray meets, where that is known
    ShadowQueue* shadows = nullptr;       // where sampled light may wait for its shadow ray, …
    std::uint32_t path = 0;               // … as this path's

    /// The same for a branch of the path, which has numbers of its own, and is not written down.
    [[nodiscard]] PathContext with(PathSampler& other) const {
        return {job, world, lambda, other, stats, hemisphere, lights, photons, nearest};
    }
};

/// State of the path between two vertices.
struct Walk {
    Ray ray;
    RawHit const* met = nullptr;  // what the ray meets, where that is known
    Spectrum beta;                // throughput so far
    std::uint32_t vertex = 0;     // how many vertices came before the one this ray looks for
    Receiver from;                // the last vertex that scattered, …
    float pdf = 0;                // … the density of the direction it chose, …
    bool specular = true;         // … or a delta (or the camera): then lights could not be sampled there
    float eta_scale = 1;          // product of eta^2: radiance squeezed into glass is no reason to end a path
    bool hero_only = false;
    Mode mode = Mode::Radiance;
    float cone = 0;    // distance travelled: the footprint grows with it …
    float spread = 0;  // … by so much
    PathClass path_class;
    Interiors interiors;  // kept only in a world that encloses something

    static Walk from_camera(PathContext const& c, Ray const& ray) {
        Walk w;
        w.begin_at_camera(c, ray);
        return w;
    }
    /// The same of a new Walk, where it stands.
    void begin_at_camera(PathContext const& c, Ray const& camera_ray) {
        ray = camera_ray;
        met = c.camera_hit;
        // In rgb mode the fourth lane carries nothing.
        beta = c.lambda.is_rgb() ? Spectrum(1, 1, 1, 0) : Spectrum(1.0f);
        if (c.world.encloses()) interiors = c.job.camera_interiors();
        from.p = camera_ray.o;
        spread = c.job.camera().pixel_spread();
    }
};

/// How many paths go in step at most.
inline constexpr std::size_t kMostInStep = 256;  // a multiple of kLanes

/// Numbers of a vertex that were drawn ahead, together with those of other paths.
struct Drawn {
    Vec2 light, direction;
};

/// A vertex: where the ray met a surface (advance), and how it scatters there (prepare). Filled in place: it is too big to be
/// handed around.
struct Vertex {
    SurfaceHit hit;
    MaterialId material;     // of the hit; a mix has been resolved
    Frame frame;             // shading
    Vec3 wo_local{0, 0, 1};  // back along the path, away from the surface
    Bsdf bsdf;
    BsdfTraits is;  // of bsdf
    bool drawn_ahead = false;
    Drawn drawn;  // if so
    // Where it scatters together with others (diffuse_lanes.h): neither frame nor wo_local is filled, …
    bool in_lanes = false;
    PlainMesh const* mesh = nullptr;  // … and on this, of hit only t
};

/// What a vertex is to light. Made where it is needed: a copy of what has just been stored waits for the store.
inline void receive(Vertex const& v, Receiver& at) {
    at.p = v.hit.s.p;
    at.n = v.hit.s.ns * (v.wo_local.z < 0.0f ? -1.0f : 1.0f);
    at.both_sides = v.is.spreads_through;
}
inline Receiver receiver_of(Vertex const& v) {
    Receiver at;
    receive(v, at);
    return at;
}

/// The geometric normal on the side that the ray came from.
inline Vec3 facing_normal(Walk const& walk, Vertex const& v) {
    return dot(walk.ray.d, v.hit.s.ng) < 0.0f ? v.hit.s.ng : -v.hit.s.ng;
}

/// How emission that a ray runs into is weighed against light sampling at the ray's origin.
enum class EmissionWeight : std::uint8_t {
    Mis,          // power heuristic
    All,          // lights are not sampled
    None,         // emission is not asked for: light paths
    SpecularOnly  // lights are sampled without MIS: count only what could not be sampled
};

/// Follows the ray to the next surface that scatters, and fills v.hit. Adds beta * emission (of surfaces passed, of the one
/// reached, of the environment) to `radiance`. False when the ray left the scene.
bool advance(PathContext& c, Walk& walk, EmissionWeight weight, Vertex& v, Spectrum& radiance);

/// Scattering at v.hit; false when there is none (no material). May end the path's other wavelengths.
bool prepare(PathContext& c, Walk& walk, Vertex& v);
/// The same, but for frame and wo_local, of a diffuse material of one colour on the surface as it is; false, and nothing done, elsewhere.
inline bool prepare_plain(PathContext const& c, Vertex& v) {
    if (!v.material.valid()) return false;
    MaterialData const& data = c.world.assets().data(v.material);
    if (!data.plain) return false;
    make_plain_bsdf(data.reflectance, c.lambda, v.bsdf);
    v.is = {};
    return true;
}
/// What was left out then, for the functions that take one vertex.
inline void orient(Walk const& walk, Vertex& v) {
    v.frame = frame_from_z(v.hit.s.ns);
    v.wo_local = v.frame.to_local(-walk.ray.d);
}

/// One light sampled from the vertex: f |cos| Li / pdf, weighed by MIS unless `mis` is off. Without beta.
Spectrum sample_direct(PathContext& c, Walk const& walk, Vertex const& v, bool mis);
/// The same, times beta, for an end of a path that nothing is multiplied to any more: it may wait in c.shadows and be no part of
/// `seen`.
void add_direct(PathContext& c, Walk const& walk, Vertex const& v, bool mis, SeenLight& seen);

/// Chooses a direction and moves the walk on; false when the path ends.
bool scatter(PathContext& c, Walk& walk, Vertex const& v);
/// The same with a given sample, as of a branch of Whitted's tree.
bool follow(PathContext& c, Walk& walk, Vertex const& v, BsdfSample const& s);

/// After beta has been multiplied by the weight of a direction: false when the path ends, for there is nothing left, or no number.
inline bool carries_on(PathContext& c, Walk const& walk) {
    if (walk.beta.is_black()) return false;
    if (walk.beta.is_finite()) return true;
    c.tainted = true;
    return false;
}

/// Russian roulette (Arvo & Kirk 1990): ends the walk, which has just moved on, or makes up for those that were ended.
bool survives(PathContext& c, Walk& walk, Roulette const& roulette);
/// The probability with which it does not end.
inline float survival(Walk const& walk, Roulette const& roulette) {
    if (roulette.kind == RouletteKind::None) return 1.0f;
    if (roulette.kind == RouletteKind::Fixed) return roulette.alpha;
    if (walk.vertex == 1) return 1.0f;
    return walk.beta.max() * walk.eta_scale * (walk.hero_only ? 0.25f : 1.0f);
}
/// Whether a number is drawn at all.
inline bool takes_chance(float survival) { return !(survival >= 1.0f); }
/// The dimension of its number: of the vertex that the walk has left.
inline std::uint32_t roulette_dimension(Walk const& walk) {
    return dimension::of(walk.vertex - 1, dimension::kRoulette);
}

/// The bodies that light along w is in, after leaving v.
Interiors beyond(PathContext const& c, Walk const& walk, Vertex const& v, Vec3 w);
/// What Beer's law leaves of light over a distance (scene units) in the medium that is there.
Spectrum transmittance(PathContext const& c, Interiors const& interiors, float distance);

/// What the layers of the first hit record.
void record_first_hit(PathContext& c, Walk const& walk, bool scatters, Vertex const& v, AovSample* aov);

// The integrators: radiance along a camera ray, by classes of paths. (That of many paths in step: path_in_flight.h.)
SeenLight radiance(WhittedIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov);
SeenLight radiance(DirectIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov);
SeenLight radiance(PhotonMapIntegrator const& p, PathContext& c, Ray const& ray, AovSample* aov);

}  // namespace nephroid
