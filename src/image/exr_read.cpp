// Reading OpenEXR: as planes without loss (read_exr) and as a picture (decode_exr).
#include "exr_stream.h"
#include "image/exr.h"
#include "image/file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstring>

namespace nephroid {

namespace codec {

namespace {

std::optional<Chromaticities> chromaticities_of(Imf::Header const& header) {
    if (!Imf::hasChromaticities(header)) return std::nullopt;
    auto const& c = Imf::chromaticities(header);
    auto xy = [](Imath::V2f const& v) { return Vec2(v.x, v.y); };
    return Chromaticities{xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
}

bool has(Imf::Header const& header, std::string const& channel) {
    return header.channels().findChannel(channel) != nullptr;
}

/// The channels that make the picture, in order: plain RGB(A) first, then gray, then the first layer that has RGB, then
/// whatever is there.
std::vector<std::string> picture_channels(Imf::Header const& header) {
    auto with_alpha = [&](std::vector<std::string> names, std::string const& prefix) {
        if (has(header, prefix + "A")) names.push_back(prefix + "A");
        return names;
    };
    if (has(header, "R") && has(header, "G") && has(header, "B")) return with_alpha({"R", "G", "B"}, "");
    if (has(header, "Y")) return with_alpha({"Y"}, "");
    std::vector<std::string> all;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
        std::string const name = i.name();
        all.push_back(name);
        if (!name.ends_with(".R")) continue;
        std::string const layer = name.substr(0, name.size() - 1);
        if (has(header, layer + "G") && has(header, layer + "B"))
            return with_alpha({layer + "R", layer + "G", layer + "B"}, layer);
    }
    return all;
}

bool is_luminance_chroma(Imf::Header const& header) {
    return has(header, "Y") && has(header, "RY") && has(header, "BY") && !has(header, "R");
}

void require_full_resolution(Imf::Channel const& channel, std::string const& name, std::string const& path) {
    if (channel.xSampling != 1 || channel.ySampling != 1)
        fail(path, "channel '" + name + "' is subsampled; save it at full resolution");
}

/// Luminance and subsampled chroma: OpenEXR knows how to put them together.
Image decode_luminance_chroma(Bytes file, std::string const& path) {
    ExrSource source(file, path);
    Imf::RgbaInputFile input(source, 0);
    auto const window = input.dataWindow();
    int const width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    Image image(PixelFormat::Half, width, height,
                has(input.header(), "A") ? default_channel_names(4) : default_channel_names(3));
    image.chromaticities = chromaticities_of(input.header());
    std::vector<Imf::Rgba> row(static_cast<std::size_t>(width));
    // The library indexes with absolute coordinates; a row stride of 0 lets every line land in `row`.
    input.setFrameBuffer(row.data() - window.min.x, 1, 0);
    for (int y = 0; y < height; ++y) {
        input.readPixels(window.min.y + y);
        for (int x = 0; x < width; ++x) {
            Imf::Rgba const& p = row[static_cast<std::size_t>(x)];
            std::uint16_t const bits[4] = {p.r.bits(), p.g.bits(), p.b.bits(), p.a.bits()};
            std::copy_n(bits, image.channels(),
                        image.half_bits().begin() + static_cast<std::ptrdiff_t>(image.index(x, y, 0)));
        }
    }
    return image;
}

/// The first part with something to look at.
int picture_part(Imf::MultiPartInputFile const& input) {
    for (int part = 0; part < input.parts(); ++part) {
        auto const names = picture_channels(input.header(part));
        if (!names.empty() && (names.front().ends_with("R") || names.front() == "Y")) return part;
    }
    return 0;
}

Image decode_picture(Bytes file, std::string const& path) {
    ExrSource source(file, path);
    Imf::MultiPartInputFile input(source, 0);
    int const part_index = picture_part(input);
    Imf::Header const& header = input.header(part_index);
    if (input.parts() == 1 && is_luminance_chroma(header)) return decode_luminance_chroma(file, path);

    std::vector<std::string> const names = picture_channels(header);
    bool all_half = true;
    for (std::string const& name : names) {
        require_full_resolution(header.channels()[name], name, path);
        all_half = all_half && header.channels()[name].type == Imf::HALF;
    }
    auto const window = header.dataWindow();
    std::vector<std::string> plain = names;  // without the layer's name, if it is a picture
    if (names.size() >= 3 && names[0].ends_with(".R"))
        for (std::string& name : plain) name = name.substr(name.rfind('.') + 1);
    Image image(all_half ? PixelFormat::Half : PixelFormat::Float, window.max.x - window.min.x + 1,
                window.max.y - window.min.y + 1, plain);
    image.chromaticities = chromaticities_of(header);
    std::size_t const each = all_half ? 2 : 4;
    char* const base = all_half ? reinterpret_cast<char*>(image.half_bits().data())
                                : reinterpret_cast<char*>(image.floats().data());
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c)
        frame.insert(
            names[c],
            Imf::Slice::Make(all_half ? Imf::HALF : Imf::FLOAT, base + c * each, window, each * names.size(),
                             each * names.size() * static_cast<std::size_t>(image.width())));
    Imf::InputPart part(input, part_index);
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
    return image;
}

ExrChannel::Type type_of(Imf::Channel const& channel) {
    return channel.type == Imf::UINT   ? ExrChannel::Type::Uint
           : channel.type == Imf::HALF ? ExrChannel::Type::Half
                                       : ExrChannel::Type::Float;
}

ExrFile header_of(Imf::Header const& header) {
    auto const& data = header.dataWindow();
    auto const& display = header.displayWindow();
    ExrFile result;
    result.width = data.max.x - data.min.x + 1;
    result.height = data.max.y - data.min.y + 1;
    result.data_x0 = data.min.x;
    result.data_y0 = data.min.y;
    result.display_x0 = display.min.x;
    result.display_y0 = display.min.y;
    result.display_width = display.max.x - display.min.x + 1;
    result.display_height = display.max.y - display.min.y + 1;
    result.chromaticities = chromaticities_of(header);
    for (auto i = header.begin(); i != header.end(); ++i)
        if (auto const* text = dynamic_cast<Imf::StringAttribute const*>(&i.attribute()))
            if (std::strcmp(i.name(), "type") != 0 && std::strcmp(i.name(), "name") != 0)
                result.attributes[i.name()] = text->value();
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
        result.channels.push_back({.name = i.name(), .type = type_of(i.channel())});
    return result;
}

Imf::PixelType pixel_type(ExrChannel::Type type) {
    return type == ExrChannel::Type::Uint   ? Imf::UINT
           : type == ExrChannel::Type::Half ? Imf::HALF
                                            : Imf::FLOAT;
}

void read_planes(Imf::MultiPartInputFile& input, std::span<ExrTargetPlane const> planes,
                 std::string const& path) {
    Imf::Header const& header = input.header(0);
    auto const window = header.dataWindow();
    std::size_t const width = static_cast<std::size_t>(std::int64_t{window.max.x} - window.min.x + 1);
    Imf::FrameBuffer frame;
    for (ExrTargetPlane const& plane : planes) {
        Imf::Channel const* channel = header.channels().findChannel(plane.name);
        if (!channel) fail(path, "channel '" + plane.name + "' is missing");
        require_full_resolution(*channel, plane.name, path);
        frame.insert(plane.name, Imf::Slice::Make(pixel_type(plane.type), plane.base, window, plane.stride,
                                                  plane.stride * width));
    }
    Imf::InputPart part(input, 0);
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
}

}  // namespace

Image decode_exr(Bytes file, std::string const& path) {
    check_exr_headers(file, file.size(), kMaxImageBytes, path);
    return translating_exr_errors(path, [&] { return decode_picture(file, path); });
}

}  // namespace codec

ExrChannel const* ExrFile::find(std::string const& name) const {
    auto const found =
        std::find_if(channels.begin(), channels.end(), [&](ExrChannel const& c) { return c.name == name; });
    return found == channels.end() ? nullptr : &*found;
}

namespace {

constexpr std::int64_t kMaxPlaneBytes = std::int64_t{1} << 36;
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 24;

/// Calls f(input, header) with the first part of a file whose headers can be trusted not to lie about sizes.
template <class F>
ExrFile with_exr(std::filesystem::path const& path, std::int64_t most_bytes, F&& f) {
    std::string const name = path.string();
    codec::ExrFileSource source(path);
    std::vector<std::byte> const head = source.head(kMaxHeaderBytes);
    constexpr unsigned char kMagic[4] = {0x76, 0x2f, 0x31, 0x01};
    if (head.size() < 4 || std::memcmp(head.data(), kMagic, 4) != 0) codec::fail(name, "is no EXR file");
    codec::check_exr_headers(head, source.size(), most_bytes, name);
    return codec::translating_exr_errors(name, [&] {
        Imf::MultiPartInputFile input(source, 0);
        ExrFile result = codec::header_of(input.header(0));
        f(input, result);
        return result;
    });
}

std::size_t pixels_of(ExrFile const& file) {
    return static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height);
}

}  // namespace

ExrFile read_exr_header(std::filesystem::path const& path) {
    return with_exr(path, kMaxPlaneBytes, [](auto&, auto&) {});
}

ExrFile read_exr(std::filesystem::path const& path,
                 std::function<std::vector<ExrTargetPlane>(ExrFile const& header)> const& places) {
    return with_exr(path, kMaxPlaneBytes, [&](Imf::MultiPartInputFile& input, ExrFile const& header) {
        codec::read_planes(input, places(header), path.string());
    });
}

ExrFile read_exr(std::filesystem::path const& path) {
    return with_exr(path, kMaxImageBytes, [&](Imf::MultiPartInputFile& input, ExrFile& file) {
        // Halves come back as floats, which hold each of them exactly.
        std::size_t const n = pixels_of(file);
        if (4 * n * file.channels.size() > 4 * static_cast<std::size_t>(kMaxImageBytes))
            codec::fail(path.string(), "the EXR planes need more than 8 GiB", ErrorKind::Limit);
        std::vector<ExrTargetPlane> planes;
        for (ExrChannel& c : file.channels) {
            bool const integers = c.type == ExrChannel::Type::Uint;
            if (integers)
                c.uints.resize(n);
            else
                c.data.resize(n);
            void* const base = integers ? static_cast<void*>(c.uints.data()) : c.data.data();
            planes.push_back({c.name, integers ? ExrChannel::Type::Uint : ExrChannel::Type::Float,
                              static_cast<std::byte*>(base), 4});
        }
        codec::read_planes(input, planes, path.string());
    });
}

}  // namespace nephroid
