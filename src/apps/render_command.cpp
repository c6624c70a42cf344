#include "commands.h"
#include "film/checkpoint.h"
#include "film/develop.h"
#include "image/file.h"
#include "math/error.h"
#include "overrides.h"
#include "progress.h"
#include "read/read.h"
#include "render/render.h"
#include "scene/match.h"
#include "signals.h"
#include "statistics.h"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

namespace nephroid::cli {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(std::string const& message) { throw Error(ErrorKind::Input, message); }

/// Numbers between separators, all of the text or nothing.
template <class T>
std::vector<T> numbers(std::string const& option, std::string const& text, char separator,
                       std::size_t count) {
    std::vector<T> out;
    char const* p = text.data();
    char const* const end = p + text.size();
    while (p < end) {
        T v{};
        auto const r = std::from_chars(p, end, v);
        if (r.ec != std::errc{}) break;
        out.push_back(v);
        p = r.ptr;
        if (p < end && *p == separator && p + 1 < end)
            ++p;
        else
            break;
    }
    if (p != end || out.size() != count)
        refuse(
            fmt::format("{} {}: expected {} numbers with '{}' between them", option, text, count, separator));
    return out;
}

/// "90", "90s", "5m", "2h".
double seconds_of(std::string const& text) {
    double v = 0;
    auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
    std::string const unit(r.ptr, text.data() + text.size());
    double const scale = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
    if (r.ec != std::errc{} || !(v > 0) || scale == 0)
        refuse(fmt::format("--time {}: expected a duration such as 90s, 5m or 2h", text));
    return v * scale;
}

double since(std::chrono::steady_clock::time_point t) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

bool is_film_name(std::string const& path) {
    return path.size() > 9 && path.compare(path.size() - 9, 9, ".film.exr") == 0;
}

/// Refuses a file that could not be written in the end, before hours of work: by making one beside it.
void check_folder(std::string const& option, std::string const& file) {
    fs::path const parent = fs::path(file).parent_path();
    fs::path const folder = parent.empty() ? fs::path(".") : parent;
    std::error_code ec;
    if (!fs::is_directory(folder, ec))
        throw Error(ErrorKind::Io,
                    fmt::format("{} {}: there is no folder {}", option, file, folder.string()));
    if (fs::is_directory(file, ec))
        throw Error(ErrorKind::Io, fmt::format("{} {}: that is a folder", option, file));
    std::string probe = (folder / ".nephroid-XXXXXX").string();
    int const fd = mkstemp(probe.data());
    if (fd < 0)
        throw Error(ErrorKind::Io, fmt::format("{} {}: cannot write in the folder {}: {}", option, file,
                                               folder.string(), std::strerror(errno)));
    close(fd);
    unlink(probe.c_str());
}

void check_outputs(std::vector<std::string> const& outputs) {
    static constexpr char const* known[] = {".exr", ".png", ".jpg", ".jpeg", ".pfm", ".hdr"};
    for (std::string const& out : outputs) {
        fs::path const path(out);
        std::string extension = path.extension().string();
        std::transform(extension.begin(), extension.end(), extension.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (std::none_of(std::begin(known), std::end(known), [&](char const* k) { return extension == k; }))
            refuse(
                fmt::format("-o {}: cannot write \"{}\" files; use .exr, .png, .jpg, .pfm, .hdr or .film.exr",
                            out, extension));
        check_folder("-o", out);
    }
}

Settings settings_of(RenderOptions const& o, Scene const& scene) {
    Settings s = scene.settings;
    if (!o.integrator.empty()) set_integrator(s, o.integrator);
    for (std::string const& set : o.sets) apply_override(s, set);
    if (!o.size.empty()) {
        auto const v = numbers<int>("--size", o.size, 'x', 2);
        if (v[0] < 1 || v[1] < 1) refuse(fmt::format("--size {}: both sides must be at least 1", o.size));
        s.film.resolution = {v[0], v[1]};
        s.film.crop.reset();
    }
    if (!o.crop.empty()) {
        auto const v = numbers<int>("--crop", o.crop, ',', 4);
        Vec2i const r = s.film.resolution;
        if (v[0] < 0 || v[1] < 0 || v[0] >= v[2] || v[1] >= v[3] || v[2] > r.x || v[3] > r.y)
            refuse(
                fmt::format("--crop {}: not x0,y0,x1,y1 with x0 < x1 and y0 < y1 inside the picture of {}x{}",
                            o.crop, r.x, r.y));
        s.film.crop = std::array<int, 4>{v[0], v[2], v[1], v[3]};
    }
    if (!o.color.empty()) s.color = o.color == "rgb" ? ColorMode::Rgb : ColorMode::Spectral;
    if (o.seed) s.seed = *o.seed;
    if (o.spp) s.spp = *o.spp;
    if (o.aovs) s.film.aovs = true;
    if (o.full_float) s.film.half_float = false;
    return s;
}

PassRange passes_of(RenderOptions const& o, Settings const& s) {
    if (!o.passes.empty()) {
        auto const v = numbers<std::uint64_t>("--passes", o.passes, ':', 2);
        if (v[0] >= v[1])
            refuse(fmt::format("--passes {}: the range A:B is empty; B must be larger than A", o.passes));
        return {v[0], v[1]};
    }
    // With a time limit alone, as many as fit.
    if (!o.time.empty() && !o.spp) return {0, std::uint64_t{1} << 62};
    return {0, static_cast<std::uint64_t>(s.spp)};
}

std::map<std::string, std::string> metadata(RenderJob const& job, Film const& film,
                                            RunStatistics const& stats) {
    Settings const& s = job.settings();
    return {{"renderer", "nephroid 0.1.0"},
            {"integrator", match(
                               s.integrator, [](PathIntegrator const&) { return "path"; },
                               [](WhittedIntegrator const&) { return "whitted"; },
                               [](DirectIntegrator const&) { return "direct"; })},
            {"colorMode", s.color == ColorMode::Rgb ? "rgb" : "spectral"},
            {"seed", std::to_string(s.seed)},
            {"samplesPerPixel", std::to_string(film.passes().count())},
            {"sceneHash", job.world().scene_hash()},
            {"renderSeconds", fmt::format("{:.3f}", stats.render_seconds)}};
}

void write_outputs(std::vector<std::string> const& outputs, Film const& film, RenderJob const& job,
                   RenderOptions const& o, RunStatistics const& stats) {
    DevelopSettings develop;
    develop.half_float = job.settings().film.half_float;
    develop.exposure = o.exposure;
    develop.metadata = metadata(job, film, stats);
    for (std::string const& out : outputs) {
        if (is_film_name(out)) {
            // No times in a film: two films of the same passes are the same file.
            DevelopSettings plain = develop;
            plain.metadata.erase("renderSeconds");
            write_film(out, film, plain);
        } else {
            write_picture(out, film, develop);
        }
        fmt::print("{}\n", fs::absolute(out).lexically_normal().string());
    }
}

}  // namespace

int run(RenderOptions const& o) {
    RunStatistics stats;
    auto t = std::chrono::steady_clock::now();
    auto const lap = [&] {
        double const s = since(t);
        t = std::chrono::steady_clock::now();
        return s;
    };
    check_outputs(o.outputs);
    if (!o.checkpoint.empty()) check_folder("--checkpoint", o.checkpoint);
    if (!o.stats.empty()) check_folder("--stats", o.stats);
    std::optional<double> const seconds = o.time.empty() ? std::nullopt : std::optional(seconds_of(o.time));
    Scene scene = read_scene(o.scene);
    Settings const settings = settings_of(o, scene);
    PassRange const passes = passes_of(o, settings);
    std::vector<std::string> outputs = o.outputs;
    if (outputs.empty()) {
        fs::path const named(settings.film.filename);
        outputs.push_back(named.empty() ? fs::path(o.scene).stem().string() + ".exr"
                                        : named.filename().string());
        check_outputs(outputs);
    }
    stats.read_seconds = lap();

    scene.settings = settings;  // so that overrides are validated like the rest
    World const world = compile(std::move(scene));
    RenderJob const job(world, settings);
    Film film = job.make_film();
    if (!o.resume.empty()) {
        CheckpointSource source;
        Film resumed = read_checkpoint(o.resume, &source);
        if (!source.problem.empty())
            fmt::print(stderr, "nephroid: {}; going on from {}\n", source.problem, source.file.string());
        try {
            merge_into(film, resumed);
        } catch (Error const& e) {
            refuse(fmt::format("--resume {}: {}", o.resume, e.what()));
        }
    }
    stats.compile_seconds = lap();

    bool const json = o.log == "json";
    std::size_t const notes = world.scene().notes.size();
    if (json) {
        fmt::print(stderr, "{{\"event\":\"notes\",\"count\":{}}}\n", notes);
    } else if (!o.quiet && notes > 0) {
        fmt::print(stderr, "{}: {} thing{} approximated or ignored; `nephroid info {}` lists {}\n", o.scene,
                   notes, notes == 1 ? "" : "s", o.scene, notes == 1 ? "it" : "them");
    }
    if (world.counts().lights == 0) {
        if (json) {
            fmt::print(stderr, "{{\"event\":\"warning\",\"text\":\"the scene has no lights\"}}\n");
        } else if (!o.quiet) {
            fmt::print(stderr, "{}: warning: the scene has no lights; the picture will be black\n", o.scene);
        }
    }

    ProgressPrinter progress(progress_style(o.quiet, o.log));
    RenderControl control;
    control.passes = passes;
    control.threads = o.threads;
    control.seconds = seconds;
    control.stop = &stop_on_signals();
    control.on_progress = std::ref(progress);
    control.checkpoint_seconds = o.checkpoint_every;
    if (!o.checkpoint.empty())
        control.on_checkpoint = [&](Film const& f) { write_checkpoint(o.checkpoint, f); };
    RenderResult const result = render(job, control, film);
    progress.finish();
    stats.render_seconds = result.seconds;
    lap();

    if (!o.checkpoint.empty()) write_checkpoint(o.checkpoint, film);
    write_outputs(outputs, film, job, o, stats);
    stats.write_seconds = lap();

    auto const crop = job.crop();
    stats.rays = result.rays;
    stats.memory = world.memory();
    stats.counts = world.counts();
    stats.film_bytes = film.bytes();
    stats.passes = result.passes;
    stats.samples = result.passes * static_cast<std::uint64_t>(crop[1] - crop[0]) *
                    static_cast<std::uint64_t>(crop[3] - crop[2]);
    stats.dropped = film.dropped();
    stats.threads =
        o.threads > 0 ? o.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (!o.stats.empty()) {
        std::string const text = to_json(stats).dump(2) + "\n";
        write_file_atomically(o.stats, std::as_bytes(std::span(text.data(), text.size())));
    }
    bool const interrupted = result.end == RenderEnd::Interrupted;
    if (json) {
        nlohmann::json j = to_json(stats);
        j["event"] = interrupted ? "interrupted" : "done";
        fmt::print(stderr, "{}\n", j.dump());
    } else if (!o.quiet) {
        fmt::print(stderr, "{}", table(stats));
    }
    if (interrupted) {
        if (!json)
            fmt::print(stderr, "nephroid: interrupted after {} passes; {}\n", film.passes().count(),
                       o.checkpoint.empty() ? "what there is was written"
                                            : fmt::format("go on with --resume {}", o.checkpoint));
        return kInterrupted;
    }
    return film.dropped() > 0 || result.rays.rejected > 0 ? kTainted : kGood;
}

}  // namespace nephroid::cli
