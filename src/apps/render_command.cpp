#include "asked_settings.h"
#include "checkpoint_guard.h"
#include "commands.h"
#include "console.h"
#include "film/checkpoint.h"
#include "film/develop.h"
#include "image/file.h"
#include "math/error.h"
#include "memory.h"
#include "names.h"
#include "outputs.h"
#include "overrides.h"
#include "path_plot.h"
#include "photon_overlay.h"
#include "photon_statistics.h"
#include "progress.h"
#include "read/read.h"
#include "render/render.h"
#include "replay_option.h"
#include "signals.h"
#include "statistics.h"
#include "targets.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>
#include <new>
#include <span>
#include <thread>

namespace nephroid::cli {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(std::string const& message) { throw Error(ErrorKind::Input, message); }

/// "90", "90s", "5m", "2h".
double seconds_of(std::string const& text) {
    double v = 0;
    auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
    std::string const unit(r.ptr, text.data() + text.size());
    double const scale = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
    if (r.ec != std::errc{} || !(v > 0) || !std::isfinite(v * scale) || scale == 0)
        refuse(fmt::format("--time {}: expected a duration such as 90s, 5m or 2h", text));
    return v * scale;
}

double since(std::chrono::steady_clock::time_point t) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

/// Far beyond what anyone renders, and sums of two such numbers still fit.
constexpr std::uint64_t kLastPass = std::uint64_t{1} << 63;

PassRange passes_of(RenderOptions const& o, Settings const& s) {
    if (!o.passes.empty()) {
        auto const v = numbers<std::uint64_t>("--passes", o.passes, ':', 2);
        if (v[0] >= v[1])
            refuse(fmt::format("--passes {}: the range A:B is empty; B must be larger than A", o.passes));
        if (v[1] > kLastPass)
            refuse(fmt::format("--passes {}: passes end at 2^63; choose a smaller B", o.passes));
        return {v[0], v[1]};
    }
    // With a time limit alone, as many as fit.
    if (!o.time.empty() && !o.spp) return {0, std::uint64_t{1} << 62};
    return {0, static_cast<std::uint64_t>(wanted_passes(s))};
}

std::map<std::string, std::string> metadata(RenderJob const& job, Film const& film,
                                            RunStatistics const& stats) {
    Settings const& s = job.settings();
    std::map<std::string, std::string> m{
        {"renderer", "nephroid 0.1.0"},
        {"integrator", name_of(s.integrator)},
        {"colorMode", s.color == ColorMode::Rgb ? "rgb" : "spectral"},
        {"seed", std::to_string(s.seed)},
        {"samplesPerPixel",
         std::to_string(film.passes().count() * static_cast<std::uint64_t>(samples_per_pass(s)))},
        {"sceneHash", job.world().scene_hash()},
        {"renderSeconds", fmt::format("{:.3f}", stats.render_seconds)}};
    for (auto const& [key, value] : photon_words(s.integrator)) m["photons." + key] = value;
    return m;
}

/// Passes whose wavelengths all paths share give the colours of those wavelengths until there are enough of them.
constexpr std::uint64_t kEnoughWavelengths = 16;
std::string few_wavelengths(RenderJob const& job, Film const& film) {
    Settings const& s = job.settings();
    std::uint64_t const n = film.passes().count();
    if (!job.prepares() || s.color == ColorMode::Rgb || n == 0 || n >= kEnoughWavelengths) return {};
    return fmt::format(
        "{} in spectral colours has four wavelengths a pass, and {} pass{} tint the picture: render {} or "
        "more, or use --color rgb",
        name_of(s.integrator), n, n == 1 ? "" : "es", kEnoughWavelengths);
}

bool stored_nothing(RenderJob const& job, PhotonReport const& report) {
    return job.photon_plan() && total_of(report.global).stored + total_of(report.caustic).stored == 0;
}

/// The pixels x0 x1 y0 y1 that will be rendered; RenderJob has the last word.
std::array<int, 4> crop_of(Settings const& s) {
    return s.film.crop.value_or(std::array<int, 4>{0, s.film.resolution.x, 0, s.film.resolution.y});
}

/// Everything that this run reads and writes.
void check_files(RenderOptions const& o, std::vector<std::string> const& outputs, Scene const& scene) {
    std::vector<NamedFile> files;
    add_outputs(files, outputs);
    if (!o.stats.empty()) files.push_back({"--stats", o.stats, FileRole::Output});
    if (!o.checkpoint.empty())
        for (char const* suffix : {"", ".next", ".previous"})
            files.push_back({"--checkpoint", o.checkpoint + suffix, FileRole::FilmOutput});
    if (!o.resume.empty()) files.push_back({"--resume", o.resume, FileRole::FilmInput});
    files.push_back({"the scene", o.scene, FileRole::Input});
    for (std::string const& f : scene.files)
        if (f != o.scene) files.push_back({"the scene's", f, FileRole::Input});
    for (ImageFile const& image : scene.images) files.push_back({"the picture", image.path, FileRole::Input});
    check_conflicts(files);
}

/// What went wrong while nothing could be done about it but to go on; and everything else that is said on the way.
class Log {
  public:
    Log(bool json, bool quiet) : json_(json), quiet_(quiet) {}
    void error(std::string const& text) {
        failed_ = true;
        event("error", "nephroid: " + text, text);
    }
    /// Also with --quiet.
    void warning(std::string const& text) const { event("warning", "nephroid: " + text, text); }
    void note(std::string const& text) const {
        if (json_ || !quiet_) event("note", text, text);
    }
    [[nodiscard]] bool failed() const { return failed_; }

  private:
    void event(char const* kind, std::string const& for_people, std::string const& text) const {
        if (json_)
            say("{}\n", json_text({{"event", kind}, {"text", text}}));
        else
            say("{}\n", for_people);
    }
    bool json_, quiet_, failed_ = false;
};

/// One that fails must not end the render: the next one may succeed, and the film is in memory. Returns whether it did.
bool try_checkpoint(std::string const& file, Film const& film, bool ours, std::string& error) {
    try {
        write_checkpoint(file, film, ours);
        error.clear();
        return true;
    } catch (Error const& e) {
        error = e.what();
    } catch (std::bad_alloc const&) {
        error = file + ": out of memory";
    }
    return false;
}

void write_statistics(std::string const& file, RunStatistics const& stats, Log& log) try {
    std::string const text = json_text(to_json(stats), 2) + "\n";
    write_file_atomically(file, std::as_bytes(std::span(text.data(), text.size())));
} catch (Error const& e) {
    log.error(e.what());
}

}  // namespace

int run(RenderOptions const& o) {
    catch_signals();
    RunStatistics stats;
    auto t = std::chrono::steady_clock::now();
    auto const lap = [&] {
        double const s = since(t);
        t = std::chrono::steady_clock::now();
        return s;
    };
    bool const json = o.log == "json";
    Log log(json, o.quiet);
    std::optional<ReplayRequest> const asked = replay_request(o);
    std::vector<std::string> outputs = asked ? asked->pictures : o.outputs;
    check_outputs(outputs, asked.has_value());
    if (!o.checkpoint.empty()) check_target("--checkpoint", o.checkpoint, true);
    if (!o.stats.empty()) check_target("--stats", o.stats);
    std::optional<double> const seconds = o.time.empty() ? std::nullopt : std::optional(seconds_of(o.time));
    std::optional<std::uint64_t> const memory_limit =
        o.memory_limit.empty() ? std::nullopt : std::optional(parse_bytes("--memory-limit", o.memory_limit));
    Scene scene = read_scene(o.scene);
    Settings const settings = settings_of(o, scene);
    PassRange const passes = passes_of(o, settings);
    if (asked) check_replay(*asked, settings);
    if (outputs.empty() && !asked) {
        // Like pbrt: relative to the folder where the program was started.
        outputs.push_back(settings.film.filename.empty() ? fs::path(o.scene).stem().string() + ".exr"
                                                         : settings.film.filename);
        check_outputs(outputs);
    }
    check_output_size(outputs, crop_of(settings));
    std::vector<std::string> written = outputs;
    if (asked) written.insert(written.end(), asked->files.begin(), asked->files.end());
    check_files(o, written, scene);
    MemoryNeed need = memory_need(scene, crop_of(settings), settings.film.aovs);
    need.photons = photon_need(settings);
    check_memory(need, memory_limit);
    stats.read_seconds = lap();

    scene.settings = settings;  // so that overrides are validated like the rest
    World const world = compile(std::move(scene));
    RenderJob const job(world, settings);
    std::optional<PathRecord> path;
    if (asked) {
        path = run_replay(*asked, job);
        if (outputs.empty()) return is_finite(path->value) ? kGood : kTainted;
    }
    check_memory(refined(need, job), memory_limit);
    Film film = job.make_film();
    film.describe(words_of(settings));
    if (!o.resume.empty()) resume(o.resume, film);
    if (!o.checkpoint.empty()) guard_checkpoint(o.checkpoint, o.resume, film);
    stats.compile_seconds = lap();

    std::size_t const notes = world.scene().notes.size();
    if (json) {
        say("{{\"event\":\"notes\",\"count\":{}}}\n", notes);
    } else if (notes > 0) {
        log.note(fmt::format("{}: {} thing{} approximated or ignored; `nephroid info {}` lists {}", o.scene,
                             notes, notes == 1 ? "" : "s", o.scene, notes == 1 ? "it" : "them"));
    }
    if (world.counts().lights == 0)
        log.note(fmt::format("{}: warning: the scene has no lights; the picture will be black", o.scene));

    ProgressPrinter progress(progress_style(o.quiet, o.log));
    RenderControl control;
    control.passes = passes;
    control.threads = o.threads;
    control.seconds = seconds;
    control.stop = &stop_on_signals();
    control.on_progress = std::ref(progress);
    control.checkpoint_seconds = o.checkpoint_every;
    bool checkpoint_is_ours = !o.resume.empty() && o.resume == o.checkpoint;  // it was read, and is whole
    std::string checkpoint_error;
    PassSet on_disk;  // passes that the checkpoint holds already
    if (!o.checkpoint.empty())
        control.on_checkpoint = [&](Film const& f) {
            std::string const before = checkpoint_error;
            if (try_checkpoint(o.checkpoint, f, checkpoint_is_ours, checkpoint_error)) {
                checkpoint_is_ours = true;
                on_disk = f.passes();
            } else if (checkpoint_error != before) {
                progress.finish();
                log.warning(checkpoint_error + "; going on without a checkpoint");
            }
        };
    RenderResult result;
    bool out_of_memory = false;
    try {
        result = render(job, control, film);
    } catch (std::bad_alloc const&) {
        out_of_memory = true;  // the passes before are whole
    }
    progress.finish();
    if (out_of_memory)
        log.warning(
            fmt::format("out of memory after {} passes; what there is is written", film.passes().count()));
    stats.render_seconds = result.seconds;
    lap();
    if (result.passes > 0 && world.counts().lights > 0 && stored_nothing(job, result.photons))
        log.warning(fmt::format(
            "{}: warning: no photon was stored: nothing that is not a mirror or glass was met, or "
            "none were to be shot; light that maps would show is missing (black)",
            o.scene));

    bool const pictures =
        !std::all_of(outputs.begin(), outputs.end(), is_film_name);  // films may yet be merged
    if (std::string const few = few_wavelengths(job, film); pictures && !few.empty())
        log.note(fmt::format("{}: warning: {}", o.scene, few));

    bool const interrupted = result.end == RenderEnd::Interrupted;
    if (film.passes().empty() && out_of_memory) return kLimit;
    if (film.passes().empty()) {
        log.warning("interrupted before the first pass was done; nothing was written");
        return kInterrupted;
    }
    // Side by side with the outputs, where a thread is to be had: after a signal there are two seconds for all of them.
    std::future<bool> checkpoint;
    if (!o.checkpoint.empty() && on_disk != film.passes())
        checkpoint = std::async(std::launch::async | std::launch::deferred, [&] {
            return try_checkpoint(o.checkpoint, film, checkpoint_is_ours, checkpoint_error);
        });
    DevelopSettings develop;
    develop.half_float = settings.film.half_float;
    develop.exposure = o.exposure;
    develop.in_a_hurry = interrupted;
    develop.metadata = metadata(job, film, stats);
    Image overlay;
    if (path && pictures) {
        overlay = draw_path(job, *path);
        develop.over = &overlay;
    }
    if (draws(o.overlay) && pictures && !interrupted) {
        try {
            overlay = draw_photons(RenderJob(world, photon_settings(settings)), passes.begin, o.overlay);
            develop.over = &overlay;
        } catch (std::bad_alloc const&) {
            log.error("out of memory: photons are not drawn over the picture");
        }
    }
    for (std::string const& error :
         write_outputs(outputs, film, develop, [&](std::string const& text) { log.warning(text); }))
        log.error(error);
    if (checkpoint.valid() && !checkpoint.get()) log.error(checkpoint_error);
    stats.write_seconds = lap();

    auto const crop = job.crop();
    stats.rays = result.rays;
    stats.memory = world.memory();
    stats.counts = world.counts();
    stats.image_files = world.assets().image_files();
    stats.film_bytes = film.bytes();
    stats.passes = result.passes;
    stats.samples = result.passes * static_cast<std::uint64_t>(crop[1] - crop[0]) *
                    static_cast<std::uint64_t>(crop[3] - crop[2]) *
                    static_cast<std::uint64_t>(samples_per_pass(settings));
    stats.photons = result.photons;
    stats.photon_sources = source_names(world);
    stats.dropped = film.dropped();
    stats.rejected = film.rejected();
    stats.threads =
        o.threads > 0 ? o.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (!o.stats.empty()) write_statistics(o.stats, stats, log);
    if (json) {
        nlohmann::json j = to_json(stats);
        j["event"] = log.failed() ? "failed" : interrupted ? "interrupted" : "done";
        say("{}\n", json_text(j));
    } else if (!o.quiet) {
        say_text(table(stats));
    } else if (film.tainted()) {
        log.warning(taint(film));
    }
    if (interrupted && !json)
        say("nephroid: interrupted after {} passes; {}\n", film.passes().count(),
            log.failed()           ? "what could be written was written"
            : o.checkpoint.empty() ? "what there is was written"
                                   : fmt::format("go on with --resume {}", o.checkpoint));
    if (log.failed()) return kIo;
    if (out_of_memory) return kLimit;
    if (interrupted) return kInterrupted;
    return film.tainted() ? kTainted : kGood;
}

}  // namespace nephroid::cli
