// `--set` for photons: how many, how far they count, and what is made of them.
#include "override_keys.h"
#include "scene/match.h"

#include <fmt/format.h>

namespace nephroid::cli {

namespace {

/// f of the integrator, when that shoots photons into maps.
template <class F>
void with_maps(Settings& s, char const* key, F f) {
    match(s.integrator, [&](auto& i) {
        if constexpr (requires { i.shooting; })
            f(i);
        else
            refuse_set(key, "only the integrators photonmap and sppm have that");
    });
}
PhotonMapIntegrator& photon_map(Settings& s, char const* key) {
    return alternative<PhotonMapIntegrator>(s.integrator, key, "the integrator photonmap");
}
SppmIntegrator& sppm(Settings& s, char const* key) {
    return alternative<SppmIntegrator>(s.integrator, key, "the integrator sppm");
}

/// -1 stands for a number that follows from something else.
int to_count_or_default(std::string const& key, std::string const& text) {
    return text == "-1" ? -1 : to_int(key, text, 0);
}
/// Scene units; 0 is automatic.
float to_radius(std::string const& key, std::string const& text) {
    float const r = to_number(key, text);
    if (!(r >= 0)) refuse_set(key, fmt::format("{} is no radius; 0 makes one that suits the scene", r));
    return r;
}

std::vector<OverrideKey> numbers_of_photons() {
    return {
        {"indirectphotons", "photonmap: paths per pass into the global map (what is emitted, not stored)",
         [](Settings& s, std::string const& v) {
             photon_map(s, "indirectphotons").shooting.global_paths = to_int("indirectphotons", v, 0);
         }},
        {"causticphotons",
         "photonmap, sppm: paths per pass into the caustic map; -1: as many as into the other",
         [](Settings& s, std::string const& v) {
             with_maps(s, "causticphotons",
                       [&](auto& i) { i.shooting.caustic_paths = to_count_or_default("causticphotons", v); });
         }},
        {"photonsperiteration", "sppm: paths per pass into the global map; -1: as many as pixels",
         [](Settings& s, std::string const& v) {
             int const n = to_count_or_default("photonsperiteration", v);
             sppm(s, "photonsperiteration").shooting.global_paths = n == 0 ? -1 : n;
         }},
        {"lightpaths", "lightpath: paths per pass; -1: as many as pixels",
         [](Settings& s, std::string const& v) {
             int const n = to_count_or_default("lightpaths", v);
             if (n == 0) refuse_set("lightpaths", "0 is less than 1");
             alternative<LightPathIntegrator>(s.integrator, "lightpaths", "the integrator lightpath").paths =
                 n;
         }},
        {"passes", "photonmap: maps of their own, among which the samples of a pixel are shared out",
         [](Settings& s, std::string const& v) { photon_map(s, "passes").passes = to_int("passes", v, 1); }},
        {"maxphotondepth", "photonmap, sppm: scatterings of a photon at most",
         [](Settings& s, std::string const& v) {
             with_maps(s, "maxphotondepth",
                       [&](auto& i) { i.shooting.max_depth = to_int("maxphotondepth", v, 0); });
         }},
        {"maxspeculardepth", "photonmap: mirrors and glass in a row as the camera sees them; maxdepth",
         [](Settings& s, std::string const& v) {
             photon_map(s, "maxspeculardepth").max_depth = to_int("maxspeculardepth", v, 0);
         }},
        {"aim", "photonmap, sppm: false: caustic paths go everywhere, not towards mirrors and glass",
         [](Settings& s, std::string const& v) {
             with_maps(s, "aim", [&](auto& i) { i.shooting.aim = to_bool("aim", v); });
         }},
    };
}

std::vector<OverrideKey> estimates() {
    return {
        {"radius",
         "photonmap, sppm: of estimates in pass 0, scene units; 0: by the scene. Else: the filter's, pixels",
         [](Settings& s, std::string const& v) {
             match(s.integrator, [&](auto& i) {
                 if constexpr (requires { i.estimates; }) {
                     i.estimates.radius = to_radius("radius", v);
                 } else {
                     float const r = to_positive("radius", v);
                     match(s.filter, [&](auto& f) { f.radius = Vec2{r, r}; });
                 }
             });
         }},
        {"maxdist", "photonmap: radius, by pbrt-v2's name",
         [](Settings& s, std::string const& v) {
             photon_map(s, "maxdist").estimates.radius = to_radius("maxdist", v);
         }},
        {"causticradius", "photonmap, sppm: of the caustic map; 0: as radius, or by the scene",
         [](Settings& s, std::string const& v) {
             with_maps(s, "causticradius",
                       [&](auto& i) { i.estimates.caustic_radius = to_radius("causticradius", v); });
         }},
        {"nused", "photonmap, sppm: photons of an estimate at most; 0: all within the radius",
         [](Settings& s, std::string const& v) {
             with_maps(s, "nused",
                       [&](auto& i) { i.estimates.nused = to_int("nused", v, 0); });  // 1: see validate
         }},
        {"kernel", "photonmap, sppm: box, cone, epanechnikov or gaussian: how the distance of photons weighs",
         [](Settings& s, std::string const& v) {
             with_maps(s, "kernel", [&](auto& i) {
                 i.estimates.kernel = to_choice<Kernel>("kernel", v,
                                                        {{"box", Kernel::Box},
                                                         {"cone", Kernel::Cone},
                                                         {"epanechnikov", Kernel::Epanechnikov},
                                                         {"gaussian", Kernel::Gaussian}});
             });
         }},
        {"edgecorrection", "photonmap, sppm: divide by the part of the disk that the surface fills",
         [](Settings& s, std::string const& v) {
             with_maps(s, "edgecorrection",
                       [&](auto& i) { i.estimates.edge_correction = to_bool("edgecorrection", v); });
         }},
        {"finalgather",
         "photonmap: false: indirect light is read from the global map directly, blotches and all",
         [](Settings& s, std::string const& v) {
             photon_map(s, "finalgather").final_gather = to_bool("finalgather", v);
         }},
        {"finalgathersamples", "photonmap: gather rays of a sample",
         [](Settings& s, std::string const& v) {
             photon_map(s, "finalgathersamples").gather_samples = to_int("finalgathersamples", v, 1);
         }},
        {"visualize", "photonmap, sppm: none, or an estimate alone: global, caustic, both, radiance",
         [](Settings& s, std::string const& v) {
             with_maps(s, "visualize", [&](auto& i) {
                 i.visualize = to_choice<PhotonView>("visualize", v,
                                                     {{"none", PhotonView::None},
                                                      {"global", PhotonView::Global},
                                                      {"caustic", PhotonView::Caustic},
                                                      {"both", PhotonView::Both},
                                                      {"radiance", PhotonView::Radiance}});
             });
         }},
    };
}

}  // namespace

std::vector<OverrideKey> photon_keys() {
    std::vector<OverrideKey> all = numbers_of_photons();
    for (OverrideKey& k : estimates()) all.push_back(std::move(k));
    return all;
}

}  // namespace nephroid::cli
