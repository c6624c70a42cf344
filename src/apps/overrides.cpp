#include "overrides.h"

#include "math/error.h"
#include "override_keys.h"
#include "scene/match.h"
#include "words.h"

#include <fmt/format.h>

#include <charconv>
#include <type_traits>
#include <vector>

namespace nephroid::cli {

namespace {

[[noreturn]] void refuse(std::string const& message) { throw Error(ErrorKind::Input, message); }

/// Bounces; sppm's photons go as far, unless they were told otherwise.
void set_max_depth(Settings& s, int depth) {
    match(s.integrator, [&](auto& i) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(i)>, SppmIntegrator>)
            if (i.shooting.max_depth == i.max_depth) i.shooting.max_depth = depth;
        i.max_depth = depth;
    });
}

std::vector<OverrideKey> own_keys() {
    auto const path = [](Settings& s, char const* key) -> PathIntegrator& {
        return alternative<PathIntegrator>(s.integrator, key, "the path integrator");
    };
    auto const strata = [](Settings& s, char const* key) -> StratifiedSampler& {
        return alternative<StratifiedSampler>(s.sampler, key, "the stratified sampler");
    };
    return {
        {"maxdepth", "bounces at most",
         [](Settings& s, std::string const& v) { set_max_depth(s, to_int("maxdepth", v, 0)); }},
        {"segments", "path segments at most: maxdepth + 1",
         [](Settings& s, std::string const& v) { set_max_depth(s, to_int("segments", v, 1) - 1); }},
        {"roulette", "throughput, fixed or none",
         [path](Settings& s, std::string const& v) {
             path(s, "roulette").roulette.kind =
                 to_choice<RouletteKind>("roulette", v,
                                         {{"throughput", RouletteKind::Throughput},
                                          {"fixed", RouletteKind::Fixed},
                                          {"none", RouletteKind::None}});
         }},
        {"alpha",
         "survival probability of the fixed roulette; photonmap, sppm: how radii shrink, below 1 so that "
         "they do",
         [path](Settings& s, std::string const& v) {
             float const alpha = to_share("alpha", v);
             match(s.integrator, [&](auto& i) {
                 if constexpr (requires { i.alpha; })
                     i.alpha = alpha;
                 else
                     path(s, "alpha").roulette.alpha = alpha;
             });
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
        {"filterradius", "of the filter, pixels",
         [](Settings& s, std::string const& v) {
             float const r = to_positive("filterradius", v);
             match(s.filter, [&](auto& f) { f.radius = Vec2{r, r}; });
         }},
        {"iso", "film speed; brightness is proportional",
         [](Settings& s, std::string const& v) { s.film.iso = to_positive("iso", v); }},
        {"maxcomponentvalue", "scale down samples brighter than this (biased)",
         [](Settings& s, std::string const& v) {
             s.film.max_component = to_positive("maxcomponentvalue", v);
         }},
    };
}

std::vector<OverrideKey> const& keys() {
    static std::vector<OverrideKey> const list = [] {
        std::vector<OverrideKey> all = own_keys();
        for (OverrideKey& k : photon_keys()) all.push_back(std::move(k));
        return all;
    }();
    return list;
}

template <class T>
void switch_to(Settings& s) {
    if (!std::holds_alternative<T>(s.integrator)) s.integrator = T{};
}

}  // namespace

void refuse_set(std::string const& key, std::string const& why) {
    refuse(fmt::format("--set {}: {}", key, why));
}
int to_int(std::string const& key, std::string const& text, int least) {
    int v = 0;
    auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
    if (r.ec != std::errc{} || r.ptr != text.data() + text.size())
        refuse_set(key, fmt::format("\"{}\" is not a whole number up to 2147483647", text));
    if (v < least) refuse_set(key, fmt::format("{} is less than {}", v, least));
    return v;
}
float to_number(std::string const& key, std::string const& text) {
    float v = 0;
    auto const r = std::from_chars(text.data(), text.data() + text.size(), v);
    if (r.ec != std::errc{} || r.ptr != text.data() + text.size())
        refuse_set(key, fmt::format("\"{}\" is not a number", text));
    return v;
}
float to_positive(std::string const& key, std::string const& text) {
    float const v = to_number(key, text);
    if (!(v > 0)) refuse_set(key, fmt::format("{} is not above 0", v));
    return v;
}
float to_share(std::string const& key, std::string const& text) {
    float const v = to_positive(key, text);
    if (v > 1) refuse_set(key, fmt::format("{} is above 1", v));
    return v;
}
bool to_bool(std::string const& key, std::string const& text) {
    if (text == "true" || text == "1" || text == "on") return true;
    if (text == "false" || text == "0" || text == "off") return false;
    refuse_set(key, fmt::format("\"{}\" is neither true nor false", text));
}

void apply_override(Settings& settings, std::string const& assignment) {
    auto const eq = assignment.find('=');
    if (eq == std::string::npos) refuse(fmt::format("--set {}: expected key=value", assignment));
    std::string const name = assignment.substr(0, eq);
    std::vector<std::string> names;
    for (OverrideKey const& k : keys()) {
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
    Integrator const before = settings.integrator;
    if (name == "path")
        switch_to<PathIntegrator>(settings);
    else if (name == "whitted")
        settings.integrator = WhittedIntegrator{};
    else if (name == "direct" || name == "directlighting")
        settings.integrator = DirectIntegrator{};
    else if (name == "photonmap")
        switch_to<PhotonMapIntegrator>(settings);
    else if (name == "sppm")
        switch_to<SppmIntegrator>(settings);
    else if (name == "lightpath")
        switch_to<LightPathIntegrator>(settings);
    else
        refuse(fmt::format(
            "--integrator {}: unknown; did you mean \"{}\"? Choose one of path, whitted, direct, "
            "photonmap, sppm, lightpath",
            name, nearest(name, {"path", "whitted", "direct", "photonmap", "sppm", "lightpath"})));
    // The depth of photonmap counts something else.
    auto const* old_map = std::get_if<PhotonMapIntegrator>(&before);
    if (!old_map && !std::holds_alternative<PhotonMapIntegrator>(settings.integrator)) {
        int const depth = match(before, [](auto const& i) { return i.max_depth; });
        match(settings.integrator, [&](auto& i) { i.max_depth = depth; });
    }
    if (settings.integrator.index() == before.index()) return;
    if (auto* i = std::get_if<SppmIntegrator>(&settings.integrator)) i->shooting.max_depth = i->max_depth;
    if (!settings.color_given) settings.color = default_color(settings.integrator);
}

std::string override_help() {
    std::string text;
    for (OverrideKey const& k : keys()) text += fmt::format("  {:<20} {}\n", k.name, k.help);
    return text;
}

}  // namespace nephroid::cli
