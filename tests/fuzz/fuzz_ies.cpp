// Any bytes are a measured lamp that validate() takes, or throw Error.
#include "fuzz.h"

#include "read/read.h"

void nephroid::fuzz(std::string_view bytes) {
    TemporaryFile const file(bytes, ".ies");
    validate(read_pbrt_string(
        "WorldBegin LightSource \"goniometric\" \"string filename\" \"" + file.path().string() + "\"",
        "fuzz.pbrt", "/nonexistent"));
}
