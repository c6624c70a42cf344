// libFuzzer entry: any bytes are a picture of some format or an Error that names the file; never anything else. The name ends
// in .tga, because that format has no mark: whatever has no other mark is taken for one.
//   clang++ -std=c++20 -fsanitize=fuzzer,address,undefined … tests/fuzz/fuzz_image.cpp
#include "image/exr.h"
#include "image/file.h"
#include "image/peek.h"
#include "image/read.h"
#include "math/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

#include <unistd.h>

namespace {

std::filesystem::path const& file() {
    static std::filesystem::path const path =
        std::filesystem::temp_directory_path() / ("nephroid-fuzz-" + std::to_string(::getpid()) + ".tga");
    return path;
}

template <class F>
void expect_no_other_error(F&& f) {
    try {
        f();
    } catch (nephroid::Error const& e) {
        if (std::string(e.what()).find(file().string()) == std::string::npos) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    nephroid::write_file_atomically(file(), std::as_bytes(std::span(data, size)));
    (void)nephroid::peek_size(file());
    expect_no_other_error([] { (void)nephroid::read_image(file()); });
    expect_no_other_error([] { (void)nephroid::read_exr(file()); });
    std::filesystem::remove(file());
    return 0;
}
