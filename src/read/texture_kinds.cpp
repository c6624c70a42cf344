// The kinds of textures, with pbrt-v4's parameters and defaults.
#include "spectra.h"
#include "textures.h"

#include "number.h"

namespace nephroid {

namespace {

Mat4 inverse_of(Params const& p, Mat4 const& to_world) {
    auto const m = inverse(to_world);
    if (!m) p.fail("the current transform cannot be inverted");
    return *m;
}

TextureMapping mapping_2d(Params& p, Mat4 const& to_world) {
    switch (p.choice("mapping", {"uv", "spherical", "cylindrical", "planar"}, 0)) {
        case 1:
            return SphericalMapping{inverse_of(p, to_world)};
        case 2:
            return CylindricalMapping{inverse_of(p, to_world)};
        case 3:
            return PlanarMapping{inverse_of(p, to_world), p.vector3("v1", {1, 0, 0}),
                                 p.vector3("v2", {0, 1, 0}), p.number("udelta", 0), p.number("vdelta", 0)};
        default:
            return UvMapping{p.number("uscale", 1), p.number("vscale", 1), p.number("udelta", 0),
                             p.number("vdelta", 0)};
    }
}

std::string encoding(Params& p) {
    auto const text = p.string("encoding", "");
    constexpr std::string_view kGamma = "gamma ";
    bool const known = text.empty() || text == "linear" || text == "sRGB";
    if (known) return text;
    auto const gamma =
        text.starts_with(kGamma) ? parse_float(std::string_view(text).substr(kGamma.size())) : std::nullopt;
    if (!gamma || !(*gamma > 0)) p.fail("\"encoding\" must be \"linear\", \"sRGB\" or \"gamma <value>\"");
    return text;
}

}  // namespace

TextureKind Textures::image(Definition const& d, Params& p, SpectrumRole role) {
    ImageTexture t;
    t.is_spectrum = d.spectrum;
    t.role = role;
    t.mapping = mapping_2d(p, d.to_world);
    t.scale = p.number("scale", 1);
    t.invert = p.boolean("invert", false);
    constexpr std::array kWraps{WrapMode::Repeat, WrapMode::Black, WrapMode::Clamp, WrapMode::Octahedral};
    t.wrap = kWraps[p.choice("wrap", {"repeat", "black", "clamp", "octahedralsphere"}, 0)];
    constexpr std::array kFilters{FilterMode::Point, FilterMode::Bilinear, FilterMode::Trilinear,
                                  FilterMode::Ewa, FilterMode::Ewa};
    t.filter = kFilters[p.choice("filter", {"point", "bilinear", "trilinear", "ewa", "EWA"}, 1)];
    p.number("maxanisotropy", 8);
    auto const filename = p.string("filename", "");
    if (filename.empty()) p.fail("needs a \"string filename\"");
    auto const where = p.find("filename")->where;
    t.image = context_.scene.add(ImageFile{context_.resolve(where, filename).string(), encoding(p), where});
    return t;
}

TextureKind Textures::kind_of(Definition const& d, Params& p, SpectrumRole role) {
    if (d.kind == "imagemap") return image(d, p, role);
    if (d.kind == "constant") {
        if (!d.spectrum) return ConstantFloatTexture{p.number("value", 1)};
        auto const* v = p.find("value", {ParamType::Rgb, ParamType::Spectrum, ParamType::Blackbody});
        return ConstantSpectrumTexture{v ? spd_of(context_, *v, role) : Spd{ConstantSpd{1}}, role};
    }
    if (d.kind == "scale") {
        // Not in an initialiser list: the order of the textures in the scene would be the compiler's.
        ScaleTexture t;
        t.tex = input(d, p, "tex", 1, role);
        t.scale = float_param(p, "scale", 1);
        return t;
    }
    if (d.kind == "mix" || d.kind == "directionmix") {
        MixTexture t;
        t.tex1 = input(d, p, "tex1", 0, role);
        t.tex2 = input(d, p, "tex2", 1, role);
        if (d.kind == "mix") {
            t.amount = float_param(p, "amount", 0.5f);
        } else {
            p.vector3("dir", {0, 1, 0});
            t.amount = constant(0.5f, d.where);
            p.note("is not rendered yet: an even mix stands in");
        }
        return t;
    }
    if (d.kind == "checkerboard") {
        CheckerboardTexture t;
        t.dimension = p.integer("dimension", 2);
        if (t.dimension != 2 && t.dimension != 3) p.fail("\"dimension\" must be 2 or 3");
        if (t.dimension == 2)
            t.mapping = mapping_2d(p, d.to_world);
        else
            t.world_to_texture = inverse_of(p, d.to_world);
        t.tex1 = input(d, p, "tex1", 1, role);
        t.tex2 = input(d, p, "tex2", 0, role);
        return t;
    }
    return approximated(d, p, role);
}

TextureKind Textures::approximated(Definition const& d, Params& p, SpectrumRole role) {
    auto const mix = [&](TextureId a, TextureId b) { return MixTexture{a, b, constant(0.5f, d.where)}; };
    auto const flat = [&](float value) -> TextureKind {
        if (d.spectrum) return ConstantSpectrumTexture{ConstantSpd{value}, role};
        return ConstantFloatTexture{value};
    };
    if (d.kind == "bilerp") {
        p.note("is not rendered yet: the average of its corners stands in");
        mapping_2d(p, d.to_world);
        auto const v00 = input(d, p, "v00", 0, role);
        auto const v01 = input(d, p, "v01", 1, role);
        auto const v10 = input(d, p, "v10", 0, role);
        auto const v11 = input(d, p, "v11", 1, role);
        auto const low = add(mix(v00, v10), d.where);
        return mix(low, add(mix(v01, v11), d.where));
    }
    if (d.kind == "dots") {
        p.note("is not rendered yet: its \"outside\" stands in");
        mapping_2d(p, d.to_world);
        input(d, p, "inside", 1, role);
        auto const outside = input(d, p, "outside", 0, role);
        ScaleTexture t;
        t.tex = outside;
        t.scale = constant(1, d.where);
        return t;
    }
    // Noise: about its mean over space.
    struct Mean {
        char const* kind;
        float value;
    };
    for (auto const [kind, value] :
         {Mean{"fbm", 0}, {"wrinkled", 0.5f}, {"windy", 0.1f}, {"marble", 0.5f}, {"ptex", 0.5f}})
        if (d.kind == kind) {
            p.note("is not rendered yet: a constant stands in");
            p.ignore_all();
            return flat(value);
        }
    p.fail("unknown kind of texture" +
           did_you_mean(d.kind, {"constant", "imagemap", "checkerboard", "scale", "mix", "directionmix",
                                 "bilerp", "dots", "fbm", "wrinkled", "windy", "marble", "ptex"}));
}

}  // namespace nephroid
