#include "memory.h"

#include "math/error.h"
#include "render/render.h"
#include "scene/match.h"
#include "statistics.h"
#include "transport/shooting.h"
#include "world/estimate.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

namespace nephroid::cli {

namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t saturated(std::uint64_t a, std::uint64_t b) { return a > kUnlimited - b ? kUnlimited : a + b; }
std::uint64_t minus(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

/// The number after `key` in a file of lines "key number"; `key` empty: the first number.
std::optional<std::uint64_t> number_in(std::string const& file, std::string const& key) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        if (!key.empty() && (!(words >> word) || word != key)) continue;
        std::uint64_t n = 0;
        if (words >> n) return n;
        if (key.empty()) return std::nullopt;  // "max"
    }
    return std::nullopt;
}

std::uint64_t pages(int field) {
    std::ifstream in("/proc/self/statm");
    std::uint64_t n = 0;
    for (int i = 0; i <= field; ++i) in >> n;
    return n * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// What a control group has left; pages of files that were read count as used there, and are given back when needed.
std::uint64_t left_in(std::string const& folder, char const* most_name, char const* used_name,
                      std::string const& prefix) {
    auto const most = number_in(folder + "/" + most_name, "");
    if (!most) return kUnlimited;
    std::uint64_t const used = number_in(folder + "/" + used_name, "").value_or(0);
    std::uint64_t files = 0;
    for (char const* kind : {"inactive_file", "active_file"})
        files += number_in(folder + "/memory.stat", prefix + kind).value_or(0);
    return minus(*most, minus(used, files));
}

/// Version 2 of control groups, where every group above ours has its own limit, then version 1.
std::uint64_t left_in_control_group() {
    std::string group;
    std::ifstream in("/proc/self/cgroup");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("0::")) group = line.substr(3);
    std::string const root = "/sys/fs/cgroup";
    std::uint64_t left =
        left_in(root + "/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_");
    for (;; group.resize(group.rfind('/'))) {
        left = std::min(left, left_in(root + group, "memory.max", "memory.current", ""));
        if (group.find('/') == std::string::npos) return left;
    }
}

/// What encoding a film takes at most, per pixel (film/develop.cpp, image/exr_write.cpp): six or 34 planes as floats,
/// and most of them once more as halves.
constexpr std::uint64_t kEncodingBytes = 36, kEncodingBytesAovs = 190;

/// A photon takes 48 bytes in a map, and 130 more while that is made (transport/photon_map.h). A path leaves two or three in the
/// maps of a room whose walls give back 60 or 70 %; of the caustic paths so do those that go on.
constexpr std::uint64_t kPhotonBytes = 178, kPathBytes = 400;
/// Photons of a map are numbered in 32 bits; the pilot's count is off by a little.
constexpr double kMostPhotons = 4e9;
/// Light tracing sums in double, by classes of light where layers are wanted, in the pass and in the one before; and keeps the
/// splats of 131072 paths, some each (transport/light_path_image.h).
constexpr std::uint64_t kSplatPixelBytes = 48, kSplatPixelBytesAovs = 240, kSplatPathBytes = 200,
                        kSplatPathsKept = 131072;

std::uint64_t count_or(int n, std::uint64_t otherwise) {
    return n < 0 ? otherwise : static_cast<std::uint64_t>(n);
}

}  // namespace

std::uint64_t MemoryNeed::total() const {
    return saturated(saturated(program, photons), saturated(world, film));
}

std::uint64_t photon_need(Settings const& settings) {
    FilmSettings const& film = settings.film;
    std::uint64_t const pixels =
        static_cast<std::uint64_t>(film.resolution.x) * static_cast<std::uint64_t>(film.resolution.y);
    return match(settings.integrator, [&](auto const& i) -> std::uint64_t {
        if constexpr (requires { i.shooting; }) {
            std::uint64_t const global = count_or(i.shooting.global_paths, pixels);
            return (global + count_or(i.shooting.caustic_paths, global)) * kPathBytes;
        } else if constexpr (requires { i.paths; }) {
            return pixels * (film.aovs ? kSplatPixelBytesAovs : kSplatPixelBytes) +
                   std::min(count_or(i.paths, pixels), kSplatPathsKept) * kSplatPathBytes;
        } else {
            return 0;
        }
    });
}

MemoryNeed refined(MemoryNeed need, RenderJob const& job) {
    if (!job.photon_plan()) return need;
    double const photons = expected_photons(job);
    if (!(photons < kMostPhotons))
        throw Error(
            ErrorKind::Limit,
            fmt::format(
                "about {:.3g} photons a pass are more than a map can hold, 2^32; shoot fewer paths a pass "
                "(photonsperiteration, indirectphotons, causticphotons) and render more passes",
                photons));
    return {pages(1), 0, need.film, static_cast<std::uint64_t>(photons) * kPhotonBytes};
}

MemoryNeed memory_need(Scene const& scene, std::array<int, 4> crop, bool aovs) {
    std::uint64_t const pixels = static_cast<std::uint64_t>(std::max(0, crop[1] - crop[0])) *
                                 static_cast<std::uint64_t>(std::max(0, crop[3] - crop[2]));
    std::uint64_t const encoding = pixels * (aovs ? kEncodingBytesAovs : kEncodingBytes);
    // A resumed film lies beside the new one for a moment, too: as large as what rendering takes.
    return {pages(1), minus(estimated_bytes(scene), held_bytes(scene)),
            film_bytes(pixels, aovs) + std::max(encoding, render_bytes(pixels, aovs)), 0};
}

std::uint64_t parse_bytes(std::string const& option, std::string const& text) {
    double v = 0;
    auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
    std::string unit(r.ptr, text.data() + text.size());
    for (char const* ending : {"iB", "B"})
        if (unit.ends_with(ending)) {
            unit.resize(unit.size() - std::string(ending).size());
            break;
        }
    auto const power = std::string("KMGT").find(unit.empty() ? ' ' : unit[0]);
    bool const known = unit.empty() || (unit.size() == 1 && power != std::string::npos);
    double const bytes = unit.empty() ? v : v * static_cast<double>(1ull << (10 * (known ? power + 1 : 0)));
    if (r.ec != std::errc{} || !known || !(v > 0) || !(bytes < 1e18))
        throw Error(ErrorKind::Input,
                    fmt::format("{} {}: expected a size such as 8G, 500M or 1000000", option, text));
    return static_cast<std::uint64_t>(bytes);
}

std::uint64_t available_memory() {
    std::uint64_t left = kUnlimited;
    if (auto const kib = number_in("/proc/meminfo", "MemAvailable:")) left = *kib * 1024;
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        left = std::min(left, minus(limit.rlim_cur, pages(0)));
    return std::min(left, left_in_control_group());
}

void check_memory(MemoryNeed const& need, std::optional<std::uint64_t> limit) {
    std::uint64_t const most = limit ? *limit : saturated(available_memory(), need.program);
    std::uint64_t const total = need.total();
    if (total <= most) return;
    std::string const photons =
        need.photons > 0 ? fmt::format(", {} for photons", bytes_text(need.photons)) : std::string();
    throw Error(
        ErrorKind::Limit,
        fmt::format("not enough memory: about {} are needed ({} in use, {} for the compiled scene, {} for "
                    "the film{}), and {} are {}; render fewer pixels (--size, --crop), a simpler scene{}, or "
                    "raise --memory-limit if you know better",
                    bytes_text(total), bytes_text(need.program), bytes_text(need.world),
                    bytes_text(need.film), photons, bytes_text(most), limit ? "allowed" : "available",
                    need.photons > 0 ? ", fewer photons a pass" : ""));
}

}  // namespace nephroid::cli
