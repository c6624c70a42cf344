#include "names.h"

#include "scene/match.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <type_traits>

namespace nephroid::cli {

namespace {
/// A word on how many samples of a pixel are in a pass: --spp shared out among the passes.
constexpr char const* kSamplesOfAPass = "--spp / --set passes";
}  // namespace

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

std::string name_of(CameraKind const& c) {
    return match(
        c, [](PerspectiveCamera const&) { return "perspective"; },
        [](OrthographicCamera const&) { return "orthographic"; },
        [](SphericalCamera const&) { return "spherical"; });
}
std::string name_of(MaterialKind const& m) {
    return match(
        m, [](DiffuseMaterial const&) { return "diffuse"; },
        [](DielectricMaterial const&) { return "dielectric"; },
        [](ConductorMaterial const&) { return "conductor"; },
        [](ThinDielectricMaterial const&) { return "thindielectric"; },
        [](InterfaceMaterial const&) { return "interface"; }, [](MixMaterial const&) { return "mix"; },
        [](CoatedDiffuseMaterial const&) { return "coateddiffuse"; },
        [](CoatedConductorMaterial const&) { return "coatedconductor"; },
        [](DiffuseTransmissionMaterial const&) { return "diffusetransmission"; },
        [](MeasuredMaterial const&) { return "measured"; },
        [](AshikhminShirleyMaterial const&) { return "ashikhminshirley"; },
        [](PlasticMaterial const&) { return "plastic"; },
        [](MetallicRoughnessMaterial const&) { return "metallicroughness"; });
}
std::string name_of(LightKind const& l) {
    return match(
        l, [](PointLight const&) { return "point"; }, [](SpotLight const&) { return "spot"; },
        [](DistantLight const&) { return "distant"; }, [](InfiniteLight const&) { return "infinite"; },
        [](GoniometricLight const&) { return "goniometric"; },
        [](ProjectionLight const&) { return "projection"; }, [](MeasuredLight const&) { return "measured"; },
        [](SunSkyLight const&) { return "sunsky"; });
}

namespace {

std::string name_of(Kernel k) {
    constexpr std::array kNames{"box", "cone", "epanechnikov", "gaussian"};
    return kNames[static_cast<std::size_t>(k)];
}
std::string name_of(PhotonView v) {
    constexpr std::array kNames{"none", "global", "caustic", "both", "radiance"};
    return kNames[static_cast<std::size_t>(v)];
}
std::string word(bool b) { return b ? "true" : "false"; }
/// -1 and 0 are what the program chooses.
std::string count_word(int n) { return n < 0 ? "automatic" : std::to_string(n); }
std::string radius_word(float r) { return r > 0 ? fmt::format("{}", r) : "automatic"; }

}  // namespace

SettingWords photon_words(Integrator const& integrator) {
    SettingWords words;
    match(integrator, [&](auto const& i) {
        if constexpr (requires { i.shooting; }) {
            constexpr bool kSppm = std::is_same_v<std::remove_cvref_t<decltype(i)>, SppmIntegrator>;
            words = {{kSppm ? "photonsperiteration" : "indirectphotons", count_word(i.shooting.global_paths)},
                     {"causticphotons", count_word(i.shooting.caustic_paths)},
                     {"maxphotondepth", std::to_string(i.shooting.max_depth)},
                     {"aim", word(i.shooting.aim)},
                     {"nused", i.estimates.nused > 0 ? std::to_string(i.estimates.nused) : "all"},
                     {"radius", radius_word(i.estimates.radius)},
                     {"causticradius", radius_word(i.estimates.caustic_radius)},
                     {"kernel", name_of(i.estimates.kernel)},
                     {"edgecorrection", word(i.estimates.edge_correction)},
                     {"alpha", fmt::format("{}", i.alpha)},
                     {"visualize", name_of(i.visualize)}};
        }
        if constexpr (requires { i.gather_samples; }) {
            words["finalgather"] = word(i.final_gather);
            words["finalgathersamples"] = std::to_string(i.gather_samples);
        }
        if constexpr (requires { i.paths; }) words["lightpaths"] = count_word(i.paths);
    });
    return words;
}

SettingWords words_of(Settings const& s) {
    Vec2 const radius = match(s.filter, [](auto const& f) { return f.radius; });
    SettingWords words{
        {"--color", s.color == ColorMode::Rgb ? "rgb" : "spectral"},
        {"--integrator", name_of(s.integrator)},
        {"--set maxdepth", std::to_string(match(s.integrator, [](auto const& i) { return i.max_depth; }))},
        {"--set sampler", name_of(s.sampler)},
        {"--set filter", name_of(s.filter)},
        {"--set filterradius", fmt::format("{} x {}", radius.x, radius.y)},
        {"--set iso", fmt::format("{}", s.film.iso)},
        {"--set maxcomponentvalue", fmt::format("{}", s.film.max_component)}};
    for (auto const& [key, value] : photon_words(s.integrator)) words["--set " + key] = value;
    if (std::holds_alternative<PhotonMapIntegrator>(s.integrator))
        words[kSamplesOfAPass] = std::to_string(samples_per_pass(s));
    return words;
}

namespace {

template <class W>
std::vector<std::string> names_of_sources(W const& world) {
    std::vector<std::string> names;
    // Where the world can tell.
    if constexpr (requires { world.light_sources(); })
        for (auto const& source : world.light_sources())
            names.push_back(fmt::format("{} light, {}", source.kind, world.scene().locate(source.where)));
    return names;
}
template <class W>
std::uint32_t source_in(W const& world, std::uint32_t light) {
    if constexpr (requires { world.source_of(light); })
        return world.source_of(light);
    else
        return light;
}

}  // namespace

std::vector<std::string> source_names(World const& world) { return names_of_sources(world); }
std::uint32_t source_index(World const& world, std::uint32_t light) { return source_in(world, light); }

std::uint64_t samples_of_a_pass(SettingWords const& words) {
    auto const found = words.find(kSamplesOfAPass);
    std::uint64_t n = 1;
    if (found != words.end())
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), n);
    return n;
}

}  // namespace nephroid::cli
