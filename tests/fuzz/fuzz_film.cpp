// Any bytes are a film, whose header says the same as it does and which can be written again, or an Error that names the file.
#include "fuzz.h"

#include "film/checkpoint.h"
#include "film/develop.h"
#include "math/error.h"

#include <cstdlib>

void nephroid::fuzz(std::string_view bytes) {
    TemporaryFile const file(bytes, ".film.exr");
    auto const& path = file.path();
    (void)is_film(path);
    (void)other_generation(path);
    try {
        Film const film = read_checkpoint(path);
        FilmHeader const header = read_film_header(path);
        if (!difference(header, film.header()).empty() || !(header.passes == film.passes())) std::abort();
        if (film.width() > 0) write_film(path, film, {});
    } catch (Error const& e) {
        if (std::string(e.what()).find(path.string()) == std::string::npos) std::abort();
    }
}
