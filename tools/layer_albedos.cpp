// Tabulates the directional albedos of microfacets and of sheen (src/model/layer_albedos.h), by quadrature in
// double.
//
//   layer_albedos OUT.bin
#include "../src/model/layer_albedos.h"

#include "../src/model/sheen_fit.h"
#include "model/sheen.h"

#include <cstdio>
#include <memory>

namespace {

using namespace nephroid;
using T = LayerAlbedos;

constexpr double kPiD = 3.14159265358979323846;
constexpr double kGrazing = 1e-4;  // the cosine that stands for 0

double part(int i, int cells) { return static_cast<double>(i) / cells; }
double cosine(int i, int cells) { return std::max(kGrazing, part(i, cells) * part(i, cells)); }
std::size_t at(int i) { return static_cast<std::size_t>(i); }

// --- microfacets -------------------------------------------------------------------------------------------
struct Direction {
    double x, y, z;
};
double dot(Direction a, Direction b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// GGX (PBRT 4th ed., 9.6), in double.
struct Ggx {
    double ax, ay;
    [[nodiscard]] double lambda(Direction w) const {
        double const t = (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z);
        return (std::sqrt(1 + t) - 1) / 2;
    }
    /// Visible normals by spherical caps (Dupuy & Benyoub 2023).
    [[nodiscard]] Direction normal(Direction w, double u, double v) const {
        double const length = std::sqrt(ax * ax * w.x * w.x + ay * ay * w.y * w.y + w.z * w.z);
        Direction const s{ax * w.x / length, ay * w.y / length, w.z / length};
        double const z = (1 - v) * (1 + s.z) - s.z;
        double const r = std::sqrt(std::max(0.0, 1 - z * z));
        Direction const h{ax * (r * std::cos(2 * kPiD * u) + s.x), ay * (r * std::sin(2 * kPiD * u) + s.y),
                          z + s.z};
        double const l = std::sqrt(dot(h, h));
        return {h.x / l, h.y / l, h.z / l};
    }
};
/// Points of [0, 1] with weights that crowd at 1, where spherical caps have the flattest normals: one in 1 / alpha^2 of them
/// sends light into the surface, and equal steps would miss it.
struct Point {
    double v, weight;
};
Point crowded(int i, int n) {
    double const rest = 1 - (i + 0.5) / n;
    // Their sum is 1: the midpoint rule's for 3 x^2 is 1 - 1 / (4 n^2).
    return {1 - rest * rest * rest, 3 * rest * rest / (1 - 0.25 / (static_cast<double>(n) * n)) / n};
}
struct Pair {
    double one = 0, edge = 0;
};
/// Mean of G / G1 over the visible normals, and of the same times (1 - c)^5.
Pair facets(Ggx const& m, Direction w, int azimuths, int heights) {
    if (std::max(m.ax, m.ay) < 1e-3) return {1, std::pow(1 - w.z, 5)};
    Pair sum;
    double const lo = m.lambda(w);
    for (int i = 0; i < azimuths; ++i)
        for (int k = 0; k < heights; ++k) {
            Point const p = crowded(k, heights);
            Direction const n = m.normal(w, (i + 0.5) / azimuths, p.v);
            double const c = dot(w, n);
            Direction const wi{2 * c * n.x - w.x, 2 * c * n.y - w.y, 2 * c * n.z - w.z};
            if (!(wi.z > 0)) continue;
            double const weight = p.weight * (1 + lo) / (1 + lo + m.lambda(wi));
            sum.one += weight;
            sum.edge += weight * std::pow(1 - std::min(c, 1.0), 5);
        }
    return {sum.one / azimuths, sum.edge / azimuths};
}
Direction direction(double mu, double phi) {
    double const s = std::sqrt(1 - mu * mu);
    return {s * std::cos(phi), s * std::sin(phi), mu};
}

/// 2 int T mu dmu = 4 int T x^3 dx with mu = x^2, of what is linear in x between nodes.
template <std::size_t N>
double mean(std::array<float, N> const& row) {
    int const cells = static_cast<int>(N) - 1;
    double sum = 0;
    for (int i = 0; i < cells; ++i) {
        double const x = part(i, cells), y = part(i + 1, cells);
        double const whole = std::pow(y, 4) - std::pow(x, 4);          // int 4 x^3
        double const first = 0.8 * (std::pow(y, 5) - std::pow(x, 5));  // int 4 x^4
        double const upper = (first - x * whole) * cells;
        sum +=
            static_cast<double>(row[at(i)]) * (whole - upper) + static_cast<double>(row[at(i + 1)]) * upper;
    }
    return sum;
}

void isotropic(T& t) {
    for (int r = 0; r <= T::kRough; ++r) {
        double const alpha = part(r, T::kRough) * part(r, T::kRough);
        for (int i = 0; i <= T::kAngles; ++i) {
            Pair const p = facets({alpha, alpha}, direction(cosine(i, T::kAngles), 0), 32, 64);
            t.one[at(r)][at(i)] = static_cast<float>(p.one);
            t.edge[at(r)][at(i)] = static_cast<float>(p.edge);
        }
        t.one_mean[at(r)] = static_cast<float>(mean(t.one[at(r)]));
        t.edge_mean[at(r)] = static_cast<float>(mean(t.edge[at(r)]));
    }
}

void anisotropic(T& t) {
    for (int r = 0; r <= T::kMajor; ++r)
        for (int q = 0; q <= T::kRatio; ++q) {
            double const ax = part(r, T::kMajor) * part(r, T::kMajor);
            double const ay = std::max(1e-5, ax * part(q, T::kRatio) * part(q, T::kRatio));
            auto& one = t.anisotropic_one[at(r)][at(q)];
            auto& edge = t.anisotropic_edge[at(r)][at(q)];
            double one_sum = 0, edge_sum = 0;
            for (int k = 0; k <= T::kTurns; ++k) {
                for (int i = 0; i <= T::kFewAngles; ++i) {
                    Direction const w = direction(cosine(i, T::kFewAngles), part(k, T::kTurns) * kPiD / 2);
                    Pair const p = facets({ax, ay}, w, 24, 32);
                    one[at(k)][at(i)] = static_cast<float>(p.one);
                    edge[at(k)][at(i)] = static_cast<float>(p.edge);
                }
                double const weight = (k == 0 || k == T::kTurns ? 0.5 : 1.0) / T::kTurns;
                one_sum += mean(one[at(k)]) * weight;
                edge_sum += mean(edge[at(k)]) * weight;
            }
            t.anisotropic_one_mean[at(r)][at(q)] = static_cast<float>(one_sum);
            t.anisotropic_edge_mean[at(r)][at(q)] = static_cast<float>(edge_sum);
        }
}

// --- solids ------------------------------------------------------------------------------------------------
/// Sum over the visible normals of what each reflects and refracts, F = f0 (1 - e) + f90 e with e = (1 - c)^5
/// outside.
T::Solid boundary(double alpha, double index, bool inside, double mu) {
    constexpr int kAzimuths = 16, kHeights = 32;
    Ggx const m{alpha, alpha};
    Direction const w = direction(mu, 0);
    double const lo = m.lambda(w), eta = inside ? 1 / index : index;
    double base = 0, first = 0, edge = 0;
    for (int i = 0; i < kAzimuths; ++i)
        for (int k = 0; k < kHeights; ++k) {
            Point const p = crowded(k, kHeights);
            Direction const n = m.normal(w, (i + 0.5) / kAzimuths, p.v);
            double const c = std::min(dot(w, n), 1.0);
            Direction const wi{2 * c * n.x - w.x, 2 * c * n.y - w.y, 2 * c * n.z - w.z};
            double const r = wi.z > 0 ? p.weight * (1 + lo) / (1 + lo + m.lambda(wi)) : 0;
            double const sin2 = (1 - c * c) / (eta * eta);
            if (sin2 >= 1) {
                base += r;
                continue;
            }
            double const cos_t = std::sqrt(1 - sin2), s = c / eta - cos_t;
            Direction const wt{s * n.x - w.x / eta, s * n.y - w.y / eta, s * n.z - w.z / eta};
            double const t = wt.z < 0 ? p.weight * (1 + lo) / (1 + lo + m.lambda(wt)) : 0;
            double const e = std::pow(1 - (inside ? cos_t : c), 5);
            base += t;
            first += (1 - e) * (r - t);
            edge += e * (r - t);
        }
    return {static_cast<float>(base / kAzimuths), static_cast<float>(first / kAzimuths),
            static_cast<float>(edge / kAzimuths)};
}
void solids(T& t) {
    for (int side = 0; side < 2; ++side)
        for (int k = 0; k <= T::kIndices; ++k)
            for (int r = 0; r <= T::kSolidRough; ++r) {
                double const least = 1 / static_cast<double>(T::kIndexMax);
                double const index = 1 / (least + (1 - least) * part(k, T::kIndices));
                double const alpha = std::max(1e-3, part(r, T::kSolidRough) * part(r, T::kSolidRough));
                auto& row = t.solid[at(side)][at(k)][at(r)];
                T::Row<T::kFewAngles> base, first, edge;
                for (int i = 0; i <= T::kFewAngles; ++i) {
                    T::Solid const s = boundary(alpha, index, side == 1, cosine(i, T::kFewAngles));
                    row[at(i)] = s;
                    base[at(i)] = s.base;
                    first[at(i)] = s.first;
                    edge[at(i)] = s.edge;
                }
                t.solid_mean[at(side)][at(k)][at(r)] = {static_cast<float>(mean(base)),
                                                        static_cast<float>(mean(first)),
                                                        static_cast<float>(mean(edge))};
            }
}

// --- sheen -------------------------------------------------------------------------------------------------
/// Midpoint rule, with cosines spaced as squares because all happens at the horizon.
double sheen_albedo_of(double mu, double alpha) {
    constexpr int kHeights = 64, kAzimuths = 64;
    double const lo = sheen_lambda(mu, alpha);
    double const so = std::sqrt(1 - mu * mu);
    double sum = 0;
    for (int i = 0; i < kHeights; ++i) {
        double const x = (i + 0.5) / kHeights;
        double const z = x * x;
        double const si = std::sqrt(1 - z * z);
        double d = 0;
        for (int k = 0; k < kAzimuths; ++k) {
            double const across2 = so * so + si * si + 2 * so * si * std::cos(kPiD * (k + 0.5) / kAzimuths);
            d += sheen_density(across2 / (across2 + (mu + z) * (mu + z)), alpha);
        }
        // f cos = D G / (4 mu), dz = 2 x dx
        sum += d / kAzimuths * 2 * x / (4 * mu * (1 + lo + sheen_lambda(z, alpha)));
    }
    return 2 * kPiD * sum / kHeights;
}
void sheen(T& t) {
    double const least = std::sqrt(static_cast<double>(kSheenAlphaMin));
    for (int r = 0; r <= T::kRough; ++r) {
        double const roughness = least + (1 - least) * part(r, T::kRough);
        for (int i = 0; i <= T::kAngles; ++i)
            t.sheen[at(r)][at(i)] =
                static_cast<float>(sheen_albedo_of(cosine(i, T::kAngles), roughness * roughness));
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: layer_albedos OUT.bin\n");
        return 2;
    }
    auto const t = std::make_unique<T>();
    isotropic(*t);
    anisotropic(*t);
    solids(*t);
    sheen(*t);
    std::FILE* const f = std::fopen(argv[1], "wb");
    if (!f || std::fwrite(t.get(), sizeof(T), 1, f) != 1 || std::fclose(f) != 0) {
        std::fprintf(stderr, "layer_albedos: cannot write %s\n", argv[1]);
        return 4;
    }
    return 0;
}
