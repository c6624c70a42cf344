#include "overrides.h"

#include "math/error.h"
#include "scene/match.h"
#include "words.h"

#include <fmt/format.h>

#include <charconv>
#include <functional>
#include <vector>

namespace nephroid::cli {

namespace {

[[noreturn]] void refuse(std::string const& message) { throw Error(ErrorKind::Input, message); }

int to_int(std::string const& key, std::string const& text, int least) {
    int v = 0;
    auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
    if (r.ec != std::errc{} || r.ptr != text.data() + text.size())
        refuse(fmt::format("--set {}: \"{}\" is not a whole number", key, text));
    if (v < least) refuse(fmt::format("--set {}: {} is less than {}", key, v, least));
    return v;
}
float to_positive(std::string const& key, std::string const& text) {
    float v = 0;
    auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
    if (r.ec != std::errc{} || r.ptr != text.data() + text.size())
        refuse(fmt::format("--set {}: \"{}\" is not a number", key, text));
    if (!(v > 0)) refuse(fmt::format("--set {}: {} is not above 0", key, v));
    return v;
}
bool to_bool(std::string const& key, std::string const& text) {
    if (text == "true" || text == "1" || text == "on") return true;
    if (text == "false" || text == "0" || text == "off") return false;
    refuse(fmt::format("--set {}: \"{}\" is neither true nor false", key, text));
}
template <class T>
T to_choice(std::string const& key, std::string const& text,
            std::vector<std::pair<char const*, T>> const& choices) {
    std::string known;
    for (auto const& [name, value] : choices) {
        if (text == name) return value;
        known += known.empty() ? name : std::string(", ") + name;
    }
    refuse(fmt::format("--set {}: unknown \"{}\"; choose one of {}", key, text, known));
}

/// The alternative T of a setting, or a refusal that says which one would have the key.
template <class T, class Variant>
T& alternative(Variant& v, std::string const& key, char const* what) {
    if (auto* t = std::get_if<T>(&v)) return *t;
    refuse(fmt::format("--set {}: only {} has that", key, what));
}

struct Key {
    char const* name;
    char const* help;
    std::function<void(Settings&, std::string const&)> set;
};

std::vector<Key> const& keys() {
    auto const path = [](Settings& s, char const* key) -> PathIntegrator& {
        return alternative<PathIntegrator>(s.integrator, key, "the path integrator");
    };
    auto const strata = [](Settings& s, char const* key) -> StratifiedSampler& {
        return alternative<StratifiedSampler>(s.sampler, key, "the stratified sampler");
    };
    static std::vector<Key> const list{
        {"maxdepth", "bounces at most",
         [](Settings& s, std::string const& v) {
             match(s.integrator, [&](auto& i) { i.max_depth = to_int("maxdepth", v, 0); });
         }},
        {"segments", "path segments at most: maxdepth + 1",
         [](Settings& s, std::string const& v) {
             match(s.integrator, [&](auto& i) { i.max_depth = to_int("segments", v, 1) - 1; });
         }},
        {"roulette", "throughput, fixed or none",
         [path](Settings& s, std::string const& v) {
             path(s, "roulette").roulette.kind =
                 to_choice<RouletteKind>("roulette", v,
                                         {{"throughput", RouletteKind::Throughput},
                                          {"fixed", RouletteKind::Fixed},
                                          {"none", RouletteKind::None}});
         }},
        {"alpha", "survival probability of the fixed roulette",
         [path](Settings& s, std::string const& v) {
             float const alpha = to_positive("alpha", v);
             if (alpha > 1) refuse(fmt::format("--set alpha: {} is no probability: it is above 1", alpha));
             path(s, "alpha").roulette.alpha = alpha;
         }},
        {"samplelights", "false: the naive tracer",
         [path](Settings& s, std::string const& v) {
             path(s, "samplelights").sample_lights = to_bool("samplelights", v);
         }},
        {"mis", "false: sampled lights are not weighed against chance hits",
         [path](Settings& s, std::string const& v) { path(s, "mis").sample_bsdf_mis = to_bool("mis", v); }},
        {"hemisphere", "cosine or uniform",
         [path](Settings& s, std::string const& v) {
             path(s, "hemisphere").hemisphere = to_choice<HemisphereSampling>(
                 "hemisphere", v,
                 {{"cosine", HemisphereSampling::Cosine}, {"uniform", HemisphereSampling::Uniform}});
         }},
        {"sampler", "sobol, stratified or independent",
         [](Settings& s, std::string const& v) {
             s.sampler = to_choice<Sampler>("sampler", v,
                                            {{"sobol", SobolSampler{}},
                                             {"stratified", StratifiedSampler{}},
                                             {"independent", IndependentSampler{}}});
         }},
        {"xsamples", "strata across, of the stratified sampler",
         [strata](Settings& s, std::string const& v) {
             strata(s, "xsamples").x_strata = to_int("xsamples", v, 1);
         }},
        {"ysamples", "strata down",
         [strata](Settings& s, std::string const& v) {
             strata(s, "ysamples").y_strata = to_int("ysamples", v, 1);
         }},
        {"jitter", "false: points at the centres of the strata",
         [strata](Settings& s, std::string const& v) { strata(s, "jitter").jitter = to_bool("jitter", v); }},
        {"filter", "box, triangle, gaussian, mitchell or sinc",
         [](Settings& s, std::string const& v) {
             s.filter = to_choice<Filter>("filter", v,
                                          {{"box", BoxFilter{}},
                                           {"triangle", TriangleFilter{}},
                                           {"gaussian", GaussianFilter{}},
                                           {"mitchell", MitchellFilter{}},
                                           {"sinc", LanczosSincFilter{}}});
         }},
        {"radius", "of the filter, pixels",
         [](Settings& s, std::string const& v) {
             float const r = to_positive("radius", v);
             match(s.filter, [&](auto& f) { f.radius = Vec2{r, r}; });
         }},
        {"iso", "film speed; brightness is proportional",
         [](Settings& s, std::string const& v) { s.film.iso = to_positive("iso", v); }},
        {"maxcomponentvalue", "scale down samples brighter than this (biased)",
         [](Settings& s, std::string const& v) {
             s.film.max_component = to_positive("maxcomponentvalue", v);
         }},
    };
    return list;
}

}  // namespace

void apply_override(Settings& settings, std::string const& assignment) {
    auto const eq = assignment.find('=');
    if (eq == std::string::npos) refuse(fmt::format("--set {}: expected key=value", assignment));
    std::string const name = assignment.substr(0, eq);
    std::vector<std::string> names;
    for (Key const& k : keys()) {
        if (name == k.name) {
            k.set(settings, assignment.substr(eq + 1));
            return;
        }
        names.emplace_back(k.name);
    }
    refuse(fmt::format("--set {}: unknown setting; did you mean \"{}\"? (nephroid render --help lists them)",
                       name, nearest(name, names)));
}

void set_integrator(Settings& settings, std::string const& name) {
    int const depth = match(settings.integrator, [](auto const& i) { return i.max_depth; });
    if (name == "path") {
        if (!std::holds_alternative<PathIntegrator>(settings.integrator))
            settings.integrator = PathIntegrator{};
    } else if (name == "whitted") {
        settings.integrator = WhittedIntegrator{};
    } else if (name == "direct" || name == "directlighting") {
        settings.integrator = DirectIntegrator{};
    } else if (name == "photonmap") {
        if (!std::holds_alternative<PhotonMapIntegrator>(settings.integrator)) {
            settings.integrator = PhotonMapIntegrator{};
            settings.color = ColorMode::Rgb;
            return;  // its depths have other meanings
        }
    } else if (name == "sppm") {
        if (!std::holds_alternative<SppmIntegrator>(settings.integrator)) {
            SppmIntegrator i;
            i.shooting.max_depth = depth;
            settings.integrator = i;
        }
    } else if (name == "lightpath") {
        if (!std::holds_alternative<LightPathIntegrator>(settings.integrator))
            settings.integrator = LightPathIntegrator{};
    } else {
        refuse(fmt::format(
            "--integrator {}: unknown; choose one of path, whitted, direct, photonmap, sppm, lightpath",
            name));
    }
    match(settings.integrator, [&](auto& i) { i.max_depth = depth; });
}

std::string override_help() {
    std::string text;
    for (Key const& k : keys()) text += fmt::format("  {:<18} {}\n", k.name, k.help);
    return text;
}

}  // namespace nephroid::cli
