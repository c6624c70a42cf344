// Photon maps beside nanoflann: building and asking, on one thread, over three kinds of scenes. Prints the tables of
// docs/decisions/0008-photon-map-structure.md.
//
// All structures do the same queries in turn, so that they see the same machine; medians are reported. A query adds up squared
// distances, nothing else, and the sums must agree.
#include "math/bounds.h"
#include "timing.h"
#include "transport/photon_map.h"

#include <CLI/CLI.hpp>
#include <nanoflann.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

namespace nephroid {

using bench::median;
using bench::seconds_of;

namespace {

// --- places -----------------------------------------------------------------------------------------------------------------
class Places {
  public:
    explicit Places(std::uint64_t seed) : random_(seed) {}
    float uniform(float a, float b) { return std::uniform_real_distribution<float>(a, b)(random_); }
    float normal() { return std::normal_distribution<float>()(random_); }

    /// On the six walls of a cube of side `side`.
    Vec3 on_walls(float side) {
        Vec3 p{uniform(0, side), uniform(0, side), uniform(0, side)};
        auto const wall = static_cast<int>(uniform(0, 5.999f));
        p[wall / 2] = wall % 2 ? side : 0.0f;
        return p;
    }
    /// Nine of ten along a nephroid on the floor, a fifth of a percent of the room wide.
    Vec3 caustic() {
        if (uniform(0, 1) < 0.1f) return on_walls(1);
        float const t = uniform(0, kTwoPi), w = 0.002f;
        return {0.5f + 0.1f * (3 * std::cos(t) - std::cos(3 * t)) + w * normal(),
                0.5f + 0.1f * (3 * std::sin(t) - std::sin(3 * t)) + w * normal(), 0};
    }
    /// Four of five in twenty spots one unit wide, on the ground of a scene of a thousand.
    Vec3 large() {
        if (uniform(0, 1) < 0.2f) return on_walls(1000);
        auto const spot = static_cast<float>(static_cast<int>(uniform(0, 19.999f)));
        float const x = std::fmod(spot * 618.034f, 1000.0f), y = std::fmod(spot * 324.717f, 1000.0f);
        return {x + normal(), y + normal(), std::floor(uniform(0, 3)) * 0.5f};
    }

  private:
    std::mt19937_64 random_;
};

struct Scene {
    char const* name;
    Vec3 (*place)(Places&);
};
constexpr Scene kScenes[] = {{"uniform, on walls", [](Places& p) { return p.on_walls(1); }},
                             {"caustic, 90% on a curve", [](Places& p) { return p.caustic(); }},
                             {"large, 80% in 20 spots", [](Places& p) { return p.large(); }}};

std::vector<Vec3> make_places(Scene const& scene, std::size_t n, std::uint64_t seed) {
    Places places(seed);
    std::vector<Vec3> made(n);
    for (Vec3& p : made) p = scene.place(places);
    return made;
}

std::uint64_t spread(std::uint64_t x) {  // two zeros after each of 21 bits
    x = (x | x << 32) & 0x1f00000000ffffull;
    x = (x | x << 16) & 0x1f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
}
/// As tiles bring them: neighbours follow each other.
std::vector<Vec3> sorted(std::vector<Vec3> const& places) {
    Bounds3 b;
    for (Vec3 const p : places) b.add(p);
    auto const key = [&](Vec3 p) {
        std::uint64_t bits = 0;
        for (int a = 0; a < 3; ++a)
            bits |= spread(static_cast<std::uint64_t>((p[a] - b.lo[a]) / (b.hi[a] - b.lo[a] + 1e-20f) *
                                                      2097151.0f))
                    << a;
        return bits;
    };
    std::vector<std::pair<std::uint64_t, Vec3>> keyed;
    keyed.reserve(places.size());
    for (Vec3 const p : places) keyed.emplace_back(key(p), p);
    std::stable_sort(keyed.begin(), keyed.end(),
                     [](auto const& a, auto const& c) { return a.first < c.first; });
    std::vector<Vec3> out;
    out.reserve(places.size());
    for (auto const& [bits, p] : keyed) out.push_back(p);
    return out;
}

// --- structures -------------------------------------------------------------------------------------------------------------
struct Structure {
    virtual ~Structure() = default;
    virtual double nearest(std::span<Vec3 const> at, std::uint32_t k, float most) = 0;
    virtual double within(std::span<Vec3 const> at, float radius) = 0;
};

struct Ours final : Structure {
    PhotonMap map;
    NearestPhotons room;
    explicit Ours(std::vector<Photon> photons, float for_radius = 0) : map(std::move(photons), for_radius) {}
    double nearest(std::span<Vec3 const> at, std::uint32_t k, float most) override {
        double sum = 0;
        for (Vec3 const p : at) {
            map.nearest(p, k, most, room);
            float s = 0;
            for (FoundPhoton const& f : room.found) s += f.distance2;
            sum += s;
        }
        return sum;
    }
    double within(std::span<Vec3 const> at, float radius) override {
        double sum = 0;
        for (Vec3 const p : at) {
            float s = 0;
            map.within(p, radius, [&](std::uint32_t, float d2) { s += d2; });
            sum += s;
        }
        return sum;
    }
};

struct Cloud {
    std::vector<Vec3> points;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<int>(axis)];
    }
    template <class B>
    bool kdtree_get_bbox(B&) const {
        return false;
    }
};
/// The k nearest within a radius, as a heap.
class HeapSet {
  public:
    using DistanceType = float;
    std::vector<std::pair<float, std::uint32_t>> heap;
    void begin(std::size_t k, float most) { heap.clear(), k_ = k, most_ = most; }
    [[nodiscard]] bool full() const { return heap.size() == k_; }
    [[nodiscard]] float worstDist() const { return heap.size() == k_ ? heap.front().first : most_; }
    bool addPoint(float d, std::uint32_t i) {
        if (d >= worstDist()) return true;
        if (heap.size() == k_) {
            std::pop_heap(heap.begin(), heap.end());
            heap.back() = {d, i};
        } else {
            heap.emplace_back(d, i);
        }
        std::push_heap(heap.begin(), heap.end());
        return true;
    }

  private:
    std::size_t k_ = 0;
    float most_ = 0;
};
struct SumSet {
    using DistanceType = float;
    float radius2, sum = 0;
    [[nodiscard]] bool full() const { return true; }
    [[nodiscard]] float worstDist() const { return radius2; }
    bool addPoint(float d, std::uint32_t) {
        if (d < radius2) sum += d;
        return true;
    }
};
struct Nanoflann final : Structure {
    using Tree =
        nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud, float, std::uint32_t>,
                                            Cloud, 3, std::uint32_t>;
    Cloud cloud;
    std::unique_ptr<Tree> tree;
    HeapSet heap;
    explicit Nanoflann(std::vector<Photon> const& photons, float leaf) {
        cloud.points.reserve(photons.size());
        for (Photon const& p : photons) cloud.points.push_back(p.p());
        tree = std::make_unique<Tree>(
            3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(static_cast<std::size_t>(leaf)));
        tree->buildIndex();
    }
    double nearest(std::span<Vec3 const> at, std::uint32_t k, float most) override {
        double sum = 0;
        for (Vec3 const p : at) {
            float s = 0;
            heap.begin(k, most * most);
            tree->findNeighbors(heap, &p.x, nanoflann::SearchParams());
            for (auto const& f : heap.heap) s += f.first;
            sum += s;
        }
        return sum;
    }
    double within(std::span<Vec3 const> at, float radius) override {
        double sum = 0;
        for (Vec3 const p : at) {
            SumSet set{radius * radius};
            tree->findNeighbors(set, &p.x, nanoflann::SearchParams());
            sum += set.sum;
        }
        return sum;
    }
};

// --- measuring --------------------------------------------------------------------------------------------------------------
struct Options {
    std::vector<std::size_t> photons{100000};
    int repetitions = 5;
    std::string only;
};

/// Median distance of the k-th photon from where photons are.
float typical_distance(PhotonMap const& map, std::span<Vec3 const> at, std::uint32_t k) {
    NearestPhotons room;
    std::vector<double> farthest;
    for (std::size_t i = 0; i < at.size(); i += at.size() / 1000) {
        map.nearest(at[i], k, kInfinity, room);
        float most = 0;
        for (FoundPhoton const& f : room.found) most = std::max(most, f.distance2);
        farthest.push_back(std::sqrt(most));
    }
    return static_cast<float>(median(farthest));
}

std::vector<Photon> make_photons(Scene const& scene, std::size_t n) {
    std::vector<Photon> photons;
    photons.reserve(n);
    for (Vec3 const p : make_places(scene, n, 1)) {
        PhotonRecord record;
        record.p = p;
        photons.emplace_back(record);
    }
    return photons;
}

using Make = std::function<std::unique_ptr<Structure>(std::vector<Photon>)>;
Make grid_for(float radius) {
    return [radius](std::vector<Photon> p) { return std::make_unique<Ours>(std::move(p), radius); };
}
Make const kTree = grid_for(0);  // for none: a tree
Make const kNanoflann = [](std::vector<Photon> const& p) { return std::make_unique<Nanoflann>(p, 10.0f); };

/// Medians of `repetitions` rounds, in each of which all have their turn.
std::vector<double> in_turn(std::size_t n, int repetitions,
                            std::function<double(std::size_t)> const& seconds) {
    std::vector<std::vector<double>> all(n);
    for (int i = 0; i < repetitions; ++i)
        for (std::size_t m = 0; m < n; ++m) all[m].push_back(seconds(m));
    std::vector<double> medians;
    for (auto& times : all) medians.push_back(median(times));
    return medians;
}

/// Builds all, on one thread, and prints how long that takes.
std::vector<std::unique_ptr<Structure>> build(std::vector<Make> const& makers,
                                              std::vector<Photon> const& photons, int repetitions) {
    std::vector<std::unique_ptr<Structure>> made(makers.size());
    tbb::task_arena one(1);
    auto const times = in_turn(makers.size(), repetitions, [&](std::size_t m) {
        made[m].reset();
        auto copy = photons;
        double t = 0;
        one.execute([&] { t = seconds_of([&] { made[m] = makers[m](std::move(copy)); }); });
        return t;
    });
    for (std::size_t m = 0; m < times.size(); ++m)
        std::printf("%s%.3g", m == 0 ? " | " : " / ", 1e3 * times[m]);
    return made;
}

void measure(Scene const& scene, std::size_t n, Options const& o) {
    auto const photons = make_photons(scene, n);
    int const repetitions = n > 2000000 ? std::min(o.repetitions, 3) : o.repetitions;
    auto const queries = make_places(scene, 100000, 2);
    auto const in_order = sorted(queries);
    // Asks all of them, in the order of tiles and then at random, and prints nanoseconds.
    auto const ask = [&](std::vector<Structure*> const& all, std::size_t count, auto&& f) {
        for (bool const tiles : {true, false}) {
            // A part of the picture, where it is not the whole.
            std::span<Vec3 const> const at =
                tiles ? std::span<Vec3 const>(in_order).subspan((in_order.size() - count) / 2, count)
                      : std::span<Vec3 const>(queries).first(count);
            std::vector<double> sums(all.size());
            auto const times = in_turn(all.size(), repetitions, [&](std::size_t m) {
                return seconds_of([&] { sums[m] = f(*all[m], at); });
            });
            for (double const sum : sums)
                if (!(std::abs(sum - sums[0]) <= 1e-4 * sums[0]))
                    std::fprintf(stderr, "the sums differ: %g %g\n", sum, sums[0]);
            for (std::size_t m = 0; m < times.size(); ++m)
                std::printf("%s%.0f", m > 0 ? " / " : (tiles ? " | " : ", "),
                            1e9 * times[m] / static_cast<double>(count));
            std::fflush(stdout);
        }
    };
    std::printf("| %s | %.0e", scene.name, static_cast<double>(n));
    auto made = build({kTree, kNanoflann}, photons, repetitions);
    std::vector<Structure*> all{made[0].get(), made[1].get()};
    auto const& map = static_cast<Ours const&>(*made[0]).map;
    for (std::uint32_t const k : {50u, 100u, 500u})
        ask(all, 5000000 / k, [k](Structure& s, auto at) { return s.nearest(at, k, kInfinity); });
    float const most = typical_distance(map, queries, 50);
    ask(all, 100000, [most](Structure& s, auto at) { return s.nearest(at, 50, most); });
    for (std::uint32_t const k : {10u, 100u}) {
        float const radius = typical_distance(map, queries, k);
        auto grid = build({grid_for(radius)}, photons, repetitions);
        all = {made[0].get(), grid[0].get(), made[1].get()};
        ask(all, 100000, [radius](Structure& s, auto at) { return s.within(at, radius); });
    }
    std::printf(" |\n");
}

}  // namespace

}  // namespace nephroid

int main(int argc, char** argv) {
    using namespace nephroid;
    Options o;
    CLI::App app("photon maps beside nanoflann");
    app.add_option("--photons", o.photons, "how many, any number of times");
    app.add_option("--repetitions", o.repetitions, "of each measurement; the median is printed");
    app.add_option("--only", o.only, "scenes whose name holds this");
    CLI11_PARSE(app, argc, argv);
    std::printf(
        "Tree / nanoflann, or tree / grid / nanoflann. Builds in ms, queries in ns: in the order of tiles, "
        "at random.\n\n"
        "| photons | how many | build | 50 nearest | 100 nearest | 500 nearest | 50 nearest, half within | "
        "build grid | "
        "radius of 10 | build grid | radius of 100 |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (Scene const& scene : kScenes)
        for (std::size_t const n : o.photons)
            if (std::string(scene.name).find(o.only) != std::string::npos) measure(scene, n, o);
    return 0;
}
