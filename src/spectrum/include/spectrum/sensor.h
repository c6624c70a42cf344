// What a film does with the light of one camera sample before it is summed: exposure and white balance (pbrt-v4's film
// sensors, of which only the ideal one, "cie1931", is simulated).
#pragma once

#include "math/vec.h"
#include "spectrum/color.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

#include <array>
#include <optional>
#include <string_view>

namespace nephroid {

class Sensor {
  public:
    /// `imaging_ratio` is exposure time times ISO / 100. `white_kelvin`: daylight of this temperature becomes white.
    explicit Sensor(float imaging_ratio = 1, std::optional<float> white_kelvin = {});

    /// Linear sRGB.
    [[nodiscard]] Vec3 operator()(Spectrum radiance, Wavelengths const& lambda) const {
        Vec3 const rgb = to_linear_srgb(radiance, lambda);
        Spectrum const sensed = columns_[0] * rgb.x + columns_[1] * rgb.y + columns_[2] * rgb.z;
        return {sensed[0], sensed[1], sensed[2]};
    }

  private:
    std::array<Spectrum, 3> columns_;  // of the matrix, each in lanes 0..2
};

inline Vec3 sensor_rgb(Sensor const& sensor, Spectrum radiance, Wavelengths const& lambda) {
    return sensor(radiance, lambda);
}

inline constexpr std::string_view kIdealSensor = "cie1931";
/// Does pbrt-v4 have a sensor of this name? All but kIdealSensor are rendered as kIdealSensor: say so to the user.
bool is_known_sensor_name(std::string_view name);

}  // namespace nephroid
