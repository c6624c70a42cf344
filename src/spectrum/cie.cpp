#include "cie.h"

#include "spectrum/named.h"

namespace nephroid {

namespace {
Dense dense_of(char const* name) {
    Dense d;
    auto const table = *named_spectrum(name);
    for (int i = 0; i < kDenseCount; ++i)
        d[static_cast<std::size_t>(i)] = interpolate(table, kLambdaMin + static_cast<float>(i));
    return d;
}
}  // namespace

Dense const& illuminant_d65() {
    static Dense const d65 = dense_of("stdillum-D65");
    return d65;
}

Dense const& illuminant(RgbWhite white) {
    static Dense const d60 = dense_of("illum-acesD60");
    return white == RgbWhite::D65 ? illuminant_d65() : d60;
}

}  // namespace nephroid
