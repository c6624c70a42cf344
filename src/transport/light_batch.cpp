#include "light_batch.h"

#include <algorithm>
#include <memory>

namespace nephroid {

bool LightBatch::begin(PathInFlight& path, Ray const& ray, Spectrum power) {
    return begin_at_light(path.c, ray, power, shoot_.paths, *std::construct_at(&path.walk)) ||
           ends(path, path.c.tainted ? &PhotonCounts::broken : &PhotonCounts::dark);
}

Paths LightBatch::emit(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
        going_[i] = &paths_[i];
        paths_[i].c.tainted = false;
    }
    Paths const all{going_.data(), n};
    World const& world = shoot_.job.world();
    std::array<Vec2, kMostInStep> point;
    std::array<Vec2, kMostInStep> direction;
    draw_2d(all, dimension::kSourcePoint,
            [&](PathInFlight const& path) -> Vec2& { return point[path.c.path]; });
    draw_2d(all, dimension::kSourceDirection,
            [&](PathInFlight const& path) -> Vec2& { return direction[path.c.path]; });
    if (shoot_.aim || !world.has_lone_flat_light())
        return keep(all, [&](PathInFlight& path) {
            PathContext& c = path.c;
            EmissionNumbers const u{draw_source(c, shoot_.aim), point[c.path], direction[c.path]};
            auto const ray = send(c, shoot_.aim, u, &told(path).light);
            return ray ? begin(path, ray->start(), ray->power()) : ends(path, &PhotonCounts::dark);
        });
    // Of the only light, which has the number 0, eight at a time.
    std::size_t going = 0;
    for (std::size_t first = 0; first < n; first += kLanes) {
        std::size_t const size = std::min(kLanes, n - first);
        Vec2Lanes at;
        Vec2Lanes along;
        for (std::size_t i = 0; i < size; ++i) {
            at.set(i, point[first + i]);
            along.set(i, direction[first + i]);
        }
        EmittedLanes emitted;
        world.emit_lone_flat_light(at, along, emitted);
        for (std::size_t i = 0; i < size; ++i) {
            PathInFlight& path = paths_[first + i];
            if (!(emitted.pdf[i] > 0.0f))
                ends(path, &PhotonCounts::dark);
            else if (begin(path, {emitted.o[i], emitted.d[i]},
                           emitted.radiance->sample(path.c.lambda) * emitted.per_radiance[i]))
                going_[going++] = &path;
        }
    }
    return {going_.data(), going};
}

bool LightBatch::arrive(PathInFlight& path, bool in_lanes) {
    if (!reach(path, EmissionWeight::None, in_lanes)) return ends(path, &PhotonCounts::escaped);
    if (!path.walk.beta.is_finite()) return ends(path, &PhotonCounts::broken);
    // Light that an absorbing medium has swallowed to the last float is no photon.
    return (!path.walk.beta.is_black() && prepare(path, in_lanes)) || ends(path, &PhotonCounts::absorbed);
}

void LightBatch::land(PathInFlight const& path) {
    Walk const& walk = path.walk;
    bool const caustic = walk.vertex > 0 && walk.path_class.all_specular();
    if (path.v.is.near_specular || !(walk.vertex > 0 || shoot_.keeps_direct())) return;
    bool const further = shoot_.leaves_further(caustic);
    landed_.push_back(
        {path.c.path, further, Photon(photon_of(path.c, walk, path.v, told(path).light, caustic))});
    ++(further ? told(path).further : told(path).stored);
}

Paths LightBatch::survivors(Paths paths) {
    if (paths.empty()) return paths;
    std::array<float, kMostInStep> drawn;
    draw_1d(paths, roulette_dimension(paths.front()->walk), drawn.data());
    float const* u = drawn.data();
    return keep(paths, [&](PathInFlight& path) {
        float const share = shoot_.share_that_goes_on(path.walk.path_class);
        float const q = power_survival(path.walk, before_[path.c.path]) * share;
        if (!(*u++ < q)) return ends(path, share < 1.0f ? &PhotonCounts::landed : &PhotonCounts::absorbed);
        path.walk.beta /= q;
        return true;
    });
}

void LightBatch::follow(std::uint64_t first, std::size_t n) {
    begun_ = chunk_.paths.size();
    chunk_.paths.resize(begun_ + n);
    landed_.clear();
    for (std::size_t i = 0; i < n; ++i) samplers_[i] = shoot_.sampler(first + i);
    bool const lanes = goes_in_lanes(paths_.front().c);
    auto const leave_photon = [&](PathInFlight& path) {
        land(path);
        before_[path.c.path] = path.walk.beta;
        told(path).end = &PhotonCounts::absorbed;  // unless it goes on
    };
    Paths paths = emit(n);
    for (std::uint32_t vertex = 0; !paths.empty(); ++vertex) {
        trace_rays(paths);
        paths = keep(paths, [&](PathInFlight& path) { return arrive(path, lanes); });
        auto const [together, singly] = split(paths);
        if (vertex >= shoot_.max_depth) {
            complete_hits(together);
            for (PathInFlight* path : paths) land(*path), ends(*path, &PhotonCounts::too_long);
            break;
        }
        paths = joined({scatter_together(together, {.sample_lights = false}, leave_photon),
                        scatter_singly(singly, {.sample_lights = false}, leave_photon)});
        if (vertex == 0)
            paths = keep(paths, [&](PathInFlight& path) {
                return shoot_.follows(path.walk.path_class) || ends(path, &PhotonCounts::elsewhere);
            });
        paths = survivors(paths);
    }
    for (std::size_t i = 0; i < n; ++i)
        if (paths_[i].c.tainted) ends(paths_[i], &PhotonCounts::broken);
    append_landed(n);
}

void LightBatch::append_landed(std::size_t n) {
    struct Places {
        std::size_t photons, further;
    };
    std::array<Places, kMostInStep> at;
    Places size{chunk_.photons.size(), chunk_.further.size()};
    for (std::size_t i = 0; i < n; ++i) {
        at[i] = size;
        size.photons += chunk_.paths[begun_ + i].stored;
        size.further += chunk_.paths[begun_ + i].further;
    }
    chunk_.photons.resize(size.photons);
    chunk_.further.resize(size.further);
    for (Landed const& l : landed_)
        if (l.further)
            chunk_.further[at[l.path].further++] = l.photon;
        else
            chunk_.photons[at[l.path].photons++] = l.photon;
}

}  // namespace nephroid
