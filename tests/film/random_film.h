// Films for tests: filled with numbers that depend on the pass alone.
#pragma once

#include "film/film.h"

#include <cstring>
#include <filesystem>
#include <random>
#include <string>

#include <unistd.h>

namespace nephroid {

inline FilmIdentity test_identity() { return {"scene-hash", "settings-hash", 7}; }

inline Film empty_film(bool aovs = true) { return Film({12, 9}, {2, 10, 1, 8}, aovs, test_identity()); }

/// Adds pass i to the film. Dyadic: few-bit numbers whose sums are exact in any order.
inline void render_test_pass(Film& film, std::uint64_t pass, bool dyadic = false) {
    std::mt19937_64 random(pass + 1);
    auto const number = [&]() -> float {
        if (dyadic) return static_cast<float>(static_cast<int>(random() % 64) - 16) / 16.0f;
        return std::uniform_real_distribution<float>(-0.5f, 4.0f)(random);
    };
    auto const vec = [&]() { return Vec3{number(), number(), number()}; };
    auto const [x0, x1, y0, y1] = film.crop();
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            float const weight = number();
            film.add(x, y, vec(), weight);
            AovSample const sample{vec(),
                                   vec(),
                                   vec(),
                                   vec(),
                                   number(),
                                   random() % 3 != 0,
                                   static_cast<std::uint32_t>(random() % 5),
                                   {vec(), vec(), vec(), vec()},
                                   random() % 4 != 0,
                                   number(),
                                   number()};
            if (film.has_aovs()) film.add_aov(x, y, pass, sample, weight);
        }
    film.add_dropped(pass % 2);
    film.finish_pass(pass);
}

inline Film film_of(PassRange range, bool dyadic = false, bool aovs = true) {
    Film film = empty_film(aovs);
    for (std::uint64_t i = range.begin; i < range.end; ++i) render_test_pass(film, i, dyadic);
    return film;
}

inline bool same_bits(Film const& a, Film const& b) {
    if (a.resolution() != b.resolution() || a.crop() != b.crop() || a.has_aovs() != b.has_aovs())
        return false;
    if (!(a.identity() == b.identity()) || !(a.passes() == b.passes()) || a.dropped() != b.dropped())
        return false;
    auto const [x0, x1, y0, y1] = a.crop();
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            if (std::memcmp(&a.pixel(x, y), &b.pixel(x, y), sizeof(PixelSums)) != 0) return false;
            if (!a.has_aovs()) continue;
            AovSums const &p = a.aov(x, y), &q = b.aov(x, y);
            if (std::memcmp(&p, &q, offsetof(AovSums, material)) != 0 || p.material != q.material)
                return false;
        }
    return true;
}

/// A folder of its own that goes away with the test.
struct TestFolder {
    std::filesystem::path path;
    TestFolder() {
        static int counter = 0;
        path = std::filesystem::temp_directory_path() /
               ("nephroid-film-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
        std::filesystem::create_directories(path);
    }
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TestFolder(TestFolder const&) = delete;
    TestFolder& operator=(TestFolder const&) = delete;
    std::filesystem::path operator/(std::string const& name) const { return path / name; }
};

}  // namespace nephroid
