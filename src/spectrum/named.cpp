#include "spectrum/named.h"

#include "named_data.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

struct Glass {
    std::string_view name;
    Sellmeier formula;
};
// Schott, Zemax catalog of 2017-01-20, by refractiveindex.info (CC0).
constexpr Glass kGlasses[] = {
    {"glass-N-BK7", {1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653}},
    {"glass-N-SF11", {1.73759695, 0.013188707, 0.313747346, 0.0623068142, 1.89878101, 155.23629}},
    {"glass-N-SF10", {1.62153902, 0.0122241457, 0.256287842, 0.0595736775, 1.64447552, 147.468793}},
    {"glass-F2", {1.34533359, 0.00997743871, 0.209073176, 0.0470450767, 0.937357162, 111.886764}},
};

/// Names under which the same data are known.
constexpr std::pair<std::string_view, std::string_view> kAliases[] = {
    {"glass-SF5", "glass-F5"}, {"glass-SF10", "glass-F10"}, {"glass-SF11", "glass-F11"}};

std::optional<NamedData> find(std::string_view name) {
    for (auto const& [alias, original] : kAliases)
        if (name == alias) name = original;
    for (auto const list : {metals_data(), glasses_data(), illuminants_data()})
        for (NamedData const& d : list)
            if (d.name == name) return d;
    return std::nullopt;
}

}  // namespace

double Sellmeier::index(double lambda_nm) const {
    double const l2 = lambda_nm * lambda_nm * 1e-6;
    return std::sqrt(1 + b1 * l2 / (l2 - c1) + b2 * l2 / (l2 - c2) + b3 * l2 / (l2 - c3));
}

double Cauchy::index(double lambda_nm) const {
    double const l2 = lambda_nm * lambda_nm * 1e-6;
    return a + b / l2 + c / (l2 * l2);
}

namespace {
template <class Formula>
std::optional<TabulatedSpd> each_nm(Formula const& formula) {
    TabulatedSpd t;
    for (float l = kLambdaMin; l <= kLambdaMax; l += 1.0f) {
        double const n = formula.index(static_cast<double>(l));
        if (!(n > 0) || !std::isfinite(n)) return std::nullopt;
        t.lambda.push_back(l);
        t.value.push_back(static_cast<float>(n));
    }
    return t;
}
}  // namespace

std::optional<TabulatedSpd> tabulated(Sellmeier const& formula) { return each_nm(formula); }
std::optional<TabulatedSpd> tabulated(Cauchy const& formula) { return each_nm(formula); }

std::optional<Sellmeier> sellmeier_glass(std::string_view name) {
    for (Glass const& g : kGlasses)
        if (g.name == name) return g.formula;
    return std::nullopt;
}

std::vector<std::string> const& named_spectrum_names() {
    static std::vector<std::string> const names = [] {
        std::vector<std::string> n;
        for (auto const list : {metals_data(), glasses_data(), illuminants_data()})
            for (NamedData const& d : list) n.emplace_back(d.name);
        for (Glass const& g : kGlasses) n.emplace_back(g.name);
        for (auto const& [alias, original] : kAliases) n.emplace_back(alias);
        std::sort(n.begin(), n.end());
        return n;
    }();
    return names;
}

bool is_named_spectrum(std::string_view name) { return sellmeier_glass(name) || find(name); }

std::optional<TabulatedSpd> named_spectrum(std::string_view name) {
    if (auto const glass = sellmeier_glass(name)) return tabulated(*glass);
    auto const data = find(name);
    if (!data) return std::nullopt;
    TabulatedSpd t;
    for (std::size_t i = 0; i + 1 < data->pairs.size(); i += 2) {
        t.lambda.push_back(static_cast<float>(data->pairs[i]));
        t.value.push_back(static_cast<float>(data->pairs[i + 1]));
    }
    if (t.lambda.front() > kLambdaMin) {
        t.lambda.insert(t.lambda.begin(), kLambdaMin - 1);
        t.value.insert(t.value.begin(), t.value.front());
    }
    if (t.lambda.back() < kLambdaMax) {
        t.lambda.push_back(kLambdaMax + 1);
        t.value.push_back(t.value.back());
    }
    return t;
}

double interpolate(TabulatedSpd const& t, double lambda) {
    if (t.lambda.empty() || lambda < static_cast<double>(t.lambda.front()) ||
        lambda > static_cast<double>(t.lambda.back()))
        return 0;
    auto const it = std::upper_bound(t.lambda.begin(), t.lambda.end(), static_cast<float>(lambda));
    if (it == t.lambda.end()) return static_cast<double>(t.value.back());
    auto const i = static_cast<std::size_t>(it - t.lambda.begin());
    double const l0 = static_cast<double>(t.lambda[i - 1]);
    double const l1 = static_cast<double>(t.lambda[i]);
    double const a = (lambda - l0) / (l1 - l0);
    return (1 - a) * static_cast<double>(t.value[i - 1]) + a * static_cast<double>(t.value[i]);
}

}  // namespace nephroid
