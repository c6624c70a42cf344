#include "dense.h"
#include "spectrum/color.h"

namespace nephroid {

namespace {

Dense values(Spd const& spd) {
    if (auto const* s = std::get_if<RgbIlluminantSpd>(&spd)) return illuminant(s->white);
    if (!std::holds_alternative<RgbAlbedoSpd>(spd) && !std::holds_alternative<RgbUnboundedSpd>(spd))
        return dense_values(spd);
    SpectrumStore store;
    auto const sigmoid = store.compile(spd, SpectrumRole::Unbounded);
    Dense d;
    for (std::size_t i = 0; i < d.size(); ++i)
        d[i] = static_cast<double>(sigmoid.at(kLambdaMin + static_cast<float>(i)));
    return d;
}

}  // namespace

double photometric(Spd const& spd) {
    Dense const v = values(spd);
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += cie_1931().y[i] * v[i];
    return sum;
}

}  // namespace nephroid
