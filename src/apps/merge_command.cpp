#include "commands.h"
#include "film/develop.h"
#include "math/error.h"

#include <fmt/format.h>

#include <filesystem>

namespace nephroid::cli {

namespace {}  // namespace

int run(MergeOptions const& o) {
    Film film = read_film(o.films.front());
    for (std::size_t i = 1; i < o.films.size(); ++i) {
        try {
            merge_into(film, read_film(o.films[i]));
        } catch (Error const& e) {
            throw Error(e.kind(), fmt::format("{}: {}", o.films[i], e.what()));
        }
    }
    DevelopSettings develop;
    develop.exposure = o.exposure;
    develop.half_float = !o.full_float;
    develop.metadata = {{"renderer", "nephroid 0.1.0"},
                        {"samplesPerPixel", std::to_string(film.passes().count())}};
    for (std::string const& out : o.outputs) {
        bool const as_film = out.size() > 9 && out.compare(out.size() - 9, 9, ".film.exr") == 0;
        if (as_film) {
            write_film(out, film, develop);
        } else {
            write_picture(out, film, develop);
        }
        fmt::print("{}\n", std::filesystem::absolute(out).lexically_normal().string());
    }
    fmt::print(stderr, "merged {} films: passes {}\n", o.films.size(), film.passes().text());
    return film.dropped() > 0 ? kTainted : kGood;
}

}  // namespace nephroid::cli
