#include "transport/shooting.h"

#include "light_walk.h"
#include "photon_plan.h"
#include "scene/match.h"

namespace nephroid {

namespace {

template <class Visit, class Reach>
void walk_light_path(RenderJob const& job, ShotKind kind, std::uint64_t pass, std::uint64_t path,
                     std::uint64_t paths, int max_depth, RayStats& stats, Visit&& visit, Reach&& reach) {
    std::uint64_t const which = kind == ShotKind::Caustic ? stream::kCausticPhotons : stream::kGlobalPhotons;
    PathSampler sampler(job.sequence(), which, 0, pass * paths + path);
    PathContext c{job, job.world(), job.pass_wavelengths(pass), sampler, stats};
    PhotonPlan const& plan = *job.photon_plan();
    auto start = emit(c, kind == ShotKind::Caustic ? &plan.aim : nullptr, paths);
    if (!start) return;
    Walk& walk = start->walk;
    reach(start->ray.light, walk.ray.o);
    Vertex v;
    Spectrum unseen;
    for (;;) {
        if (!advance(c, walk, EmissionWeight::None, v, unseen)) return;
        reach(start->ray.light, v.hit.s.p);
        if (!prepare(c, walk, v)) return;
        if (!v.is.near_specular) {
            bool const caustic = walk.vertex > 0 && walk.path_class.all_specular();
            bool const wanted = kind == ShotKind::Global    ? true
                                : kind == ShotKind::Caustic ? caustic
                                : caustic                   ? plan.caustic_paths == 0
                                                            : walk.vertex > 0;
            if (wanted) {
                PhotonRecord r;
                r.p = v.hit.s.p;
                r.wi = -walk.ray.d;
                r.n = dot(v.hit.s.ng, walk.ray.d) < 0.0f ? v.hit.s.ng : -v.hit.s.ng;
                r.power = walk.beta;
                r.bounces = walk.vertex;
                r.light = start->ray.light;
                r.caustic = caustic;
                r.hero_only = walk.hero_only;
                visit(r);
            }
        }
        if (walk.vertex >= static_cast<std::uint32_t>(max_depth)) return;
        Spectrum const before = walk.beta;
        if (!scatter(c, walk, v) || !survives_with_power(c, walk, before)) return;
        if (kind == ShotKind::Caustic && !walk.path_class.all_specular()) return;
    }
}

int depth_of(RenderJob const& job) {
    return match(job.settings().integrator, [](auto const& i) {
        if constexpr (requires { i.shooting; }) return i.shooting.max_depth;
        return 0;
    });
}

}  // namespace

std::optional<Shot> shoot(RenderJob const& job, ShotKind kind, std::uint64_t pass, std::uint64_t paths,
                          PrepareControl const& control) {
    Shot shot;
    shot.paths = paths;
    int const depth = depth_of(job);
    std::uint64_t seen = ~std::uint64_t{0};
    auto const of = [&](std::uint32_t light) -> PhotonCounts& {
        if (shot.by_source.size() <= light) shot.by_source.resize(light + 1);
        return shot.by_source[light];
    };
    for (std::uint64_t i = 0; i < paths; ++i) {
        if (control.stopped()) return std::nullopt;
        walk_light_path(
            job, kind, pass, i, paths, depth, shot.rays,
            [&](PhotonRecord const& r) {
                shot.photons.emplace_back(r);
                of(r.light).stored++;
            },
            [&](std::uint32_t light, Vec3) {
                if (seen != i) of(light).emitted++;
                seen = i;
            });
    }
    return shot;
}

TracedPath trace_light_path(RenderJob const& job, ShotKind kind, std::uint64_t pass, std::uint64_t path,
                            std::uint64_t paths) {
    TracedPath traced;
    RayStats stats;
    walk_light_path(
        job, kind, pass, path, paths, depth_of(job), stats,
        [&](PhotonRecord const& r) { traced.photons.push_back(r); },
        [&](std::uint32_t light, Vec3 p) {
            traced.light = light;
            traced.vertices.push_back(p);
        });
    return traced;
}

}  // namespace nephroid
