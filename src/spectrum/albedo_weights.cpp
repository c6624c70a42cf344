#include "spectrum/albedo_weights.h"

#include "cie.h"
#include "spectrum/color.h"

#include <algorithm>
#include <utility>

namespace nephroid {

std::vector<Vec3> albedo_to_srgb_weights(std::span<float const> wavelengths) {
    Observer const& o = cie_1931();
    Dense const& light = illuminant_d65();
    double white = 0;
    for (std::size_t i = 0; i < kDenseCount; ++i) white += light[i] * o.y[i];
    std::vector<std::array<double, 3>> xyz(wavelengths.size(), {0, 0, 0});
    for (std::size_t i = 0; i < kDenseCount; ++i) {
        float const lambda = kLambdaMin + static_cast<float>(i);
        auto const above = static_cast<std::size_t>(
            std::upper_bound(wavelengths.begin(), wavelengths.end(), lambda) - wavelengths.begin());
        std::size_t const next = std::min(above, wavelengths.size() - 1);
        std::size_t const last = above > 0 ? above - 1 : 0;
        double const t =
            next == last
                ? 0
                : static_cast<double>((lambda - wavelengths[last]) / (wavelengths[next] - wavelengths[last]));
        double const share = light[i] / white;
        for (auto const& [node, weight] : {std::pair{last, 1 - t}, std::pair{next, t}}) {
            xyz[node][0] += weight * share * o.x[i];
            xyz[node][1] += weight * share * o.y[i];
            xyz[node][2] += weight * share * o.z[i];
        }
    }
    std::vector<Vec3> rgb;
    for (auto const& c : xyz)
        rgb.push_back(
            xyz_to_srgb({static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])}));
    return rgb;
}

}  // namespace nephroid
