// What photon maps find is what looking at every photon finds, wherever the photons are, and the map does not depend on threads.
#include "transport/photon_map.h"
#include "statistics.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <tuple>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

using namespace nephroid;
using nephroid::test::Random;

namespace {

/// Photons that know which they were, in their power.
std::vector<Photon> photons_at(std::vector<Vec3> const& places) {
    std::vector<Photon> photons;
    for (std::size_t i = 0; i < places.size(); ++i) {
        PhotonRecord r;
        r.p = places[i];
        r.power = Spectrum(static_cast<float>(i + 1));
        photons.emplace_back(r);
    }
    return photons;
}
Vec3 in_cube(Random& random) { return {random.unit(), random.unit(), random.unit()}; }

struct Cloud {
    char const* name;
    Vec3 (*place)(Random&);
};
Cloud const kClouds[] = {
    {"in a cube", [](Random& r) { return in_cube(r); }},
    {"on a plane",
     [](Random& r) {
         return Vec3{r.unit(), 0.25f, r.unit()};
     }},
    {"on a curve, with strays",
     [](Random& r) {
         if (r.below(10) == 0) return in_cube(r) * 100.0f;
         float const t = r.unit() * kTwoPi;
         return Vec3{std::cos(t), std::sin(t), 1e-3f * r.unit()};
     }},
    {"at few places, many at each",
     [](Random& r) {
         return Vec3(static_cast<float>(r.below(7)), static_cast<float>(r.below(5)), 0) * 0.125f;
     }},
    {"at one place",
     [](Random&) {
         return Vec3{0.5f, 0.25f, 0.75f};
     }},
    {"small", [](Random& r) { return in_cube(r) * 1e-3f; }},
    {"large", [](Random& r) { return in_cube(r) * 1e5f; }},
    {"far from the origin",
     [](Random& r) {
         return in_cube(r) + Vec3{1e5f, -2e4f, 3e4f};
     }},
    {"huge and sparse", [](Random& r) { return (in_cube(r) - Vec3(0.5f)) * std::exp(40.0f * r.unit()); }},
};

std::vector<Vec3> places_of(Cloud const& cloud, std::size_t n, std::uint64_t seed) {
    Random random(seed);
    std::vector<Vec3> places(n);
    for (Vec3& p : places) p = cloud.place(random);
    return places;
}

/// Squared distances of all photons, the nearest first.
std::vector<float> all_distances(std::vector<Vec3> const& places, Vec3 p) {
    std::vector<float> d2;
    for (Vec3 const q : places) d2.push_back(dot(q - p, q - p));
    std::sort(d2.begin(), d2.end());
    return d2;
}
std::vector<float> nearer_than(std::vector<float> const& sorted, float radius) {
    return {sorted.begin(), std::lower_bound(sorted.begin(), sorted.end(), radius * radius)};
}

/// Found distances are sorted; each photon is where its distance says, and found once.
struct Found {
    std::vector<float> d2;
    bool sound = true;
};
Found sorted_out(PhotonMap const& map, Vec3 p, std::span<FoundPhoton const> found) {
    Found out;
    std::vector<std::uint32_t> indices;
    for (FoundPhoton const f : found) {
        out.d2.push_back(f.distance2);
        indices.push_back(f.index);
        Vec3 const d = map[f.index].p() - p;
        out.sound &= f.index < map.size() && f.distance2 == dot(d, d);
    }
    std::sort(out.d2.begin(), out.d2.end());
    std::sort(indices.begin(), indices.end());
    out.sound &= std::adjacent_find(indices.begin(), indices.end()) == indices.end();
    return out;
}
Found within(PhotonMap const& map, Vec3 p, float radius) {
    std::vector<FoundPhoton> found;
    map.within(p, radius, [&](std::uint32_t i, float d2) { found.push_back({d2, i}); });
    return sorted_out(map, p, found);
}
Found nearest(PhotonMap const& map, Vec3 p, std::uint32_t k, float most, NearestPhotons& room) {
    map.nearest(p, k, most, room);
    return sorted_out(map, p, room.found);
}

/// Within which a photon in the middle of the list has fifty others or so.
float radius_for(std::vector<Vec3> const& places) {
    if (places.size() < 2) return 1.0f;
    auto const all = all_distances(places, places[places.size() / 2]);
    float const d2 = all[std::min<std::size_t>(50, all.size() - 1)];
    return d2 > 0.0f ? std::sqrt(d2) : 1.0f;
}

/// Queries at, near and far from photons, with few and many, against looking at every photon. Returns the number of wrong ones.
int wrong_answers(PhotonMap const& map, std::vector<Vec3> const& places, Cloud const& cloud, int queries,
                  std::uint64_t seed) {
    Random random(seed);
    NearestPhotons room;
    int wrong = 0;
    for (int i = 0; i < queries; ++i) {
        Vec3 p = cloud.place(random);
        if (!places.empty() && random.below(4) == 0)
            p = places[random.below(static_cast<std::uint32_t>(places.size()))];
        if (random.below(8) == 0) p = p * 1.5f + in_cube(random);
        auto const all = all_distances(places, p);
        std::uint32_t const ks[] = {1, 2, 10, 50, 300, 5000};
        std::uint32_t const k = ks[random.below(6)];
        // A radius that holds some; the distance of one of them exactly, in one query of two, which then is out.
        float radius = 1.0f;
        if (!all.empty()) {
            auto const farthest = std::min<std::size_t>(all.size() - 1, random.below(200));
            radius = std::sqrt(all[farthest]) * (random.below(2) ? 1.0f : 1.001f);
        }
        float const most = random.below(2) ? radius : kInfinity;
        auto expected = nearer_than(all, most);
        expected.resize(std::min<std::size_t>(expected.size(), k));
        auto const found = nearest(map, p, k, most, room);
        auto const inside = within(map, p, radius);
        wrong +=
            !(found.sound && inside.sound && found.d2 == expected && inside.d2 == nearer_than(all, radius));
    }
    return wrong;
}

std::string bytes_of(PhotonMap const& map) {
    std::string bytes(map.size() * sizeof(Photon), '\0');
    for (std::size_t i = 0; i < map.size(); ++i)
        std::memcpy(bytes.data() + i * sizeof(Photon), &map[i], sizeof(Photon));
    return bytes;
}

/// What a map says in the order in which it says it: that of its nodes and cells.
std::vector<std::uint32_t> answers(PhotonMap const& map, std::vector<Vec3> const& places) {
    std::vector<std::uint32_t> found;
    NearestPhotons room;
    float const radius = radius_for(places);
    for (std::size_t i = 0; i < places.size(); i += places.size() / 20) {
        map.within(places[i], radius, [&](std::uint32_t index, float) { found.push_back(index); });
        map.nearest(places[i], 30, 2 * radius, room);
        for (FoundPhoton const& f : room.found) found.push_back(f.index);
    }
    return found;
}

}  // namespace

TEST_CASE("a photon map finds what looking at every photon finds: 10^5 queries") {
    int const queries = test::samples(11200, 100000);  // for each of nine clouds: 10^5 in all
    for (Cloud const& cloud : kClouds) {
        CAPTURE(cloud.name);
        auto const places = places_of(cloud, 997, 1);
        PhotonMap const map(photons_at(places));
        CHECK(wrong_answers(map, places, cloud, queries, 2) == 0);
        PhotonMap const grid(photons_at(places), radius_for(places));
        CHECK(wrong_answers(grid, places, cloud, queries / 8, 2) == 0);
    }
}

TEST_CASE("photon maps of every small size, and of many photons") {
    for (Cloud const& cloud : kClouds) {
        CAPTURE(cloud.name);
        for (std::size_t n :
             {0, 1, 2, 3, 7, 8, 9, 15, 16, 17, 63, 64, 65, 66, 127, 129, 511, 512, 513, 4097}) {
            CAPTURE(n);
            auto const places = places_of(cloud, n, 3 + n);
            PhotonMap const map(photons_at(places));
            CHECK(map.size() == n);
            CHECK(wrong_answers(map, places, cloud, 40, 4) == 0);
            for (float factor : {0.1f, 1.0f, 100.0f}) {
                PhotonMap const grid(photons_at(places), factor * radius_for(places));
                CHECK(grid.size() == n);
                CHECK(wrong_answers(grid, places, cloud, 20, 4) == 0);
            }
        }
        auto const places = places_of(cloud, static_cast<std::size_t>(test::samples(150000, 2000000)), 5);
        PhotonMap const map(photons_at(places));
        CHECK(wrong_answers(map, places, cloud, 12, 6) == 0);
        PhotonMap const grid(photons_at(places), radius_for(places));
        CHECK(wrong_answers(grid, places, cloud, 12, 6) == 0);
    }
}

TEST_CASE("every photon is in the map, once") {
    for (Cloud const& cloud : kClouds) {
        CAPTURE(cloud.name);
        auto const places = places_of(cloud, 30001, 7);
        for (float radius : {0.0f, radius_for(places)}) {
            PhotonMap const map(photons_at(places), radius);
            std::vector<bool> seen(places.size(), false);
            int wrong = map.size() != places.size();
            for (std::size_t i = 0; i < map.size(); ++i) {
                auto const which = static_cast<std::size_t>(map[i].power()[0] + 0.5f) - 1;
                wrong += !(which < places.size() && !seen[which] && map[i].p() == places[which]);
                if (which < places.size()) seen[which] = true;
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("a photon map is the same on any number of threads") {
    tbb::global_control const more(tbb::global_control::max_allowed_parallelism, 8);
    for (Cloud const& cloud : kClouds) {
        CAPTURE(cloud.name);
        auto const places = places_of(cloud, 200000, 8);
        auto const photons = photons_at(places);
        for (float radius : {0.0f, radius_for(places)}) {
            auto const on = [&](int threads) {
                PhotonMap map;
                tbb::task_arena arena(threads);
                arena.execute([&] { map = PhotonMap(photons, radius); });
                return map;
            };
            PhotonMap const one = on(1);
            for (int threads : {2, 7}) {
                PhotonMap const other = on(threads);
                CHECK(bytes_of(other) == bytes_of(one));
                CHECK(answers(other, places) == answers(one, places));
            }
        }
    }
}

TEST_CASE("odd questions") {
    auto const places = places_of(kClouds[0], 1000, 9);
    float const nan = std::numeric_limits<float>::quiet_NaN();
    for (float for_radius : {0.0f, 0.1f, 1e-5f, 10.0f, nan, kInfinity}) {
        CAPTURE(for_radius);
        PhotonMap const map(photons_at(places), for_radius);
        NearestPhotons room;
        Vec3 const p{0.5f, 0.5f, 0.5f};
        {  // k = 0
            CHECK(nearest(map, p, 0, kInfinity, room).d2.empty());
        }
        {  // k is the largest number

            CHECK(nearest(map, p, ~0u, kInfinity, room).d2 == all_distances(places, p));
        }
        {  // no radius, and none that is one

            for (float radius : {0.0f, -1.0f, nan, -kInfinity, 1e-30f}) {
                CHECK(within(map, places[0], radius).d2.empty());
                CHECK(nearest(map, places[0], 5, radius, room).d2.empty());
            }
        }
        {  // at no place

            for (Vec3 const q : {Vec3{nan, 0, 0}, Vec3{0, nan, 0}, Vec3{0, 0, nan}, Vec3{kInfinity, 0, 0},
                                 Vec3(-kInfinity)}) {
                CHECK(within(map, q, kInfinity).d2.empty());
                CHECK(nearest(map, q, 5, kInfinity, room).d2.empty());
            }
        }
        {  // everywhere
            CHECK(within(map, p, kInfinity).d2 == all_distances(places, p));
        }
        {  // an answer replaces the one before

            nearest(map, p, 400, kInfinity, room);
            CHECK(room.found.size() == 400);
            nearest(map, p, 3, kInfinity, room);
            CHECK(room.found.size() == 3);
            nearest(PhotonMap(), p, 3, kInfinity, room);
            CHECK(room.found.empty());
        }
    }
}

TEST_CASE("photons at places that are not finite are left out") {
    auto places = places_of(kClouds[0], 1000, 10);
    auto const sound = std::vector<Vec3>(places.begin() + 3, places.end());
    places[0].x = std::numeric_limits<float>::quiet_NaN();
    places[1].y = kInfinity;
    places[2].z = -kInfinity;
    PhotonMap const map(photons_at(places));
    CHECK(map.size() == 997);
    CHECK(wrong_answers(map, sound, kClouds[0], 100, 11) == 0);
}

TEST_CASE("a photon map needs 48 bytes a photon") {
    for (Cloud const& cloud : kClouds) {
        CAPTURE(cloud.name);
        auto const places = places_of(cloud, 100000, 12);
        for (float radius : {0.0f, 1e-6f, radius_for(places)}) {
            PhotonMap const map(photons_at(places), radius);
            CHECK(map.bytes() < 48 * map.size() + 1000);
        }
    }
    CHECK(PhotonMap().bytes() == 0);
}
