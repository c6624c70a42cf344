// Any bytes are a .ray scene that validate() takes, or throw Error.
#include "fuzz.h"

#include "read/read.h"

void nephroid::fuzz(std::string_view bytes) {
    TemporaryFile const file(bytes, ".ray");
    Scene scene = read_scene(file.path());
    drop_degenerate(scene);
    validate(scene);
}
