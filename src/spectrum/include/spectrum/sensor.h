// What a film does with the light of one camera sample before it is summed: exposure and white balance (pbrt-v4's film
// sensors, of which only the ideal one, "cie1931", is simulated).
#pragma once

#include "math/vec.h"
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
    [[nodiscard]] Vec3 operator()(Spectrum radiance, Wavelengths const& lambda) const;

  private:
    std::array<Vec3, 3> rows_;
};

inline Vec3 sensor_rgb(Sensor const& sensor, Spectrum radiance, Wavelengths const& lambda) {
    return sensor(radiance, lambda);
}

inline constexpr std::string_view kIdealSensor = "cie1931";
/// Does pbrt-v4 have a sensor of this name? All but kIdealSensor are rendered as kIdealSensor: say so to the user.
bool is_known_sensor_name(std::string_view name);

}  // namespace nephroid
