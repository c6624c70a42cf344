// Shots of photons, and sums over them.
#pragma once

#include "measure.h"
#include "scenes.h"
#include "transport/photon_map.h"
#include "transport/shooting.h"

#include <functional>

namespace nephroid::test {

inline SppmIntegrator shooting(int paths, bool aim = true, int max_depth = 16) {
    SppmIntegrator i;
    i.shooting = {.global_paths = paths, .caustic_paths = paths, .max_depth = max_depth, .aim = aim};
    i.estimates.radius = 0.1f;  // nobody asks for estimates
    i.estimates.caustic_radius = 0.1f;
    return i;
}
inline Settings shot_settings(int paths, ColorMode color = ColorMode::Rgb, bool aim = true,
                              int max_depth = 16, std::uint64_t seed = 1) {
    Settings s = settings(shooting(paths, aim, max_depth));
    s.color = color;
    s.seed = seed;
    return s;
}
inline Shot shot_of(World const& world, Settings const& s, ShotKind kind, std::uint64_t pass = 0) {
    RenderJob const job(world, s);
    auto const& i = std::get<SppmIntegrator>(s.integrator);
    return *shoot(job, kind, pass, static_cast<std::uint64_t>(i.shooting.global_paths), {});
}

/// What a hero alone carries is all lanes' together.
inline double carried(Photon const& p, int lane) {
    Spectrum const power = p.power();
    return static_cast<double>(p.hero_only() ? power[0] / 4.0f : power[lane]);
}
using Which = std::function<bool(Photon const&)>;
inline double sum_of(std::vector<Photon> const& photons, int lane, Which const& which) {
    double sum = 0;
    for (Photon const& p : photons)
        if (which(p)) sum += carried(p, lane);
    return sum;
}
/// The sum over 32 shots with scrambles of their own, lane 1.
inline Mean batches_of(World const& world, Settings s, ShotKind kind, Which const& which, int lane = 1) {
    Mean mean;
    for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
        s.seed = 1000 + batch;
        mean.add(sum_of(shot_of(world, s, kind).photons, lane, which));
    }
    return mean;
}
inline PhotonCounts total(Shot const& shot) {
    PhotonCounts all;
    for (PhotonCounts const& c : shot.by_source) all.add(c);
    return all;
}

inline Light distant(Vec3 from, float irradiance = 1) {
    DistantLight l;
    l.from = from;
    l.to = {0, 0, 0};
    l.scale = irradiance;
    return Light{l, {}, {}};
}
inline Light spot_light(Vec3 from, Vec3 to, float intensity, float degrees, float soft_degrees) {
    SpotLight l;
    l.from = from;
    l.to = to;
    l.scale = intensity;
    l.cone_angle = degrees * kPi / 180.0f;
    l.cone_delta = soft_degrees * kPi / 180.0f;
    return Light{l, {}, {}};
}
inline Object& add_sphere(Scene& s, Vec3 centre, float radius, MaterialId m = {}) {
    Object& o = add(s, Sphere{radius, -radius, radius}, m);
    o.to_group = translate(centre.x, centre.y, centre.z);
    return o;
}
/// Glass whose inside absorbs, of a priority.
inline MaterialId filled(Scene& s, float eta, Vec3 absorption, int priority = 1) {
    DielectricMaterial m;
    m.eta = ConstantSpd{eta};
    m.interior = {RgbUnboundedSpd{absorption}, priority};
    return material(s, m);
}

}  // namespace nephroid::test
