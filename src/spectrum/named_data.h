// Tables of named spectra, as they are stored.
#pragma once

#include <span>
#include <string_view>

namespace nephroid {

struct NamedData {
    std::string_view name;
    std::span<double const> pairs;  // wavelength, value, …
};
std::span<NamedData const> metals_data();
std::span<NamedData const> glasses_data();
std::span<NamedData const> illuminants_data();

}  // namespace nephroid
