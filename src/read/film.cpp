#include "options.h"
#include "shown.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

using Crop = std::array<int, 4>;

/// pbrt's rounding: a pixel belongs to a window when its lower corner does.
Crop crop_of(std::vector<float> const& window, Vec2i resolution) {
    auto const pixel = [](float t, int size) {
        return static_cast<int>(std::ceil(static_cast<float>(size) * clamp(t, 0, 1)));
    };
    return {pixel(std::min(window[0], window[1]), resolution.x),
            pixel(std::max(window[0], window[1]), resolution.x),
            pixel(std::min(window[2], window[3]), resolution.y),
            pixel(std::max(window[2], window[3]), resolution.y)};
}

void read_crop(Params& p, FilmSettings& film) {
    auto const bounds = p.integers("pixelbounds");
    auto const window = p.numbers("cropwindow");
    if (!bounds.empty() && bounds.size() != 4) p.fail("\"pixelbounds\" needs four values: x0 x1 y0 y1");
    if (!window.empty() && window.size() != 4) p.fail("\"cropwindow\" needs four values: x0 x1 y0 y1");
    Vec2i const r = film.resolution;
    if (!window.empty()) {
        if (!bounds.empty()) p.note("\"cropwindow\" wins over \"pixelbounds\"");
        film.crop = crop_of(window, r);
    } else if (!bounds.empty()) {
        film.crop = Crop{std::clamp(bounds[0], 0, r.x), std::clamp(bounds[1], 0, r.x),
                         std::clamp(bounds[2], 0, r.y), std::clamp(bounds[3], 0, r.y)};
        if (!std::equal(bounds.begin(), bounds.end(), film.crop->begin()))
            p.note("\"pixelbounds\" reaches beyond the picture and was clamped");
    }
    if (film.crop && ((*film.crop)[0] >= (*film.crop)[1] || (*film.crop)[2] >= (*film.crop)[3]))
        p.fail("the crop holds no pixel");
}

void read_resolution(Params& p, FilmSettings& film) {
    film.resolution = {p.integer("xresolution", 1280), p.integer("yresolution", 720)};
    if (film.resolution.x <= 0 || film.resolution.y <= 0)
        p.fail("\"xresolution\" and \"yresolution\" must be above 0");
    constexpr long long kMaxPixels = 1ll << 31;
    if (static_cast<long long>(film.resolution.x) * film.resolution.y >= kMaxPixels)
        throw Error(ErrorKind::Limit,
                    p.context().scene.locate(p.where()) + ": a film of " + std::to_string(film.resolution.x) +
                        " x " + std::to_string(film.resolution.y) + " pixels; the limit is 2^31 pixels");
}

}  // namespace

FilmSettings make_film(std::string const& type, Params& p) {
    if (type == "image") p.fail("\"image\" is of pbrt-v3; in pbrt-v4 it is \"rgb\"");
    if (type != "rgb" && type != "gbuffer" && type != "spectral")
        p.fail("unknown film" + did_you_mean(type, {"rgb", "gbuffer", "spectral"}));
    FilmSettings film;
    film.where = p.where();
    read_resolution(p, film);
    read_crop(p, film);
    film.filename = p.string("filename", "");
    film.iso = p.number("iso", 100);
    film.white_balance = p.number("whitebalance", 0);
    film.max_component = p.number("maxcomponentvalue", kInfinity);
    film.half_float = p.boolean("savefp16", true);
    p.number("diagonal", 35);  // of use to realistic cameras only
    if (auto const sensor = p.string("sensor", "cie1931"); sensor != "cie1931")
        p.note("sensor \"" + shown(sensor) + "\" is not simulated yet: cie1931 stands in");
    if (type == "gbuffer") {
        film.aovs = true;
        p.find("coordinatesystem", {ParamType::String});
    }
    if (type == "spectral") {
        p.note("spectral buckets are not written yet: an rgb film stands in");
        p.find("nbuckets"), p.find("lambdamin"), p.find("lambdamax");
    }
    return film;
}

}  // namespace nephroid
