#include "options.h"
#include "shown.h"

#include <algorithm>
#include <array>

namespace nephroid {

namespace {

int pixel_samples(Params& p) {
    int const spp = p.integer("pixelsamples", 16);
    if (spp <= 0) p.fail("\"pixelsamples\" must be above 0");
    return spp;
}

SamplerOptions stratified(Params& p) {
    StratifiedSampler const s{p.integer("xsamples", 4), p.integer("ysamples", 4), p.boolean("jitter", true)};
    constexpr int kMost = 1 << 15;  // their product must fit an int
    if (s.x_strata <= 0 || s.y_strata <= 0 || s.x_strata > kMost || s.y_strata > kMost)
        p.fail("\"xsamples\" and \"ysamples\" must be from 1 to 32768");
    return {s, p.find("pixelsamples") ? pixel_samples(p) : s.x_strata * s.y_strata, {}};
}

}  // namespace

SamplerOptions make_sampler(std::string const& type, Params& p) {
    constexpr std::array<std::string_view, 5> kSobol{"zsobol", "sobol", "paddedsobol", "pmj02bn", "halton"};
    SamplerOptions o;
    if (type == "stratified") {
        o = stratified(p);
    } else if (type == "quadrant") {
        // The report's: each four samples fall one into each quadrant.
        o = {StratifiedSampler{2, 2, p.boolean("jitter", true)}, pixel_samples(p), {}};
    } else if (type == "independent") {
        o = {IndependentSampler{}, pixel_samples(p), {}};
    } else if (std::find(kSobol.begin(), kSobol.end(), type) != kSobol.end()) {
        o = {SobolSampler{}, pixel_samples(p), {}};
        p.find("randomization", {ParamType::String});  // ours is always Owen's
        if (type == "halton" || type == "pmj02bn")
            p.note("info: padded Sobol' points of the same count stand in");
    } else if (type == "random" || type == "02sequence" || type == "lowdiscrepancy" || type == "maxmindist") {
        p.fail("\"" + shown(type) + "\" is of pbrt-v3; in pbrt-v4 write \"" +
               (type == "random"       ? "independent"
                : type == "maxmindist" ? "pmj02bn"
                                       : "paddedsobol") +
               "\"");
    } else {
        p.fail("unknown sampler" + did_you_mean(type, {"zsobol", "sobol", "paddedsobol", "pmj02bn", "halton",
                                                       "stratified", "quadrant", "independent"}));
    }
    if (p.find("seed")) o.seed = p.integer("seed", 0);
    return o;
}

}  // namespace nephroid
