// The furnace: an enclosure whose radiance is known, after 1 to 12 segments and in the limit.
#include "sections.h"

#include "measure.h"
#include "plot.h"
#include "scene_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace nephroid::experiment {

namespace {

constexpr std::array kReflectance{0.3, 0.6, 0.9};  // as in the scene
constexpr std::array<char const*, 3> kChannels{"red, R = 0.3", "green, R = 0.6", "blue, R = 0.9"};
constexpr int kSegments = 12;

/// The farthest from the formula so far, in standard errors.
struct Farthest {
    double off = 0;
    void add(Estimate const& e, double formula) {
        if (e.error > 1e-6) off = std::max(off, std::abs(e.mean - formula) / e.error);
    }
};

std::string measured(Estimate const& e) {
    return e.error > 1e-6 ? with_error(e.mean, e.error) : number(e.mean, 4) + " (no noise)";
}

}  // namespace

void furnace_table(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report's check of its path tracer. Inside a closed box every point of which emits 1 and "
        "reflects R diffusely, light that was scattered k times has radiance R^k in every direction: paths "
        "of N segments carry (1 − R^N)/(1 − R), and all of them 1/(1 − R). Nothing of the geometry enters, "
        "so that no wrong factor can hide behind it. Light is sampled at each bounce and found by chance, "
        "weighed by MIS; the last row survives by roulette.");
    auto const path = [](std::string const& depth) {
        return "Integrator \"path\" \"integer segments\" " + depth +
               " \"string roulette\" \"none\"\nSampler \"independent\"";
    };
    std::string const endless =
        "Integrator \"path\" \"integer maxdepth\" 10000 \"string roulette\" \"throughput\"\nSampler "
        "\"independent\"";
    page.code("# scenes/report/furnace.pbrt\n" + path(fmt::format("1…{}", kSegments)) + "\n# limit\n" +
              endless);

    Setup const setup = prepare_file("report/furnace.pbrt");
    std::uint64_t const passes = lab.passes(64);
    int const seeds = lab.seeds(16);
    std::vector<std::vector<std::string>> rows;
    std::array<Line, 3> lines;
    Farthest farthest;
    for (int n = 1; n <= kSegments + 1; ++n) {
        bool const limit = n > kSegments;
        auto const e = means_by_channel(setup, limit ? endless : path(std::to_string(n)), passes, seeds);
        std::vector<std::string> row{limit ? "limit" : std::to_string(n)};
        for (std::size_t c = 0; c < 3; ++c) {
            double const r = kReflectance[c];
            double const formula = (limit ? 1 : 1 - std::pow(r, n)) / (1 - r);
            row.insert(row.end(), {number(formula, 4), measured(e[c])});
            farthest.add(e[c], formula);
            if (limit) continue;
            lines[c].x.push_back(n), lines[c].y.push_back(e[c].mean);
        }
        rows.push_back(row);
    }
    std::vector<Line> plotted;
    for (std::size_t c = 0; c < 3; ++c) {
        lines[c].name = kChannels[c];
        plotted.push_back(lines[c]);
    }
    page.save("furnace.svg",
              line_plot("A furnace, segment by segment", {"segments", false}, {"radiance", false}, plotted));
    page.image("furnace.svg", "Radiance in the furnace over the number of segments, three reflectances");
    std::vector<std::string> head{"segments"};
    for (char const* channel : kChannels) head.insert(head.end(), {channel, "measured"});
    page.table(head, rows);
    page.text(
        fmt::format("Means of {} paths with their standard errors, from {} seeds; the farthest is {} "
                    "standard errors off.",
                    passes * 256 * static_cast<std::uint64_t>(seeds), seeds, number(farthest.off, 2)));
}

}  // namespace nephroid::experiment
