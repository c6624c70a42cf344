// Named spectra: metals (metal-Ag-eta, metal-Ag-k …), glasses (glass-BK7 …; glass-N-BK7, glass-N-SF11, glass-N-SF10 and
// glass-F2 by Sellmeier's formula) and illuminants (stdillum-D65 …).
#pragma once

#include "spectrum/spd.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

std::vector<std::string> const& named_spectrum_names();
bool is_named_spectrum(std::string_view name);
/// Tabulated, and continued constantly to the ends of the visible range where the measurement stops (pbrt-v4). Sellmeier
/// glasses are tabulated at each nm.
std::optional<TabulatedSpd> named_spectrum(std::string_view name);

/// Sellmeier's formula, n^2 = 1 + sum B_i l^2 / (l^2 - C_i), l in micrometres, C in um^2.
struct Sellmeier {
    double b1, c1, b2, c2, b3, c3;
    [[nodiscard]] double index(double lambda_nm) const;
};
/// Cauchy's formula, n = a + b / l^2 + c / l^4, l in micrometres.
struct Cauchy {
    double a, b, c;
    [[nodiscard]] double index(double lambda_nm) const;
};
/// At each nm of the visible range; nothing where the formula gives no index there.
std::optional<TabulatedSpd> tabulated(Sellmeier const& formula);
std::optional<TabulatedSpd> tabulated(Cauchy const& formula);
std::optional<Sellmeier> sellmeier_glass(std::string_view name);

/// Piecewise linear value; 0 outside the table.
double interpolate(TabulatedSpd const& table, double lambda);

}  // namespace nephroid
