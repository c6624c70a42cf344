#include "dense.h"

#include "math/error.h"
#include "spectrum/named.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nephroid {

namespace {

void check(TabulatedSpd const& t) {
    if (t.lambda.empty() || t.lambda.size() != t.value.size())
        refuse_spectrum("a spectrum needs pairs of wavelength and value");
    for (std::size_t i = 0; i < t.lambda.size(); ++i) {
        if (!std::isfinite(t.lambda[i]) || !std::isfinite(t.value[i]))
            refuse_spectrum("a spectrum holds a number that is not finite");
        if (i > 0 && !(t.lambda[i] > t.lambda[i - 1]))
            refuse_spectrum("the wavelengths of a spectrum must increase");
    }
}

Dense point_samples(TabulatedSpd const& t) {
    Dense d;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = interpolate(t, 360.0 + static_cast<double>(i));
    return d;
}

/// Means under a hat of 1 nm to either side, so that a line narrower than the grid keeps its energy.
Dense hat_means(TabulatedSpd const& t) {
    Dense d{};
    for (std::size_t k = 1; k < t.lambda.size(); ++k) {
        double const l0 = static_cast<double>(t.lambda[k - 1]), l1 = static_cast<double>(t.lambda[k]);
        double const v0 = static_cast<double>(t.value[k - 1]), v1 = static_cast<double>(t.value[k]);
        auto const value = [&](double l) { return v0 + (v1 - v0) * (l - l0) / (l1 - l0); };
        double const end = std::min(l1, 830.0);
        for (double a = std::max(l0, 360.0); a < end;) {
            double const cell = std::floor(a);
            double const b = std::min(cell + 1, end);
            double const m = (a + b) / 2;
            // Simpson's rule is exact for the product of two lines.
            double const all = (b - a) / 6 * (value(a) + 4 * value(m) + value(b));
            double const right =
                (b - a) / 6 * (value(a) * (a - cell) + 4 * value(m) * (m - cell) + value(b) * (b - cell));
            auto const i = static_cast<std::size_t>(cell) - 360;
            d[i] += all - right;
            d[i + 1] += right;
            a = b;
        }
    }
    d.front() *= 2, d.back() *= 2;  // only half of their hats is within
    return d;
}

Dense of(ConstantSpd const& s) {
    if (!std::isfinite(s.value)) refuse_spectrum("a spectrum is not a finite number");
    Dense d;
    d.fill(static_cast<double>(s.value));
    return d;
}

Dense of(TabulatedSpd const& s) {
    check(s);
    bool fine = false;
    for (std::size_t i = 1; i < s.lambda.size(); ++i) fine |= s.lambda[i] - s.lambda[i - 1] < 1.0f;
    return fine ? hat_means(s) : point_samples(s);
}

/// Planck's law over its maximum, where all constants cancel but c2 = h c / k.
Dense of(BlackbodySpd const& s) {
    if (!(s.kelvin > 0) || !std::isfinite(s.kelvin))
        refuse_spectrum("a black body's temperature must be above 0 kelvin");
    constexpr double c2 = 1.438776877e7;        // nm K (CODATA 2018)
    constexpr double wien = 4.965114231744276;  // c2 / (lambda T) at the maximum
    double const t = static_cast<double>(s.kelvin);
    Dense d;
    for (std::size_t i = 0; i < d.size(); ++i) {
        double const x = c2 / ((360.0 + static_cast<double>(i)) * t);
        d[i] = std::pow(x / wien, 5) * (std::expm1(wien) / std::expm1(x));
    }
    return d;
}

Dense of(NamedSpd const& s) {
    auto const table = named_spectrum(s.name);
    if (!table) refuse_spectrum("unknown spectrum \"" + s.name + "\"");
    return point_samples(*table);
}

template <class Rgb>
Dense of(Rgb const&) {
    assert(!"an rgb triple has no table");
    return {};
}

}  // namespace

void refuse_spectrum(std::string const& message) { throw Error(ErrorKind::Input, message); }

Dense dense_values(Spd const& spd) {
    return std::visit([](auto const& s) { return of(s); }, spd);
}

}  // namespace nephroid
