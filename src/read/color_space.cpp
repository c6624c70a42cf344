#include "color_space.h"

#include "spectrum/color.h"

#include <cctype>
#include <string>

namespace nephroid {

std::optional<FileColorSpace> file_color_space(std::string_view text) {
    std::string name(text);
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (name == "srgb") return FileColorSpace::Srgb;
    if (name == "dci-p3") return FileColorSpace::DciP3;
    if (name == "rec2020") return FileColorSpace::Rec2020;
    if (name == "aces2065-1") return FileColorSpace::Aces2065;
    if (name == "srgb-acesd60") return FileColorSpace::SrgbAcesD60;
    return std::nullopt;
}

RgbWhite white_of(FileColorSpace space) {
    return space == FileColorSpace::Aces2065 || space == FileColorSpace::SrgbAcesD60 ? RgbWhite::AcesD60
                                                                                     : RgbWhite::D65;
}

Vec3 to_srgb(Vec3 rgb, FileColorSpace from) {
    switch (from) {
        case FileColorSpace::Srgb:
        case FileColorSpace::SrgbAcesD60:
            break;
        case FileColorSpace::DciP3:
            return convert_rgb(rgb, kDciP3, kSrgb);
        case FileColorSpace::Rec2020:
            return convert_rgb(rgb, kRec2020, kSrgb);
        case FileColorSpace::Aces2065:
            return convert_rgb(rgb, kAces2065, kSrgb);
    }
    return rgb;
}

}  // namespace nephroid
