// Runs every file of the folders given: the fuzzers' corpus as a test, in builds without libFuzzer.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

int main(int argc, char** argv) {
    std::vector<std::filesystem::path> files;
    for (int i = 1; i < argc; ++i)
        for (auto const& entry : std::filesystem::recursive_directory_iterator(argv[i]))
            if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    int faults = 0;
    for (auto const& file : files) {
        std::ifstream in(file, std::ios::binary);
        std::string const bytes(std::istreambuf_iterator<char>(in), {});
        // Said first: what crashes says nothing afterwards.
        std::printf("%s\n", file.c_str());
        std::fflush(stdout);
        try {
            LLVMFuzzerTestOneInput(reinterpret_cast<std::uint8_t const*>(bytes.data()), bytes.size());
        } catch (std::exception const& e) {
            std::printf("FAULT: %s\n", e.what());
            ++faults;
        }
    }
    std::printf("%zu files, %d faults\n", files.size(), faults);
    return files.empty() || faults > 0 ? 1 : 0;
}
