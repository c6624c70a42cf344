// How terms become parts. The parts are mixed, each chosen as often as its largest component is of their sum and brighter by as
// much, so that their contributions are the file's; where they add up to more than 1 all are scaled down.
//
// The highlight: those programs add k_s c cos^n(angle to the mirror direction) for a small light of colour c. Ashikhmin & Shirley's
// lobe of exponent m = 4n about the half vector is as wide (its angle is half of the other), and at normal incidence its value is
// (m + 1) R_s / (8 pi); with an irradiance of pi c that is k_s c for R_s = 8 k_s / (m + 1).
#include "ray_phong.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// What was written for programs that multiplied the shininess by 128.
constexpr float kOldShininess = 128;

float exponent_of(Phong const& p) {
    float const n = p.shininess <= 1 ? p.shininess * kOldShininess : p.shininess;
    return min(4 * n, 1e5f);  // beyond that it is a mirror of a lobe
}

/// The lobe's reflectance at normal incidence as a share of k_s.
float lobe_share(Phong const& p) { return min(1, 8 / (exponent_of(p) + 1)); }

RayColour scaled(RayColour c, float factor) {
    c.value *= factor;
    return c;
}

}  // namespace

PhongMapper::Key PhongMapper::key_of(Phong const& p) {
    Key key{};
    std::size_t i = 0;
    for (auto const* c : {&p.emissive, &p.ambient, &p.diffuse, &p.specular, &p.reflective, &p.transmissive}) {
        for (int k = 0; k < 3; ++k) key[i++] = c->value[k];
        key[i++] = c->map.valid() ? static_cast<float>(c->map.value) : -1.0f;
    }
    key[i++] = p.shininess;
    key[i] = p.index;
    return key;
}

TextureId PhongMapper::texture(RayColour const& c, float factor, SourceLocation where, SpectrumRole role) {
    if (c.map.valid()) {
        ImageTexture picture;
        picture.image = c.map;
        picture.scale = factor;
        picture.role = role;
        return context_.scene.add(Texture{picture, where});
    }
    Vec3 const rgb = min(c.value * factor, Vec3{1});
    return context_.scene.add(Texture{ConstantSpectrumTexture{RgbAlbedoSpd{rgb}, role}, where});
}

TextureId PhongMapper::number(float value, SourceLocation where) {
    return context_.scene.add(Texture{ConstantFloatTexture{value}, where});
}

MaterialId PhongMapper::base(Phong const& p, RayColour const& lobe, float factor) {
    auto const diffuse = texture(p.diffuse, factor, p.where);
    if (lobe.black()) return context_.scene.add(Material{DiffuseMaterial{diffuse}, p.name, p.where});
    context_.note(
        p.where,
        "specular: the highlight is a lobe of Ashikhmin and Shirley's model, as wide, and as bright where a "
        "small light is mirrored head-on");
    if (p.shininess > 0 && p.shininess <= 1)
        context_.note(p.where,
                      "a shininess of at most 1 is taken for a share of 128, as the oldest files mean it");
    auto const exponent = number(exponent_of(p), p.where);
    // A picture's share cannot be in its value.
    float const lobe_factor = lobe.map.valid() ? factor * lobe_share(p) : factor;
    auto const specular = texture(lobe, lobe_factor, p.where);
    return context_.scene.add(
        Material{AshikhminShirleyMaterial{diffuse, specular, exponent, exponent}, p.name, p.where});
}

MaterialId PhongMapper::mirror(Phong const& p, float factor) {
    context_.note(
        p.where,
        "reflective: a smooth metal that reflects as much head-on, and more at grazing angles (Fresnel)");
    ConductorMaterial metal;
    metal.reflectance = texture(p.reflective, factor, p.where);
    return context_.scene.add(Material{metal, p.name, p.where});
}

MaterialId PhongMapper::transmission(Phong const& p, float factor) {
    auto const tint = texture(p.transmissive, factor, p.where);
    bool const white = !p.transmissive.map.valid() && min(p.transmissive.value * factor, Vec3{1}) == Vec3{1};
    bool const bends = p.index != 1;
    if (bends && (white || p.index < 1)) {
        if (!white)
            context_.note(p.where,
                          "transmissive: an index below 1 is rendered without a tint of what passes");
        DielectricMaterial glass;
        glass.eta = ConstantSpd{p.index};
        return context_.scene.add(Material{glass, p.name, p.where});
    }
    // glTF's glass has the tint at each crossing that those programs gave it.
    auto const zero = number(0, p.where);
    MetallicRoughnessMaterial glass;
    glass.base_color = tint;
    glass.metallic = glass.roughness = zero;
    glass.index.ior = p.index;
    if (!bends) glass.specular.factor = zero;
    glass.transmission.factor = number(1, p.where);
    glass.transmission.thin = !bends;
    return context_.scene.add(Material{glass, p.name, p.where});
}

MaterialId PhongMapper::material(Phong const& p) {
    bool const fresnel = !p.transmissive.black() && p.index != 1;
    if (fresnel)
        context_.note(
            p.where,
            "transmissive: a smooth dielectric of that index; how much it reflects follows from the index "
            "(Fresnel), and \"reflective\" is not used");
    RayColour const lobe = scaled(p.specular, lobe_share(p));
    float const lobe_top = lobe.map.valid() ? lobe_share(p) : lobe.top();
    struct Part {
        float top;
        MaterialId (*make)(PhongMapper&, Phong const&, RayColour const&, float);
    };
    std::array<Part, 3> const parts{{
        {max(p.diffuse.top(), lobe_top),
         [](PhongMapper& m, Phong const& q, RayColour const& l, float f) { return m.base(q, l, f); }},
        {fresnel ? 0.0f : p.reflective.top(),
         [](PhongMapper& m, Phong const& q, RayColour const&, float f) { return m.mirror(q, f); }},
        {p.transmissive.top(),
         [](PhongMapper& m, Phong const& q, RayColour const&, float f) { return m.transmission(q, f); }},
    }};
    float sum = 0;
    for (auto const& part : parts) sum += part.top;
    if (!(sum > 0)) return base(p, {}, 1);
    if (!std::isfinite(sum)) context_.fail(p.where, "the colours of the material are too large; divide them");
    // Sums such as 0.7 + 0.3 may be a rounding above 1.
    if (sum > 1.00001f)
        context_.note(
            p.where,
            "more light would leave than arrives: diffuse, specular, reflective and transmissive together "
            "are scaled down to 1");
    float const all = min(sum, 1);
    MaterialId mixed;
    float mixed_top = 0;
    for (auto const& part : parts) {
        if (!(part.top > 1e-6f * sum)) continue;  // not worth the choice
        auto const made = part.make(*this, p, lobe, all / part.top);
        mixed_top += part.top;
        if (mixed.valid()) {
            auto const amount = number(part.top / mixed_top, p.where);
            mixed = context_.scene.add(Material{MixMaterial{mixed, made, amount}, p.name, p.where});
        } else {
            mixed = made;
        }
    }
    return mixed;
}

RaySurface PhongMapper::surface(Phong const& p, bool open) {
    auto const [it, is_new] = known_.try_emplace(key_of(p));
    if (is_new) {
        it->second = material(p);
        Vec3 const d = p.ambient.value - p.diffuse.value;
        if (p.ambient.map != p.diffuse.map || max_component(max(d, -d)) > 1e-3f)
            other_ambient_.push_back(p.where);
    }
    RaySurface s{it->second, {}};
    if (p.emissive.black()) return s;
    AreaLight& light = s.light.emplace();
    if (p.emissive.map.valid()) {
        light.texture = texture(p.emissive, 1, p.where, SpectrumRole::Unbounded);
    } else {
        light.radiance = RgbIlluminantSpd{p.emissive.value};
    }
    light.two_sided = open;
    light.where = p.where;
    return s;
}

}  // namespace nephroid
