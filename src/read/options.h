// What stands before WorldBegin: camera, film, filter, sampler, integrator. Names and defaults are pbrt-v4's.
#pragma once

#include "params.h"

namespace nephroid {

/// `world_from_camera` is the inverse of the current transform at the directive.
Camera make_camera(std::string const& type, Params& params, Mat4 const& world_from_camera);
FilmSettings make_film(std::string const& type, Params& params);
Filter make_filter(std::string const& type, Params& params);
Integrator make_integrator(std::string const& type, Params& params);

struct SamplerOptions {
    Sampler sampler;
    int spp = 16;
    std::optional<int> seed;
};
SamplerOptions make_sampler(std::string const& type, Params& params);

}  // namespace nephroid
