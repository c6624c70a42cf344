#include "transport/shooting.h"

#include "light_batch.h"
#include "shoot.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace nephroid {

namespace {

/// So many paths are one task, and lie in the map one after the other whoever traces them: few enough that no thread waits long for the
/// last of them.
constexpr std::uint64_t kChunk = 1024;
/// Where a ray that leaves the scene is past all of it.
Vec3 leaving_point(Bounds3 const& box, Ray const& ray) {
    float far = kInfinity;
    for (int i = 0; i < 3; ++i)
        if (ray.d[i] != 0.0f)
            far = min(far, ((ray.d[i] > 0.0f ? box.hi[i] : box.lo[i]) - ray.o[i]) / ray.d[i]);
    // From outside of the box, or on its very side: as far as the scene is wide.
    float const wide = 2.0f * bounding_sphere(box).radius;
    float const t = far > 1e-3f * wide && std::isfinite(far) ? far : wide;
    return ray.o + t * ray.d;
}

/// Writes down where a path goes.
struct Visit {
    TracedPath traced;
    Bounds3 bounds;

    void begins(Ray const& ray) { traced.vertices.push_back(ray.o); }
    void meets(Vec3 p) { traced.vertices.push_back(p); }
    void leaves(Ray const& ray) { traced.vertices.push_back(leaving_point(bounds, ray)); }
    void lands(PhotonRecord const& r, bool further) {
        (further ? traced.further : traced.photons).push_back(r);
    }
};

/// What the chunks left, which are empty then.
std::vector<Photon> one_after_another(std::vector<std::vector<Photon>>& chunks) {
    std::vector<std::size_t> first(chunks.size() + 1);
    for (std::size_t n = 0; n < chunks.size(); ++n) first[n + 1] = first[n] + chunks[n].size();
    std::vector<Photon> all(first.back());
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t n) {
        std::copy(chunks[n].begin(), chunks[n].end(), all.begin() + static_cast<std::ptrdiff_t>(first[n]));
        std::vector<Photon>().swap(chunks[n]);
    });
    return all;
}

/// Path `i` of a shot, from its light to its end. `visit` is told where it goes. This is what LightBatch does to many.
End follow_light(Shoot const& s, std::uint64_t i, std::uint32_t& light, RayStats& stats, Visit& visit) {
    PathSampler sampler = s.sampler(i);
    PathContext c{s.job, s.job.world(), s.lambda, sampler, stats};
    auto start = emit(c, s.aim, s.paths, &light);
    if (!start) return c.tainted ? &PhotonCounts::broken : &PhotonCounts::dark;
    Walk& walk = start->walk;
    visit.begins(walk.ray);
    Vertex v;
    Spectrum unseen;
    for (;;) {
        if (!advance(c, walk, EmissionWeight::None, v, unseen)) {
            visit.leaves(walk.ray);
            return &PhotonCounts::escaped;
        }
        visit.meets(v.hit.s.p);
        if (!walk.beta.is_finite()) return &PhotonCounts::broken;
        // Light that an absorbing medium has swallowed to the last float is no photon.
        if (walk.beta.is_black() || !prepare(c, walk, v)) return &PhotonCounts::absorbed;
        bool const caustic = walk.vertex > 0 && walk.path_class.all_specular();
        if (!v.is.near_specular && (walk.vertex > 0 || s.keeps_direct()))
            visit.lands(photon_of(c, walk, v, light, caustic), s.leaves_further(caustic));
        if (walk.vertex >= s.max_depth) return &PhotonCounts::too_long;
        Spectrum const before = walk.beta;
        if (!scatter(c, walk, v)) return c.tainted ? &PhotonCounts::broken : &PhotonCounts::absorbed;
        if (!s.follows(walk.path_class)) return &PhotonCounts::elsewhere;
        float const share = s.share_that_goes_on(walk.path_class);
        if (!survives_with_power(c, walk, before, share))
            return share < 1.0f ? &PhotonCounts::landed : &PhotonCounts::absorbed;
    }
}

}  // namespace

std::optional<Shot> shoot(RenderJob const& job, ShotKind kind, std::uint64_t pass, std::uint64_t paths,
                          PrepareControl const& control) {
    Shot shot;
    shot.paths = paths;
    World const& world = job.world();
    shot.by_source.resize(world.light_sources().size());
    PhotonPlan const* plan = job.photon_plan();
    // Without power nobody emits anything.
    if (!plan || paths == 0 || !(world.total_power() > 0.0f)) return shot;
    Shoot const s(job, *plan, kind, pass, paths);

    std::uint64_t const count = (paths + kChunk - 1) / kChunk;
    std::vector<std::vector<Photon>> photons(count);
    std::vector<std::vector<Photon>> further(count);
    std::mutex adding;  // once a chunk: what is added up are whole numbers, in whatever order
    std::uint64_t done = 0;
    std::atomic<bool> stopped = false;
    tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t n) {
        PhotonChunk chunk;
        LightBatch batch(s, chunk);
        std::uint64_t const begin = n * kChunk, end = std::min(paths, begin + kChunk);
        for (std::uint64_t i = begin; i < end; i += kMostInStep) {
            if (stopped || control.stopped()) {
                stopped = true;
                return;
            }
            batch.follow(i, std::min<std::uint64_t>(kMostInStep, end - i));
        }
        photons[n] = std::move(chunk.photons);
        further[n] = std::move(chunk.further);
        std::lock_guard const lock(adding);
        for (PhotonChunk::Path const& path : chunk.paths) {
            PhotonCounts& counts = shot.by_source[world.source_of(path.light)];
            ++counts.emitted;
            counts.stored += path.stored;
            counts.further += path.further;
            ++(counts.*path.end);
        }
        shot.rays.add(chunk.rays);
        done += end - begin;
        if (control.on_progress) control.on_progress(static_cast<double>(done) / static_cast<double>(paths));
    });
    if (stopped) return std::nullopt;

    shot.photons = one_after_another(photons);
    shot.further = one_after_another(further);
    return shot;
}

PhotonsPerPath photons_per_path(RenderJob const& job, ShotKind kind, std::uint64_t paths) {
    if (paths == 0 || !job.photon_plan()) return {};
    std::optional<Shot> const shot = shoot(job, kind, kPilotPass, paths, {});
    if (!shot) return {};
    auto const n = static_cast<double>(paths);
    return {static_cast<double>(shot->photons.size()) / n, static_cast<double>(shot->further.size()) / n};
}

double expected_photons(RenderJob const& job) {
    PhotonPlan const* plan = job.photon_plan();
    if (!plan) return 0;
    auto const left = [&](ShotKind kind) {
        std::uint64_t const paths = paths_of_pass(job, kind);
        PhotonsPerPath const per_path = paths > 0 ? photons_per_path(job, kind) : PhotonsPerPath{};
        auto const n = static_cast<double>(paths);
        return PhotonsPerPath{n * per_path.photons, n * per_path.further};
    };
    PhotonsPerPath const caustic = left(ShotKind::Caustic);
    double const copies = plan->caustics_in_global ? 2 : 1;
    return left(plan->global_kind).photons + copies * caustic.photons + caustic.further;
}

TracedPath trace_light_path(RenderJob const& job, ShotKind kind, std::uint64_t pass, std::uint64_t path,
                            std::uint64_t paths) {
    Visit visit{{}, job.world().bounds()};
    PhotonPlan const* plan = job.photon_plan();
    if (!plan || paths == 0 || !(job.world().total_power() > 0.0f)) return visit.traced;
    RayStats stats;
    visit.traced.end =
        follow_light(Shoot(job, *plan, kind, pass, paths), path, visit.traced.light, stats, visit);
    return visit.traced;
}

}  // namespace nephroid
