// Film, filter, sampler and options.
#include "writer.h"

#include "scene/match.h"

#include <cmath>

namespace nephroid {

namespace {

void radius(ParamText& p, Vec2 r) {
    p.number("xradius", r.x);
    p.number("yradius", r.y);
}

std::string filter_text(Filter const& filter) {
    ParamText p;
    char const* const type = match(
        filter, [](BoxFilter const&) { return "box"; }, [](TriangleFilter const&) { return "triangle"; },
        [&](GaussianFilter const& f) {
            p.number("sigma", f.sigma);
            return "gaussian";
        },
        [&](MitchellFilter const& f) {
            p.number("B", f.b);
            p.number("C", f.c);
            return "mitchell";
        },
        [&](LanczosSincFilter const& f) {
            p.number("tau", f.tau);
            return "sinc";
        });
    match(filter, [&](auto const& f) { radius(p, f.radius); });
    return "PixelFilter \"" + std::string(type) + '"' + p.text() + '\n';
}

std::string sampler_text(Settings const& s, bool portable) {
    ParamText p;
    char const* const type = match(
        s.sampler, [](SobolSampler const&) { return "zsobol"; },
        [](IndependentSampler const&) { return "independent"; },
        [&](StratifiedSampler const& strata) {
            p.integer("xsamples", strata.x_strata);
            p.integer("ysamples", strata.y_strata);
            p.boolean("jitter", strata.jitter, true);
            return "stratified";
        });
    auto const* strata = std::get_if<StratifiedSampler>(&s.sampler);
    // pbrt's has as many samples as there are strata.
    if (!strata || (!portable && s.spp != strata->x_strata * strata->y_strata))
        p.integer("pixelsamples", s.spp);
    return "Sampler \"" + std::string(type) + '"' + p.text() + '\n';
}

}  // namespace

void Writer::write_settings() {
    Settings const& s = scene_.settings;
    FilmSettings const& film = s.film;
    if (!portable_ && (s.color_given || s.color != default_color(s.integrator)))
        head_ += std::string("Option \"string color\" \"") +
                 (s.color == ColorMode::Rgb ? "rgb" : "spectral") + "\"\n";
    if (s.seed != 0)
        head_ += "Option \"integer seed\" " + std::to_string(static_cast<std::int64_t>(s.seed)) + '\n';
    ParamText p;
    p.integer("xresolution", film.resolution.x);
    p.integer("yresolution", film.resolution.y);
    if (film.crop) p.integers("pixelbounds", film.crop->data(), film.crop->size());
    if (!film.filename.empty()) p.string("filename", film.filename);
    p.number("iso", film.iso, 100);
    p.number("whitebalance", film.white_balance, 0);
    if (std::isfinite(film.max_component)) p.number("maxcomponentvalue", film.max_component);
    p.boolean("savefp16", film.half_float, true);
    head_ += std::string("Film \"") + (film.aovs ? "gbuffer" : "rgb") + '"' + p.text() + '\n';
    head_ += filter_text(s.filter);
    head_ += sampler_text(s, portable_);
    write_integrator();
}

}  // namespace nephroid
