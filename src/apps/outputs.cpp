#include "outputs.h"

#include "console.h"
#include "math/error.h"
#include "targets.h"

#include <new>

namespace nephroid::cli {

std::vector<std::string> write_outputs(std::vector<std::string> const& outputs, Film const& film,
                                       DevelopSettings const& develop,
                                       std::function<void(std::string const&)> const& note) {
    std::vector<std::string> errors;
    for (std::string const& out : outputs) try {
            if (is_film_name(out)) {
                // No times in a film: two films of the same passes are the same file.
                DevelopSettings plain = develop;
                plain.metadata.erase("renderSeconds");
                write_film(out, film, plain);
            } else {
                for (std::string const& channel : write_picture(out, film, develop))
                    note(fmt::format(
                        "{}: the layer of channel {} holds numbers above 65504, the largest half: "
                        "written as 32-bit floats",
                        out, channel));
            }
            print_written(out);
        } catch (Error const& e) {
            errors.emplace_back(e.what());
        } catch (std::bad_alloc const&) {
            errors.push_back(out + ": out of memory");
        }
    return errors;
}

std::string taint(Film const& film) {
    std::string text;
    if (film.dropped() > 0) text = fmt::format("{} samples were not finite and were dropped", film.dropped());
    if (film.rejected() > 0)
        text += fmt::format("{}{} rays were not finite and were not traced", text.empty() ? "" : "; ",
                            film.rejected());
    return text.empty() ? text : "the picture is tainted: " + text;
}

}  // namespace nephroid::cli
