#include "spectrum/wavelengths.h"

namespace nephroid {

WavelengthTable::WavelengthTable() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        // In double, so that neighbours differ by what they should.
        double const t = 0.85691062 - 1.82750197 * static_cast<double>(i) / kCells;
        nodes_[i].lambda = static_cast<float>(538.0 - 138.888889 * std::atanh(t));
        nodes_[i].slope = static_cast<float>(138.888889 * 1.82750197 / (1.0 - t * t) / kCells);
    }
}

WavelengthTable const kWavelengthTable;

}  // namespace nephroid
