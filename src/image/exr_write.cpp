// Writing OpenEXR, line by line into the file that takes the place of the old one in the end.
#include "exr_stream.h"
#include "image/file.h"
#include "image/write.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace nephroid {

namespace {

Imf::PixelType pixel_type(ExrChannel::Type type) {
    switch (type) {
        case ExrChannel::Type::Half:
            return Imf::HALF;
        case ExrChannel::Type::Float:
            return Imf::FLOAT;
        case ExrChannel::Type::Uint:
            break;
    }
    return Imf::UINT;
}

void check(ExrFile const& file, bool alone, std::string const& path) {
    codec::check_size(path, file.width, file.height, 1, 1);
    if (file.channels.empty() && alone) codec::fail(path, "cannot write an EXR file without channels");
    std::size_t const n = static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height);
    for (ExrChannel const& c : file.channels) {
        std::size_t const have = c.type == ExrChannel::Type::Uint ? c.uints.size() : c.data.size();
        if (c.name.empty() || have != n)
            codec::fail(path, "channel '" + c.name + "' has " + std::to_string(have) + " values for " +
                                  std::to_string(n) + " pixels");
    }
}

std::vector<std::uint16_t> to_halves(std::vector<float> const& values) {
    std::vector<std::uint16_t> plane(values.size());
    std::transform(values.begin(), values.end(), plane.begin(), [](float v) {
        return float_to_half(std::isfinite(v) ? clamp(v, -kLargestHalf, kLargestHalf) : v);
    });
    return plane;
}

Imf::Header make_header(ExrFile const& file, std::span<ExrSourcePlane const> more,
                        ExrCompression compression) {
    Imath::Box2i const data(Imath::V2i(file.data_x0, file.data_y0),
                            Imath::V2i(file.data_x0 + file.width - 1, file.data_y0 + file.height - 1));
    Imath::Box2i display = data;
    if (file.display_width > 0 && file.display_height > 0)
        display = Imath::Box2i(
            Imath::V2i(file.display_x0, file.display_y0),
            Imath::V2i(file.display_x0 + file.display_width - 1, file.display_y0 + file.display_height - 1));
    Imf::Header header(display, data, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y,
                       compression == ExrCompression::Zip ? Imf::ZIP_COMPRESSION : Imf::RLE_COMPRESSION);
    for (auto const& [name, text] : file.attributes) header.insert(name, Imf::StringAttribute(text));
    if (file.chromaticities) {
        auto xy = [](Vec2 v) { return Imath::V2f(v.x, v.y); };
        Chromaticities const& c = *file.chromaticities;
        Imf::addChromaticities(header, Imf::Chromaticities(xy(c.r), xy(c.g), xy(c.b), xy(c.w)));
    }
    for (ExrChannel const& c : file.channels)
        header.channels().insert(c.name, Imf::Channel(pixel_type(c.type)));
    for (ExrSourcePlane const& plane : more)
        header.channels().insert(plane.name, Imf::Channel(pixel_type(plane.type)));
    return header;
}

}  // namespace

void write_exr(std::filesystem::path const& path, ExrFile const& file, std::span<ExrSourcePlane const> more,
               ExrCompression compression) {
    std::string const name = path.string();
    check(file, more.empty(), name);
    NewFile target(path);
    try {
        codec::translating_exr_errors(name, [&] {
            Imf::Header const header = make_header(file, more, compression);
            auto const& window = header.dataWindow();
            std::vector<std::vector<std::uint16_t>>
                halves;  // converted planes must live until they are written
            halves.reserve(file.channels.size());
            Imf::FrameBuffer frame;
            auto const insert = [&](std::string const& channel, ExrChannel::Type type, void const* base,
                                    std::size_t stride) {
                frame.insert(channel, Imf::Slice::Make(pixel_type(type), base, window, stride,
                                                       stride * static_cast<std::size_t>(file.width)));
            };
            for (ExrChannel const& c : file.channels) {
                if (c.type == ExrChannel::Type::Half)
                    insert(c.name, c.type, halves.emplace_back(to_halves(c.data)).data(), 2);
                else
                    insert(c.name, c.type,
                           c.type == ExrChannel::Type::Uint ? static_cast<void const*>(c.uints.data())
                                                            : c.data.data(),
                           4);
            }
            for (ExrSourcePlane const& plane : more) insert(plane.name, plane.type, plane.base, plane.stride);
            codec::ExrSink sink(name, target);
            {
                Imf::OutputFile output(sink, header, 0);
                output.setFrameBuffer(frame);
                output.writePixels(file.height);
                // The file is complete when `output` is destroyed, which writes the table of offsets.
            }
            sink.flush();
        });
    } catch (Error const&) {
        if (!target.failed()) throw;
    }
    target.commit();  // says what failed
}

void write_exr(std::filesystem::path const& path, Image const& image) {
    if (image.empty()) codec::fail(path.string(), "cannot write an empty image");
    ExrFile file;
    file.width = image.width();
    file.height = image.height();
    file.chromaticities = image.chromaticities;
    auto const type = image.format() == PixelFormat::Half ? ExrChannel::Type::Half : ExrChannel::Type::Float;
    for (int c = 0; c < image.channels(); ++c) {
        ExrChannel& channel = file.channels.emplace_back();
        channel.name = image.channel_names()[static_cast<std::size_t>(c)];
        channel.type = type;
        channel.data.reserve(static_cast<std::size_t>(image.width()) *
                             static_cast<std::size_t>(image.height()));
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) channel.data.push_back(image.get(x, y, c));
    }
    write_exr(path, file);
}

void write_image(std::filesystem::path const& path, Image const& image) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") return write_exr(path, image);
    if (extension == ".png") return write_png(path, image);
    if (extension == ".jpg" || extension == ".jpeg") return write_jpeg(path, image);
    if (extension == ".pfm") return write_pfm(path, image);
    if (extension == ".hdr") return write_hdr(path, image);
    codec::fail(path.string(),
                "cannot tell the format from the name; end it in .exr, .png, .jpg, .pfm or .hdr");
}

}  // namespace nephroid
