// What must be true of every scattering model, checked from outside through sample, pdf and evaluate (PBRT 4th ed., 9.1.2):
// samples by their density, consistency, the Jacobian of the warp, reciprocity, adjointness, energy.
//
// Lobes may be ten thousand times narrower than the sphere is wide. Therefore the cells of chi square are made by the sampler
// itself: a pilot run is halved at its medians, in turn by height and by azimuth, until each cell holds about as many pilot
// samples as every other. The run that is tested is another one, so that its counts are independent of the cells. The density
// is integrated over each cell by Gauss' rule, 3 x 3, halved where its halves do not agree with the whole, where more than a few
// pilot samples are, and where its corners are far from its inside (an edge, or a tail begins); cells that hold a mirrored or
// refracted direction are always halved down to a lobe of alpha 0.001, lest a peak of the density without any samples be
// overlooked. The same cells integrate f |cos|.
#pragma once

#include "model/bsdf.h"
#include "model/fresnel.h"
#include "support.h"

#include <doctest/doctest.h>

#include <array>
#include <span>
#include <string>

namespace nephroid::test {

inline float const kExtremes[] = {0.0f, 0x1p-32f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};

/// 22 outgoing directions: both sides, the normal, and grazing ones.
inline std::vector<Vec3> outgoing() {
    std::vector<Vec3> w;
    for (double const theta : {0.0, 0.3, 0.7, 1.1, 1.4, 1.5, 1.55, 1.565, 1.5705})
        w.push_back(direction(theta, 1.7 * theta + 0.4));
    for (double const phi : {2.0, 3.5}) w.push_back(direction(1.2, phi));
    std::size_t const n = w.size();
    for (std::size_t i = 0; i < n; ++i) w.push_back(-w[i]);
    return w;
}

/// f |cos| / pdf.
inline double throughput(BsdfSample const& s, int lane = 0) {
    return static_cast<double>(s.f[lane]) * std::abs(static_cast<double>(s.wi.z)) /
           static_cast<double>(s.pdf);
}

/// |a - b| within `share` of the greater one.
inline bool near(double a, double b, double share) {
    return std::abs(a - b) <= share * std::max(std::abs(a), std::abs(b));
}

// --- cells ----------------------------------------------------------------------------------------------------------------
/// The sphere cut where a pilot run of directions lies; see the top. Coordinates: h = (1 - z) / 2 and turns of azimuth, in
/// which areas are equal.
class AdaptiveCells {
  public:
    /// `peaks`: directions where a density may be high without pilot samples. `few`: pilot samples in a part that need not be
    /// halved; fewer for densities with edges.
    AdaptiveCells(std::vector<Vec3> const& pilot, std::vector<Vec3> const& peaks, std::size_t cells,
                  std::size_t few = 6)
        : few_(few) {
        std::vector<Point> p;
        for (Vec3 const w : pilot) p.push_back(point(w));
        for (Vec3 const w : peaks) peaks_.push_back(point(w));
        least_ = std::max<std::size_t>(p.size() / cells, 1);
        total_ = p.size();
        build(p, Box{Point{0, 0}, Point{1, 1}}, 0);
    }
    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    [[nodiscard]] std::size_t cell(Vec3 w) const {
        Point const p = point(w);
        int n = 0;
        while (nodes_[index(n)].axis >= 0) {
            Node const& node = nodes_[index(n)];
            n = p[index(node.axis)] < node.at ? node.below : node.above;
        }
        return index(nodes_[index(n)].below);
    }
    /// Integral of f over each cell, by solid angle. `tolerance`: absolute, of each part that is not halved any more.
    template <class F>
    [[nodiscard]] std::vector<double> integrate(F const& f, double tolerance) const {
        std::vector<double> r;
        for (Cell const& c : cells_) {
            std::vector<Point> points = c.pilot;
            r.push_back(refine(f, c.box, rule(f, c.box), tolerance, 0, points));
        }
        return r;
    }

  private:
    using Point = std::array<double, 2>;
    struct Box {
        Point lo, hi;
    };
    struct Cell {
        Box box;
        std::vector<Point> pilot;
    };
    struct Node {
        int axis = -1;  // -1: a cell, whose number is `below`
        double at = 0;
        int below = 0, above = 0;
    };
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }
    static Point point(Vec3 w) {
        // Without cancellation about both poles, and never on the wrong side of the surface.
        double const x = static_cast<double>(w.x), y = static_cast<double>(w.y), z = static_cast<double>(w.z);
        double const h = (x * x + y * y) / (2 * (1 + std::abs(z)));
        double const turn = std::atan2(y, x) / (2 * kPiD) + 0.5;
        return {z > 0 ? std::min(h, 0.5 - 0x1p-54) : std::max(1 - h, 0.5), turn};
    }
    static Vec3 at(double h, double turn) {
        double const phi = (turn - 0.5) * 2 * kPiD, s = 2 * std::sqrt(h * (1 - h));
        return {static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                static_cast<float>(1 - 2 * h)};
    }
    int build(std::vector<Point>& p, Box const& box, int depth) {
        int const n = static_cast<int>(nodes_.size());
        nodes_.emplace_back();
        std::size_t axis = depth < 2 ? 0 : index(depth) % 2;
        double split = 0.5;  // first the two sides of the surface
        if (depth > 0) {
            for (int attempt = 0; attempt < 2; ++attempt, axis = 1 - axis) {
                if (p.size() < 2 * least_ || depth > 40) break;
                auto const middle = p.begin() + static_cast<std::ptrdiff_t>(p.size() / 2);
                std::nth_element(p.begin(), middle, p.end(),
                                 [&](Point const& a, Point const& b) { return a[axis] < b[axis]; });
                split = (*middle)[axis];
                if (split > box.lo[axis] && split < box.hi[axis]) break;
                split = -1;
            }
            if (p.size() < 2 * least_ || depth > 40 || split < 0) {
                nodes_[index(n)].below = static_cast<int>(cells_.size());
                cells_.push_back({box, std::move(p)});
                return n;
            }
        }
        std::vector<Point> low, high;
        for (Point const& q : p) (q[axis] < split ? low : high).push_back(q);
        p = {};
        Box a = box, b = box;
        a.hi[axis] = b.lo[axis] = split;
        int const below = build(low, a, depth + 1), above = build(high, b, depth + 1);
        nodes_[index(n)] = {static_cast<int>(axis), split, below, above};
        return n;
    }
    /// Gauss' rule over a box, and what the corners say, where tails begin.
    struct Estimate {
        double inside = 0, corners = 0;
        int axis = 0;  // along which f changes more
    };
    template <class F>
    static Estimate rule(F const& f, Box const& c) {
        static constexpr double x[] = {0.1127016653792583, 0.5, 0.8872983346207417};
        static constexpr double w[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
        double const dh = c.hi[0] - c.lo[0], dt = c.hi[1] - c.lo[1], area = dh * dt * 4 * kPiD;
        auto const value = [&](double a, double b) {
            return static_cast<double>(f(at(c.lo[0] + a * dh, c.lo[1] + b * dt)));
        };
        Estimate e;
        double v[3][3], corner[2][2], change[2] = {0, 0};
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) e.inside += w[i] * w[k] * (v[i][k] = value(x[i], x[k])) * area;
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 2; ++k)
                e.corners += (corner[i][k] = value(i ? 1 - 1e-9 : 1e-9, k ? 1 - 1e-9 : 1e-9)) * area / 4;
        for (int k = 0; k < 3; ++k) {
            change[0] += std::abs(v[0][k] - v[1][k]) + std::abs(v[1][k] - v[2][k]);
            change[1] += std::abs(v[k][0] - v[k][1]) + std::abs(v[k][1] - v[k][2]);
        }
        for (int k = 0; k < 2; ++k) {
            change[0] += std::abs(corner[0][k] - corner[1][k]);
            change[1] += std::abs(corner[k][0] - corner[k][1]);
        }
        e.axis = change[0] == change[1] ? dt > dh : change[1] > change[0];
        return e;
    }
    template <class F>
    double refine(F const& f, Box const& c, Estimate const& whole, double tolerance, int depth,
                  std::span<Point> points) const {
        bool peak = false;
        double const area = (c.hi[0] - c.lo[0]) * (c.hi[1] - c.lo[1]);
        for (Point const& p : peaks_)
            peak |= area > 1e-7 && p[0] >= c.lo[0] && p[0] <= c.hi[0] && p[1] >= c.lo[1] && p[1] <= c.hi[1];
        bool const full = points.size() > few_;
        Point const middle{(c.lo[0] + c.hi[0]) / 2, (c.lo[1] + c.hi[1]) / 2};
        std::size_t axis = index(peak ? depth % 2 : whole.axis);
        if (full && !peak) {
            // Across the axis along which the samples are less even.
            std::ptrdiff_t off[2];
            for (std::size_t k = 0; k < 2; ++k)
                off[k] = std::abs(2 * std::count_if(points.begin(), points.end(),
                                                    [&](Point const& p) { return p[k] < middle[k]; }) -
                                  static_cast<std::ptrdiff_t>(points.size()));
            if (off[0] != off[1]) axis = off[1] > off[0];
        }
        Box a = c, b = c;
        a.hi[axis] = b.lo[axis] = middle[axis];
        Estimate const low = rule(f, a), high = rule(f, b);
        double const sum = low.inside + high.inside;
        bool const uneven = std::abs(whole.corners - whole.inside) > 0.2 * whole.inside + 4 * tolerance;
        // Samples where nothing is seen yet: a lobe narrower than the box.
        bool const unseen = sum * static_cast<double>(total_) < 0.02 * static_cast<double>(points.size());
        if (depth >= 40 ||
            (!full && !peak && !unseen && !uneven && std::abs(sum - whole.inside) <= tolerance))
            return sum;
        auto const cut =
            static_cast<std::size_t>(std::partition(points.begin(), points.end(),
                                                    [&](Point const& p) { return p[axis] < middle[axis]; }) -
                                     points.begin());
        return refine(f, a, low, tolerance, depth + 1, points.first(cut)) +
               refine(f, b, high, tolerance, depth + 1, points.subspan(cut));
    }

    std::size_t few_, least_ = 1, total_ = 1;
    std::vector<Point> peaks_;
    std::vector<Node> nodes_;
    std::vector<Cell> cells_;
};

// --- samples --------------------------------------------------------------------------------------------------------------
/// How a model is checked, and how exactly.
struct BsdfChecks {
    int n = samples(40'000, 1'000'000);  // samples of each outgoing direction
    std::size_t cells = 200;
    std::vector<Vec3> directions = outgoing();
    int family = 22;  // how many tests share alpha = 0.01, see sidak()
    HemisphereSampling how = HemisphereSampling::Cosine;
    float eta = 1;           // n below the surface / n above, as refraction and its reciprocity need it
    int lane = 0;            // whose energy is looked at
    double same = 1e-4;      // relative, between what sample() says and what pdf() and evaluate() say
    double within = 0.02;    // half-width of the sampled albedo
    double albedo = -1;      // albedo() is within this of the integral; below 0: not compared
    bool by_density = true;  // false: pdf() is not exactly the density of samples (stochastic layers)
    std::uint64_t seed = 1;
};

/// The directions where smooth parts of a boundary have their peaks.
inline std::vector<Vec3> peaks_of(Vec3 wo, float eta) {
    std::vector<Vec3> p{{-wo.x, -wo.y, wo.z}, -wo};
    Vec3 wt;
    if (eta != 1 && refract(wo, eta, wt)) p.push_back(wt);
    return p;
}

/// Chi square of draw(Random&) -> optional<Vec3> against density(Vec3); where nothing is drawn, 1 - the density's integral.
struct Drawn {
    ChiSquare chi;
    double nothing = 0, nothing_expected = 0;
};
template <class Draw, class Density>
Drawn chi_square_of(Draw const& draw, Density const& density, std::vector<Vec3> const& peaks, int n,
                    std::size_t cells, std::uint64_t seed, std::size_t few = 6) {
    Random pilot_numbers(seed + 7919), r(seed);
    std::vector<Vec3> pilot;
    for (std::size_t i = 0; i < 64 * cells; ++i)
        if (auto const w = draw(pilot_numbers)) pilot.push_back(*w);
    AdaptiveCells const tree(pilot, peaks, cells, few);
    std::vector<double> o(tree.size() + 1), e = tree.integrate(density, 1e-4 / static_cast<double>(cells));
    for (int i = 0; i < n; ++i) {
        auto const w = draw(r);
        ++(w ? o[tree.cell(*w)] : o.back());
    }
    double sum = 0;
    for (double& x : e) sum += x, x *= n;
    Drawn d;
    d.nothing = o.back();
    d.nothing_expected = std::max(0.0, 1 - sum) * n;
    // What is drawn next to never has no bin of its own: the quadrature's error would be all of it.
    if (d.nothing_expected < 5e-4 * n) {
        o.pop_back();
        d.chi = chi_square(o, e, false);
    } else {
        e.push_back(d.nothing_expected);
        d.chi = chi_square(o, e);
    }
    if (d.nothing > d.nothing_expected + 5 * std::sqrt(d.nothing_expected) + 5 + 5e-4 * n) d.chi.p = 0;
    return d;
}

/// Samples fall by the density, say what pdf() and evaluate() say, and are never where those are 0. Delta parts are counted
/// apart: as often as each says it is chosen.
inline void check_samples(Bsdf const& b, BsdfChecks const& c = {}) {
    double const level = sidak(2 * c.family);
    for (std::size_t k = 0; k < c.directions.size(); ++k) {
        Vec3 const wo = c.directions[k];
        INFO("wo = ", wo.x, " ", wo.y, " ", wo.z);
        std::array<double, 2> deltas{}, probability{};  // reflected and transmitted ones
        std::string wrong;
        int i = 0, drawn = 0;
        auto const say = [&](char const* what, BsdfSample const& s, double is, double should) {
            if (wrong.empty())
                wrong = std::string(what) + ": " + std::to_string(is) + ", not " + std::to_string(should) +
                        ", wi.z = " + std::to_string(s.wi.z);
        };
        auto const draw = [&](Random& r) -> std::optional<Vec3> {
            Mode const mode = ++i % 2 ? Mode::Radiance : Mode::Importance;
            float const uc = r.unit();
            auto const s = sample(b, wo, uc, random_square(r), mode, c.how);
            ++drawn;
            if (!s) return std::nullopt;
            auto const length2 = static_cast<double>(length_squared(s->wi));
            if (!(std::abs(length2 - 1) < 1e-5)) say("|wi|^2", *s, length2, 1);
            if (!(s->pdf > 0) || !std::isfinite(s->pdf)) say("pdf", *s, static_cast<double>(s->pdf), 1);
            if (!s->f.is_finite() || s->f[c.lane] < 0) say("f", *s, static_cast<double>(s->f[c.lane]), 1);
            if (s->transmitted == (s->wi.z * wo.z > 0))
                say("transmitted", *s, s->transmitted, !s->transmitted);
            if (s->transmitted && !traits(b).spreads_through && !s->delta) say("spreads_through", *s, 0, 1);
            if (s->delta) {
                ++deltas[s->transmitted];
                double& p = probability[s->transmitted];
                if (p != 0 && !near(p, static_cast<double>(s->pdf), c.same)) say("delta", *s, s->pdf, p);
                p = static_cast<double>(s->pdf);
                return std::nullopt;
            }
            auto const density = static_cast<double>(pdf(b, wo, s->wi, c.how));
            if (!(density > 0)) say("sample where pdf is", *s, density, static_cast<double>(s->pdf));
            if (!s->proportional) {
                auto const said = static_cast<double>(s->pdf);
                if (!near(said, density, c.same)) say("pdf", *s, said, density);
                Spectrum const f = evaluate(b, wo, s->wi, mode);
                for (int l = 0; l < 4; ++l)
                    if (!near(static_cast<double>(s->f[l]), static_cast<double>(f[l]), c.same))
                        say("f", *s, static_cast<double>(s->f[l]), static_cast<double>(f[l]));
            }
            return s->wi;
        };
        if (traits(b).delta) {
            Random r(c.seed + k);
            for (int j = 0; j < c.n; ++j) draw(r);
        } else if (!c.by_density) {
            Random r(c.seed + k);
            for (int j = 0; j < c.n; ++j) draw(r);
        } else {
            // Delta parts count among what is not drawn by the density.
            auto const density = [&](Vec3 wi) { return static_cast<double>(pdf(b, wo, wi, c.how)); };
            auto const d = chi_square_of(draw, density, peaks_of(wo, c.eta), c.n, c.cells, c.seed + k);
            INFO(d.chi, "; nothing drawn (deltas included): ", d.nothing, " of ", c.n, ", expected ",
                 d.nothing_expected);
            CHECK(d.chi.p >= level);
        }
        CHECK_MESSAGE(wrong.empty(), wrong);
        for (std::size_t t = 0; t < 2; ++t) {
            double const e = probability[t] * drawn;
            double const spread = std::sqrt(std::max(e * (1 - probability[t]), 0.0));
            INFO("deltas ", t, ": ", deltas[t], ", expected ", e);
            CHECK(std::abs(deltas[t] - e) <= 5 * spread + 1e-4 * e + 1);
        }
    }
    // Extreme numbers, and directions within the surface.
    std::vector<Vec3> all = c.directions;
    for (Vec3 const w : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 1e-30f}, Vec3{0.6f, 0.8f, -1e-12f}})
        all.push_back(w);
    int bad = 0;
    for (Vec3 const wo : all)
        for (float const uc : kExtremes)
            for (float const x : kExtremes)
                for (float const y : kExtremes)
                    for (auto const mode : {Mode::Radiance, Mode::Importance}) {
                        auto const s = sample(b, wo, uc, {x, y}, mode, c.how);
                        if (!s) continue;
                        bool const good = s->pdf > 0 && std::isfinite(s->pdf) && s->f.is_finite() &&
                                          std::abs(length(s->wi) - 1) < 1e-5f && s->wi.z != 0;
                        if (!good && bad++ == 0)
                            MESSAGE("bad: wo.z = ", wo.z, ", uc = ", uc, ", u = ", x, " ", y,
                                    ": pdf = ", s->pdf, ", wi = ", s->wi.x, " ", s->wi.y, " ", s->wi.z,
                                    ", f = ", s->f[0]);
                    }
    CHECK(bad == 0);
    for (Vec3 const wo : all)
        for (Vec3 const wi : all) {
            float const d = pdf(b, wo, wi, c.how);
            bad += !(d >= 0) || !std::isfinite(d) || !evaluate(b, wo, wi, Mode::Radiance).is_finite();
        }
    CHECK(bad == 0);
}

/// A density is the Jacobian of its warp: density(w) |dw/du x dw/dv| = 1 by central differences, extrapolated (Richardson), at
/// the steps where two extrapolations agree best: wide ones suffer from curvature, narrow ones from rounding. Where none agree
/// the warp has a crease; that may not be in more than half of all places. Floats resolve it for lobes of alpha >= 0.03 or so.
template <class Warp, class Density>
void check_jacobian(Warp const& warp, Density const& density, double within = 1e-3, int n = 300,
                    std::uint64_t seed = 2) {
    Random r(seed);
    int looked = 0, drawn = 0;
    double worst = 0;
    for (int i = 0; i < n; ++i) {
        Vec2 const u{0.15f + 0.7f * r.unit(), 0.15f + 0.7f * r.unit()};
        auto const element = [&](float h) -> double {
            std::optional<Vec3> const a = warp(u + Vec2{h, 0}), b = warp(u - Vec2{h, 0});
            std::optional<Vec3> const d = warp(u + Vec2{0, h}), e = warp(u - Vec2{0, h});
            if (!a || !b || !d || !e) return -1;
            return static_cast<double>(length(cross(*a - *b, *d - *e))) / (4.0 * static_cast<double>(h * h));
        };
        std::optional<Vec3> const w = warp(u);
        if (!w) continue;
        double best = 1e9, value = 0, before = -1;
        bool missing = false;
        for (int k = 4; k < 9 && !missing; ++k) {
            double const coarse = element(std::ldexp(1.0f, -k)), fine = element(std::ldexp(1.0f, -k - 1));
            missing = coarse < 0 || fine < 0;
            double const extrapolated = (4 * fine - coarse) / 3;
            if (k > 4 && std::abs(extrapolated / before - 1) < best) {
                best = std::abs(extrapolated / before - 1);
                value = extrapolated;
            }
            before = extrapolated;
        }
        if (missing) continue;
        ++drawn;
        if (best > within) continue;
        ++looked;
        worst = std::max(worst, std::abs(static_cast<double>(density(*w)) * value - 1));
    }
    INFO("worst ", worst, " in ", looked, " of ", drawn);
    CHECK(2 * looked >= drawn);
    CHECK(looked > 0);
    CHECK(worst <= within);
}

/// f(o, i) = f(i, o); through a boundary f(i -> o) / n_o^2 = f(o -> i) / n_i^2 (Veach 1997, eq. 5.14); and importance is the
/// adjoint of radiance. Pairs of random directions, and pairs that `sample` finds, so that narrow lobes are seen.
inline void check_reciprocity(Bsdf const& b, BsdfChecks const& c = {}, double within = 1e-5, int n = 2000) {
    Random r(c.seed + 3);
    double reflected = 0, transmitted = 0, adjoint = 0;
    int lit = 0;
    for (int i = 0; i < n; ++i) {
        Vec3 const wo = random_direction(r);
        Vec3 wi = random_direction(r);
        if (i % 2) {
            auto const s = sample(b, wo, r.unit(), random_square(r), Mode::Radiance, c.how);
            if (!s || s->delta) continue;
            wi = s->wi;
        }
        double const there =
            wo.z * wi.z > 0 ? 1 : (wo.z > 0 ? 1 : static_cast<double>(c.eta));  // n on wo's side
        double const back = wo.z * wi.z > 0 ? 1 : (wi.z > 0 ? 1 : static_cast<double>(c.eta));
        for (int l = 0; l < 4; ++l) {
            auto const f = static_cast<double>(evaluate(b, wo, wi, Mode::Radiance)[l]);
            auto const g = static_cast<double>(evaluate(b, wi, wo, Mode::Radiance)[l]);
            auto const h = static_cast<double>(evaluate(b, wo, wi, Mode::Importance)[l]);
            lit += f > 0;
            auto const off = [](double x, double y) {
                double const most = std::max(std::abs(x), std::abs(y));
                return most > 1e-30 ? std::abs(x - y) / most : 0.0;
            };
            double& worst = wo.z * wi.z > 0 ? reflected : transmitted;
            worst = std::max(worst, off(f / (there * there), g / (back * back)));
            adjoint = std::max(adjoint, off(h, g));
        }
    }
    CHECK(lit > 0);
    CHECK(reflected <= within);
    CHECK(transmitted <= within);
    CHECK(adjoint <= within);
}

// --- energy ---------------------------------------------------------------------------------------------------------------
/// What part of the light from wo is scattered, once by quadrature of f |cos| (without delta parts) and once by samples.
struct Albedo {
    double quadrature = 0, delta = 0;
    Mean sampled;  // without delta parts
    [[nodiscard]] double total() const { return quadrature + delta; }
};
inline Albedo directional_albedo(Bsdf const& b, Vec3 wo, BsdfChecks const& c, int n) {
    Albedo a;
    Random r(c.seed + 5);
    std::vector<Vec3> pilot;
    std::array<double, 2> deltas{};
    for (int i = 0; i < n; ++i) {
        // Power: importance is not squeezed by refraction.
        float const uc = r.unit();
        auto const s = sample(b, wo, uc, random_square(r), Mode::Importance, c.how);
        if (s && !s->delta && pilot.size() < 64 * c.cells) pilot.push_back(s->wi);
        if (s && s->delta) deltas[s->transmitted] = throughput(*s, c.lane) * static_cast<double>(s->pdf);
        a.sampled.add(s && !s->delta ? throughput(*s, c.lane) : 0);
    }
    a.delta = deltas[0] + deltas[1];
    AdaptiveCells const cells(pilot, peaks_of(wo, c.eta), c.cells);
    for (double const x : cells.integrate(
             [&](Vec3 wi) {
                 return static_cast<double>(evaluate(b, wo, wi, Mode::Importance)[c.lane]) *
                        std::abs(static_cast<double>(wi.z));
             },
             1e-6))
        a.quadrature += x;
    return a;
}

/// No more light than came in; samples and quadrature agree on how much, and so does albedo() where that is promised.
inline void check_energy(Bsdf const& b, BsdfChecks const& c = {}) {
    for (Vec3 const wo : c.directions) {
        auto const a = directional_albedo(b, wo, c, c.n);
        INFO("wo.z = ", wo.z, ": quadrature ", a.quadrature, ", delta ", a.delta, ", sampled ",
             a.sampled.mean());
        CHECK(a.total() <= 1 + 1e-4);
        // With the few samples that sanitizers get, neither the cells nor the mean are fine enough to be compared.
        if (a.quadrature > 1e-3 && kSanitizerShare == 1) {
            // What the quadrature is off (at edges and in far tails) is not held against the samples.
            double const off =
                std::max(0.0, std::abs(a.sampled.mean() - a.quadrature) - 1.5e-3 * a.quadrature);
            double const p =
                off == 0 ? 1 : student_p(off / a.sampled.standard_error(), static_cast<double>(c.n - 1));
            INFO("p = ", p, ", half-width ", a.sampled.half_width());
            CHECK(p >= sidak(c.family));
            CHECK(a.sampled.half_width() <= c.within * a.quadrature);
        }
        if (c.albedo >= 0)
            CHECK(std::abs(static_cast<double>(albedo(b, wo)[c.lane]) - a.total()) <= c.albedo);
    }
}

}  // namespace nephroid::test
