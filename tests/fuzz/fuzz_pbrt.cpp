// Any bytes are a scene that validate() takes, or throw Error.
#include "fuzz.h"

#include "read/read.h"

void nephroid::fuzz(std::string_view bytes) {
    Scene scene = read_pbrt_string(bytes, "fuzz.pbrt", "/nonexistent");
    drop_degenerate(scene);
    validate(scene);
}
