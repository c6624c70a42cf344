// Density estimates against fields whose irradiance is known: kernels, the photon that does not count, leaks, edges, shading normals, and the
// bias that is exactly what theory says.
#include "estimates.h"
#include "kernel.h"
#include "photon_plan.h"
#include "tilted_floor.h"
#include "transport/shooting.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {
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
            cases.push_back({kernel, k, radius, full() ? within / 4 : within * kSanitizerRoom});
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
    CHECK(agrees(naive, 12.0 / 11.0, 0.02 * kSanitizerRoom));
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
                if (m == 0) {
                    how.shrink = 1;
                    CHECK(e.radius ==
                          doctest::Approx(shrink * probe.irradiance(map, how, {0, 0, 0}, kUp).radius));
                }
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
        for (float const radius : {0.0f, 1e-30f, 1e-21f, 1.0f})
            for (float const x : {0.0f, 0.5f, 0.25f}) {
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

namespace {
/// A floor in z = 0 turned by `degrees` about the origin, which is its middle, a point of its edge or its corner; with walls
/// along its edges or without.
enum class Spot { Middle, Edge, Corner };
struct Bounded {
    Quad floor;
    std::vector<Quad> walls;
};
Bounded bounded(Spot spot, double degrees, bool walls) {
    auto const turned = [&](float x, float y) {
        double const c = std::cos(degrees * kPiD / 180), s = std::sin(degrees * kPiD / 180);
        return Vec3(c * x - s * y, s * x + c * y, 0);
    };
    float const x0 = spot == Spot::Middle ? -1 : 0, y0 = spot == Spot::Corner ? 0 : -1;
    Bounded b;
    b.floor = {turned(x0, y0), turned(1 - x0, 0), turned(0, 1 - y0)};
    if (walls && spot != Spot::Middle) b.walls.push_back({b.floor.origin, b.floor.edge_v, {0, 0, 1}});
    if (walls && spot == Spot::Corner) b.walls.push_back({b.floor.origin, {0, 0, 1}, b.floor.edge_u});
    return b;
}
}  // namespace

TEST_CASE("edges and corners: the raw estimate is a half or a quarter, the corrected one is right to 2%") {
    for (bool const walls : {false, true})
        for (Spot const spot : {Spot::Edge, Spot::Corner}) {
            double const raw = spot == Spot::Edge ? 0.5 : 0.25;
            for (double const degrees : {0.0, 17.0, 45.0, 71.0, 133.0}) {
                Bounded const b = bounded(spot, degrees, walls);
                Scene s;
                MaterialId const grey = diffuse(s, 0.5f);
                add(s, b.floor, grey);
                for (Quad const& wall : b.walls) add(s, wall, grey);
                World const world = compile(std::move(s));
                Probe probe(world);
                struct Case {
                    EstimateRule how;
                    Mean raw, corrected;
                };
                std::vector<Case> cases;
                for (Kernel const kernel : kKernels) {
                    for (float const radius : {0.1f, 0.3f, 0.6f})
                        cases.push_back({rule(kernel, 0, radius), {}, {}});
                    for (std::uint32_t const k : {60u, 250u}) cases.push_back({rule(kernel, k, 1), {}, {}});
                }
                Random random(1);
                for (int i = 0; i < samples(40, 400); ++i) {
                    std::vector<Photon> photons;
                    scatter_over(photons, random, b.floor, kUp, 20000);
                    for (Quad const& wall : b.walls)
                        scatter_over(photons, random, wall, normalize(cross(wall.edge_u, wall.edge_v)), 5000);
                    PhotonMap const map(std::move(photons));
                    for (Case& c : cases) {
                        c.how.edge_correction = false;
                        c.raw.add(
                            static_cast<double>(probe.irradiance(map, c.how, {0, 0, 0}, kUp).radiance[0]));
                        c.how.edge_correction = true;
                        c.corrected.add(
                            static_cast<double>(probe.irradiance(map, c.how, {0, 0, 0}, kUp).radiance[0]));
                    }
                }
                for (Case const& c : cases) {
                    INFO(std::string(spot == Spot::Edge ? "edge" : "corner"),
                         std::string(walls ? " with walls" : ""), " at ", degrees, " degrees, ",
                         name_of(c.how.kernel), ", k = ", c.how.k, ", radius ", c.how.radius);
                    double const noise = 3.5 * c.raw.standard_error() / raw;
                    CHECK(c.raw.mean() / raw == doctest::Approx(1).epsilon(noise));
                    CHECK(c.corrected.mean() == doctest::Approx(1).epsilon(0.02 + noise));
                }
            }
        }
}

TEST_CASE("what of a disk is surface: edges at any distance and angle, against sums over a fine grid") {
    World const world = floor_world(1);
    RayStats stats;
    double worst = 0;
    for (Kernel const kernel : kKernels)
        for (float const distance : {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
            // The share of the disk nearer than `distance` in one direction, and with a second edge across.
            double all = 0, half_plane = 0, quadrant = 0;
            with_kernel(kernel, [&](auto const& k) {
                constexpr int kFine = 1000;
                for (int i = 0; i < kFine; ++i)
                    for (int j = 0; j < kFine; ++j) {
                        float const x = (2 * static_cast<float>(i) + 1) / kFine - 1;
                        float const y = (2 * static_cast<float>(j) + 1) / kFine - 1;
                        if (x * x + y * y >= 1) continue;
                        auto const w = static_cast<double>(k(x * x + y * y));
                        all += w;
                        if (x < distance) half_plane += w;
                        if (x < distance && y < 0) quadrant += w;
                    }
            });
            constexpr float kRadius = 0.3f;
            auto const off = [&](Vec3 p, double exact) {
                double const found =
                    static_cast<double>(coverage(world, p, kUp, kRadius, kernel, stats).share);
                worst = std::max(worst, std::abs(found / exact - 1));
                INFO(name_of(kernel), ", ", distance, " from an edge: ", found, ", exactly ", exact);
                CHECK(std::abs(found / exact - 1) < (distance == 0 ? 0.005 : 0.06));
            };
            float const x = 1 - distance * kRadius;
            off({x, 0, 0}, half_plane / all);
            off({-x, 0, 0}, half_plane / all);
            off({0, x, 0}, half_plane / all);
            off({x, 1, 0}, quadrant / all);
            off({-x, -1, 0}, quadrant / all);
        }
    MESSAGE("the share is off by ", worst, " at most");
    CHECK(coverage(world, {0, 0, 0}, kUp, 0.3f, Kernel::Box, stats).share == 1);
}

TEST_CASE("beside a box that stands on a floor: corrected, and not where light comes from beyond a wall") {
    Scene s;
    MaterialId const grey = diffuse(s, 0.5f);
    add(s, floor_quad(1), grey);
    add(s, Box{{0, -1, 0}, {1, 1, 1}}, grey);
    World const boxed = compile(std::move(s));
    Scene t;
    add(t, floor_quad(1), diffuse(t, 0.5f));
    add(t, Quad{{0, -1, 0}, {0, 2, 0}, {0, 0, 1}}, diffuse(t, 0.5f));
    World const walled = compile(std::move(t));
    Probe beside_box(boxed), beside_wall(walled);
    Mean box, lit, dark, dark_raw;
    Random random(1);
    for (int i = 0; i < samples(200, 1000); ++i) {
        std::vector<Photon> photons;
        scatter_over(photons, random, Quad{{-1, -1, 0}, {1, 0, 0}, {0, 2, 0}}, kUp, 5000);
        PhotonMap const map(std::move(photons));
        EstimateRule how = rule(Kernel::Epanechnikov, 0, 0.3f);
        auto const at = [&](Probe& probe, float x) {
            return static_cast<double>(probe.irradiance(map, how, {x, 0, 0}, kUp).radiance[0]);
        };
        how.edge_correction = true;
        box.add(at(beside_box, -0.003f));
        lit.add(at(beside_wall, -0.003f));
        dark.add(at(beside_wall, 0.003f));
        how.edge_correction = false;
        dark_raw.add(at(beside_wall, 0.003f));
    }
    CHECK(box.mean() == doctest::Approx(1).epsilon(0.02));
    CHECK(lit.mean() == doctest::Approx(1).epsilon(0.02));
    // The floor on the wall's dark side does borrow from beyond, within the radius; no more with the correction than without.
    CHECK(dark.mean() == dark_raw.mean());
}

TEST_CASE("shading normals: photons weigh by the facet that they landed on") {
    // A flat roof, smoothed: facets tilted by 5 degrees to either side, shaded as one level plane. Light that grazes one facet falls
    // three times as densely on the other.
    float const slope = std::tan(radians(5));
    TriangleMesh roof = rectangle({-1, -1, -slope}, {0, -1, 0}, {0, 1, 0}, {-1, 1, -slope});
    TriangleMesh const other = rectangle({0, -1, 0}, {1, -1, -slope}, {1, 1, -slope}, {0, 1, 0});
    roof.p.insert(roof.p.end(), other.p.begin(), other.p.end());
    roof.triangles.insert(roof.triangles.end(), {{4, 5, 6}, {4, 6, 7}});
    roof.n.assign(8, kUp);
    Scene s;
    add(s, roof, diffuse(s, 0.5f));
    World const world = compile(std::move(s));
    Probe probe(world);
    for (double const degrees : {0.0, 60.0, 80.0}) {
        Vec3 const wi(std::sin(degrees * kPiD / 180), 0, std::cos(degrees * kPiD / 180));
        std::vector<Photon> photons;
        Random random(1);
        for (float const side : {-1.0f, 1.0f}) {
            Quad const facet{{side < 0 ? -0.5f : 0.0f, -0.5f, side < 0 ? -0.5f * slope : 0.0f},
                             {0.5f, 0, -side * 0.5f * slope},
                             {0, 1, 0}};
            Vec3 const n = normalize(cross(facet.edge_u, facet.edge_v));
            std::size_t const first = photons.size();
            scatter_over(photons, random, facet, n, 100000, dot(wi, n));
            for (std::size_t i = first; i < photons.size(); ++i) {
                PhotonRecord r = landed(photons[i].p(), n, photons[i].power()[0]);
                r.wi = wi;
                photons[i] = Photon(r);
            }
        }
        PhotonMap const map(std::move(photons));
        double const found = static_cast<double>(
            probe.reflected(map, rule(Kernel::Box, 0, 0.4f), down_at(-1e-4f, 0)).radiance[0]);
        INFO("light from ", degrees, " degrees");
        CHECK(found == doctest::Approx(0.5 / kPiD * std::cos(degrees * kPiD / 180)).epsilon(0.03));
    }
}

namespace {
/// Photons of all bounces shown as they are, with no help from elsewhere; alpha = 1 leaves the radius as it is.
SppmIntegrator shown(Kernel kernel, float radius, int paths, float alpha = 1) {
    SppmIntegrator p;
    p.alpha = alpha;
    p.visualize = PhotonView::Global;
    p.estimates.kernel = kernel;
    p.estimates.radius = radius;
    p.shooting.global_paths = paths;
    p.shooting.caustic_paths = 0;
    return p;
}
/// A light of 1 W/sr one above a floor, from which it sends only what is needed: a cone that is a little wider than a disk of
/// radius .2 there.
World below_a_light(float reflectance) {
    Scene s;
    add(s, floor_quad(0.5f), diffuse(s, reflectance));
    SpotLight l;
    l.from = {0, 0, 1};
    l.to = {0, 0, 0};
    l.cone_angle = 0.21f;  // atan .2 = .1974
    l.cone_delta = 0;
    s.add(Light{l, {}, {}});
    look_at_point(s, {0, 0, 2}, {0, 0, 0});
    return compile(std::move(s));
}
/// E in the middle, averaged over a disk of radius r, where it is 1.
double averaged(double r) { return 2 * (1 - 1 / std::sqrt(1 + r * r)) / (r * r); }
}  // namespace

TEST_CASE("the exact biased value: below a point light, averaged over the disk") {
    CHECK(averaged(0.2) == doctest::Approx(0.970966).epsilon(1e-6));
    World const world = below_a_light(0.5f);
    Settings const how = point_settings(shown(Kernel::Box, 0.2f, 2000), 1, 1);
    check_mean(world, how, 2, 0.5 / kPiD * averaged(0.2));
}

TEST_CASE("progressive: the bias of 1000 passes is the mean of theirs") {
    double expected = 0;
    for (std::uint64_t i = 0; i < 1000; ++i)
        expected += averaged(static_cast<double>(PhotonPlan::shrunk(0.2f, 2.0f / 3, i))) / 1000;
    CHECK(expected == doctest::Approx(0.995090).epsilon(1e-6));
    World const world = below_a_light(0.5f);
    Settings const how = point_settings(shown(Kernel::Box, 0.2f, samples(100, 2000), 2.0f / 3), 1, 1);
    auto const means = measure(world, how, 1000);
    auto const a = agrees(means[0][1], 0.5 / kPiD * expected, full() ? 0.001 : 0.002);
    INFO(a);
    CHECK(a);
    CHECK_FALSE(agrees(means[0][1], 0.5 / kPiD, 0.002).equal);  // this well one sees that it is not 1
}

TEST_CASE("progressive: the squared error falls by the number of passes to the power of -2/3") {
    // Squared bias and variance of the mean of n passes, exactly: a pass's photons are so many draws that hit the disk or do not.
    constexpr int kPaths = 40;
    double const cone = 2 * kPiD * (1 - std::cos(0.21));
    auto const squared_error = [&](std::uint64_t n) {
        double mean = 0, variance = 0;
        for (std::uint64_t i = 0; i < n; ++i) {
            auto const r = static_cast<double>(PhotonPlan::shrunk(0.2f, 2.0f / 3, i));
            double const hits = averaged(r) * kPiD * r * r / cone;
            mean += averaged(r);
            variance += hits * (1 - hits) / kPaths * std::pow(cone / (kPiD * r * r), 2);
        }
        auto const passes = static_cast<double>(n);
        return std::pow(mean / passes - 1, 2) + variance / (passes * passes);
    };
    CHECK(std::log(squared_error(1 << 18) / squared_error(1 << 12)) / std::log(64.0) ==
          doctest::Approx(-2.0 / 3).epsilon(0.01));
    World const world = below_a_light(0.5f);
    Settings how = point_settings(shown(Kernel::Box, 0.2f, kPaths, 2.0f / 3), 1, 1);
    how.sampler = IndependentSampler{};  // well spread photons do better than the law
    std::vector<std::uint64_t> counts{16, 64, 256};
    if (full()) counts = {128, 256, 512, 1024, 2048};
    std::vector<double> squares(counts.size());
    int const batches = samples(100, 1500);
    RayStats stats;
    for (int batch = 0; batch < batches; ++batch) {
        how.seed = static_cast<std::uint64_t>(batch);
        RenderJob const job(world, how);
        Film film = job.make_film();
        std::uint64_t done = 0;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            for (; done < counts[i]; ++done) render_pass(job, done, film, stats);
            PixelSums const& p = film.pixel(0, 0);
            double const error = p.rgb[1] / p.weight / (0.5 / kPiD) - 1;
            squares[i] += error * error / batches;
        }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        INFO("passes: ", counts[i]);
        // Squares of so many draws; 3.5 standard deviations.
        CHECK(squares[i] / squared_error(counts[i]) ==
              doctest::Approx(1).epsilon(3.5 * std::sqrt(2.0 / batches)));
    }
    if (full()) {
        double const slope =
            std::log(squares.back() / squares.front()) /
            std::log(static_cast<double>(counts.back()) / static_cast<double>(counts.front()));
        MESSAGE("slope ", slope);
        CHECK(std::abs(slope + 2.0 / 3) < 0.05);
    }
}

TEST_CASE("photons on a floor whose normals are tilted by 30 degrees: rho E cos 30 / pi") {
    World const w = compile(tilted_floor_lit_from_above());
    for (Kernel const kernel : kKernels)
        check_mean(w, settings(shown(kernel, 0.2f, 4000)), 4, 0.6 * std::cos(kPiD / 6) / kPiD);
}

TEST_CASE("a room behind a thin wall is black in every estimate of photons") {
    // A room beside a larger one, a thousandth of the radius of wall between them; the light is in the larger, the camera in the other.
    Scene s;
    MaterialId const grey = diffuse(s, 0.5f);
    add(s, Box{{-1, -1, -1}, {0, 1, 1}}, grey);
    add(s, Box{{1e-4f, -0.7f, -0.7f}, {1, 0.7f, 0.7f}}, grey);
    s.add(point_light({-0.3f, 0, 0}, 1));
    look_around(s, {0.5f, 0.1f, 0.2f});
    World const dark = compile(std::move(s));
    for (int const nused : {0, 50}) {
        SppmIntegrator sppm = shown(Kernel::Epanechnikov, 0.1f, 5000);
        sppm.estimates.nused = nused;
        check_mean(dark, settings(sppm, 8, 8), 1, 0.0);
        sppm.visualize = PhotonView::None;
        check_mean(dark, settings(sppm, 8, 8), 1, 0.0);
        PhotonMapIntegrator maps;
        maps.shooting.global_paths = 5000;
        maps.estimates.nused = nused;
        maps.estimates.radius = 0.1f;
        maps.visualize = PhotonView::Radiance;
        check_mean(dark, settings(maps, 8, 8), 1, 0.0);
    }
}
