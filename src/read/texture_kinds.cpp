// The kinds of textures, with pbrt-v4's parameters and defaults.
#include "spectra.h"
#include "textures.h"

#include "number.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

Mat4 inverse_of(Params& p, Textures::Place const& place) {
    p.find("inverse");
    auto const m = place.from_world ? place.from_world : inverse(place.to_world);
    if (!m) p.fail("the current transform cannot be inverted");
    return *m;
}

/// Unit, in the world; 0 where it has no length.
Vec3 to_world_direction(Mat4 const& to_world, Vec3 v) {
    double w[3] = {};
    double sum = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        for (int k = 0; k < 3; ++k)
            w[r] += to_world.m[r][static_cast<std::size_t>(k)] * static_cast<double>(v[k]);
        sum += w[r] * w[r];
    }
    if (!(sum > 0)) return Vec3{0};
    // One that is a unit vector but for rounding keeps its bits.
    double const scale = std::abs(sum - 1) < 1e-6 ? 1 : 1 / std::sqrt(sum);
    return {static_cast<float>(w[0] * scale), static_cast<float>(w[1] * scale),
            static_cast<float>(w[2] * scale)};
}

TextureMapping mapping_2d(Params& p, Textures::Place const& place) {
    switch (p.choice("mapping", {"uv", "spherical", "cylindrical", "planar"}, 0)) {
        case 1:
            return SphericalMapping{inverse_of(p, place)};
        case 2:
            return CylindricalMapping{inverse_of(p, place)};
        case 3:
            return PlanarMapping{inverse_of(p, place), p.vector3("v1", {1, 0, 0}), p.vector3("v2", {0, 1, 0}),
                                 p.number("udelta", 0), p.number("vdelta", 0)};
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
    t.mapping = mapping_2d(p, d.place);
    t.scale = p.number("scale", 1);
    t.invert = p.boolean("invert", false);
    constexpr std::array kWraps{WrapMode::Repeat, WrapMode::Black, WrapMode::Clamp, WrapMode::Octahedral};
    t.wrap = kWraps[p.choice("wrap", {"repeat", "black", "clamp", "octahedralsphere"}, 0)];
    constexpr std::array kFilters{FilterMode::Point, FilterMode::Bilinear, FilterMode::Trilinear,
                                  FilterMode::Ewa, FilterMode::Ewa};
    t.filter = kFilters[p.choice("filter", {"point", "bilinear", "trilinear", "ewa", "EWA"}, 1)];
    t.max_anisotropy = p.number("maxanisotropy", 8);
    if (!(t.max_anisotropy >= 1)) p.fail("\"maxanisotropy\" must be at least 1");
    auto const filename = p.string("filename", "");
    if (filename.empty()) p.fail("needs a \"string filename\"");
    auto const where = p.find("filename")->where;
    t.image = context_.scene.add(ImageFile{context_.resolve(where, filename).string(), encoding(p), where});
    return t;
}

/// Those made of other textures.
TextureKind Textures::of_others(Definition const& d, Params& p, SpectrumRole role) {
    // Not in initialiser lists: the order of the textures in the scene would be the compiler's.
    if (d.kind == "scale") {
        ScaleTexture t;
        t.tex = input(d, p, "tex", 1, role);
        t.scale = float_param(p, "scale", 1);
        return t;
    }
    if (d.kind == "mix") {
        MixTexture t;
        t.tex1 = input(d, p, "tex1", 0, role);
        t.tex2 = input(d, p, "tex2", 1, role);
        t.amount = float_param(p, "amount", 0.5f);
        return t;
    }
    if (d.kind == "directionmix") {
        DirectionMixTexture t;
        t.tex1 = input(d, p, "tex1", 0, role);
        t.tex2 = input(d, p, "tex2", 1, role);
        t.dir = to_world_direction(d.place.to_world, p.vector3("dir", {0, 1, 0}));
        if (t.dir == Vec3{0}) p.fail("\"dir\" is a direction without length");
        return t;
    }
    if (d.kind == "bilerp") {
        BilerpTexture t;
        t.mapping = mapping_2d(p, d.place);
        t.v00 = input(d, p, "v00", 0, role);
        t.v01 = input(d, p, "v01", 1, role);
        t.v10 = input(d, p, "v10", 0, role);
        t.v11 = input(d, p, "v11", 1, role);
        return t;
    }
    if (d.kind == "dots") {
        DotsTexture t;
        t.mapping = mapping_2d(p, d.place);
        // pbrt-v4 mixes the two up: "inside" is what lies around the dots. Scenes are made by what they look like there.
        t.outside = input(d, p, "inside", 1, role);
        t.inside = input(d, p, "outside", 0, role);
        return t;
    }
    CheckerboardTexture t;
    t.dimension = p.integer("dimension", 2);
    if (t.dimension != 2 && t.dimension != 3) p.fail("\"dimension\" must be 2 or 3");
    if (t.dimension == 2)
        t.mapping = mapping_2d(p, d.place);
    else
        t.world_to_texture = inverse_of(p, d.place);
    t.tex1 = input(d, p, "tex1", 1, role);
    t.tex2 = input(d, p, "tex2", 0, role);
    return t;
}

/// Those made of Perlin's noise: in pbrt-v4 marble is always a spectrum, and the others are always floats.
TextureKind Textures::of_noise(Definition const& d, Params& p) {
    bool const marble = d.kind == "marble";
    if (marble && !d.spectrum) p.fail("is a spectrum texture only; write \"spectrum\" for \"float\"");
    if (!marble && d.spectrum)
        p.fail("is a float texture only; make it one and let it be the \"amount\" of a spectrum \"mix\"");
    Mat4 const world_to_texture = inverse_of(p, d.place);
    if (d.kind == "windy") return WindyTexture{world_to_texture};
    int const octaves = p.integer("octaves", 8);
    if (octaves < 0 || octaves > kMaxOctaves)
        p.fail("\"octaves\" must be 0 to " + std::to_string(kMaxOctaves));
    float const roughness = p.number("roughness", 0.5f);
    if (d.kind == "fbm") return FbmTexture{world_to_texture, octaves, roughness};
    if (d.kind == "wrinkled") return WrinkledTexture{world_to_texture, octaves, roughness};
    MarbleTexture t{world_to_texture, octaves, roughness};
    t.scale = p.number("scale", 1);
    t.variation = p.number("variation", 0.2f);
    return t;
}

TextureKind Textures::kind_of(Definition const& d, Params& p, SpectrumRole role) {
    auto const is = [&](std::initializer_list<std::string_view> kinds) {
        return std::find(kinds.begin(), kinds.end(), d.kind) != kinds.end();
    };
    if (d.kind == "imagemap") return image(d, p, role);
    if (is({"scale", "mix", "directionmix", "bilerp", "dots", "checkerboard"})) return of_others(d, p, role);
    if (is({"fbm", "wrinkled", "windy", "marble"})) return of_noise(d, p);
    if (d.kind == "constant") {
        if (!d.spectrum) return ConstantFloatTexture{p.number("value", 1)};
        auto const* v =
            p.find("value", {ParamType::Rgb, ParamType::Spectrum, ParamType::Blackbody, ParamType::Float});
        return ConstantSpectrumTexture{v ? spd_of(context_, *v, role) : Spd{ConstantSpd{1}}, role};
    }
    if (d.kind == "ptex") {
        p.note("is not rendered: a constant 0.5 stands in");
        p.ignore_all();
        if (d.spectrum) return ConstantSpectrumTexture{ConstantSpd{0.5f}, role};
        return ConstantFloatTexture{0.5f};
    }
    p.fail("unknown kind of texture" +
           did_you_mean(d.kind, {"constant", "imagemap", "checkerboard", "scale", "mix", "directionmix",
                                 "bilerp", "dots", "fbm", "wrinkled", "windy", "marble", "ptex"}));
}

}  // namespace nephroid
