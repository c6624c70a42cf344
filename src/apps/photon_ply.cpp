#include "photon_ply.h"

#include "image/file.h"
#include "image/image.h"
#include "math/error.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <limits>
#include <span>

namespace nephroid::cli {

namespace {

static_assert(std::endian::native == std::endian::little, "the files are little endian");

std::array<float, 3> floats(Vec3 v) { return {v.x, v.y, v.z}; }
std::array<std::uint8_t, 3> bytes(Vec3 linear) {
    return {linear_to_srgb_byte(linear.x), linear_to_srgb_byte(linear.y), linear_to_srgb_byte(linear.z)};
}
std::int32_t whole(std::uint64_t n) {
    return static_cast<std::int32_t>(std::min<std::uint64_t>(n, std::numeric_limits<std::int32_t>::max()));
}

std::array<std::uint8_t, 3> color_of(PathSegment s) {
    constexpr std::array<std::array<std::uint8_t, 3>, 3> kColors{
        {{255, 255, 255}, {255, 200, 40}, {90, 160, 255}}};
    return kColors[static_cast<std::size_t>(s)];
}

constexpr char const* kColorProperties = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

void put(std::vector<std::byte>& out, auto const& value) {
    auto const old = out.size();
    out.resize(old + sizeof value);
    std::memcpy(out.data() + old, &value, sizeof value);
}
void put_text(std::vector<std::byte>& out, std::string const& text) {
    auto const b = std::as_bytes(std::span(text.data(), text.size()));
    out.insert(out.end(), b.begin(), b.end());
}

}  // namespace

void PhotonCloud::add(PhotonRecord const& photon, Wavelengths const& lambda, ShotKind map) {
    PlyPhoton& p = photons_.emplace_back();
    p.p = floats(photon.p), p.n = floats(photon.n), p.d = floats(photon.wi);
    p.power = floats(power_rgb(photon, lambda));
    p.map = map == ShotKind::Caustic ? 1 : 0;
    p.bounce = whole(photon.bounces), p.light = whole(photon.light);
}

void PhotonCloud::write(std::filesystem::path const& path) {
    auto const power = [](PlyPhoton const& p) { return Vec3{p.power[0], p.power[1], p.power[2]}; };
    std::vector<float> most;
    most.reserve(photons_.size());
    for (PlyPhoton const& p : photons_) most.push_back(max_component(power(p)));
    PhotonColors const colors(median_of(std::move(most)));
    for (PlyPhoton& p : photons_) p.color = bytes(colors(power(p)));

    NewFile file(path);
    std::string const header = fmt::format(
        "ply\nformat binary_little_endian 1.0\n"
        "comment nephroid: photons of one pass. power: W, linear sRGB; d: to where it came from; map: 0 "
        "global, 1 caustic\n"
        "element vertex {}\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "property float dx\nproperty float dy\nproperty float dz\n"
        "property float power_r\nproperty float power_g\nproperty float power_b\n"
        "{}property uchar map\nproperty int bounce\nproperty int light\nend_header\n",
        photons_.size(), kColorProperties);
    file.write(std::as_bytes(std::span(header.data(), header.size())));
    file.write(std::as_bytes(std::span(photons_)));
    file.commit();
}

void PathLines::add(TracedPath const& path) {
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
        auto const color = color_of(segment_of(path, i > 0 ? i - 1 : 0));
        vertices_.push_back({floats(path.vertices[i]), color});
        if (i == 0) continue;
        std::int32_t const here = whole(vertices_.size() - 1);
        edges_.push_back({{here - 1, here}, color});
    }
}

void PathLines::write(std::filesystem::path const& path) const {
    std::vector<std::byte> out;
    put_text(
        out,
        fmt::format("ply\nformat binary_little_endian 1.0\n"
                    "comment nephroid: photon paths, from the light on. white: direct, yellow: after mirrors "
                    "and glass alone, blue: after others\n"
                    "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
                    "element edge {}\nproperty int vertex1\nproperty int vertex2\n{}end_header\n",
                    vertices_.size(), kColorProperties, edges_.size(), kColorProperties));
    for (Vertex const& v : vertices_) put(out, v.p), put(out, v.color);
    for (Edge const& e : edges_) put(out, e.vertices), put(out, e.color);
    write_file_atomically(path, out);
}

}  // namespace nephroid::cli
