#include "asked_settings.h"

#include "math/error.h"
#include "overrides.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::cli {

void refuse_option(std::string const& message) { throw Error(ErrorKind::Input, message); }

Settings settings_of(SettingOptions const& o, Scene const& scene) {
    Settings s = scene.settings;
    if (!o.integrator.empty()) set_integrator(s, o.integrator);
    for (std::string const& set : o.sets) apply_override(s, set);
    if (!o.size.empty()) {
        auto const v = numbers<int>("--size", o.size, 'x', 2);
        if (v[0] < 1 || v[1] < 1)
            refuse_option(fmt::format("--size {}: both sides must be at least 1", o.size));
        s.film.resolution = {v[0], v[1]};
        s.film.crop.reset();
    }
    if (!o.crop.empty()) {
        auto const v = numbers<int>("--crop", o.crop, ',', 4);
        Vec2i const r = s.film.resolution;
        if (v[0] < 0 || v[1] < 0 || v[0] >= v[2] || v[1] >= v[3] || v[2] > r.x || v[3] > r.y)
            refuse_option(
                fmt::format("--crop {}: not x0,y0,x1,y1 with x0 < x1 and y0 < y1 inside the picture of {}x{}",
                            o.crop, r.x, r.y));
        s.film.crop = std::array<int, 4>{v[0], v[2], v[1], v[3]};
    }
    if (!o.color.empty()) {
        s.color = o.color == "rgb" ? ColorMode::Rgb : ColorMode::Spectral;
        s.color_given = true;
    }
    if (o.seed) s.seed = *o.seed;
    if (o.spp) s.spp = *o.spp;
    if (o.aovs) s.film.aovs = true;
    if (o.full_float) s.film.half_float = false;
    return s;
}

}  // namespace nephroid::cli
