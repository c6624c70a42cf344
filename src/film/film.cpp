#include "film/film.h"

#include "math/error.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

void add_scaled(std::array<double, 3>& sum, Vec3 v, double w) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += w * static_cast<double>(v[static_cast<int>(c)]);
}
void add(std::array<double, 3>& sum, std::array<double, 3> const& other) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += other[c];
}

void add(PixelSums& a, PixelSums const& b) {
    auto const& [rgb, weight, square, cross, weight_square, samples] =
        b;  // a new field does not compile here
    add(a.rgb, rgb);
    a.weight += weight;
    add(a.square, square);
    add(a.cross, cross);
    a.weight_square += weight_square;
    a.samples += samples;
}

void add(AovSums& a, AovSums const& b) {
    auto const& [albedo, shading_normal, geometric_normal, position, depth, hits, light, radius, photons,
                 estimates, pass, material] = b;
    add(a.albedo, albedo);
    add(a.shading_normal, shading_normal);
    add(a.geometric_normal, geometric_normal);
    add(a.position, position);
    a.depth += depth;
    a.hits += hits;
    for (std::size_t i = 0; i < light.size(); ++i) add(a.light[i], light[i]);
    a.radius += radius;
    a.photons += photons;
    a.estimates += estimates;
    if (pass < a.material_pass) a.material_pass = pass, a.material = material;
}

[[noreturn]] void refuse(std::string const& message) {
    throw Error(ErrorKind::Input, "cannot merge the films: " + message);
}

std::string size_text(FilmHeader const& h) {
    return std::to_string(h.resolution.x) + "x" + std::to_string(h.resolution.y);
}
std::string crop_text(FilmHeader const& h) {
    auto const [x0, x1, y0, y1] = h.crop;
    return std::to_string(x0) + "," + std::to_string(y0) + "," + std::to_string(x1) + "," +
           std::to_string(y1);
}

}  // namespace

Film::Film(Vec2i resolution, std::array<int, 4> crop, bool with_aovs, FilmIdentity identity)
    : resolution_(resolution), crop_(crop), identity_(std::move(identity)) {
    auto const [x0, x1, y0, y1] = crop;
    if (!(0 <= x0 && x0 < x1 && x1 <= resolution.x && 0 <= y0 && y0 < y1 && y1 <= resolution.y))
        throw Error(ErrorKind::Input, "the film's crop window is empty or leaves the picture: correct it");
    std::int64_t const pixels = std::int64_t{width()} * height();
    if (pixels > kMaxPixels) throw Error(ErrorKind::Limit, "the film has more than 2^28 pixels: crop it");
    pixels_.resize(static_cast<std::size_t>(pixels));
    if (with_aovs) aovs_.resize(static_cast<std::size_t>(pixels));
}

std::size_t Film::bytes() const { return film_bytes(pixels_.size(), has_aovs()); }

std::uint64_t film_bytes(std::uint64_t pixels, bool with_aovs) {
    return pixels * (sizeof(PixelSums) + (with_aovs ? sizeof(AovSums) : 0));
}

FilmHeader Film::header() const {
    return {identity_, resolution_, crop_, has_aovs(), passes_, dropped_, rejected_, words_};
}

std::string difference(FilmHeader const& a, FilmHeader const& b) {
    std::string text;
    auto const hold = [&](std::string const& what, std::string const& left, std::string const& right) {
        if (left == right) return;
        text += (text.empty() ? "" : "; ") + what + " is " + left + " in one and " + right + " in the other";
    };
    if (a.identity.scene_hash != b.identity.scene_hash)
        text = "they show different scenes: a file of the scene was changed, or it is another one";
    hold("--size", size_text(a), size_text(b));
    if (a.resolution == b.resolution) hold("--crop", crop_text(a), crop_text(b));
    hold("--seed", std::to_string(a.identity.seed), std::to_string(b.identity.seed));
    hold("--aovs", a.aovs ? "given" : "left out", b.aovs ? "given" : "left out");
    for (auto const& [option, value] : a.words) {
        auto const other = b.words.find(option);
        if (other != b.words.end()) hold(option, value, other->second);
    }
    if (text.empty() && !(a.identity == b.identity))
        text = "they were rendered with different settings (film, filter, sampler or integrator)";
    return text;
}

void Film::add_aov(int x, int y, std::uint64_t pass, AovSample const& sample, float weight) {
    bool const finite =
        std::isfinite(weight) && is_finite(sample.albedo) && is_finite(sample.shading_normal) &&
        is_finite(sample.geometric_normal) && is_finite(sample.position) && std::isfinite(sample.depth) &&
        std::all_of(sample.light.begin(), sample.light.end(), [](Vec3 v) { return is_finite(v); }) &&
        std::isfinite(sample.radius) && std::isfinite(sample.photons);
    if (!finite) return;
    AovSums& sums = aov(x, y);
    double const w = static_cast<double>(weight);
    add_scaled(sums.albedo, sample.albedo, w);
    add_scaled(sums.shading_normal, sample.shading_normal, w);
    add_scaled(sums.geometric_normal, sample.geometric_normal, w);
    for (std::size_t i = 0; i < kLightClasses; ++i) add_scaled(sums.light[i], sample.light[i], w);
    if (sample.estimated) {
        sums.radius += std::abs(w) * static_cast<double>(sample.radius);
        sums.photons += std::abs(w) * static_cast<double>(sample.photons);
        sums.estimates += std::abs(w);
    }
    if (!sample.hit) return;
    add_scaled(sums.position, sample.position, std::abs(w));
    sums.depth += std::abs(w) * static_cast<double>(sample.depth);
    sums.hits += std::abs(w);
    if (pass < sums.material_pass) sums.material_pass = pass, sums.material = sample.material;
}

void merge_into(Film& a, Film const& b) {
    if (b.pixels_.empty()) return;
    if (a.pixels_.empty()) {
        a = b;
        return;
    }
    if (std::string const how = difference(a.header(), b.header()); !how.empty())
        refuse(how + "; render again with the options of the other");
    PassSet const common = a.passes_.intersection(b.passes_);
    if (!common.empty())
        refuse("both hold passes " + common.text() +
               ", and a pass counts once; leave one out, or render other --passes");
    for (std::size_t i = 0; i < a.pixels_.size(); ++i) add(a.pixels_[i], b.pixels_[i]);
    for (std::size_t i = 0; i < a.aovs_.size(); ++i) add(a.aovs_[i], b.aovs_[i]);
    a.passes_.insert(b.passes_);
    a.dropped_ += b.dropped_;
    a.rejected_ += b.rejected_;
}

Film merge(Film a, Film const& b) {
    merge_into(a, b);
    return a;
}

}  // namespace nephroid
