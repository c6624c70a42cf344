// How the error of progressive photon mapping falls with the passes (Knaus & Zwicker 2011).
#include "patch.h"
#include "sections.h"

#include "plot.h"

#include <fmt/format.h>

namespace nephroid::experiment {

void progressive_passes(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The same floor below a mirror so large that all of it lies in the mirrored light. Each pass "
        "shoots new photons and has a smaller radius; α says how fast it shrinks: with 1 it stays. The "
        "variance of the mean falls as N to the power of −α, the square of the bias as N to that of 2α − "
        "2: where noise is what is left, the error has the slope −α/2.");
    std::string const format =
        "Integrator \"sppm\" \"string visualize\" \"caustic\" \"integer photonsperiteration\" 1 \"integer "
        "causticphotons\" {} \"float radius\" 0.2 \"float alpha\" {}\nSampler \"independent\"";
    int const paths = lab.quick ? 200 : 1000;
    page.code(fmt::format(fmt::runtime(format), paths, "0.5|0.667|0.9|1"));
    int const n = lab.pixels(24);
    Setup const setup = patch_setup(kLargeMirror, n);
    Reference const reference = patch_reference(kLargeMirror, setup);
    std::vector<int> counts{1, 4, 16, 64, 256};
    if (!lab.quick) counts.push_back(1024);
    std::vector<double> const x(counts.begin(), counts.end());
    std::vector<Line> lines;
    std::vector<std::vector<std::string>> rows;
    for (double const alpha : {0.5, 2.0 / 3, 0.9, 1.0}) {
        auto const e = rmse_over_samples(setup, fmt::format(fmt::runtime(format), paths, alpha), counts,
                                         lab.seeds(4), reference.picture);
        std::string const slope = fixed(log_log_slope(x, e), 3);
        lines.push_back({"α = " + number(alpha), x, e, "slope " + slope});
        std::vector<std::string> row{number(alpha), fixed(-alpha / 2, 3), slope};
        for (double const v : e) row.push_back(percent(v));
        rows.push_back(row);
    }
    page.save("passes.svg", line_plot("Error over passes", {"passes", true, x}, {"relative RMSE"}, lines));
    page.image("passes.svg", "Relative RMSE of sppm over passes, by alpha");
    std::vector<std::string> head{"α", "−α/2", "slope"};
    for (int const c : counts) head.push_back(fmt::format("{} pass{}", c, c > 1 ? "es" : ""));
    page.table(head, rows);
}

}  // namespace nephroid::experiment
