// Density estimates against fields whose irradiance is known: kernels, the photon that does not count, leaks, edges, shading normals, and the
// bias that is exactly what theory says.
#include "estimates.h"
#include "kernel.h"
#include "photon_plan.h"
#include "transport/shooting.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {
constexpr double kPiD = 3.14159265358979323846;
constexpr Vec3 kUp{0, 0, 1};

World floor_world(float half, float reflectance = 0.5f) {
    Scene s;
    add(s, floor_quad(half), diffuse(s, reflectance));
    return compile(std::move(s));
}
Ray down_at(float x, float y) { return {{x, y, 1}, {0, 0, -1}}; }

/// Means of what `ask` adds to sums at 64 places whose disks do not touch, on floors of 20,000 photons.
template <class Ask>
std::vector<Mean> on_even_floors(std::size_t quantities, int floors, Ask&& ask) {
    std::vector<Mean> means(quantities);
    for (int batch = 0; batch < kBatches; ++batch) {
        Random random = numbers_of(batch);
        std::vector<double> sums(quantities);
        for (int m = 0; m < floors; ++m) {
            std::vector<Photon> photons;
            scatter_over(photons, random, floor_quad(1), kUp, 20000);
            PhotonMap const map(std::move(photons));
            for (int i = 0; i < 64; ++i)
                ask(map, 0.22f * (static_cast<float>(i & 7) - 3.5f),
                    0.22f * (static_cast<float>(i >> 3) - 3.5f), sums);
        }
        for (std::size_t i = 0; i < quantities; ++i) means[i].add(sums[i] / (64 * floors));
    }
    return means;
}
}  // namespace

TEST_CASE("kernels: each integrates to 1 over the disk, and farther photons never weigh more") {
    for (Kernel const kernel : kKernels) {
        INFO(name_of(kernel));
        with_kernel(kernel, [](auto const& k) {
            double sum = 0;
            constexpr int kSteps = 100000;
            float before = kInfinity;
            for (int i = 0; i < kSteps; ++i) {
                float const at = k((static_cast<float>(i) + 0.5f) / kSteps);
                CHECK_UNARY(at >= 0.0f && at <= before);
                before = at;
                sum += static_cast<double>(at);
            }
            CHECK(kPiD * sum / kSteps == doctest::Approx(1).epsilon(1e-6));
        });
    }
}

TEST_CASE(
    "kernels on a uniform field: a fixed radius, the nearest k, and where the radius ends the search half of "
    "the time") {
    World const world = floor_world(1);
    Probe probe(world);
    struct Case {
        Kernel kernel;
        std::uint32_t k;
        float radius;
        double within;
    };
    std::vector<Case> cases;
    // Within .1 there are 157 photons on average: of 157 nearest, the last lies beyond it about as often as not.
    for (Kernel const kernel : kKernels)
        for (auto const& [k, radius, within] :
             {std::tuple{0u, 0.1f, 0.005}, {12u, 1.0f, 0.02}, {60u, 1.0f, 0.008}, {157u, 0.1f, 0.005}})
            cases.push_back({kernel, k, radius, full() ? within / 4 : within});
    auto const means = on_even_floors(
        cases.size(), samples(4, 80), [&](PhotonMap const& map, float x, float y, std::vector<double>& sums) {
            for (std::size_t i = 0; i < cases.size(); ++i)
                sums[i] += static_cast<double>(
                    probe.reflected(map, rule(cases[i].kernel, cases[i].k, cases[i].radius), down_at(x, y))
                        .radiance[0]);
        });
    double const alpha = sidak(static_cast<int>(cases.size()));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        INFO(name_of(cases[i].kernel), ", k = ", cases[i].k, ", radius ", cases[i].radius);
        CHECK(agrees(means[i], 0.5 / kPiD, cases[i].within, alpha));
    }
}

TEST_CASE("the k-th photon must not count: the naive estimate is too bright by k / (k - 1)") {
    NearestPhotons nearest;
    constexpr std::uint32_t kNearest = 12;
    Mean const naive = on_even_floors(1, samples(4, 60),
                                      [&](PhotonMap const& map, float x, float y, std::vector<double>& sums) {
                                          map.nearest({x, y, 0}, kNearest, 1, nearest);
                                          float most = 0;
                                          Spectrum power;
                                          for (FoundPhoton const& f : nearest.found) {
                                              most = max(most, f.distance2);
                                              power += map[f.index].power();
                                          }
                                          sums[0] += static_cast<double>(power[0] / (kPi * most));
                                      })[0];
    CHECK(agrees(naive, 12.0 / 11.0, 0.02));
    CHECK_FALSE(agrees(naive, 1, 0.02).equal);
}

TEST_CASE("the nearest k among photons of another surface, and within half of their radius: still no bias") {
    // A wall stands beside each place: its photons are nearest to some degree, and are none of the floor's.
    World const world = floor_world(1);
    Probe probe(world);
    for (float const shrink : {1.0f, 0.5f}) {
        Mean mean;
        for (int batch = 0; batch < kBatches; ++batch) {
            Random random = numbers_of(batch);
            double sum = 0;
            int const maps = samples(60, 1000);
            for (int m = 0; m < maps; ++m) {
                std::vector<Photon> photons;
                scatter_over(photons, random, floor_quad(1), kUp, 1000);
                scatter_over(photons, random, {{0.05f, -1, 0}, {0, 2, 0}, {0, 0, 1}}, {-1, 0, 0}, 2000, 7);
                PhotonMap const map(std::move(photons));
                EstimateRule how = rule(Kernel::Box, 100, 5);
                how.shrink = shrink;
                Estimate const e = probe.irradiance(map, how, {0, 0, 0}, kUp);
                CHECK(e.photons < 99);
                sum += static_cast<double>(e.radiance[0]);
            }
            mean.add(sum / maps);
        }
        CHECK(agrees(mean, 1, 0.025, sidak(2)));
    }
}

TEST_CASE("curved surfaces lose no photons: spheres of two and three radii, from outside and from inside") {
    // A ball of radius r about a point of a sphere cuts out pi r^2 of it, whatever the sphere's radius, and squared distances are even
    // there: every kernel should be right.
    Scene s;
    add(s, Sphere{}, diffuse(s, 0.5f));
    World const world = compile(std::move(s));
    Probe probe(world);
    for (Kernel const kernel : kKernels)
        for (float const share : {2.0f, 3.0f})
            for (float const side : {1.0f, -1.0f}) {
                INFO(name_of(kernel), ", radius ", 1 / share, ", side ", side);
                Mean mean;
                for (int batch = 0; batch < kBatches; ++batch) {
                    Random random = numbers_of(batch);
                    std::vector<Photon> photons;
                    constexpr int kCount = 10000;
                    for (int i = 0; i < kCount; ++i) {
                        float const z = 2 * random.unit() - 1, phi = kTwoPi * random.unit();
                        Vec3 const p = spherical_direction(safe_sqrt(1 - z * z), z, phi);
                        photons.emplace_back(landed(p, side * p, 4 * kPi / kCount));
                    }
                    PhotonMap const map(std::move(photons));
                    double sum = 0;
                    constexpr int kPlaces = 40;
                    for (int i = 0; i < kPlaces; ++i) {
                        Vec3 const at = spherical_direction(
                            std::sqrt(1 - sqr(-0.975f + 0.05f * static_cast<float>(i))),
                            -0.975f + 0.05f * static_cast<float>(i), 2.4f * static_cast<float>(i));
                        sum += static_cast<double>(
                            probe.irradiance(map, rule(kernel, 0, 1 / share), at, side * at).radiance[0]);
                    }
                    mean.add(sum / kPlaces);
                }
                CHECK(agrees(mean, 1, 0.006, sidak(16)));
            }
}

TEST_CASE("photons of other sides, of other planes and of paths that are too long do not count") {
    World const world = floor_world(1);
    Probe probe(world);
    EstimateRule const how = rule(Kernel::Box, 0, 0.5f);
    auto const counted = [&](PhotonRecord const& r, std::uint32_t most = 99) {
        std::vector<Photon> photons{Photon(r)};
        return probe.reflected(PhotonMap(std::move(photons)), how, down_at(0, 0), most).photons == 1;
    };
    PhotonRecord photon = landed({0.1f, 0, 0}, kUp, 1);
    CHECK(counted(photon));
    photon.n = -kUp;
    CHECK_FALSE(counted(photon));
    photon.n = normalize(Vec3{1, 0, 1});  // the other side of a ridge
    CHECK(counted(photon));
    photon.n = {1, 0, 0};
    CHECK_FALSE(counted(photon));
    CHECK(counted(landed({0.1f, 0, 0.05f}, kUp, 1)));
    CHECK_FALSE(counted(landed({0.1f, 0, 0.2f}, kUp, 1)));  // a shelf
    CHECK_FALSE(counted(landed({0.51f, 0, 0}, kUp, 1)));
    // The photon's scatterings, the one at the surface, and those of the camera's path (none).
    photon = landed({0.1f, 0, 0}, kUp, 1);
    photon.bounces = 3;
    CHECK(counted(photon, 4));
    CHECK_FALSE(counted(photon, 3));
}

TEST_CASE("both ends in the hero's lane alone: it stands for all lanes once") {
    World const world = floor_world(1);
    Probe probe(world);
    PhotonRecord photon = landed({0, 0, 0}, kUp, 1);
    photon.power = Spectrum(4, 0, 0, 0);
    photon.hero_only = true;
    std::vector<Photon> photons{Photon(photon)};
    PhotonMap const map(std::move(photons));
    EstimateRule const how = rule(Kernel::Box, 0, 1);
    float const one = 0.5f * kInvPi * kInvPi;
    CHECK(probe.reflected(map, how, down_at(0, 0)).radiance[0] == doctest::Approx(4 * one));
    CHECK(probe.reflected(map, how, down_at(0, 0), 99, true).radiance[0] == doctest::Approx(one));
}

TEST_CASE(
    "thin walls do not leak: two faces a thousandth of the radius apart, one face, and one that light goes "
    "through") {
    for (float const thickness : {1e-3f, 0.0f}) {
        Scene s;
        MaterialId const grey = diffuse(s, 0.5f);
        add(s, floor_quad(1, thickness / 2), grey);
        if (thickness > 0) add(s, floor_quad(1, -thickness / 2), grey);
        World const world = compile(std::move(s));
        Probe probe(world);
        Random random(1);
        std::vector<Photon> photons;
        scatter_over(photons, random, floor_quad(1, thickness / 2), kUp, 5000);
        PhotonMap const map(std::move(photons));
        for (std::uint32_t const k : {0u, 50u}) {
            EstimateRule const how = rule(Kernel::Epanechnikov, k, 1);
            Estimate const dark = probe.reflected(map, how, {{0, 0, -1}, {0, 0, 1}});
            CHECK(dark.radiance.is_black());
            CHECK(dark.photons == 0);
            CHECK(probe.irradiance(map, how, {0, 0, -thickness / 2}, -kUp).radiance.is_black());
            CHECK_FALSE(probe.reflected(map, how, down_at(0, 0)).radiance.is_black());
        }
    }
    // Paper: lit from above by 1 and from below by 2, it shows both on both sides.
    Scene s;
    DiffuseTransmissionMaterial paper;
    paper.reflectance = spectrum(s, ConstantSpd{0.25f});
    paper.transmittance = spectrum(s, ConstantSpd{0.5f});
    add(s, floor_quad(1), material(s, paper));
    World const world = compile(std::move(s));
    Probe probe(world);
    std::vector<Photon> photons{Photon(landed({0, 0, 0}, kUp, 1)), Photon(landed({0, 0, 0}, -kUp, 2))};
    PhotonMap const map(std::move(photons));
    EstimateRule const how = rule(Kernel::Box, 0, 1);
    CHECK(probe.reflected(map, how, down_at(0, 0)).radiance[0] ==
          doctest::Approx((0.25f * 1 + 0.5f * 2) * kInvPi * kInvPi));
    CHECK(probe.reflected(map, how, {{0, 0, -1}, {0, 0, 1}}).radiance[0] ==
          doctest::Approx((0.25f * 2 + 0.5f * 1) * kInvPi * kInvPi));
}

TEST_CASE("corners of the data: no photons, all of them at one point, a radius of 0, k = 1") {
    World const world = floor_world(1);
    Probe probe(world);
    PhotonMap const none;
    std::vector<Photon> at_one_point;
    for (int i = 0; i < 1000; ++i) at_one_point.emplace_back(landed({0.5f, 0, 0}, kUp, 1e-3f));
    PhotonMap const heap(std::move(at_one_point));
    for (std::uint32_t const k : {0u, 1u, 2u, 50u, 5000u})
        for (float const radius : {0.0f, 1e-30f, 1.0f})
            for (float const x : {0.0f, 0.5f}) {
                CAPTURE(k);
                CAPTURE(radius);
                CHECK(
                    probe.reflected(none, rule(Kernel::Cone, k, radius), down_at(x, 0)).radiance.is_black());
                Estimate const e = probe.reflected(heap, rule(Kernel::Cone, k, radius), down_at(x, 0));
                CHECK(e.radiance.is_finite());
                CHECK(e.radiance[0] >= 0);
            }
    // The k-th alone is no estimate.
    CHECK(probe.reflected(heap, rule(Kernel::Cone, 1, 1), down_at(0, 0)).radiance.is_black());
}
