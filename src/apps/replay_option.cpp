#include "replay_option.h"

#include "asked_settings.h"
#include "console.h"
#include "image/file.h"
#include "names.h"
#include "path_json.h"
#include "path_plot.h"
#include "path_words.h"
#include "photon_overlay.h"
#include "statistics.h"

#include <fmt/format.h>

#include <limits>
#include <span>

namespace nephroid::cli {

std::optional<ReplayRequest> replay_request(RenderOptions const& o) {
    if (o.replay.empty()) return std::nullopt;
    ReplayRequest r;
    auto const v = numbers<std::uint64_t>("--replay", o.replay, ',', 3);
    constexpr std::uint64_t kFar = std::numeric_limits<int>::max();
    if (v[0] >= std::uint64_t{1} << 63)
        refuse_option(fmt::format("--replay {}: passes end at 2^63; choose a smaller one", o.replay));
    r.pass = v[0];
    r.pixel = {static_cast<int>(std::min(v[1], kFar)), static_cast<int>(std::min(v[2], kFar))};
    for (std::string const& out : o.outputs) {
        std::string const extension = extension_of(out);
        bool const ours = extension == ".svg" || extension == ".json";
        if (ours) check_target("-o", out);
        (ours ? r.files : r.pictures).push_back(out);
    }
    if (draws(o.overlay))
        refuse_option(
            "--replay with --show-photons, --show-paths or --show-normals: pictures show one of them; leave "
            "the other out");
    if (!r.pictures.empty()) return r;
    for (auto const& [option, given] : {std::pair{"--passes", !o.passes.empty()},
                                        {"--time", !o.time.empty()},
                                        {"--checkpoint", !o.checkpoint.empty()},
                                        {"--resume", !o.resume.empty()},
                                        {"--stats", !o.stats.empty()}})
        if (given)
            refuse_option(fmt::format(
                "--replay with {}: nothing is rendered without a picture to write (-o picture.png "
                "shows the path over it); leave {} out",
                option, option));
    return r;
}

void check_replay(ReplayRequest const& r, Settings const& s) {
    Vec2i const size = s.film.resolution;
    if (r.pixel.x >= size.x || r.pixel.y >= size.y)
        refuse_option(fmt::format(
            "--replay {},{},{}: the picture has {}x{} pixels; give pass,x,y with x from 0 to {} and y "
            "from 0 to {}",
            r.pass, r.pixel.x, r.pixel.y, size.x, size.y, size.x - 1, size.y - 1));
    if (!can_replay(s.integrator))
        refuse_option(fmt::format(
            "--replay: what {} shows comes from many light paths at once and not along one path of a "
            "pixel; add --integrator path, direct or whitted (nephroid photons writes light paths)",
            name_of(s.integrator)));
}

PathRecord run_replay(ReplayRequest const& request, RenderJob const& job) {
    PathRecord record = replay(job, request.pass, request.pixel);
    print_text(path_table(job, record));
    for (std::string const& file : request.files) {
        std::string const text =
            extension_of(file) == ".svg" ? path_svg(job, record) : json_text(to_json(job, record), 2) + "\n";
        write_file_atomically(file, std::as_bytes(std::span(text)));
        print_written(file);
    }
    return record;
}

}  // namespace nephroid::cli
