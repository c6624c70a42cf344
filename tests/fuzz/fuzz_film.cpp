// libFuzzer entry: any bytes are a film, whose header says the same as it does and which can be written again, or an Error
// that names the file; never anything else.
//   clang++ -std=c++20 -fsanitize=fuzzer,address,undefined … tests/fuzz/fuzz_film.cpp
#include "film/checkpoint.h"
#include "film/develop.h"
#include "image/file.h"
#include "math/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    static std::filesystem::path const path = std::filesystem::temp_directory_path() /
                                              ("nephroid-fuzz-" + std::to_string(::getpid()) + ".film.exr");
    nephroid::write_file_atomically(path, std::as_bytes(std::span(data, size)));
    (void)nephroid::is_film(path);
    (void)nephroid::other_generation(path);
    try {
        nephroid::Film const film = nephroid::read_checkpoint(path);
        nephroid::FilmHeader const header = nephroid::read_film_header(path);
        if (!nephroid::difference(header, film.header()).empty() || !(header.passes == film.passes()))
            std::abort();
        if (film.width() > 0) nephroid::write_film(path, film, {});
    } catch (nephroid::Error const& e) {
        if (std::string(e.what()).find(path.string()) == std::string::npos) std::abort();
    }
    std::filesystem::remove(path);
    return 0;
}
