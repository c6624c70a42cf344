// libFuzzer's entry: Error is what bad input is for, and all else reaches the fuzzer.
#include "fuzz.h"

#include "math/error.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    try {
        nephroid::fuzz({reinterpret_cast<char const*>(data), size});
    } catch (nephroid::Error const&) {
        return 0;  // refused, and it said why
    }
    return 0;
}
