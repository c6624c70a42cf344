#include "photon_cloud.h"

#include "overrides.h"
#include "scene/match.h"
#include "spectrum/color.h"

#include <algorithm>

namespace nephroid::cli {

Settings photon_settings(Settings const& settings) {
    Settings s = settings;
    bool const maps = match(s.integrator, [](auto const& i) {
        return requires { i.shooting; };
    });
    if (!maps) set_integrator(s, "photonmap");
    // No map is asked, so that no radius need be found. (How many caustic paths go on is: that is how they go.)
    match(s.integrator, [](auto& i) {
        if constexpr (requires { i.shooting; }) i.estimates.radius = i.estimates.caustic_radius = 1;
    });
    return s;
}

ShownMap shown_map(std::string const& name) {
    return name == "global" ? ShownMap::Global : name == "caustic" ? ShownMap::Caustic : ShownMap::Both;
}

std::vector<ShotKind> shots_of(ShownMap map) {
    if (map == ShownMap::Global) return {ShotKind::Global};
    if (map == ShownMap::Caustic) return {ShotKind::Caustic};
    return {ShotKind::Global, ShotKind::Caustic};
}

Vec3 power_rgb(PhotonRecord const& photon, Wavelengths const& lambda) {
    // The lone lane of a hero counts for all four already (light_walk.h).
    return to_linear_srgb(photon.power, lambda);
}

Vec3 PhotonColors::operator()(Vec3 power) const {
    Vec3 const light = max(power, Vec3(0));
    float const most = max_component(light);
    if (!(most > 0)) return Vec3(0.2f);
    return light * (std::max(0.2f, most / (most + 0.5f * typical_)) / most);
}

float median_of(std::vector<float> numbers) {
    if (numbers.empty()) return 0;
    auto const middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

PathSegment segment_of(TracedPath const& path, std::size_t first_vertex) {
    if (first_vertex == 0) return PathSegment::Direct;
    // Photons lie where a surface is neither mirror nor glass.
    for (std::size_t k = 1; k <= first_vertex; ++k)
        for (auto const* photons : {&path.photons, &path.further})
            for (PhotonRecord const& photon : *photons)
                if (photon.p == path.vertices[k]) return PathSegment::Indirect;
    return PathSegment::Caustic;
}

}  // namespace nephroid::cli
