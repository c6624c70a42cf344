// libFuzzer entry: any bytes either read as a scene that validate() takes or throw Error; never anything else.
//   clang++ -std=c++20 -fsanitize=fuzzer,address,undefined … tests/fuzz/fuzz_pbrt.cpp
#include "read/read.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    try {
        std::string_view const text(reinterpret_cast<char const*>(data), size);
        nephroid::validate(nephroid::read_pbrt_string(text, "fuzz.pbrt", "/nonexistent"));
    } catch (nephroid::Error const&) {
        // What bad input is for.
    }
    return 0;
}
