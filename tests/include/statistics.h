// Statistics that tests share: p-values, intervals, and the rule that says when a mean may be accepted.
//
// A family of m tests shares alpha = 0.01: each is held at sidak(m). A mean is accepted only when its 99% interval holds the
// expected value *and* is narrower than a given share of it; a wider one is inconclusive, which counts as a failure. Feed
// batches (independent scrambles, say) rather than samples where samples are not independent.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace nephroid::test {

/// Longer runs are asked for (environment variable NEPHROID_FULL).
inline bool full() { return std::getenv("NEPHROID_FULL") != nullptr; }
/// Sanitizers look for faults of memory and arithmetic, not of chance, and take ten times as long.
#ifdef __SANITIZE_ADDRESS__
inline constexpr int kSanitizerShare = 5;
inline constexpr double kSanitizerRoom =
    3;  // for intervals, which grow with the root of that and by what luck there is
#else
inline constexpr int kSanitizerShare = 1;
inline constexpr double kSanitizerRoom = 1;
#endif
inline constexpr double kPiD = 3.14159265358979323846;

/// The number of samples of a test: `quick` by default.
inline int samples(int quick, int when_full) {
    return full() ? when_full : std::max(1, quick / kSanitizerShare);
}

/// A stream of numbers of the tests' own, so that they do not lean on what they test (SplitMix64).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 0x1234567ull) {}
    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// Uniform in [0, 1), never rounded up to 1.
    float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
    double uniform(double a, double b) { return a + (b - a) * uniform(); }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(uniform() * n); }

  private:
    std::uint64_t state_;
};

// --- special functions --------------------------------------------------------------------------------------------------
/// Regularised upper incomplete gamma function Q(a, x): series below a + 1, Lentz' continued fraction above.
inline double gamma_q(double a, double x) {
    if (!(x > 0)) return 1;
    double const front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a;
        double sum = term;
        for (int n = 1; n < 100000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
        return std::clamp(1 - sum * front, 0.0, 1.0);
    }
    double b = x + 1 - a;
    double c = 1e300;
    double d = 1 / b;
    double h = d;
    for (int n = 1; n < 100000; ++n) {
        double const an = -n * (n - a);
        b += 2;
        d = an * d + b;
        if (std::abs(d) < 1e-300) d = 1e-300;
        c = b + an / c;
        if (std::abs(c) < 1e-300) c = 1e-300;
        d = 1 / d;
        double const delta = d * c;
        h *= delta;
        if (std::abs(delta - 1) < 1e-15) break;
    }
    return std::clamp(front * h, 0.0, 1.0);
}

/// Regularised incomplete beta function I_x(a, b).
inline double beta_i(double a, double b, double x) {
    if (!(x > 0)) return 0;
    if (!(x < 1)) return 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - beta_i(b, a, 1 - x);
    double const front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) +
                                  b * std::log1p(-x)) /
                         a;
    auto const nonzero = [](double v) { return std::abs(v) < 1e-300 ? 1e-300 : v; };
    double c = 1;
    double d = 1 / nonzero(1 - (a + b) * x / (a + 1));
    double h = d;
    for (int m = 1; m < 10000; ++m) {
        double const even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / nonzero(1 + even * d);
        c = nonzero(1 + even / c);
        h *= d * c;
        double const odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / nonzero(1 + odd * d);
        c = nonzero(1 + odd / c);
        h *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return front * h;
}

/// P(|X| >= |t|) of Student's t with `dof` degrees of freedom; the normal law from a million on.
inline double student_p(double t, double dof) {
    if (!std::isfinite(t)) return 0;
    if (dof > 1e6) return std::erfc(std::abs(t) / std::sqrt(2.0));
    return beta_i(dof / 2, 0.5, dof / (dof + t * t));
}
/// The t that |X| exceeds with probability alpha.
inline double student_quantile(double alpha, double dof) {
    double lo = 0;
    double hi = 1;
    while (student_p(hi, dof) > alpha && hi < 1e9) hi *= 2;
    for (int i = 0; i < 100; ++i) {
        double const mid = (lo + hi) / 2;
        (student_p(mid, dof) > alpha ? lo : hi) = mid;
    }
    return (lo + hi) / 2;
}

/// What one of m tests may use of the family's alpha.
inline double sidak(int m, double alpha = 0.01) { return -std::expm1(std::log1p(-alpha) / m); }

// --- chi square -----------------------------------------------------------------------------------------------------------
struct ChiSquare {
    double statistic = 0;
    int dof = 0;
    double p = 0;             // 0 when something fell where nothing may
    bool impossible = false;  // a count where 0 was expected
};
inline std::ostream& operator<<(std::ostream& o, ChiSquare const& c) {
    return o << "chi2 = " << c.statistic << ", dof = " << c.dof << ", p = " << c.p
             << (c.impossible ? ", counts where none may be" : "");
}

/// Pearson's test of counts against expectations. Bins that expect fewer than `least` are pooled, the smallest first.
/// `fixed_total`: the expectations were scaled to the number of samples, which costs a degree of freedom.
inline ChiSquare chi_square(std::span<double const> observed, std::span<double const> expected,
                            bool fixed_total = true, double least = 5) {
    ChiSquare r;
    std::vector<std::size_t> order(expected.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return expected[a] < expected[b]; });
    double pooled_o = 0;
    double pooled_e = 0;
    int bins = 0;
    auto const add = [&](double o, double e) { r.statistic += (o - e) * (o - e) / e, ++bins; };
    for (std::size_t const i : order) {
        if (!(expected[i] > 0)) {
            if (observed[i] > 0) r.impossible = true;
            continue;
        }
        if (pooled_e < least && (expected[i] < least || pooled_e > 0)) {
            pooled_o += observed[i];
            pooled_e += expected[i];
            if (pooled_e >= least) add(pooled_o, pooled_e), pooled_o = pooled_e = 0;
            continue;
        }
        add(observed[i], expected[i]);
    }
    if (pooled_e > 0) add(pooled_o, pooled_e);
    r.dof = bins - (fixed_total ? 1 : 0);
    // With one bin there is nothing to compare: the caller's bins are wrong, and that must be seen.
    r.p = r.impossible || r.dof < 1 ? 0 : gamma_q(r.dof / 2.0, r.statistic / 2);
    return r;
}

// --- Kolmogorov and Smirnov ---------------------------------------------------------------------------------------------
/// p-value of the hypothesis that the values are uniform over [0, 1] (Stephens' approximation, good from n = 5).
inline double ks_uniform(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    auto const n = static_cast<double>(values.size());
    double d = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        auto const k = static_cast<double>(i);
        d = std::max({d, values[i] - k / n, (k + 1) / n - values[i]});
    }
    double const x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * d;
    if (x < 0.2) return 1;
    double sum = 0;
    for (int k = 1; k <= 100; ++k) sum += (k % 2 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
    return std::clamp(sum, 0.0, 1.0);
}

// --- means ------------------------------------------------------------------------------------------------------------------
/// Independent observations of one quantity (samples, or means of batches), by Welford's update.
class Mean {
  public:
    void add(double x) {
        ++n_;
        double const delta = x - mean_;
        mean_ += delta / static_cast<double>(n_);
        m2_ += delta * (x - mean_);
    }
    [[nodiscard]] std::int64_t count() const { return n_; }
    [[nodiscard]] double mean() const { return mean_; }
    [[nodiscard]] double variance() const { return n_ > 1 ? m2_ / static_cast<double>(n_ - 1) : 0; }
    /// Of the mean.
    [[nodiscard]] double standard_error() const { return std::sqrt(variance() / static_cast<double>(n_)); }
    /// Half of the interval that holds the true mean with probability 1 - alpha.
    [[nodiscard]] double half_width(double alpha = 0.01) const {
        if (n_ < 2) return std::numeric_limits<double>::infinity();
        return student_quantile(alpha, static_cast<double>(n_ - 1)) * standard_error();
    }
    /// p-value of the hypothesis that the true mean is `expected`. What float rounding may hide (1e-6) is not held against it.
    [[nodiscard]] double p(double expected) const {
        if (n_ < 2) return 0;
        double const slack = 1e-6 * std::abs(expected);
        double const off = std::max(0.0, std::abs(mean_ - expected) - slack);
        if (off == 0) return 1;
        return student_p(off / standard_error(), static_cast<double>(n_ - 1));
    }

  private:
    std::int64_t n_ = 0;
    double mean_ = 0, m2_ = 0;
};

/// A mean held against what it should be. Converts to true only when it agrees and the test had the power to say so.
struct Agreement {
    double mean = 0, expected = 0, half_width = 0, p = 0;
    bool powerful = false, equal = false;
    explicit operator bool() const { return powerful && equal; }
};
inline std::ostream& operator<<(std::ostream& o, Agreement const& a) {
    return o << a.mean << " +- " << a.half_width << ", expected " << a.expected << ", p = " << a.p
             << (!a.equal      ? ": DIFFERENT"
                 : !a.powerful ? ": INCONCLUSIVE"
                               : "");
}

/// `within`: the greatest half-width of the 99% interval, as a share of |expected| (of `unit` where expected is 0).
/// `alpha`: of this test, see sidak().
inline Agreement agrees(Mean const& m, double expected, double within = 0.005, double alpha = 0.01,
                        double unit = 1) {
    Agreement a;
    a.mean = m.mean();
    a.expected = expected;
    a.half_width = m.half_width(0.01);
    a.p = m.p(expected);
    // Under sanitizers there are fewer samples, and other errors to look for.
    double const room = kSanitizerShare > 1 ? 4 : 1;
    a.powerful = a.half_width <= room * within * (expected != 0 ? std::abs(expected) : unit);
    a.equal = a.p >= alpha;
    return a;
}

}  // namespace nephroid::test
