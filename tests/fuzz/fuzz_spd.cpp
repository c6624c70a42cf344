// Any bytes are a spectrum, or throw Error.
#include "fuzz.h"

#include "read/read.h"

void nephroid::fuzz(std::string_view bytes) {
    TemporaryFile const file(bytes, ".spd");
    validate(
        read_pbrt_string("WorldBegin LightSource \"point\" \"spectrum I\" \"" + file.path().string() + "\"",
                         "fuzz.pbrt", "/nonexistent"));
}
