// Public test files and deliberately broken ones. They are not part of the project: without them the cases say so.
#include "support.h"

#include "image/chromaticity.h"
#include "image/read.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace nephroid;
using test::error_of;
namespace fs = std::filesystem;

namespace {

std::optional<fs::path> data(std::string_view folder) {
    auto const path = test::shared(folder);
    if (!path) MESSAGE("skipped: no test data at NEPHROID_SHARED/", std::string(folder));
    return path;
}

/// Reads it and checks that it took no longer than a reader may. Returns whether it was accepted.
bool accepts(fs::path const& path) {
    auto const start = std::chrono::steady_clock::now();
    std::string message;
    auto const error = error_of([&] { (void)read_image(path); }, &message);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
    if (error) CHECK(message.find(path.string() + ": ") == 0);
    return !error.has_value();
}

std::uint32_t fnv1a(std::vector<std::uint8_t> const& bytes) {
    std::uint32_t hash = 0x811c9dc5u;
    for (std::uint8_t const b : bytes) hash = (hash ^ b) * 0x01000193u;
    return hash;
}

/// The picture as encoded bytes; 16 bits lose their lower half, as in the reference hashes.
std::vector<std::uint8_t> to_bytes(Image const& image) {
    if (image.format() == PixelFormat::U8) return image.u8();
    std::vector<std::uint8_t> bytes;
    int const alpha = image.channel("A").value_or(-1);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < image.channels(); ++c) {
                float const v = image.get(x, y, c);
                auto const word =
                    static_cast<unsigned>(std::lround((c == alpha ? v : linear_to_srgb(v)) * 65535.0f));
                bytes.push_back(static_cast<std::uint8_t>(word >> 8));
            }
    return bytes;
}

}  // namespace

TEST_CASE("PngSuite: valid files decode to the reference hashes, corrupt ones are refused") {
    auto const root = data("data/malformed/image/stb-pngsuite");
    if (!root) return;
    std::ifstream table(*root / "ref_results.csv");
    std::string line;
    std::getline(table, line);
    int compared = 0;
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string name, width, height, components, error, hash;
        std::getline(fields, name, ',');
        std::getline(fields, width, ',');
        std::getline(fields, height, ',');
        std::getline(fields, components, ',');
        std::getline(fields, error, ',');
        std::getline(fields, hash, ',');
        while (!hash.empty() && (hash.back() == '\r' || hash.back() == '\n')) hash.pop_back();
        fs::path const path = *root / name.substr(name.find('/') + 1);
        // Apple's variant is no PNG; libpng refuses it. The corrupt folder is looked at below.
        if (name.find("/iphone/") != std::string::npos || name.find("/corrupt/") != std::string::npos)
            continue;
        CAPTURE(name);
        Image const image = read_image(path);
        CHECK(image.width() == std::stoi(width));
        CHECK(image.height() == std::stoi(height));
        CHECK(image.channels() == std::stoi(components));
        CHECK(fnv1a(to_bytes(image)) == std::stoul(hash, nullptr, 16));
        ++compared;
    }
    CHECK(compared > 200);
    for (auto const& entry : fs::directory_iterator(*root / "corrupt")) {
        CAPTURE(entry.path().string());
        CHECK_FALSE(accepts(entry.path()));
    }
    for (auto const& entry : fs::directory_iterator(*root / "iphone")) CHECK_FALSE(accepts(entry.path()));
}

TEST_CASE("broken files of every format are refused by name, good ones read") {
    auto const root = data("data/malformed/made");
    if (!root) return;
    std::ifstream manifest(*root / "MANIFEST.tsv");
    std::string line;
    int seen = 0;
    while (std::getline(manifest, line)) {
        std::istringstream fields(line);
        std::string name, verdict;
        std::getline(fields, name, '\t');
        std::getline(fields, verdict, '\t');
        std::string const folder = name.substr(0, name.find('/'));
        if (folder != "png" && folder != "exr" && folder != "hdr" && folder != "pfm") continue;
        CAPTURE(name);
        bool const accepted = accepts(*root / name);
        if (verdict == "accept") CHECK(accepted);
        if (verdict == "reject") CHECK_FALSE(accepted);
        if (folder == "exr") CHECK((accepted || error_of([&] { (void)read_exr(*root / name); }).has_value()));
        ++seen;
    }
    CHECK(seen > 90);
}

TEST_CASE("OpenEXR's conformance pictures are read") {
    auto const root = data("data/exr-conformance");
    if (!root) return;
    int seen = 0;
    for (auto const& entry : fs::recursive_directory_iterator(*root)) {
        if (entry.path().extension() != ".exr") continue;
        CAPTURE(entry.path().string());
        CHECK(accepts(entry.path()));
        ++seen;
    }
    CHECK(seen >= 25);

    auto half = [&](std::string_view name) { return read_image(*root / name); };
    Image const all = half("TestImages/AllHalfValues.exr");
    CHECK(all.format() == PixelFormat::Half);
    std::vector<bool> met(65536);
    for (std::uint16_t const bits : all.half_bits()) met[bits] = true;
    int missing = 0;
    for (bool const m : met) missing += m ? 0 : 1;
    CHECK(missing == 0);
    CHECK(count_bad_pixels(half("TestImages/BrightRings.exr")) == 0);
    Image rings = half("TestImages/BrightRingsNanInf.exr");
    CHECK(sanitize(rings) > 0);
    CHECK(count_bad_pixels(rings) == 0);
    CHECK(half("TestImages/WideFloatRange.exr").format() == PixelFormat::Float);

    // Luminance-chroma is the RGB picture again, but for the filtered chroma.
    Image const rgb = half("Chromaticities/Rec709.exr"), yc = half("Chromaticities/Rec709_YC.exr");
    REQUIRE(rgb.width() == yc.width());
    CHECK(yc.channels() >= 3);
    double difference = 0;
    for (int y = 0; y < rgb.height(); ++y)
        for (int x = 0; x < rgb.width(); ++x) difference += std::abs(rgb.get(x, y, 1) - yc.get(x, y, 1));
    CHECK(difference / (rgb.width() * rgb.height()) < 0.005);
    for (char const* name : {"Chromaticities/XYZ.exr", "Chromaticities/XYZ_YC.exr"}) {
        CAPTURE(name);
        Image xyz = half(name);  // the same picture in other primaries
        CHECK(convert_to_rec709(xyz));
        CHECK_FALSE(xyz.chromaticities.has_value());
        difference = 0;
        for (int y = 0; y < rgb.height(); ++y)
            for (int x = 0; x < rgb.width(); ++x)
                for (int c = 0; c < 3; ++c) difference += std::abs(rgb.get(x, y, c) - xyz.get(x, y, c));
        CHECK(difference / (3.0 * rgb.width() * rgb.height()) < 0.01);
    }
    CHECK(read_exr(*root / "Tiles/GoldenGate.exr").channels.size() >= 3);
    ExrFile const window = read_exr(*root / "DisplayWindow/t08.exr");
    CHECK(window.width == 400);
    CHECK(window.height == 300);
}

TEST_CASE("TGA files of another program: raw and run-length encoded show the same") {
    auto const root = data("data/mitsuba/mitsuba-data/tests/bitmap");
    if (!root) return;
    Image const raw = read_image(*root / "tga_uncompressed.tga"),
                runs = read_image(*root / "tga_compressed.tga");
    CHECK(raw.width() == 100);
    CHECK(raw.height() == 67);
    CHECK(raw.u8() == runs.u8());
}
