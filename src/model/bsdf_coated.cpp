// Layered surfaces by random walks (Guo et al. 2018, "Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs";
// PBRT 4th ed., 14.3): light is followed between the coat's boundary at z = thickness and the base at z = 0. Only z and the direction
// count. The medium between has an attenuation of 1, so that thickness is its optical depth; it absorbs what it does not scatter,
// and without an albedo it only absorbs (pbrt-v4).
//
// The numbers of a walk are hashes of what it is for: (seed, wo, wi), and one stream for each of f, the density and the draw.
// That f and the density do not share numbers is what keeps products of the two, as in multiple importance sampling, unbiased.
#include "coat_table.h"
#include "diffuse_boundary.h"
#include "layer_boundary.h"
#include "make_bsdf.h"
#include "model/fresnel.h"
#include "sampling/hash.h"
#include "sampling/henyey_greenstein.h"
#include "sampling/warp.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nephroid {

namespace {

/// What numbers are drawn for.
enum class Stream : std::uint64_t { Value, Density, Draw, Albedo };

/// A stream of numbers made of its key.
class Numbers {
  public:
    explicit Numbers(std::uint64_t key) : key_(key) {}
    float next() { return to_unit_float(static_cast<std::uint32_t>(bits() >> 32)); }
    Vec2 pair() {
        std::uint64_t const b = bits();
        return {to_unit_float(static_cast<std::uint32_t>(b >> 32)),
                to_unit_float(static_cast<std::uint32_t>(b))};
    }

  private:
    std::uint64_t bits() { return mix64(key_ += 0x9e3779b97f4a7c15ull); }
    std::uint64_t key_;
};
std::uint64_t pack(float a, float b) {
    return (std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32) | std::bit_cast<std::uint32_t>(b);
}
Numbers numbers(std::uint32_t seed, Stream stream, Vec3 a, Vec3 b) {
    return Numbers(hash_keys((std::uint64_t{seed} << 8) | static_cast<std::uint64_t>(stream), pack(a.x, a.y),
                             pack(a.z, b.x), pack(b.y, b.z)));
}

/// Transmittance of an optical depth along the normal.
float passing(float depth, Vec3 w) { return std::exp(-std::abs(depth / w.z)); }

/// Where a walk is, on its way along w.
struct Walker {
    Vec3 w;
    float z = 0;
    Spectrum beta{1.0f};
};

/// Where the next event is.
enum class Event { Scattering, Top, Base, Lost };

/// A coat over a base, seen from above: all directions that enter or leave have z > 0.
template <class Base>
struct Layers {
    CoatLayer const& coat;
    LayerBoundary top;
    Base const& base;
    bool mirror = traits(base).delta;  // the base has nothing but a delta part
    bool empty = coat.albedo.is_black();

    Layers(CoatLayer const& c, Base const& b) : coat(c), top(c.eta, c.facets), base(b) {}

    /// From where the walker is to what it meets.
    Event move(Walker& at, Numbers& r) const {
        if (at.w.z == 0.0f) return Event::Lost;
        bool const up = at.w.z > 0.0f;
        if (empty) {
            at.beta *= passing(coat.thickness, at.w);
        } else {
            float const way = -std::log1p(-r.next()) * std::abs(at.w.z);
            float const z = up ? at.z + way : at.z - way;
            if (z == at.z) return Event::Lost;
            if (0.0f < z && z < coat.thickness) {
                at.z = z;
                return Event::Scattering;
            }
        }
        at.z = up ? coat.thickness : 0.0f;
        return up ? Event::Top : Event::Base;
    }
    /// Turns at a particle, and pays the albedo; the density of the new direction, which is the phase function's value.
    float turn(Walker& at, Numbers& r) const {
        Vec3 const wo = -at.w;
        at.beta *= coat.albedo;
        at.w = sample_henyey_greenstein(coat.g, wo, r.pair());
        return henyey_greenstein(coat.g, wo, at.w);
    }
    /// Turns at the base; the density of the new direction, or nothing where the light ends.
    std::optional<float> bounce(Walker& at, Numbers& r) const {
        float const uc = r.next();
        auto const s = sample(base, -at.w, uc, r.pair(), Mode::Importance, HemisphereSampling::Cosine);
        if (!s || !(s->pdf > 0.0f) || !(s->wi.z > 0.0f)) return std::nullopt;
        at.beta *= s->f * (abs_cos_theta(s->wi) / s->pdf);
        at.w = s->wi;
        return s->pdf;
    }
    /// Between two mirrors nothing but particles can be joined with a direction: light that goes `up`, once straight (`seen`) and
    /// once by way of the base, and the turns of it between the two for which `events` are left, that of leaving among them.
    /// pbrt-v4's f lacks all but the first, its samples do not.
    Spectrum between_mirrors(Walker const& at, Vec3 up, Spectrum seen, int events) const {
        Spectrum const base_r = albedo(base, up);
        float const phase = henyey_greenstein(coat.g, -at.w, {up.x, up.y, -up.z});
        Spectrum const turn =
            base_r * (fresnel_dielectric(-up.z, coat.eta) * passing(2.0f * coat.thickness, up));
        Spectrum by_base = base_r * (phase * passing(coat.thickness + at.z, up));
        Spectrum sum;
        for (; events >= 1; events -= 2) {
            sum += events >= 2 ? seen + by_base : seen;
            seen *= turn;
            by_base *= turn;
            if (seen.max() + by_base.max() < 1e-9f) break;
        }
        return sum;
    }
    /// Russian roulette, as pbrt-v4 has it: from the fifth event on, where little is left.
    static bool survives(Walker& at, int depth, Numbers& r) {
        if (depth <= 3) return true;
        float const q = at.beta.max();
        if (q >= 0.25f) return true;
        if (!(r.next() < q)) return false;
        at.beta /= q;
        return true;
    }
};

/// f(wo, wi). A walk from wo; at each event it is joined with a direction that was drawn through the boundary from wi, and where
/// the boundary is rough also with wi itself, through the boundary from the direction that the event drew (PBRT 4th ed., 14.3.2).
/// Where two ways find the same light they share it by the power heuristic, both densities being of the inner direction.
template <class Base>
Spectrum evaluate_layers(Layers<Base> const& l, Vec3 wo, Vec3 wi, std::uint32_t seed) {
    if (!same_hemisphere(wo, wi)) return {};
    if (wo.z < 0.0f) {
        wo = -wo;
        wi = -wi;
    }
    Spectrum f(l.top.f_reflect(wo, wi));
    bool const joins = !l.mirror || !l.top.smooth() || !l.empty;
    if (!joins) return f;
    Numbers r = numbers(seed, Stream::Value, wo, wi);
    bool const rough = !l.top.smooth();
    float const thickness = l.coat.thickness;
    // f(in -> out) = f(out -> in) / eta^2 turns what was drawn from wi around.
    float const turned = 1.0f / sqr(l.top.eta());
    Spectrum walks;
    for (int s = 0; s < l.coat.samples; ++s) {
        auto const in = l.top.transmit(wo, r.pair());
        auto const out = l.top.transmit(wi, r.pair());
        if (!in || !out) continue;
        Walker at{in->w, thickness, Spectrum(in->weight)};
        Vec3 const up = -out->w;
        float const leaving = out->weight * turned;

        // Light that an event sent along at.w with the density `drawn`, out through the rough boundary.
        auto const leave = [&](float drawn, bool joined) {
            float const value = l.top.f_transmit(-at.w, wi);
            if (!(value > 0.0f)) return;
            float const w = joined ? power_heuristic(drawn, l.top.pdf_transmit(wi, -at.w)) : 1.0f;
            walks += at.beta * (value * w * passing(thickness - at.z, at.w));
        };
        for (int depth = 0; depth < l.coat.max_depth; ++depth) {
            if (!l.survives(at, depth, r)) break;
            Event const event = l.move(at, r);
            if (event == Event::Lost) break;
            if (event == Event::Scattering) {
                float const phase = henyey_greenstein(l.coat.g, -at.w, up);
                float const w = rough ? power_heuristic(out->pdf, phase) : 1.0f;
                Spectrum seen(phase * w * passing(thickness - at.z, up));
                if (l.mirror && !rough) seen = l.between_mirrors(at, up, seen, l.coat.max_depth - depth);
                walks += at.beta * l.coat.albedo * seen * (leaving / up.z);
                float const drawn = l.turn(at, r);
                if (rough && at.w.z > 0.0f) leave(drawn, true);
            } else if (event == Event::Top) {
                auto const back = l.top.reflect(-at.w, r.pair());
                if (!back) break;
                at.beta *= back->weight;
                at.w = back->w;
            } else {
                if (!l.mirror) {
                    float const w =
                        rough ? power_heuristic(out->pdf, pdf(l.base, -at.w, up, HemisphereSampling::Cosine))
                              : 1.0f;
                    walks += at.beta * evaluate(l.base, -at.w, up, Mode::Importance) *
                             (w * passing(thickness, up) * leaving);
                }
                auto const drawn = l.bounce(at, r);
                if (!drawn) break;
                if (rough) leave(*drawn, !l.mirror);
            }
        }
    }
    return f + walks / static_cast<float>(l.coat.samples);
}

/// Follows light through the layers until it leaves. What the walk may do is what `evaluate_layers` counts: max_depth events and
/// the way out.
template <class Base>
std::optional<BsdfSample> sample_layers(Layers<Base> const& l, Vec3 wo, float uc, Vec2 u,
                                        std::uint32_t seed) {
    bool const below = wo.z < 0.0f;
    if (wo.z == 0.0f) return std::nullopt;
    if (below) wo = -wo;
    auto const first = l.top.either(wo, uc, u);
    if (!first) return std::nullopt;
    // Of a walk that went on through rough things nobody knows the density: it is said to be 1.
    auto const leaves = [&](Vec3 wi, Spectrum weight, float p, bool delta) {
        BsdfSample s;
        s.wi = below ? -wi : wi;
        s.f = weight * (p / abs_cos_theta(wi));
        s.pdf = p;
        s.delta = delta;
        s.proportional = !delta;
        return s;
    };
    if (!first->transmitted) return leaves(first->w, Spectrum(first->weight), first->pdf, l.top.smooth());
    Numbers r = numbers(seed, Stream::Draw, wo, {uc, u.x, u.y});
    Walker at{first->w, l.coat.thickness, Spectrum(first->weight)};
    bool delta = l.top.smooth();
    for (int depth = 0; depth <= l.coat.max_depth; ++depth) {
        if (!l.survives(at, depth, r)) return std::nullopt;
        Event const event = l.move(at, r);
        if (event == Event::Top) {
            float const choice = r.next();
            auto const s = l.top.either(-at.w, choice, r.pair());
            if (!s) return std::nullopt;
            at.beta *= s->weight;
            at.w = s->w;
            if (s->transmitted) return leaves(at.w, at.beta, 1.0f, delta);
        } else if (event == Event::Base) {
            delta = delta && l.mirror;
            if (!l.bounce(at, r)) return std::nullopt;
        } else if (event == Event::Scattering) {
            delta = false;
            l.turn(at, r);
        } else {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

/// An estimate of the density of `sample_layers`, for weights only: the coat's reflection and light that meets the base once, the rest
/// as if it were uniform (PBRT 4th ed., 14.3.4, with the parts weighted by what the boundary lets through).
template <class Base>
float layers_pdf(Layers<Base> const& l, Vec3 wo, Vec3 wi, std::uint32_t seed) {
    if (!same_hemisphere(wo, wi)) return 0.0f;
    if (wo.z < 0.0f) {
        wo = -wo;
        wi = -wi;
    }
    bool const rough = !l.top.smooth();
    if (l.mirror && !rough && l.empty) return 0.0f;
    Numbers r = numbers(seed, Stream::Density, wo, wi);
    float const eta2 = sqr(l.top.eta());
    // A diffuse base makes light try again until it gets out, through the cone of 1 / eta^2 of its directions.
    float const tries = std::same_as<Base, DiffuseBsdf> ? eta2 : 1.0f;
    float sum = 0;
    for (int s = 0; s < l.coat.samples; ++s) {
        auto const in = l.top.transmit(wo, r.pair());
        if (!in) continue;
        float found = 0;
        if (!l.mirror) {
            auto const out = l.top.transmit(wi, r.pair());
            if (out) {
                float const inner = pdf(l.base, -in->w, -out->w, HemisphereSampling::Cosine);
                float const w = rough ? power_heuristic(out->pdf, inner) : 1.0f;
                // Densities by outer solid angle: dw_in cos_in = dw_out cos_out / eta^2.
                found += w * inner * tries * wi.z / (eta2 * std::abs(out->w.z));
            }
        }
        if (rough) {
            Walker at{in->w};
            if (auto const drawn = l.bounce(at, r)) {
                float const w = l.mirror ? 1.0f : power_heuristic(*drawn, l.top.pdf_transmit(wi, -at.w));
                found += w * tries * l.top.pdf_transmit(-at.w, wi);
            }
        }
        sum += in->weight * found;
    }
    float const walks =
        l.top.reflectance(wo, wi) * l.top.pdf_reflect(wo, wi) + sum / static_cast<float>(l.coat.samples);
    return lerp(0.1f, walks, kUniformHemispherePdf);
}

/// An estimate by some walks, fixed by wo and the seed.
template <class Base>
Spectrum layers_albedo(Layers<Base> const& l, Vec3 wo, std::uint32_t seed) {
    constexpr int kWalks = 32;
    Numbers r = numbers(seed, Stream::Albedo, wo, {});
    Spectrum sum;
    for (int i = 0; i < kWalks; ++i) {
        float const uc = (static_cast<float>(i) + r.next()) / static_cast<float>(kWalks);
        if (auto const s = sample_layers(l, wo, uc, r.pair(), seed))
            sum += s->f * (abs_cos_theta(s->wi) / s->pdf);
    }
    return sum / static_cast<float>(kWalks);
}

/// How often light may meet the base among that many events.
std::uint8_t meetings(CoatLayer const& l) { return static_cast<std::uint8_t>((l.max_depth + 1) / 2); }

template <class F>
auto with_layers(CoatedDiffuseBsdf const& b, F const& f) {
    DiffuseBsdf const base{b.reflectance};
    return f(Layers<DiffuseBsdf>(b.coat, base));
}
template <class F>
auto with_layers(CoatedConductorBsdf const& b, F const& f) {
    if (b.facets.smooth()) {
        ConductorBsdf const base{b.eta, b.k};
        return f(Layers<ConductorBsdf>(b.coat, base));
    }
    RoughConductorBsdf const base{b.eta, b.k, b.facets};
    return f(Layers<RoughConductorBsdf>(b.coat, base));
}

}  // namespace

// --- over a diffuse base ------------------------------------------------------------------------------------------------------
// Light that gets in gets out again, and its two factors of n^2 cancel: radiance and importance scatter alike.
Spectrum evaluate(CoatedDiffuseBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    return with_layers(b, [&](auto const& l) { return evaluate_layers(l, wo, wi, b.seed); });
}
float pdf(CoatedDiffuseBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    return with_layers(b, [&](auto const& l) { return layers_pdf(l, wo, wi, b.seed); });
}
std::optional<BsdfSample> sample(CoatedDiffuseBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode,
                                 HemisphereSampling) {
    return with_layers(b, [&](auto const& l) { return sample_layers(l, wo, uc, u, b.seed); });
}
Spectrum albedo(CoatedDiffuseBsdf const& b, Vec3 wo) {
    return with_layers(b, [&](auto const& l) { return layers_albedo(l, wo, b.seed); });
}
DeltaBranches delta_branches(CoatedDiffuseBsdf const& b, Vec3 wo, Mode) {
    if (!b.coat.facets.smooth()) return {};
    return mirror_branch(Spectrum(fresnel_dielectric(abs_cos_theta(wo), b.coat.eta)), wo);
}

// --- over a conductor ---------------------------------------------------------------------------------------------------------
Spectrum evaluate(CoatedConductorBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    return with_layers(b, [&](auto const& l) { return evaluate_layers(l, wo, wi, b.seed); });
}
float pdf(CoatedConductorBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    return with_layers(b, [&](auto const& l) { return layers_pdf(l, wo, wi, b.seed); });
}
std::optional<BsdfSample> sample(CoatedConductorBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode,
                                 HemisphereSampling) {
    return with_layers(b, [&](auto const& l) { return sample_layers(l, wo, uc, u, b.seed); });
}
Spectrum albedo(CoatedConductorBsdf const& b, Vec3 wo) {
    return with_layers(b, [&](auto const& l) { return layers_albedo(l, wo, b.seed); });
}
/// What meets no particle on its way goes as without a medium, whose extinction is the same.
DeltaBranches delta_branches(CoatedConductorBsdf const& b, Vec3 wo, Mode mode) {
    return delta_branches(ClosedCoatedConductorBsdf{b.eta, b.k, b.coat.facets, b.facets, b.coat.eta,
                                                    b.coat.thickness, meetings(b.coat), b.coat.dispersive},
                          wo, mode);
}

// --- from materials -----------------------------------------------------------------------------------------------------------
namespace {

/// pbrt-v4's defaults. A coat of index 1 bends nothing, whatever its microfacets.
CoatLayer layer(Coat const& c, MaterialPoint const& p) {
    CoatLayer l;
    RuntimeSpectrum const& eta = p.data().eta;
    l.eta = p.index(eta)[0];
    l.dispersive = p.disperses(eta);
    if (l.eta != 1.0f) l.facets = p.facets(c.roughness);
    l.thickness = max(p.number(c.thickness, 0.01f), 0.0f);
    l.albedo = clamp(p.spectrum(c.albedo, {}), 0.0f, 1.0f);
    l.g = clamp(p.number(c.g, 0.0f), -0.999f, 0.999f);
    l.max_depth = static_cast<std::uint8_t>(std::clamp(c.max_depth, 1, 255));
    l.samples = static_cast<std::uint8_t>(std::clamp(c.samples, 1, 255));
    return l;
}
/// Walks differ from path to path, even where the same light is looked at from the same place. Of the place the exponents are
/// left out: a scene scaled by a power of two has the same walks.
std::uint32_t seed_of(MaterialPoint const& p) {
    auto const digits = [](float x) {
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & 0x807fffffu);
    };
    return static_cast<std::uint32_t>(hash_keys(pack(digits(p.at.p.x), digits(p.at.p.y)),
                                                pack(digits(p.at.p.z), p.lambda.lambda(0)),
                                                pack(p.at.uv.x, p.at.uv.y)));
}

// --- closed forms ---------------------------------------------------------------------------------------------------------------
/// A scattering medium is for walks alone. Otherwise the closed form is taken where its albedo was within 2% of the walks'
/// (decision 7; tests/model/bsdf_coated_test.cpp measures it again), or where it is asked for.
bool closed(Coat const& c, CoatLayer const& l, bool holds) {
    if (c.model == CoatModel::Stochastic || !l.albedo.is_black()) return false;
    return c.model == CoatModel::ClosedForm || holds;
}
float alpha_of(Microfacets const& m) { return max(m.ax, m.ay); }
/// What the table of coats was made for.
bool tabulated(Microfacets const& m) {
    return m.smooth() || (m.kind == Distribution::TrowbridgeReitz && min(m.ax, m.ay) * 1.5f >= alpha_of(m));
}
bool closed_form_holds(CoatLayer const& l) {
    if (l.facets.smooth()) return diffuse_boundary_covers(l.eta);
    return tabulated(l.facets) && coat_table_covers(l.eta) && l.thickness <= 0.1f;
}
/// `brightest`: of the base within the coat, the brightest lane's reflectance at normal incidence.
bool closed_form_holds(CoatLayer const& l, Microfacets const& base, float brightest) {
    if (l.facets.smooth() && base.smooth()) return true;
    // Copper is what was measured; over a white metal, where more light goes to and fro, 4% are lost.
    constexpr float kCopper = 0.94f;
    if (brightest > kCopper) return false;
    // Where the base is much smoother than the coat, light meets it at angles that the lobes know nothing of.
    float const a = l.facets.smooth() ? 0.0f : alpha_of(l.facets);
    float const b = base.smooth() ? 0.0f : alpha_of(base);
    return tabulated(l.facets) && tabulated(base) && coat_table_covers(l.eta) && l.thickness <= 0.02f &&
           a <= 0.15f && b >= 0.05f && b >= 1.6f * a;
}
float brightest_lane(Spectrum eta, Spectrum k, Wavelengths const& lambda) {
    float f = 0.0f;
    for (int i = 0; i < (lambda.is_rgb() ? 3 : 4); ++i) f = max(f, fresnel_conductor(1.0f, eta[i], k[i]));
    return f;
}

}  // namespace

void make(CoatedDiffuseMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    CoatLayer const coat = layer(m.coat, p);
    Spectrum const reflectance = clamp(p.spectrum(m.reflectance, Spectrum(0.5f)), 0.0f, 1.0f);
    if (closed(m.coat, coat, closed_form_holds(coat)))
        bsdf.emplace<PlasticBsdf>(PlasticBsdf{reflectance, Spectrum(1.0f), coat.eta, coat.facets, true,
                                              coat.dispersive, meetings(coat), coat.thickness});
    else
        bsdf.emplace<CoatedDiffuseBsdf>(CoatedDiffuseBsdf{coat, reflectance, seed_of(p)});
}

void make(CoatedConductorMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    auto const [eta, k] = complex_index(m.conductor, p);
    CoatLayer const coat = layer(m.coat, p);
    Microfacets const base = p.facets(m.conductor.roughness);
    Spectrum const inner_eta = eta / coat.eta;
    Spectrum const inner_k = k / coat.eta;
    if (closed(m.coat, coat, closed_form_holds(coat, base, brightest_lane(inner_eta, inner_k, p.lambda))))
        bsdf.emplace<ClosedCoatedConductorBsdf>(ClosedCoatedConductorBsdf{inner_eta, inner_k, coat.facets,
                                                                          base, coat.eta, coat.thickness,
                                                                          meetings(coat), coat.dispersive});
    else
        bsdf.emplace<CoatedConductorBsdf>(CoatedConductorBsdf{coat, inner_eta, inner_k, base, seed_of(p)});
}

}  // namespace nephroid
