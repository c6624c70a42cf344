#include "spectrum/sensor.h"

#include <algorithm>

namespace nephroid {

Sensor::Sensor(float imaging_ratio, std::optional<float> white_kelvin) {
    Matrix3 m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (white_kelvin)
        m = xyz_to_rgb(kSrgb) * (white_balance(daylight_xy(*white_kelvin), kSrgb.w) * rgb_to_xyz(kSrgb));
    for (std::size_t i = 0; i < 3; ++i) {
        auto const& row = m[i];
        for (std::size_t j = 0; j < 3; ++j)
            columns_[j].set(static_cast<int>(i), imaging_ratio * static_cast<float>(row[j]));
    }
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
