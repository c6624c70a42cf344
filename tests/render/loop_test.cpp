// The pass loop: stopping, time limits, progress, checkpoints. Whenever it ends, the film holds the passes it says it holds.
#include <doctest/doctest.h>

#include "films.h"

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

using namespace nephroid;
using namespace nephroid::test;
using Clock = std::chrono::steady_clock;

namespace {

double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

/// A job whose passes take some milliseconds.
struct Slow {
    World world = compile(read_text(kRoom));
    Settings settings = [this] {
        Settings s = world.scene().settings;
        s.film.resolution = {96, 64};
        s.film.aovs = true;
        return s;
    }();
    RenderJob job{world, settings};
};

}  // namespace

TEST_CASE("a stop leaves exactly the passes that the film names") {
    Slow const slow;
    int interrupted = 0;
    for (int const delay_us : {0, 300, 2'000, 5'000, 11'000, 23'000, 47'000, 90'000, 150'000}) {
        CAPTURE(delay_us);
        std::atomic<bool> stop{false};
        RenderControl control;
        control.passes = {0, 1'000'000};
        control.threads = 2;
        control.stop = &stop;
        Film film = slow.job.make_film();
        std::thread signal([&] {
            std::this_thread::sleep_for(std::chrono::microseconds(delay_us));
            stop = true;
        });
        RenderResult const result = render(slow.job, control, film);
        signal.join();
        CHECK(result.end == RenderEnd::Interrupted);
        interrupted += result.passes > 0;
        CHECK(film.passes().count() == result.passes);
        if (result.passes > 0) CHECK(film.passes().ranges() == std::vector<PassRange>{{0, result.passes}});
        CHECK(differing_pixels(film, by_definition(slow.job, {0, result.passes})) == 0);
        // And it goes on from there.
        std::uint64_t const more = result.passes + 2;
        add_passes(slow.job, {0, more}, film);
        CHECK(differing_pixels(film, by_definition(slow.job, {0, more})) == 0);
    }
    CHECK(interrupted > 0);  // how many depends on the machine
}

TEST_CASE("a stop is heard soon") {
    Slow const slow;
    std::atomic<bool> stop{false};
    RenderControl control;
    control.passes = {0, 1'000'000};
    control.stop = &stop;
    Clock::time_point asked;
    std::thread signal([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(700));  // batches have grown by now
        asked = Clock::now();
        stop = true;
    });
    Film film = slow.job.make_film();
    render(slow.job, control, film);
    double const took = since(asked);
    signal.join();
    CHECK(took < 1.0);
}

TEST_CASE("a stop before the start renders nothing") {
    Slow const slow;
    std::atomic<bool> const stop{true};
    RenderControl control;
    control.stop = &stop;
    Film film = slow.job.make_film();
    RenderResult const result = render(slow.job, control, film);
    CHECK(result.end == RenderEnd::Interrupted);
    CHECK(result.passes == 0);
    CHECK(film.passes().empty());
    CHECK(differing_pixels(film, slow.job.make_film()) == 0);
}

TEST_CASE("a time limit ends between passes") {
    Slow const slow;
    RenderControl control;
    control.passes = {0, std::uint64_t{1} << 62};
    control.threads = 2;
    control.seconds = 0.3;
    Film film = slow.job.make_film();
    auto const t = Clock::now();
    RenderResult const result = render(slow.job, control, film);
    CHECK(result.end == RenderEnd::TimeLimit);
    CHECK(since(t) >= 0.3);
    CHECK(since(t) < 3);
    CHECK(result.passes > 0);
    CHECK(result.seconds >= 0.3);
    CHECK(differing_pixels(film, by_definition(slow.job, {0, result.passes})) == 0);
    // Nothing to do is not out of time.
    control.passes = {0, 1};
    control.seconds = 0.0;
    CHECK(render(slow.job, control, film).end == RenderEnd::Complete);
}

TEST_CASE("progress rises to the end, from one thread at a time") {
    Slow const slow;
    for (bool const limited : {false, true}) {
        std::atomic<int> inside{0};
        bool overlapping = false;
        bool falling = false;
        RenderProgress last;
        int calls = 0;
        RenderControl control;
        control.passes = {5, 45};
        control.threads = 4;
        if (limited) control.seconds = 100;
        control.on_progress = [&](RenderProgress const& p) {
            if (inside.fetch_add(1) != 0) overlapping = true;
            if (p.fraction < last.fraction || p.passes_done < last.passes_done || p.seconds < last.seconds)
                falling = true;
            if (!(p.fraction >= 0 && p.fraction <= 1) || p.passes_wanted != 40) falling = true;
            last = p;
            ++calls;
            inside.fetch_sub(1);
        };
        Film film = slow.job.make_film();
        render(slow.job, control, film);
        CHECK_FALSE(overlapping);
        CHECK_FALSE(falling);
        CHECK(calls >= 1);
        CHECK(last.fraction == 1.0);
        CHECK(last.passes_done == 40);
    }
}

TEST_CASE("checkpoints are films between batches") {
    Slow const slow;
    RenderControl control;
    control.passes = {0, 30};
    control.checkpoint_seconds = 0;
    int calls = 0;
    std::uint64_t last = 0;
    bool whole = true;
    control.on_checkpoint = [&](Film const& f) {
        ++calls;
        whole = whole && f.passes().count() > last;
        last = f.passes().count();
        for (int y = 0; y < f.height(); ++y)
            for (int x = 0; x < f.width(); ++x) whole = whole && f.pixel(x, y).samples == last;
    };
    Film film = slow.job.make_film();
    RenderResult const result = render(slow.job, control, film);
    CHECK(calls >= 1);
    CHECK(whole);
    CHECK(last == 30);
    CHECK(result.passes == 30);
    CHECK(result.rays.rays[0] >= 30u * 96 * 64);
    CHECK(result.rays.rejected == 0);
}

TEST_CASE("what the film holds is not rendered again") {
    Slow const slow;
    Film film = rendered(slow.job, {0, 3});
    RenderResult const again = add_passes(slow.job, {0, 3}, film);
    CHECK(again.end == RenderEnd::Complete);
    CHECK(again.passes == 0);
    CHECK(again.rays.rays[0] == 0);
    CHECK(differing_pixels(film, by_definition(slow.job, {0, 3})) == 0);
}

TEST_CASE("however short the time, there is one pass; and not done is not 100%") {
    Slow const slow;
    RenderControl control;
    control.passes = {0, 1000};
    control.seconds = 1e-9;
    double most = 0;
    control.on_progress = [&](RenderProgress const& p) { most = std::max(most, p.fraction); };
    Film film = slow.job.make_film();
    RenderResult const result = render(slow.job, control, film);
    CHECK(result.end == RenderEnd::TimeLimit);
    CHECK(result.passes == 1);
    CHECK(most < 1);
    CHECK(differing_pixels(film, by_definition(slow.job, {0, 1})) == 0);
}

TEST_CASE("pass numbers near the end of 64 bits do not wrap around") {
    Slow const slow;
    std::uint64_t const end = ~std::uint64_t{0};
    Film film = slow.job.make_film();
    RenderResult const result = add_passes(slow.job, {end - 4, end}, film);
    CHECK(result.end == RenderEnd::Complete);
    CHECK(result.passes == 4);
    CHECK(film.passes().ranges() == std::vector<PassRange>{{end - 4, end}});
}

TEST_CASE("memory that runs out in the middle of a pass costs that pass alone") {
    Slow const slow;
    RenderControl control;
    control.passes = {0, 1000};
    control.threads = 2;
    int calls = 0;
    control.on_progress = [&](RenderProgress const&) {
        if (++calls == 4) throw std::bad_alloc();
    };
    Film film = slow.job.make_film();
    CHECK_THROWS_AS(render(slow.job, control, film), std::bad_alloc);
    CHECK(differing_pixels(film, by_definition(slow.job, {0, film.passes().count()})) == 0);
}
