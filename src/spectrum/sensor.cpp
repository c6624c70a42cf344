#include "spectrum/sensor.h"

#include "spectrum/color.h"

#include <algorithm>

namespace nephroid {

Sensor::Sensor(float imaging_ratio, std::optional<float> white_kelvin) {
    Matrix3 m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (white_kelvin)
        m = xyz_to_rgb(kSrgb) * (white_balance(daylight_xy(*white_kelvin), kSrgb.w) * rgb_to_xyz(kSrgb));
    for (std::size_t i = 0; i < 3; ++i) {
        auto const& row = m[i];
        rows_[i] = imaging_ratio * Vec3(row[0], row[1], row[2]);
    }
}

Vec3 Sensor::operator()(Spectrum radiance, Wavelengths const& lambda) const {
    Vec3 const rgb = to_linear_srgb(radiance, lambda);
    return {dot(rows_[0], rgb), dot(rows_[1], rgb), dot(rows_[2], rgb)};
}

bool is_known_sensor_name(std::string_view name) {
    // clang-format off
    static constexpr std::string_view names[] = {
        kIdealSensor,
        "canon_eos_100d", "canon_eos_1dx_mkii", "canon_eos_200d", "canon_eos_200d_mkii", "canon_eos_5d",
        "canon_eos_5d_mkii", "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds", "canon_eos_m",
        "hasselblad_l1d_20c", "nikon_d810", "nikon_d850",
        "sony_ilce_6400", "sony_ilce_7m3", "sony_ilce_7rm3", "sony_ilce_9"};
    // clang-format on
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

}  // namespace nephroid
