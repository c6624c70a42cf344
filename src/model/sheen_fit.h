// The formulas of Conty Estevez & Kulla 2017 (see model/sheen.h), for the lobe and for the tool that
// tabulates its albedo.
#pragma once

#include <algorithm>
#include <cmath>

namespace nephroid {

/// The fit's L(x), its coefficients between those of a = 1 and a = 0 (section 2.2, table 1).
template <class T>
T sheen_fit(T x, T alpha) {
    T const t = (1 - alpha) * (1 - alpha);
    auto const between = [t](double rough, double sharp) { return T(rough) + (T(sharp) - T(rough)) * t; };
    T const a = between(21.5473, 25.3245), b = between(3.82987, 3.32435), c = between(0.19823, 0.16801);
    T const d = between(-1.97760, -1.27393), e = between(-4.32054, -4.85967);
    return a / (1 + b * std::pow(x, c)) + d * x + e;
}
/// Smith's Lambda of a direction of cosine mu.
template <class T>
T sheen_lambda(T mu, T alpha) {
    mu = std::clamp(mu, T(0), T(1));
    return mu < T(0.5) ? std::exp(sheen_fit(mu, alpha))
                       : std::exp(2 * sheen_fit(T(0.5), alpha) - sheen_fit(1 - mu, alpha));
}
/// D of the half vector, by the squared sine of its angle.
template <class T>
T sheen_density(T sin2, T alpha) {
    return (2 + 1 / alpha) * std::pow(std::clamp(sin2, T(0), T(1)), T(0.5) / alpha) *
           T(0.15915494309189535);  // 1 / 2 pi
}

}  // namespace nephroid
