// Estimates against a closed form: bias and noise over the photons that an estimate takes, and by kernel.
#include "patch.h"
#include "runs.h"
#include "sections.h"

#include "plot.h"
#include "sheet.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::experiment {

namespace {

/// Of many maps of the same size: what their mean is off by, and how they scatter about it; as shares of the mean
/// radiance, over the pixels.
struct Off {
    double bias = 0, noise = 0;
    double bias_inside = 0;  // the mean difference where no edge is near
    [[nodiscard]] double total() const { return std::hypot(bias, noise); }
};
Off measured(Setup const& setup, std::string const& directives, Picture const& truth, int maps) {
    std::size_t const n = truth.rgb.size();
    std::vector<double> sum(n), square(n);
    for (int seed = 1; seed <= maps; ++seed) {
        Picture const p = render_picture(setup, directives, 1, static_cast<std::uint64_t>(seed));
        for (std::size_t i = 0; i < n; ++i) sum[i] += p.rgb[i][1], square[i] += p.rgb[i][1] * p.rgb[i][1];
    }
    double noise2 = 0, bias2 = 0, off_inside = 0, inside = 0;
    auto const side = static_cast<std::size_t>(truth.width);
    for (std::size_t i = 0; i < n; ++i) {
        double const mean = sum[i] / maps;
        double const variance = std::max(0.0, square[i] / maps - mean * mean) * maps / (maps - 1);
        // The mean of the maps is noisy itself.
        double const off2 = std::pow(mean - truth.rgb[i][1], 2) - variance / maps;
        noise2 += variance, bias2 += off2;
        std::size_t const column = i % side, row = i / side;
        double const x = (static_cast<double>(column) + 0.5) / static_cast<double>(side) - 0.25;
        double const y = (static_cast<double>(row) + 0.5) / static_cast<double>(side) - 0.5;
        if (std::hypot(x, y) < 0.12) off_inside += mean - truth.rgb[i][1], inside += truth.rgb[i][1];
    }
    double const mean_radiance = mean(truth);
    auto const share = [&](double squares, double count) {
        return std::sqrt(std::max(0.0, squares) / count) / mean_radiance;
    };
    auto const pixels = static_cast<double>(n);
    return {share(bias2, pixels), share(noise2, pixels), off_inside / inside};
}

std::string signed_percent(double share) { return (share > 0 ? "+" : "") + fixed(100 * share, 2) + "%"; }

std::string ask(std::uint64_t paths, int k, std::string const& kernel) {
    return fmt::format(
        "Integrator \"photonmap\" \"string visualize\" \"caustic\" \"integer indirectphotons\" 0 \"integer "
        "causticphotons\" {} \"integer nused\" {} \"float radius\" 0.5 \"string kernel\" \"{}\"\nSampler "
        "\"independent\" \"integer pixelsamples\" 1",
        paths, k, kernel);
}
constexpr std::uint64_t kPaths = 40000;

std::uint64_t paths_of(Lab const& lab) { return lab.quick ? kPaths / 20 : kPaths; }

}  // namespace

void bias_and_noise(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "A point light over a floor, and a small mirror beside it: the mirror throws a patch of light on "
        "the floor, whose radiance has a closed form, with sharp edges. Only the caustic map is asked, at "
        "points. The more photons an estimate takes, the less it scatters, and the farther it reaches: "
        "over edges, most of all.");
    page.code(ask(kPaths, 100, "epanechnikov"));
    int const n = lab.pixels(48);
    Setup const setup = patch_setup(kSmallMirror, n);
    Picture const truth = patch_reference(kSmallMirror, setup).picture;
    int const maps = lab.seeds(24);
    std::uint64_t const paths = paths_of(lab);
    std::vector<int> const ks{10, 20, 50, 100, 200, 500, 1000};
    Line bias{"bias", {}, {}, {}}, noise{"noise", {}, {}, {}}, both{"both", {}, {}, {}};
    SheetRow row{"", {}, exposure_for(truth, 0.99)};
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;
    for (int const k : ks) {
        std::string const directives = ask(paths, k, "epanechnikov");
        Off const off = measured(setup, directives, truth, maps);
        for (auto [line, y] : {std::pair{&bias, off.bias}, {&noise, off.noise}, {&both, off.total()}})
            line->x.push_back(static_cast<double>(k)), line->y.push_back(y);
        rows.push_back({std::to_string(k), percent(off.bias), signed_percent(off.bias_inside),
                        percent(off.noise), percent(off.total())});
        if (k == 10 || k == 50 || k == 200 || k == 1000) {
            labels.push_back("k = " + std::to_string(k));
            row.pictures.push_back(
                render_picture(patch_setup(kSmallMirror, lab.pixels(128)), directives, 1, 1));
        }
    }
    row.pictures.push_back(patch_reference(kSmallMirror, patch_setup(kSmallMirror, lab.pixels(128))).picture);
    labels.emplace_back("closed form");
    show_sheet(lab, "bias.png", "A patch of mirrored light by photons an estimate, and in closed form",
               labels, {row});
    noise.note = "slope " + fixed(log_log_slope(noise.x, noise.y), 2);
    page.save("bias.svg", line_plot("Bias and noise", {"photons an estimate", true, bias.x},
                                    {"share of the mean radiance"}, {bias, noise, both}));
    page.image("bias.svg", "Bias and noise over photons an estimate");
    page.table({"photons an estimate", "bias, RMS", "far from edges, mean", "noise, RMS", "both"}, rows);
    std::size_t best = 0;
    for (std::size_t i = 0; i < ks.size(); ++i)
        if (both.y[i] < both.y[best]) best = i;
    page.text(
        fmt::format("{} maps of {} paths each; shares of the mean radiance. Noise falls with the slope {}; "
                    "an estimate of k independent photons has −1/2. With so many photons, {} an estimate "
                    "are best.",
                    maps, thousands(paths), fixed(log_log_slope(noise.x, noise.y), 2), ks[best]));
}

void kernels(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "How photons are weighed by their distance, over the same patch of light, with the same photons, "
        "100 an estimate; and below the glass ball of `scenes/cornell-spheres.pbrt`, 60 an estimate.");
    int const n = lab.pixels(48);
    Setup const setup = patch_setup(kSmallMirror, n);
    Picture const truth = patch_reference(kSmallMirror, setup).picture;
    int const maps = lab.seeds(24);
    int const size = lab.pixels(480);
    Setup const ball = cropped(sized_file("cornell-spheres.pbrt", size, size), 0.55, 0.9, 0.65, 1);
    std::uint64_t const shot = lab.quick ? 2000 : 100000;
    SheetRow row{"", {}, 1};
    std::vector<std::string> const names{"box", "cone", "epanechnikov", "gaussian"};
    std::vector<std::vector<std::string>> rows;
    for (std::string const& kernel : names) {
        Off const off = measured(setup, ask(paths_of(lab), 100, kernel), truth, maps);
        rows.push_back({kernel, percent(off.bias), signed_percent(off.bias_inside), percent(off.noise),
                        percent(off.total())});
        row.pictures.push_back(render_picture(
            ball,
            fmt::format(
                "Integrator \"photonmap\" \"string visualize\" \"caustic\" \"integer indirectphotons\" 0 "
                "\"integer causticphotons\" {} \"integer nused\" 60 \"string kernel\" \"{}\"\nSampler "
                "\"zsobol\" \"integer pixelsamples\" 4",
                shot, kernel),
            1, 1));
    }
    row.exposure = 0.4 * exposure_for(row.pictures.back(), 0.95);
    show_sheet(lab, "kernels.png", "The caustic below a glass ball by kernel", names, {row});
    page.table({"100 photons an estimate", "bias, RMS", "far from edges, mean", "noise, RMS", "both"}, rows);
    page.text(
        "At the same number of photons a kernel that falls off sees less far: less bias, more noise. The "
        "box shows each photon's disk.");
}

}  // namespace nephroid::experiment
