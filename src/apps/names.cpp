#include "names.h"

#include "scene/match.h"

#include <fmt/format.h>

namespace nephroid::cli {

std::string name_of(Integrator const& i) {
    return match(
        i, [](PathIntegrator const&) { return "path"; }, [](WhittedIntegrator const&) { return "whitted"; },
        [](DirectIntegrator const&) { return "direct"; },
        [](PhotonMapIntegrator const&) { return "photonmap"; }, [](SppmIntegrator const&) { return "sppm"; },
        [](LightPathIntegrator const&) { return "lightpath"; });
}
std::string name_of(Sampler const& s) {
    return match(
        s, [](SobolSampler const&) { return "sobol"; }, [](StratifiedSampler const&) { return "stratified"; },
        [](IndependentSampler const&) { return "independent"; });
}
std::string name_of(Filter const& f) {
    return match(
        f, [](BoxFilter const&) { return "box"; }, [](TriangleFilter const&) { return "triangle"; },
        [](GaussianFilter const&) { return "gaussian"; }, [](MitchellFilter const&) { return "mitchell"; },
        [](LanczosSincFilter const&) { return "sinc"; });
}

SettingWords words_of(Settings const& s) {
    Vec2 const radius = match(s.filter, [](auto const& f) { return f.radius; });
    return {
        {"--color", s.color == ColorMode::Rgb ? "rgb" : "spectral"},
        {"--integrator", name_of(s.integrator)},
        {"--set maxdepth", std::to_string(match(s.integrator, [](auto const& i) { return i.max_depth; }))},
        {"--set sampler", name_of(s.sampler)},
        {"--set filter", name_of(s.filter)},
        {"--set radius", fmt::format("{} x {}", radius.x, radius.y)},
        {"--set iso", fmt::format("{}", s.film.iso)},
        {"--set maxcomponentvalue", fmt::format("{}", s.film.max_component)}};
}

}  // namespace nephroid::cli
