// Computes what closed forms of coats need (src/model/coat_format.h).
//
// Albedos of a coat over a mirror of microfacets, exactly but for quadrature: because all is isotropic, light is followed by the cosine
// of its direction alone. What a boundary does to it is a matrix between cosines ("adding", van de Hulst 1980), and light that
// met the base n times is c_n = T R_c (R_in R_c)^(n-1) e, e being what gets out.
//
//   coat_table OUT.bin
#include "../src/model/coat_format.h"
#include "../src/model/layer_boundary.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

namespace {

using namespace nephroid;
using Vector = std::vector<double>;

constexpr std::size_t kInner = 64;  // cosines inside, evenly spaced
constexpr std::size_t kOrders = 5;  // meetings with the base, as many as pbrt's walks have by default

/// Points of the plane, as even as can be (Roberts' R2 sequence).
Vec2 point(int i) {
    double const x = 0.5 + 0.7548776662466927 * i;
    double const y = 0.5 + 0.5698402909980532 * i;
    return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}
Vec3 upwards(float mu) { return {safe_sqrt(1.0f - mu * mu), 0, mu}; }
Microfacets facets(float alpha) { return {.ax = alpha, .ay = alpha}; }

/// Linear functions of a cosine given at nodes: f(mu) = sum of weights times nodes.
struct Row {
    Vector weight;
    void add_inner(float mu, double w) { add(static_cast<double>(mu) * (kInner - 1), w); }
    void add_outer(float mu, double w) { add(static_cast<double>(CoatTable::mu_place(mu)), w); }
    [[nodiscard]] double operator()(Vector const& v) const {
        double sum = 0;
        for (std::size_t i = 0; i < v.size(); ++i) sum += weight[i] * v[i];
        return sum;
    }

  private:
    void add(double x, double w) {
        std::size_t const i = std::min(static_cast<std::size_t>(x), weight.size() - 2);
        double const t = x - static_cast<double>(i);
        weight[i] += (1 - t) * w;
        weight[i + 1] += t * w;
    }
};
using Matrix = std::vector<Row>;
Vector operator*(Matrix const& m, Vector const& v) {
    Vector r;
    for (Row const& row : m) r.push_back(row(v));
    return r;
}
float inner_mu(std::size_t i) { return std::max(static_cast<float>(i) / (kInner - 1), 1e-3f); }

/// A mirror of microfacets turns w: what shadowing leaves, or 0.
struct Turn {
    Vec3 wi;
    double weight = 0;
    double slant = 0;  // Schlick's (1 - cos)^5 at the microfacet
};
Turn mirror(float alpha, Vec3 w, Vec2 u) {
    Microfacets const m = facets(alpha);
    Vec3 const wm = m.smooth() ? Vec3{0, 0, 1} : sample_microfacet(m, w, u);
    Turn t;
    t.wi = wm * (2.0f * dot(w, wm)) - w;
    if (!(t.wi.z > 0.0f)) return t;
    t.weight = m.smooth() ? 1 : static_cast<double>(microfacet_g(m, w, t.wi) / microfacet_g1(m, w));
    t.slant = std::pow(1 - std::min(1.0, static_cast<double>(dot(w, wm))), 5);
    return t;
}

/// The base's reflection between inner cosines, and the same weighted by the slant.
struct Base {
    Matrix turn, slant;
    explicit Base(float alpha) {
        constexpr int n = 1024;
        for (std::size_t i = 0; i < kInner; ++i) {
            Row row{Vector(kInner)}, slanted{Vector(kInner)};
            for (int s = 0; s < n; ++s) {
                Turn const t = mirror(alpha, upwards(inner_mu(i)), point(s));
                if (!(t.weight > 0)) continue;
                row.add_inner(t.wi.z, t.weight / n);
                slanted.add_inner(t.wi.z, t.weight * t.slant / n);
            }
            turn.push_back(row);
            slant.push_back(slanted);
        }
    }
};

/// What the coat's boundary does.
struct Boundary {
    Matrix in;      // from outer nodes to inner cosines
    Matrix back;    // between inner cosines
    Vector escape;  // from inner cosines
    Boundary(float alpha, float eta) {
        constexpr int n = 512;
        LayerBoundary const boundary(eta, facets(alpha));
        for (std::size_t i = 0; i < CoatTable::kMus; ++i) {
            Row row{Vector(kInner)};
            for (int s = 0; s < 4 * n; ++s)
                if (auto const t = boundary.transmit(upwards(CoatTable::mu(i)), point(s)))
                    row.add_inner(-t->w.z, static_cast<double>(t->weight) / (4 * n));
            in.push_back(row);
        }
        for (std::size_t i = 0; i < kInner; ++i) {
            Row row{Vector(kInner)};
            double out = 0;
            Vec3 const w = -upwards(inner_mu(i));
            for (int s = 0; s < n; ++s) {
                if (auto const r = boundary.reflect(w, point(s)))
                    row.add_inner(-r->w.z, static_cast<double>(r->weight) / n);
                if (auto const t = boundary.transmit(w, point(s))) out += static_cast<double>(t->weight) / n;
            }
            back.push_back(row);
            escape.push_back(out);
        }
    }
};

/// The lobe of n meetings without its scale, from outer nodes to outer cosines, and the same weighted by the slant.
struct Lobe {
    Matrix turn, slant;
    Lobe(float coat, float base, float eta, int n) {
        constexpr int samples = 1024;
        float const alpha = coat_lobe_alpha(coat, base, eta, n);
        for (std::size_t i = 0; i < CoatTable::kMus; ++i) {
            Row row{Vector(CoatTable::kMus)}, slanted{Vector(CoatTable::kMus)};
            Vec3 const wo = inside_coat(upwards(CoatTable::mu(i)), eta);
            double const from = static_cast<double>(coat_lobe_passing(CoatTable::mu(i), coat, eta));
            for (int s = 0; s < samples; ++s) {
                Turn const t = mirror(alpha, wo, point(s));
                float const sin2 = (1.0f - t.wi.z * t.wi.z) * eta * eta;
                if (!(t.weight > 0) || sin2 >= 1.0f) continue;
                float const mu = std::sqrt(1.0f - sin2);
                double const w =
                    t.weight * from * static_cast<double>(coat_lobe_passing(mu, coat, eta)) / samples;
                row.add_outer(mu, w);
                slanted.add_outer(mu, w * t.slant);
            }
            turn.push_back(row);
            slant.push_back(slanted);
        }
    }
};

/// g with g(mu) integral L(mu, mu') g(mu') = albedo(mu): a scale that keeps the lobe reciprocal (Sinkhorn's iteration, damped).
Vector scales(Lobe const& lobe, Vector const& albedo) {
    Vector g(CoatTable::kMus, 1.0);
    for (int k = 0; k < 100; ++k) {
        Vector const reached = lobe.turn * g;
        for (std::size_t i = 0; i < g.size(); ++i)
            g[i] = std::sqrt(g[i] * albedo[i] / std::max(reached[i], 1e-12));
    }
    return g;
}

/// What light from each outer node has left after 1, 2, … meetings with the base, and its slant at the first and at the first
/// two.
struct Orders {
    std::array<Vector, kOrders> albedo;
    std::array<Vector, 2> slant;
    Orders(Boundary const& coat, Base const& base, float depth) {
        auto const layer = [&](Vector v) {
            for (std::size_t i = 0; i < v.size(); ++i)
                v[i] *= std::exp(-static_cast<double>(depth) / static_cast<double>(inner_mu(i)));
            return v;
        };
        // What an upward cosine above the base will bring out after so many more meetings.
        Vector up = layer(coat.escape);
        auto const again = [&](Vector const& v) { return layer(coat.back * layer(v)); };
        for (std::size_t n = 0; n < kOrders; ++n) {
            Vector const down = base.turn * up;
            albedo[n] = coat.in * layer(down);
            if (n == 0) slant[0] = coat.in * layer(base.slant * up);
            if (n == 1) {
                Vector const first = coat.in * layer(base.slant * up);
                Vector const second = coat.in * layer(base.turn * again(base.slant * layer(coat.escape)));
                slant[1] = first;
                for (std::size_t i = 0; i < first.size(); ++i) slant[1][i] = (first[i] + second[i]) / 2;
            }
            up = again(down);
        }
    }
};

/// The r of a geometric series that has the sum of all meetings from the second on.
double tail(Orders const& o, std::size_t i) {
    double sum = 0;
    for (std::size_t n = 1; n < kOrders; ++n) sum += o.albedo[n][i] / o.albedo[1][i];
    double lo = 0, hi = 1;
    for (int k = 0; k < 40; ++k) {
        double const r = (lo + hi) / 2;
        double series = 0;
        for (std::size_t n = 1; n < kOrders; ++n) series = 1 + r * series;
        (series < sum ? lo : hi) = r;
    }
    return (lo + hi) / 2;
}

void fill_lobes(CoatTable& t, std::vector<Base> const& bases, std::size_t e, std::size_t a,
                Boundary const& coat) {
    float const eta = CoatTable::eta(e), alpha = CoatTable::alpha(a);
    for (std::size_t b = 0; b < CoatTable::kAlphas; ++b) {
        Orders const clear(coat, bases[b], 0), dim(coat, bases[b], CoatTable::kDepthLo);
        for (std::size_t i = 0; i < CoatTable::kMus; ++i)
            t.lobes[e][a][b][i].tail = static_cast<float>(tail(clear, i));
        for (std::size_t n = 0; n < 2; ++n) {
            Lobe const lobe(alpha, CoatTable::alpha(b), eta, static_cast<int>(n) + 1);
            Vector const g = scales(lobe, clear.albedo[n]), slanted = lobe.slant * g;
            for (std::size_t i = 0; i < CoatTable::kMus; ++i) {
                CoatTable::Lobes& l = t.lobes[e][a][b][i];
                double const all = clear.albedo[n][i], slant = clear.slant[n][i] / all;
                l.g[n] = static_cast<float>(g[i]);
                l.albedo[n] = static_cast<float>(all);
                l.way[n] = static_cast<float>(std::log(all / dim.albedo[n][i]) /
                                              static_cast<double>(CoatTable::kDepthLo));
                l.slant[n] = static_cast<float>(slant);
                l.excess[n] = static_cast<float>(slant - slanted[i] * g[i] / all);
            }
        }
    }
}

void fill_ways(CoatTable& t, std::size_t e, std::size_t a) {
    constexpr int n = 4096;
    LayerBoundary const boundary(CoatTable::eta(e), facets(CoatTable::alpha(a)));
    using Sums = std::array<double, CoatTable::kDepths>;
    auto const add = [](Sums& s, double& clear, double weight, double way) {
        clear += weight;
        for (std::size_t d = 0; d < s.size(); ++d)
            s[d] += weight * std::exp(-static_cast<double>(CoatTable::depth(d)) * way);
    };
    auto const mean = [](Sums const& s, double clear, float* way) {
        for (std::size_t d = 0; d < s.size(); ++d)
            way[d] = static_cast<float>(clear > 0 && s[d] > 0 ? -std::log(s[d] / clear) /
                                                                    static_cast<double>(CoatTable::depth(d))
                                                              : 0);
    };
    for (std::size_t i = 0; i < CoatTable::kMus; ++i) {
        Sums s{};
        double clear = 0;
        for (int k = 0; k < n; ++k)
            if (auto const step = boundary.transmit(upwards(CoatTable::mu(i)), point(k)))
                add(s, clear, static_cast<double>(step->weight),
                    1 / std::abs(static_cast<double>(step->w.z)));
        mean(s, clear, t.down[e][a][i]);
    }
    Sums back{}, out{};
    double back_clear = 0, out_clear = 0;
    for (int k = 0; k < 16 * n; ++k) {
        // Diffuse light: cosines are roots of a third number.
        double const x = 0.5 + 0.4301597090019468 * k;
        auto const mu = static_cast<float>(std::sqrt(x - std::floor(x)));
        Vec3 const w = -upwards(std::max(mu, 1e-4f));
        double const way = 1 / std::abs(static_cast<double>(w.z));
        if (auto const r = boundary.reflect(w, point(k)))
            add(back, back_clear, static_cast<double>(r->weight),
                way + 1 / std::abs(static_cast<double>(r->w.z)));
        if (auto const o = boundary.transmit(w, point(k)))
            add(out, out_clear, static_cast<double>(o->weight), way);
    }
    mean(back, back_clear, t.back[e][a]);
    mean(out, out_clear, t.out[e][a]);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: coat_table OUT.bin\n");
        return 2;
    }
    auto const table = std::make_unique<CoatTable>();
    std::vector<Base> bases;
    for (std::size_t b = 0; b < CoatTable::kAlphas; ++b) bases.emplace_back(CoatTable::alpha(b));
    for (std::size_t e = 0; e < CoatTable::kEtas; ++e)
        for (std::size_t a = 0; a < CoatTable::kAlphas; ++a) {
            fill_ways(*table, e, a);
            fill_lobes(*table, bases, e, a, Boundary(CoatTable::alpha(a), CoatTable::eta(e)));
        }
    std::FILE* const f = std::fopen(argv[1], "wb");
    if (!f || std::fwrite(table.get(), sizeof(CoatTable), 1, f) != 1 || std::fclose(f) != 0) {
        std::fprintf(stderr, "coat_table: cannot write %s\n", argv[1]);
        return 4;
    }
    return 0;
}
