// The pass loop: threads, progress, stopping, checkpoints. What is computed is render_pass's business alone; this room only
// decides when, and on which thread. A film is the same to the bit for any number of threads and any size of batch.
#pragma once

#include "film/film.h"
#include "transport/render_pass.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>

namespace nephroid {

struct RenderProgress {
    std::uint64_t passes_done = 0, passes_wanted = 0;  // of this run
    double fraction = 0;                               // counts tiles of the batch in flight
    double seconds = 0;
    RayStats rays;
};

struct RenderControl {
    PassRange passes{0, 16};  // what the film should hold in the end; what it already holds is skipped
    int threads = 0;          // 0 = as many as the machine has
    std::optional<double>
        seconds;  // stop starting new batches after this long, but not before the first pass
    std::atomic<bool> const* stop =
        nullptr;  // set from outside (a signal): abandon the batch in flight and return
    std::function<void(RenderProgress const&)> on_progress;  // from one thread at a time, some times a second
    std::function<void(Film const&)> on_checkpoint;  // between batches, at most every checkpoint_seconds
    double checkpoint_seconds = 60;
};

enum class RenderEnd : std::uint8_t { Complete, TimeLimit, Interrupted };

struct RenderResult {
    RenderEnd end = RenderEnd::Complete;
    RayStats rays;
    double seconds = 0;
    std::uint64_t passes = 0;  // rendered in this run
    PhotonReport photons;      // of integrators that shoot them; its rays are among `rays`
};

/// Memory that render() takes beside the film, at most: what it may have to go back to.
std::uint64_t render_bytes(std::uint64_t pixels, bool with_aovs);

/// Adds the wanted passes to `film`. Passes are finished whole: when it stops early the film holds exactly the passes that its
/// pass set says.
RenderResult render(RenderJob const& job, RenderControl const& control, Film& film);

}  // namespace nephroid
