#include "shoot.h"

#include "scene/match.h"

#include <algorithm>

namespace nephroid {

namespace {

PhotonShooting shooting_of(RenderJob const& job) {
    return match(job.settings().integrator, [](auto const& i) -> PhotonShooting {
        if constexpr (requires { i.shooting; }) return i.shooting;
        return {};
    });
}

/// Where alpha or a mix leaves it to chance whether a surface keeps a photon, the same chance decides whether a ray from the eye asks
/// for it: photons there stand for those that went on as well, or such a surface would be lit by its share of the light alone.
float share_kept(PathContext const& c, Vertex const& v) {
    if (v.mesh) return 1.0f;
    float share = c.world.presence(v.hit);
    if (c.world.assets().data(v.hit.material).mix) {
        TexturePoint at;
        at.p = v.hit.s.p;
        at.uv = v.hit.s.uv;
        at.n = v.hit.s.ng;
        if (float const s = spreading_share(c.world.assets(), v.hit.material, at, c.lambda); s > 0.0f)
            share *= s;
    }
    return share;
}

}  // namespace

Shoot::Shoot(RenderJob const& j, PhotonPlan const& p, ShotKind k, std::uint64_t pass, std::uint64_t n)
    : job(j),
      kind(k),
      lambda(j.pass_wavelengths(pass)),
      first(pass * n),
      paths(n),
      max_depth(static_cast<std::uint32_t>(std::max(0, shooting_of(j).max_depth))),
      aim(k == ShotKind::Caustic && shooting_of(j).aim && p.aim.casts() ? &p.aim : nullptr),
      divided(k != ShotKind::Global && p.caustic_paths > 0),
      onward(p.onward) {}

PhotonRecord photon_of(PathContext const& c, Walk const& walk, Vertex const& v, std::uint32_t light,
                       bool caustic) {
    PhotonRecord r;
    r.p = v.hit.s.p;
    r.wi = -walk.ray.d;
    r.n = facing_normal(walk, v);
    r.power = walk.beta / share_kept(c, v);
    r.bounces = walk.vertex;
    r.light = light;
    r.caustic = caustic;
    r.hero_only = walk.hero_only;
    return r;
}

}  // namespace nephroid
