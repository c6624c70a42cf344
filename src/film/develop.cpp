#include "film/develop.h"

#include "beauty.h"
#include "math/error.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace nephroid {

namespace {

/// Calls f(x, y) for every pixel of the film in rows, from the top.
template <class F>
void for_each_pixel(Film const& film, F f) {
    auto const [x0, x1, y0, y1] = film.crop();
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) f(x, y);
}

double mean(PixelSums const& s, std::size_t c) { return s.weight != 0 ? s.rgb[c] / s.weight : 0; }

/// A pixel is the ratio m = sum(w v) / sum(w), whose denominator is random too, and w may be negative. To first order
/// the error of a ratio is sum(w v - w M) / sum(w) with the true mean M (Cochran, Sampling Techniques, ch. 6): a sum of
/// independent terms of mean 0, whose variance is estimated by the sum of their squares with m for M,
///     Var m = n/(n-1) * sum((w v - w m)^2) / sum(w)^2,
///     sum((w v - w m)^2) = sum((w v)^2) - 2 m sum(w^2 v) + m^2 sum(w^2).
/// For w = 1 this is the textbook s^2/n.
double variance(PixelSums const& s, std::size_t c) {
    if (s.weight == 0) return 0;
    double const m = mean(s, c);
    if (s.samples < 2) return m * m;
    // Rounding may leave a tiny negative number where all samples are equal.
    double const squares = std::max(0.0, s.square[c] - 2 * m * s.cross[c] + m * m * s.weight_square);
    double const n = static_cast<double>(s.samples);
    return n / (n - 1) * squares / (s.weight * s.weight);
}

template <class Value>
Image make_image(Film const& film, Value value) {
    Image image(PixelFormat::Float, film.width(), film.height(), {"R", "G", "B"});
    image.chromaticities = kRec709;
    std::size_t i = 0;
    for_each_pixel(film, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c)
            image.floats()[i++] = static_cast<float>(value(film.pixel(x, y), c));
    });
    return image;
}

template <class Value>
void add_channel(ExrFile& file, Film const& film, std::string name, ExrChannel::Type type, Value value) {
    ExrChannel& channel = file.channels.emplace_back();
    channel.name = std::move(name);
    channel.type = type;
    channel.data.reserve(static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height()));
    for_each_pixel(film, [&](int x, int y) { channel.data.push_back(static_cast<float>(value(x, y))); });
}

double ratio(double sum, double weight) { return weight != 0 ? sum / weight : 0; }

constexpr std::array<char const*, kLightClasses> kLightLayers{"direct", "caustic", "indirect", "specular"};

/// Photon estimates are in the sums: some integrator with photons made them.
bool has_estimates(Film const& film) {
    bool found = false;
    for_each_pixel(film, [&](int x, int y) { found = found || film.aov(x, y).estimates > 0; });
    return found;
}

void add_aovs(ExrFile& file, Film const& film, ExrChannel::Type type) {
    auto const over_all = [&](std::string const& layer, std::string const& letters, auto const& sums) {
        for (std::size_t c = 0; c < 3; ++c)
            add_channel(file, film, layer + "." + letters[c], type, [&](int x, int y) {
                return ratio(sums(film.aov(x, y))[c], film.pixel(x, y).weight);
            });
    };
    over_all("albedo", "RGB", [](AovSums const& s) { return s.albedo; });
    over_all("N", "XYZ", [](AovSums const& s) { return s.geometric_normal; });
    over_all("Ns", "XYZ", [](AovSums const& s) { return s.shading_normal; });
    for (std::size_t i = 0; i < kLightClasses; ++i)
        over_all(kLightLayers[i], "RGB", [i](AovSums const& s) { return s.light[i]; });
    for (std::size_t c = 0; c < 3; ++c)
        add_channel(file, film, std::string("P.") + "XYZ"[c], ExrChannel::Type::Float,
                    [&](int x, int y) { return ratio(film.aov(x, y).position[c], film.aov(x, y).hits); });
    add_channel(file, film, "Z", ExrChannel::Type::Float,
                [&](int x, int y) { return ratio(film.aov(x, y).depth, film.aov(x, y).hits); });
    if (has_estimates(film)) {
        add_channel(file, film, "radius", ExrChannel::Type::Float,
                    [&](int x, int y) { return ratio(film.aov(x, y).radius, film.aov(x, y).estimates); });
        add_channel(file, film, "photons", ExrChannel::Type::Float,
                    [&](int x, int y) { return ratio(film.aov(x, y).photons, film.aov(x, y).estimates); });
    }
    ExrChannel& id = file.channels.emplace_back();
    id.name = "material.id";
    id.type = ExrChannel::Type::Uint;
    for_each_pixel(film, [&](int x, int y) { id.uints.push_back(film.aov(x, y).material); });
}

std::string lower_extension(std::filesystem::path const& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string layer_of(std::string const& channel) {
    auto const dot = channel.find('.');
    return dot == std::string::npos ? std::string() : channel.substr(0, dot);
}

/// Halves end at 65504. A layer with a number beyond becomes floats as a whole; returns the first channel of each.
std::vector<std::string> widen(ExrFile& file) {
    std::vector<std::string> widened;
    for (ExrChannel const& wide : file.channels) {
        if (wide.type != ExrChannel::Type::Half) continue;
        if (std::none_of(wide.data.begin(), wide.data.end(),
                         [](float v) { return std::isfinite(v) && std::abs(v) > kLargestHalf; }))
            continue;
        widened.push_back(wide.name);
        for (ExrChannel& c : file.channels)
            if (c.type == ExrChannel::Type::Half && layer_of(c.name) == layer_of(widened.back()))
                c.type = ExrChannel::Type::Float;
    }
    return widened;
}

void require_pixels(Film const& film) {
    if (film.width() <= 0 || film.height() <= 0)
        throw Error(ErrorKind::Input, "the film has no pixels: there is nothing to develop");
}

}  // namespace

Image develop(Film const& film) {
    require_pixels(film);
    return make_image(film, mean);
}

Image develop_variance(Film const& film) {
    require_pixels(film);
    return make_image(film, variance);
}

ExrFile develop_beauty_exr(Film const& film, DevelopSettings const& settings) {
    require_pixels(film);
    auto const type = settings.half_float ? ExrChannel::Type::Half : ExrChannel::Type::Float;
    ExrFile file;
    file.width = film.width(), file.height = film.height();
    file.data_x0 = film.crop()[0], file.data_y0 = film.crop()[2];
    file.display_width = film.resolution().x, file.display_height = film.resolution().y;
    file.chromaticities = kRec709;
    file.attributes = settings.metadata;
    file.attributes["nephroid.scene"] = film.identity().scene_hash;
    file.attributes["nephroid.settings"] = film.identity().settings_hash;
    file.attributes["nephroid.seed"] = std::to_string(film.identity().seed);
    file.attributes["nephroid.passes"] = film.passes().text();
    file.attributes["nephroid.dropped"] = std::to_string(film.dropped());
    file.attributes["nephroid.rejected"] = std::to_string(film.rejected());
    for (std::size_t c = 0; c < 3; ++c)
        add_channel(file, film, std::string(1, "RGB"[c]), type,
                    [&](int x, int y) { return mean(film.pixel(x, y), c); });
    return file;
}

namespace {

ExrFile all_layers(Film const& film, DevelopSettings const& settings) {
    ExrFile file = develop_beauty_exr(film, settings);
    for (std::size_t c = 0; c < 3; ++c)
        add_channel(file, film, std::string("variance.") + "RGB"[c], ExrChannel::Type::Float,
                    [&](int x, int y) { return variance(film.pixel(x, y), c); });
    if (film.has_aovs())
        add_aovs(file, film, settings.half_float ? ExrChannel::Type::Half : ExrChannel::Type::Float);
    return file;
}

}  // namespace

ExrFile develop_exr(Film const& film, DevelopSettings const& settings) {
    ExrFile file = all_layers(film, settings);
    widen(file);
    return file;
}

namespace {

/// value(x, y, c) of the beauty, before exposure, with what is drawn over it.
template <class Value>
void lay_over(DevelopSettings const& settings, Value&& value) {
    Image const* over = settings.over;
    if (!over) return;
    float const undo = std::exp2(-settings.exposure);
    for (int y = 0; y < over->height(); ++y)
        for (int x = 0; x < over->width(); ++x) {
            float const alpha = over->get(x, y, 3);
            if (alpha <= 0) continue;
            for (int c = 0; c < 3; ++c) {
                float& v = value(x, y, c);
                v = v * (1 - alpha) + over->get(x, y, c) * undo;
            }
        }
}

}  // namespace

std::vector<std::string> write_picture(std::filesystem::path const& path, Film const& film,
                                       DevelopSettings const& settings) {
    std::string const extension = lower_extension(path);
    if (extension == ".exr") {
        ExrFile file = all_layers(film, settings);
        lay_over(settings, [&](int x, int y, int c) -> float& {
            // The first three channels are R, G and B (develop_beauty_exr).
            return file.channels[static_cast<std::size_t>(c)]
                .data[static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width()) +
                      static_cast<std::size_t>(x)];
        });
        auto widened = widen(file);
        write_exr(path, file, {}, settings.in_a_hurry ? ExrCompression::Fast : ExrCompression::Zip);
        return widened;
    }
    Image image = develop(film);
    lay_over(settings, [&](int x, int y, int c) -> float& { return image.floats()[image.index(x, y, c)]; });
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") {
        float const gain = std::exp2(settings.exposure);
        for (float& v : image.floats()) v *= gain;
    }
    write_image(path, image);  // encodes for 8 bits, and refuses what it does not know
    return {};
}

}  // namespace nephroid
