#include "transport/interiors.h"

#include "scene/match.h"

#include <algorithm>
#include <map>

namespace nephroid {

namespace {

/// A boundary's index as seen from a medium of index `outside`: eta is the ratio.
void immerse_in(Spectrum outside, bool disperses, Bsdf& bsdf) {
    match(
        bsdf,
        [&](DielectricBsdf& b) {
            b.eta = b.eta / outside;
            b.dispersive = b.dispersive || disperses;
        },
        [&](auto& b) {
            if constexpr (requires {
                              b.eta + 1.0f;
                              b.dispersive;
                          }) {
                b.eta /= outside[0];
                b.dispersive = b.dispersive || disperses;
            }
        });
}

}  // namespace

MaterialId Interiors::highest(Assets const& assets, MaterialId without) const {
    MaterialId best;
    int rank = -1;
    bool skipped = !without.valid();
    for (std::uint32_t i = count_; i-- > 0;) {  // the newest first
        if (!skipped && bodies_[i].surface == without) {
            skipped = true;
            continue;
        }
        MaterialId const m = bodies_[i].material;
        int const priority = assets.data(m).priority;
        if (priority > rank) best = m, rank = priority;
    }
    return best;
}

bool Interiors::hides(Assets const& assets, Boundary const& b, bool inwards) const {
    int const priority = assets.data(b.material).priority;
    if (priority == 0) return false;
    MaterialId const other = highest(assets, inwards ? MaterialId{} : b.surface);
    return other.valid() && assets.data(other).priority >= priority;
}

void Interiors::cross(Boundary const& b, bool inwards) {
    if (inwards) {
        if (count_ < kMost) bodies_[count_++] = b;
        return;
    }
    // Out of the one that was entered last; out of what was never entered (an open surface) changes nothing.
    for (std::uint32_t i = count_; i-- > 0;)
        if (bodies_[i].surface == b.surface) {
            std::copy(bodies_.begin() + i + 1, bodies_.begin() + count_, bodies_.begin() + i);
            --count_;
            return;
        }
}

Spectrum Interiors::absorption(Assets const& assets, Wavelengths const& lambda) const {
    MaterialId const m = highest(assets);
    return m.valid() ? assets.data(m).absorption.sample(lambda) : Spectrum{};
}

void Interiors::immerse(Assets const& assets, Boundary const& b, bool inwards, Wavelengths const& lambda,
                        Bsdf& bsdf) const {
    if (assets.data(b.material).priority == 0) return;
    MaterialId const around = highest(assets, inwards ? MaterialId{} : b.surface);
    if (!around.valid() || assets.data(around).priority == 0) return;
    RuntimeSpectrum const& eta = assets.data(around).eta;
    immerse_in(index_lanes(eta, lambda), !lambda.is_rgb() && !eta.is_constant(), bsdf);
}

namespace {

/// Does the ray come through the box, or a little beside it?
bool meets(Bounds3 const& box, Ray const& ray) {
    Vec3 const slack = 1e-5f * (abs(box.lo) + abs(box.hi));
    float near = 0, far = kInfinity;
    for (int i = 0; i < 3; ++i) {
        float const a = (box.lo[i] - slack[i] - ray.o[i]) / ray.d[i];
        float const b = (box.hi[i] + slack[i] - ray.o[i]) / ray.d[i];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near <= far;
}

}  // namespace

Interiors interiors_at(World const& world, Vec3 p, RayStats& stats) {
    Interiors found;
    Assets const& assets = world.assets();
    std::map<std::uint32_t, int> entered;  // by material, on the way out
    constexpr int kMostSurfaces = 4096;
    Ray ray{p, normalize(Vec3{0.31f, 0.83f, 0.46f})};  // no direction of a modelled edge
    if (std::none_of(world.bodies().begin(), world.bodies().end(),
                     [&](Bounds3 const& box) { return meets(box, ray); }))
        return found;
    SurfaceHit hit;
    for (int i = 0; i < kMostSurfaces && world.intersect(ray, kInfinity, RayKind::Camera, stats, hit); ++i) {
        ray = hit.spawn(ray.d);
        if (!hit.material.valid() || !assets.data(hit.material).encloses || assets.data(hit.material).mix)
            continue;
        int& count = entered[hit.material.value];
        if (dot(ray.d, hit.s.ng) < 0.0f)
            ++count;
        else if (count > 0)
            --count;
        else
            found.cross({hit.material, hit.material}, true);
    }
    return found;
}

}  // namespace nephroid
