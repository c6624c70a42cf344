// A hundred thousand lights: what they cost, and how much noise choosing among them makes.
#include "measure.h"
#include "scenes.h"

#include <algorithm>
#include <chrono>

using namespace nephroid;
using namespace nephroid::test;

namespace {

struct Lamp {
    Vec3 p[3];
    float radiance;
};

/// A hall with boxes in it, lit by clusters of small one-sided triangles that look anywhere: a few bright ones, many dim ones.
struct Hall {
    Scene scene;
    std::vector<Lamp> lamps;

    Hall(int clusters, int per_cluster) {
        MaterialId const grey = diffuse(scene, 0.5f);
        add(scene, box_mesh({-10, -10, 0}, {10, 10, 5}, true), grey);
        Random r(17);
        auto const in = [&r](double a, double b) { return static_cast<float>(r.uniform(a, b)); };
        for (int i = 0; i < 40; ++i) {
            Vec3 const lo{in(-9, 8), in(-9, 8), 0};
            add(scene, box_mesh(lo, lo + Vec3{in(0.3, 1.5), in(0.3, 1.5), in(0.5, 3)}, false), grey);
        }
        for (int c = 0; c < clusters; ++c) {
            Vec3 const centre{in(-9.5, 9.5), in(-9.5, 9.5), in(0.5, 4.8)};
            float const size = in(0.05, 0.3);
            AreaLight const light = white(static_cast<float>(std::exp(r.uniform(0, 4))));
            TriangleMesh mesh;
            for (int i = 0; i < per_cluster; ++i) {
                Lamp lamp;
                lamp.radiance = light.scale;
                Vec3 const at = centre + size * Vec3{in(-1, 1), in(-1, 1), in(-1, 1)};
                for (Vec3& p : lamp.p) {
                    p = at + 0.01f * Vec3{in(-1, 1), in(-1, 1), in(-1, 1)};
                    mesh.p.push_back(p);
                }
                int const k = static_cast<int>(mesh.p.size());
                mesh.triangles.emplace_back(k - 3, k - 2, k - 1);
                lamps.push_back(lamp);
            }
            add(scene, mesh).light = light;
        }
    }
};

/// Irradiance of p from a small lamp without shadows; the lamp as a point.
double unshadowed(Lamp const& l, Vec3 p, Vec3 n) {
    Vec3 const area = 0.5f * cross(l.p[1] - l.p[0], l.p[2] - l.p[0]);
    Vec3 const d = (l.p[0] + l.p[1] + l.p[2]) / 3.0f - p;
    auto const r2 = static_cast<double>(dot(d, d));
    double const cosines = static_cast<double>(dot(n, d)) * -static_cast<double>(dot(area, d));
    return dot(n, d) > 0 && dot(area, d) < 0 ? static_cast<double>(l.radiance) * cosines / (r2 * r2) : 0.0;
}

}  // namespace

TEST_CASE("many lights: 10^5 emissive triangles take little memory, and choosing makes little noise") {
    Hall hall(400, 250);
    auto const t0 = std::chrono::steady_clock::now();
    World const world = compile(hall.scene);
    double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    double const bytes = static_cast<double>(world.memory().lights) / static_cast<double>(hall.lamps.size());
    MESSAGE(hall.lamps.size(), " lights: the whole world is compiled in ", seconds, " s, ", bytes,
            " bytes a light");
    CHECK(world.counts().lights == hall.lamps.size());
    CHECK(bytes <= 400);

    // The recorded points: what rays from the middle of the hall meet.
    Random r(19);
    RayStats stats;
    double sum = 0;
    double sum_oracle = 0;
    double worst = 0;
    int points = 0;
    int const draws = samples(3000, 30000);
    while (points < 24) {
        SurfaceHit hit;
        Vec3 const eye{0, 0, 2.5f};
        Vec3 const d =
            normalize(Vec3{static_cast<float>(r.uniform(-1, 1)), static_cast<float>(r.uniform(-1, 1)),
                           static_cast<float>(r.uniform(-1, 0.6))});
        if (!world.intersect({eye, d}, kInfinity, RayKind::Camera, stats, hit) || hit.emits) continue;
        ++points;
        Vec3 const n = face_forward(hit.s.ng, -d);
        Receiver const to{hit.s.p, n, false};
        Mean ours;
        for (int i = 0; i < draws; ++i) {
            auto const s = world.sample_light(to, {}, r.uniform(), {r.unit(), r.unit()}, Wavelengths::rgb());
            double x = 0;
            if (s && dot(n, s->wi) > 0 && !s->radiance.is_black())
                x = static_cast<double>(s->radiance[1]) * static_cast<double>(dot(n, s->wi)) *
                    static_cast<double>(world.transmittance(hit, *s, stats)) / static_cast<double>(s->pdf);
            ours.add(x);
        }
        // The oracle knows what each of them sends, but not what is in its way.
        std::vector<double> cdf(hall.lamps.size() + 1);
        for (std::size_t i = 0; i < hall.lamps.size(); ++i)
            cdf[i + 1] = cdf[i] + unshadowed(hall.lamps[i], to.p, n);
        Mean oracle;
        for (int i = 0; i < draws; ++i) {
            auto const at =
                std::upper_bound(cdf.begin(), cdf.end(), r.uniform() * cdf.back()) - cdf.begin() - 1;
            auto const k = std::min(static_cast<std::size_t>(at), hall.lamps.size() - 1);
            Lamp const& l = hall.lamps[k];
            LightSample s;
            float const u = std::sqrt(r.unit());
            float const v = r.unit();
            s.p = (1 - u) * l.p[0] + u * (1 - v) * l.p[1] + u * v * l.p[2];
            s.p_error = gamma_bound(8) * abs(s.p);
            s.n = normalize(cross(l.p[1] - l.p[0], l.p[2] - l.p[0]));
            Vec3 const to_light = s.p - to.p;
            auto const r2 = static_cast<double>(dot(to_light, to_light));
            s.wi = normalize(to_light);
            double const area = 0.5 * static_cast<double>(length(cross(l.p[1] - l.p[0], l.p[2] - l.p[0])));
            double const cosine = -static_cast<double>(dot(s.n, s.wi));
            double x = 0;
            if (dot(n, s.wi) > 0 && cosine > 0)
                x = static_cast<double>(l.radiance) * static_cast<double>(dot(n, s.wi)) * cosine / r2 * area *
                    static_cast<double>(world.transmittance(hit, s, stats)) * cdf.back() /
                    (cdf[k + 1] - cdf[k]);
            oracle.add(x);
        }
        // Both find the same.
        double const apart = std::abs(ours.mean() - oracle.mean());
        double const error = std::hypot(ours.standard_error(), oracle.standard_error());
        CHECK(apart < 4.5 * error);
        double const scale = oracle.mean() * oracle.mean();
        if (!(scale > 0)) continue;
        sum += ours.variance() / scale;
        sum_oracle += oracle.variance() / scale;
        worst = std::max(worst, std::sqrt(ours.variance() / oracle.variance()));
    }
    double const ratio = std::sqrt(sum / sum_oracle);
    MESSAGE("noise, in units of the oracle's: ", ratio, "; at the worst of ", points, " points ", worst);
    CHECK(ratio <= 2);
}
