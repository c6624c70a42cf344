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

/// A mirror of microfacets turns w; what shadowing leaves, or 0.
double mirror(float alpha, Vec3 w, Vec2 u, Vec3& wi) {
    Microfacets const m = facets(alpha);
    if (m.smooth()) {
        wi = {-w.x, -w.y, w.z};
        return 1;
    }
    Vec3 const wm = sample_microfacet(m, w, u);
    wi = wm * (2.0f * dot(w, wm)) - w;
    if (!(wi.z > 0.0f)) return 0;
    return static_cast<double>(microfacet_g(m, w, wi) / microfacet_g1(m, w));
}

/// The base's reflection between inner cosines.
Matrix base_matrix(float alpha) {
    constexpr int n = 1024;
    Matrix m;
    for (std::size_t i = 0; i < kInner; ++i) {
        Row row{Vector(kInner)};
        for (int s = 0; s < n; ++s) {
            Vec3 wi;
            double const w = mirror(alpha, upwards(inner_mu(i)), point(s), wi);
            if (w > 0) row.add_inner(wi.z, w / n);
        }
        m.push_back(row);
    }
    return m;
}

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

/// The lobe of n meetings without its scale, from outer node i to outer cosines.
Row lobe_row(std::size_t i, float coat, float base, float eta, int n) {
    constexpr int samples = 1024;
    Row row{Vector(CoatTable::kMus)};
    float const alpha = coat_lobe_alpha(coat, base, eta, n);
    Vec3 const wo = inside_coat(upwards(CoatTable::mu(i)), eta);
    double const from = static_cast<double>(coat_lobe_passing(CoatTable::mu(i), coat, eta));
    for (int s = 0; s < samples; ++s) {
        Vec3 wi;
        double const w = mirror(alpha, wo, point(s), wi);
        float const sin2 = (1.0f - wi.z * wi.z) * eta * eta;
        if (!(w > 0) || sin2 >= 1.0f) continue;
        float const mu = std::sqrt(1.0f - sin2);
        row.add_outer(mu, w * from * static_cast<double>(coat_lobe_passing(mu, coat, eta)) / samples);
    }
    return row;
}

/// g with g(mu) integral L(mu, mu') g(mu') = albedo(mu): a scale that keeps the lobe reciprocal (Sinkhorn's iteration, damped).
Vector scales(float coat, float base, float eta, int n, Vector const& albedo) {
    Matrix lobe;
    for (std::size_t i = 0; i < CoatTable::kMus; ++i) lobe.push_back(lobe_row(i, coat, base, eta, n));
    Vector g(CoatTable::kMus, 1.0);
    for (int k = 0; k < 100; ++k) {
        Vector const reached = lobe * g;
        for (std::size_t i = 0; i < g.size(); ++i)
            g[i] = std::sqrt(g[i] * albedo[i] / std::max(reached[i], 1e-12));
    }
    return g;
}

void fill_lobes(CoatTable& t, std::vector<Matrix> const& bases, std::size_t e, std::size_t a,
                Boundary const& coat) {
    float const eta = CoatTable::eta(e), alpha = CoatTable::alpha(a);
    for (std::size_t b = 0; b < CoatTable::kAlphas; ++b) {
        float const base = CoatTable::alpha(b);
        Vector v = bases[b] * coat.escape;
        std::array<Vector, 3> c;
        for (Vector& order : c) {
            order = coat.in * v;
            v = bases[b] * (coat.back * v);
        }
        Vector const g1 = scales(alpha, base, eta, 1, c[0]), g2 = scales(alpha, base, eta, 2, c[1]);
        double second = 0, third = 0;
        for (std::size_t i = 0; i < CoatTable::kMus; ++i) {
            t.lobes[e][a][b][i] = {static_cast<float>(g1[i]), static_cast<float>(g2[i]),
                                   static_cast<float>(c[0][i]), static_cast<float>(c[1][i])};
            // Nodes are at squares, so that projected solid angle goes with i^3.
            double const weight = std::pow(static_cast<double>(i), 3);
            second += weight * c[1][i], third += weight * c[2][i];
        }
        t.tail[e][a][b] = static_cast<float>(second > 0 ? third / second : 0);
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
    std::vector<Matrix> bases;
    for (std::size_t b = 0; b < CoatTable::kAlphas; ++b) bases.push_back(base_matrix(CoatTable::alpha(b)));
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
