// Any bytes are a picture of some format, or an Error that names the file. The name ends in .tga, because that format has no
// mark: whatever has no other mark is taken for one.
#include "fuzz.h"

#include "image/exr.h"
#include "image/peek.h"
#include "image/read.h"
#include "math/error.h"

#include <cstdlib>

namespace {

/// Runs f; an Error has to say which file it is about.
template <class F>
void names_the_file(std::filesystem::path const& file, F&& f) {
    try {
        f();
    } catch (nephroid::Error const& e) {
        if (std::string(e.what()).find(file.string()) == std::string::npos) std::abort();
    }
}

}  // namespace

void nephroid::fuzz(std::string_view bytes) {
    TemporaryFile const file(bytes, ".tga");
    (void)peek_size(file.path());
    names_the_file(file.path(), [&] { (void)read_image(file.path()); });
    names_the_file(file.path(), [&] { (void)read_exr(file.path()); });
}
