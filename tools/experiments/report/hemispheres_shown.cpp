// Directions uniform over the hemisphere against directions by the cosine: the comparison that the report left to do.
#include "sections.h"

#include "figures.h"
#include "runs.h"
#include "sheet.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::experiment {

namespace {

/// Scattering alone finds the sky, on one bounce more than is seen.
std::string path(std::string const& hemisphere, std::string const& sampler) {
    return "Integrator \"path\" \"integer maxdepth\" 12 \"bool samplelights\" false \"string hemisphere\" "
           "\"" +
           hemisphere + "\"\nSampler \"" + sampler + "\"";
}

}  // namespace

void hemispheres_shown(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "The report chose directions uniformly over the hemisphere, found out that the cosine is the better "
        "density, and left the comparison as a TODO. Here it is: the spheres of Figure 2, light found by "
        "scattering alone, at equal samples.");
    page.code("# scenes/report/02-three-spheres.pbrt\n" + path("uniform|cosine", "independent"));
    auto const scene = [](int width, int height) {
        return sized_file("report/02-three-spheres.pbrt", width, height);
    };
    Setup const setup = scene(lab.pixels(160), lab.pixels(120));
    Setup const small = at_centres(scene(lab.measured(48), lab.measured(36)));
    std::vector<SheetRow> sheet;
    std::vector<std::vector<std::string>> rows;
    std::vector<SampleVariance> variances;
    double exposure = 0;
    for (std::string const hemisphere : {"uniform", "cosine"}) {
        SheetRow row{hemisphere, {}, 1};
        for (std::uint64_t const samples : {1, 4, 16, 64})
            row.pictures.push_back(render_picture(setup, path(hemisphere, "independent"), samples, 1));
        exposure = exposure_for(row.pictures.back(), 0.98);
        sheet.push_back(std::move(row));
        variances.push_back(
            variance_per_sample(small, path(hemisphere, "independent"), lab.passes(1024), lab.seeds(4)));
        SampleVariance const& v = variances.back();
        rows.push_back({"`" + hemisphere + "`", with_error(v.mean, v.mean_error),
                        with_error(v.relative, v.error), percent(std::sqrt(v.relative / 16))});
    }
    for (SheetRow& row : sheet) row.exposure = exposure;
    show_sheet(lab, "hemispheres.png",
               "The spheres under a sky: directions uniform over the hemisphere, and by the cosine",
               {"1", "4", "16", "64"}, sheet);
    page.table({"hemisphere", "mean radiance", "variance of a sample / mean²", "error at 16 samples"}, rows);
    SampleVariance const &u = variances[0], &c = variances[1];
    double const ratio = u.relative / c.relative;
    page.text(fmt::format(
        "One sample by the cosine is worth {} uniform ones here, between surfaces that hide the sky from "
        "each other. Where nothing does, theory knows the answer:",
        with_error(ratio, ratio * std::hypot(u.error / u.relative, c.error / c.relative))));
    hemispheres(lab);
}

}  // namespace nephroid::experiment
