#include "checkpoint_guard.h"

#include "film/checkpoint.h"
#include "film/develop.h"
#include "math/error.h"

#include <fmt/format.h>

#include <filesystem>

namespace nephroid::cli {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(std::string const& message) { throw Error(ErrorKind::Input, message); }

bool same_file(fs::path const& a, fs::path const& b) {
    std::error_code ec;
    fs::path const one = fs::weakly_canonical(a, ec);
    if (ec) return false;
    fs::path const other = fs::weakly_canonical(b, ec);
    return !ec && one == other;
}

std::string offer(fs::path const& other) {
    return other.empty() ? std::string()
                         : fmt::format("; --resume {} is whole and of this render", other.string());
}

/// Is everything in `set` also in `all`?
bool contains(PassSet const& all, PassSet const& set) { return all.intersection(set) == set; }

void guard_generation(std::string const& file, fs::path const& generation, FilmHeader const& job,
                      PassSet const& kept) {
    FilmHeader there;
    try {
        there = read_film_header(generation);
    } catch (Error const& e) {
        refuse(
            fmt::format("--checkpoint {}: would overwrite what is no film, or a damaged one ({}){}; name "
                        "another file, or delete it",
                        file, e.what(), offer(other_generation(file, &job))));
    }
    if (std::string const how = difference(there, job); !how.empty())
        refuse(fmt::format("--checkpoint {}: {} holds another render: {}; name another file, or delete it",
                           file, generation.string(), how));
    if (!contains(kept, there.passes))
        refuse(fmt::format(
            "--checkpoint {}: {} holds passes {} of this render, some of which would be lost; go on "
            "with --resume {}, name another file, or delete it",
            file, generation.string(), there.passes.text(), generation.string()));
}

}  // namespace

void resume(std::string const& file, Film& film) {
    FilmHeader const job = film.header();
    Film resumed = read_checkpoint(file);
    if (std::string const how = difference(resumed.header(), job); !how.empty())
        refuse(fmt::format("--resume {}: the film is of another render: {}; render with its options{}", file,
                           how, offer(other_generation(file, &job))));
    merge_into(film, resumed);
}

void guard_checkpoint(std::string const& file, std::string const& resumed, Film const& film) {
    fs::path const path(file);
    if (!resumed.empty() && same_file(resumed, path)) return;
    // What is in the film now, and nothing that may or may not be rendered: the first checkpoint comes before the last pass.
    PassSet const& kept = film.passes();
    std::error_code ec;
    if (fs::exists(path, ec)) {
        // Going on from an older generation is what one does when the newest is damaged.
        bool const recovering = !resumed.empty() && (same_file(resumed, file + ".previous") ||
                                                     same_file(resumed, file + ".next"));
        if (recovering) try {
                (void)read_film(path);
            } catch (Error const&) {
                return;
            }
        guard_generation(file, path, film.header(), kept);
        return;
    }
    for (char const* suffix : {".next", ".previous"})
        if (std::string const other = file + suffix; fs::exists(other, ec))
            guard_generation(file, other, film.header(), kept);
}

}  // namespace nephroid::cli
