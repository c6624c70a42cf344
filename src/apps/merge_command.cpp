#include "commands.h"
#include "console.h"
#include "film/develop.h"
#include "math/error.h"
#include "memory.h"
#include "names.h"
#include "outputs.h"
#include "targets.h"

#include <fmt/format.h>

namespace nephroid::cli {

namespace {

/// Everything that can be refused without the sums, before they are read.
FilmHeader check(MergeOptions const& o) {
    check_outputs(o.outputs);
    std::vector<NamedFile> files;
    add_outputs(files, o.outputs);
    for (std::string const& f : o.films) files.push_back({"the film", f, FileRole::FilmInput});
    check_conflicts(files);
    FilmHeader first = read_film_header(o.films.front());
    PassSet passes;
    for (std::string const& f : o.films) {
        FilmHeader const header = read_film_header(f);
        if (std::string const how = difference(first, header); !how.empty())
            throw Error(ErrorKind::Input,
                        fmt::format("{}: cannot be merged with {}: {}; render again with the options "
                                    "of the other",
                                    f, o.films.front(), how));
        if (PassSet const common = passes.intersection(header.passes); !common.empty())
            throw Error(ErrorKind::Input,
                        fmt::format("{}: cannot be merged: its passes {} are in a film before it, and "
                                    "a pass counts once; leave one out",
                                    f, common.text()));
        passes.insert(header.passes);
    }
    check_output_size(o.outputs, first.crop);
    return first;
}

}  // namespace

int run(MergeOptions const& o) {
    FilmHeader const first = check(o);
    check_memory(memory_need({}, first.crop, first.aovs), std::nullopt);
    Film film = read_film(o.films.front());
    for (std::size_t i = 1; i < o.films.size(); ++i) {
        try {
            merge_into(film, read_film(o.films[i]));
        } catch (Error const& e) {
            if (std::string(e.what()).starts_with(o.films[i])) throw;
            throw Error(e.kind(), fmt::format("{}: {}", o.films[i], e.what()));
        }
    }
    DevelopSettings develop;
    develop.exposure = o.exposure;
    develop.half_float = !o.full_float;
    develop.metadata = {
        {"renderer", "nephroid 0.1.0"},
        {"samplesPerPixel", std::to_string(film.passes().count() * samples_of_a_pass(first.words))}};
    auto const errors =
        write_outputs(o.outputs, film, develop, [](std::string const& text) { say("nephroid: {}\n", text); });
    for (std::string const& error : errors) say("nephroid: {}\n", error);
    say("merged {} films: passes {}\n", o.films.size(), film.passes().text());
    if (film.tainted()) say("nephroid: {}\n", taint(film));
    if (!errors.empty()) return kIo;
    return film.tainted() ? kTainted : kGood;
}

}  // namespace nephroid::cli
