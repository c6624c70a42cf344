#include "cie.h"

#include "spectrum/named.h"

namespace nephroid {

Dense const& illuminant_d65() {
    static Dense const d65 = [] {
        Dense d;
        auto const table = *named_spectrum("stdillum-D65");
        for (int i = 0; i < kDenseCount; ++i)
            d[static_cast<std::size_t>(i)] = interpolate(table, kLambdaMin + static_cast<float>(i));
        return d;
    }();
    return d65;
}

}  // namespace nephroid
