// What it costs to add up splats so that their sum does not depend on threads: in the order of the paths (the renderer's way), or in
// fixed point, whose sums have no order. docs/decisions/0009-splats.md.
//
//   bench_splats [splats]        nanoseconds a splat
//   bench_splats WAY PICTURE N   one of them alone, for callgrind
#include "light_path_image.h"
#include "sampling/hash.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace nephroid;

namespace {

constexpr std::size_t kChunkSplats = 1500, kWave = 256;

struct Picture {
    std::string name;
    int width, height;
    double lit, share;  // this share of the splats falls on this part of the pixels
};
std::vector<Picture> pictures() {
    return {{"even, 1280x720", 1280, 720, 1, 1},
            {"caustic, 1280x720", 1280, 720, 0.01, 0.9},
            {"even, 16x16", 16, 16, 1, 1}};
}

Splat splat(Picture const& p, std::uint64_t i) {
    std::uint64_t const h = mix64(i * 0x9e3779b97f4a7c15ull + 1);
    auto const pixels = static_cast<double>(p.width) * p.height;
    double const u = static_cast<double>(h >> 40) * 0x1p-24;
    bool const focused = static_cast<double>(h & 0xFFFF) * 0x1p-16 < p.share;
    auto const pixel = static_cast<std::uint32_t>(u * pixels * (focused ? p.lit : 1));
    float const v = static_cast<float>(h >> 16 & 0xFFFF) * 0x1p-16f;
    return {pixel | static_cast<std::uint32_t>(h >> 20 & 3) << Splat::kPixelBits, {v, 0.5f * v, 0.25f * v}};
}

/// Making splats alone: taken off.
double made(Picture const& p, std::size_t count) {
    std::size_t const chunks = count / kChunkSplats;
    std::vector<SplatChunk> wave(kWave);
    for (std::size_t first = 0; first < chunks; first += kWave)
        tbb::parallel_for(std::size_t{0}, std::min(kWave, chunks - first), [&](std::size_t k) {
            wave[k].clear();
            for (std::size_t i = 0; i < kChunkSplats; ++i)
                wave[k].add(splat(p, (first + k) * kChunkSplats + i));
        });
    return 0;
}
double in_order(Picture const& p, std::size_t count) {
    LightPathImage image({0, p.width, 0, p.height}, false);
    std::size_t const chunks = count / kChunkSplats;
    std::vector<SplatChunk> wave(kWave);
    for (std::size_t first = 0; first < chunks; first += kWave) {
        std::size_t const n = std::min(kWave, chunks - first);
        tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
            wave[k].clear();
            for (std::size_t i = 0; i < kChunkSplats; ++i)
                wave[k].add(splat(p, (first + k) * kChunkSplats + i));
            wave[k].sort();
        });
        image.add(std::span(wave).first(n));
    }
    return static_cast<double>(image.total(p.width / 200, 0).x);
}
double fixed_point(Picture const& p, std::size_t count) {
    auto const pixels = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
    auto const sums = std::make_unique<std::atomic<std::int64_t>[]>(3 * pixels);
    std::size_t const chunks = count / kChunkSplats;
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t k) {
        for (std::size_t i = 0; i < kChunkSplats; ++i) {
            Splat const s = splat(p, k * kChunkSplats + i);
            for (int c = 0; c < 3; ++c)
                sums[3 * s.where() + static_cast<std::size_t>(c)].fetch_add(
                    std::llrint(static_cast<double>(s.rgb[c]) * 0x1p32), std::memory_order_relaxed);
        }
    });
    return static_cast<double>(sums[3 * static_cast<std::size_t>(p.width / 200)]) * 0x1p-32;
}

struct Way {
    std::string name;
    double (*add)(Picture const&, std::size_t);
};
std::vector<Way> ways() { return {{"made", made}, {"in-order", in_order}, {"fixed-point", fixed_point}}; }

double nanoseconds(Way const& way, Picture const& p, std::size_t count, int threads) {
    tbb::task_arena arena(threads);
    double best = 1e30;
    for (int round = 0; round < 7; ++round)
        arena.execute([&] {
            auto const begun = std::chrono::steady_clock::now();
            way.add(p, count);
            std::chrono::duration<double, std::nano> const t = std::chrono::steady_clock::now() - begun;
            best = std::min(best, t.count() / static_cast<double>(count));
        });
    return best;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 4) {
        Way const way = ways().at(static_cast<std::size_t>(std::stoul(argv[1])));
        Picture const picture = pictures().at(static_cast<std::size_t>(std::stoul(argv[2])));
        tbb::task_arena arena(1);
        arena.execute([&] { std::printf("%g\n", way.add(picture, std::stoul(argv[3]))); });
        return 0;
    }
    std::size_t const count = argc > 1 ? std::stoul(argv[1]) : 6'000'000;
    int const cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    for (Picture const& p : pictures()) {
        for (int const threads : {1, cores}) {
            double const base = nanoseconds(ways()[0], p, count, threads);
            std::printf("%-20s %2d threads: made %5.2f ns", p.name.c_str(), threads, base);
            for (std::size_t w = 1; w < 3; ++w)
                std::printf(", %s +%.2f ns", ways()[w].name.c_str(),
                            nanoseconds(ways()[w], p, count, threads) - base);
            std::printf("\n");
        }
    }
}
