#include "options.h"

namespace nephroid {

namespace {

Vec2 radius(Params& p, Vec2 otherwise) {
    Vec2 const r{p.number("xradius", otherwise.x), p.number("yradius", otherwise.y)};
    if (!(r.x > 0 && r.y > 0)) p.fail("\"xradius\" and \"yradius\" must be above 0");
    for (char const* old : {"xwidth", "ywidth"})
        if (auto const* w = p.find(old))
            p.context().fail(w->where, "\"" + std::string(old) + "\" is of pbrt-v3; in pbrt-v4 it is \"" +
                                           old[0] + "radius\"");
    return r;
}

}  // namespace

Filter make_filter(std::string const& type, Params& p) {
    if (type == "box") return BoxFilter{radius(p, BoxFilter{}.radius)};
    if (type == "triangle") return TriangleFilter{radius(p, TriangleFilter{}.radius)};
    if (type == "gaussian") {
        GaussianFilter const f{radius(p, GaussianFilter{}.radius), p.number("sigma", 0.5f)};
        if (!(f.sigma > 0)) p.fail("\"sigma\" must be above 0");
        return f;
    }
    if (type == "mitchell") {
        MitchellFilter const standard;
        return MitchellFilter{radius(p, standard.radius), p.number("B", standard.b),
                              p.number("C", standard.c)};
    }
    if (type == "sinc") {
        LanczosSincFilter const f{radius(p, LanczosSincFilter{}.radius), p.number("tau", 3)};
        if (!(f.tau > 0)) p.fail("\"tau\" must be above 0");
        return f;
    }
    p.fail("unknown pixel filter" + did_you_mean(type, {"box", "triangle", "gaussian", "mitchell", "sinc"}));
}

}  // namespace nephroid
