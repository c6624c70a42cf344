#include "render/render.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace nephroid {

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

constexpr int kTileSize = 16;

std::vector<Tile> tiles_of(std::array<int, 4> crop) {
    std::vector<Tile> tiles;
    for (int y = crop[2]; y < crop[3]; y += kTileSize)
        for (int x = crop[0]; x < crop[1]; x += kTileSize)
            tiles.push_back({x, std::min(x + kTileSize, crop[1]), y, std::min(y + kTileSize, crop[3])});
    return tiles;
}

/// The sums before a batch touched them, to go back to when it is abandoned. In one piece, which the system gets back
/// while a checkpoint is written.
class Undo {
  public:
    explicit Undo(std::size_t tiles) : kept_(tiles) {}
    void begin(Film const& film) {
        crop_ = film.crop();
        std::fill(kept_.begin(), kept_.end(), char{0});
        auto const n = static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height());
        if (pixels_) return;
        // Not set to anything: a tile writes its part before it reads it, and the pages come with that.
        pixels_ = std::make_unique_for_overwrite<Plain<PixelSums>[]>(n);
        if (film.has_aovs()) aovs_ = std::make_unique_for_overwrite<Plain<AovSums>[]>(n);
    }
    void keep(Film const& film, Tile const& t, std::size_t tile) {
        for_each(t, [&](int x, int y, std::size_t i) {
            std::memcpy(&pixels_[i], &film.pixel(x, y), sizeof(PixelSums));
            if (aovs_) std::memcpy(&aovs_[i], &film.aov(x, y), sizeof(AovSums));
        });
        kept_[tile] = 1;
    }
    void restore(Film& film, Tile const& t, std::size_t tile) const {
        if (!kept_[tile]) return;
        for_each(t, [&](int x, int y, std::size_t i) {
            std::memcpy(static_cast<void*>(&film.pixel(x, y)), &pixels_[i], sizeof(PixelSums));
            if (aovs_) std::memcpy(static_cast<void*>(&film.aov(x, y)), &aovs_[i], sizeof(AovSums));
        });
    }
    void release() { pixels_.reset(), aovs_.reset(); }

  private:
    template <class Sums>
    struct Plain {
        alignas(Sums) std::byte bytes[sizeof(Sums)];
    };
    template <class F>
    void for_each(Tile const& t, F f) const {
        auto const width = static_cast<std::size_t>(crop_[1] - crop_[0]);
        for (int y = t.y0; y < t.y1; ++y)
            for (int x = t.x0; x < t.x1; ++x)
                f(x, y,
                  static_cast<std::size_t>(y - crop_[2]) * width + static_cast<std::size_t>(x - crop_[0]));
    }

    std::array<int, 4> crop_{};
    std::unique_ptr<Plain<PixelSums>[]> pixels_;
    std::unique_ptr<Plain<AovSums>[]> aovs_;
    std::vector<char> kept_;  // written by one thread each
};

/// One run of the loop. A batch is a range of passes; each tile adds them to its pixels in ascending order, so that neither
/// the batches' sizes nor the threads change a bit of the sums.
class Loop {
  public:
    Loop(RenderJob const& job, RenderControl const& control, Film& film)
        : job_(job),
          control_(control),
          film_(film),
          tiles_(tiles_of(job.crop())),
          undo_(tiles_.size()),
          stats_(tiles_.size()) {
        result_.end = RenderEnd::Complete;
    }

    RenderResult run() {
        auto const missing = film_.passes().missing(control_.passes);
        wanted_ = missing.count();
        last_checkpoint_ = Clock::now();
        std::uint64_t batch_size = 1;
        for (PassRange const& range : missing.ranges()) {
            for (std::uint64_t next = range.begin; next < range.end;) {
                if (stopped()) return finish(RenderEnd::Interrupted);
                // However short the time, there is one pass: a picture of none is black.
                if (control_.seconds && result_.passes > 0 && since(start_) >= *control_.seconds)
                    return finish(RenderEnd::TimeLimit);
                PassRange const batch{next, next + std::min(range.end - next, batch_size)};
                auto const t0 = Clock::now();
                if (!render_batch(batch)) return finish(RenderEnd::Interrupted);
                next = batch.end;
                batch_size = next_size(batch.end - batch.begin, since(t0));
                if (control_.on_checkpoint && since(last_checkpoint_) >= control_.checkpoint_seconds) {
                    undo_.release();  // what encoding takes does not come on top of it
                    control_.on_checkpoint(film_);
                    last_checkpoint_ = Clock::now();
                }
            }
        }
        return finish(RenderEnd::Complete);
    }

  private:
    [[nodiscard]] bool stopped() const {
        return control_.stop && control_.stop->load(std::memory_order_relaxed);
    }

    /// Batches of a second at most: long enough to pay for starting threads and for what is kept to go back to (1% of a quarter of a
    /// second), short enough to lose. At first shorter: a stop loses no more than about half of what there is.
    std::uint64_t next_size(std::uint64_t size, double seconds) const {
        if (job_.prepares()) return 1;  // each pass has work of its own
        double const target = control_.seconds ? std::min(0.25, std::max(0.02, *control_.seconds / 20))
                                               : std::clamp(since(start_) / 4, 0.25, 1.0);
        if (seconds > 2 * target) return std::max<std::uint64_t>(1, size / 2);
        if (seconds < target / 2) return std::min<std::uint64_t>(64, size * 2);
        return size;
    }

    void go_back() {
        for (std::size_t i = 0; i < tiles_.size(); ++i) undo_.restore(film_, tiles_[i], i);
    }

    /// Photons before pixels. False when it was stopped.
    bool prepare(PassRange batch) {
        if (!job_.prepares()) return true;
        PrepareControl control;
        control.stop = control_.stop;
        control.on_progress = [this](double share) {
            prepared_ = share;
            report(false);
        };
        prepared_ = 0;
        auto work = prepare_pass(job_, batch.begin, control);
        if (!work) return false;
        prepared_ = 1;
        work_ = std::move(*work);
        result_.photons.add(work_.report);
        return true;
    }

    void render_tiles(PassRange batch, std::atomic<bool>& abandoned, std::atomic<std::uint64_t>& dropped) {
        tbb::blocked_range<std::size_t> const all(0, tiles_.size());
        tbb::parallel_for(all, [&](tbb::blocked_range<std::size_t> const& mine) {
            TileRenderer renderer(job_, work_, film_, stats_[mine.begin()]);
            for (std::size_t i = mine.begin(); i < mine.end(); ++i) {
                undo_.keep(film_, tiles_[i], i);
                // Pass by pass, so that a signal is heard soon.
                for (std::uint64_t pass = batch.begin; pass < batch.end; ++pass) {
                    if (stopped()) {
                        abandoned = true;
                        return;
                    }
                    dropped.fetch_add(renderer.add(tiles_[i], {pass, pass + 1}), std::memory_order_relaxed);
                }
                tiles_done_.fetch_add(1, std::memory_order_relaxed);
                report(false);
            }
        });
    }

    bool render_batch(PassRange batch) {
        std::atomic<bool> abandoned{false};
        std::atomic<std::uint64_t> dropped{0};
        tiles_done_ = 0;
        batch_ = batch;
        std::uint64_t const rejected = rejected_rays();
        undo_.begin(film_);
        try {
            if (!prepare(batch)) return false;
            render_tiles(batch, abandoned, dropped);
        } catch (...) {
            // No pass throws, but memory may run out: the film must be what it says it is.
            go_back();
            throw;
        }
        if (abandoned) {
            go_back();
            return false;
        }
        film_.add_dropped(dropped);
        film_.add_rejected(rejected_rays() - rejected);
        for (std::uint64_t pass = batch.begin; pass < batch.end; ++pass) film_.finish_pass(pass);
        result_.passes += batch.end - batch.begin;
        batch_ = {0, 0};
        report(result_.passes == wanted_);
        return true;
    }

    [[nodiscard]] std::uint64_t rejected_rays() const {
        std::uint64_t n = result_.photons.rays.rejected;
        for (RayStats const& s : stats_) n += s.rejected;
        return n;
    }

    void report(bool now) {
        if (!control_.on_progress) return;
        std::unique_lock lock(report_mutex_, std::defer_lock);
        if (now) {
            lock.lock();
        } else if (!lock.try_lock() || since(last_report_) < 0.1) {
            return;
        }
        last_report_ = Clock::now();
        RenderProgress p;
        p.passes_done = result_.passes;
        p.passes_wanted = wanted_;
        double const tiles = static_cast<double>(tiles_done_.load()) /
                             static_cast<double>(std::max<std::size_t>(1, tiles_.size()));
        // Of a pass that is prepared, that is a third of the work, about.
        double const share = job_.prepares() ? (prepared_ + 2 * tiles) / 3 : tiles;
        double const in_flight = static_cast<double>(batch_.end - batch_.begin) * share;
        double const done = static_cast<double>(result_.passes) + in_flight;
        p.fraction = wanted_ > 0 ? done / static_cast<double>(wanted_) : 1.0;
        if (control_.seconds)
            p.fraction = std::max(p.fraction, std::min(1.0, since(start_) / *control_.seconds));
        if (p.passes_done < wanted_) p.fraction = std::min(p.fraction, 0.999);  // not done is not 100%
        p.seconds = since(start_);
        control_.on_progress(p);
    }

    RenderResult finish(RenderEnd end) {
        result_.end = end;
        for (RayStats const& s : stats_) result_.rays.add(s);
        result_.rays.add(result_.photons.rays);
        result_.seconds = since(start_);
        return result_;
    }

    RenderJob const& job_;
    RenderControl const& control_;
    Film& film_;
    std::vector<Tile> tiles_;
    Undo undo_;
    std::vector<RayStats> stats_;  // of runs of tiles, by the first: never shared
    RenderResult result_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_checkpoint_;
    Clock::time_point last_report_;
    std::mutex report_mutex_;
    std::atomic<std::size_t> tiles_done_{0};
    PassWork work_;  // of the batch, where passes are prepared
    std::atomic<double> prepared_{0};
    PassRange batch_{0, 0};
    std::uint64_t wanted_ = 0;
};

}  // namespace

std::uint64_t render_bytes(std::uint64_t pixels, bool with_aovs) { return film_bytes(pixels, with_aovs); }

RenderResult render(RenderJob const& job, RenderControl const& control, Film& film) {
    int const threads = control.threads > 0
                            ? control.threads
                            : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    // TBB has as many workers as the machine has cores; more are had by asking.
    std::optional<tbb::global_control> more;
    if (threads > tbb::info::default_concurrency())
        more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    RenderResult result;
    arena.execute([&] { result = Loop(job, control, film).run(); });
    return result;
}

}  // namespace nephroid
