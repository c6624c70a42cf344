// Photons, their paths and the normals where they landed, drawn over the picture (Figures 17 to 19 of the report).
#include "figures.h"
#include "runs.h"

#include "apps/photon_overlay.h"
#include "sheet.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::experiment {

void photons_and_paths(Lab const& lab) {
    Page& page = lab.page;
    int const n = lab.pixels(300);
    int const photons = lab.quick ? 40 : 6000, paths = lab.quick ? 4 : 60, normals = lab.quick ? 20 : 1200;
    page.text(
        "The report's Figures 17 to 19, over a dimmed picture: photons of both maps where they landed, in "
        "the colour of their power; paths of both, white; normals of the surfaces as the photons keep "
        "them, in 16 bits, green. All are drawn where nothing hides them from the camera. All three at "
        "once:");
    page.code(fmt::format(
        "nephroid render scenes/report/16-spheres.pbrt -o marked.png --show-photons={} --show-paths {} "
        "--show-normals {}",
        photons, paths, normals));
    Setup const setup = sized_file("report/16-spheres.pbrt", n, n);
    Picture under = render_picture(setup, "Integrator \"path\" \"integer maxdepth\" 8\nSampler \"zsobol\"",
                                   lab.passes(64), 1);
    under = exposed(std::move(under), 0.93);
    for (auto& color : under.rgb)
        for (double& v : color) v = 0.3 * std::min(1.0, v);

    RenderJob const job(setup.world, cli::photon_settings(setup.settings));
    auto const draw = [&](int some_photons, int some_paths, int some_normals) {
        cli::OverlayOptions o;
        o.photons = some_photons, o.paths = some_paths, o.normals = some_normals;
        return over(cli::draw_photons(job, 0, o), under);
    };
    show_sheet(lab, "photons.png", "Photons, photon paths and normals over the Cornell box with two balls",
               {"photons", "paths", "normals"},
               {{"", {draw(photons, 0, 0), draw(0, paths, 0), draw(0, 0, normals)}, 1}});

    std::uint64_t const shot = lab.quick ? 2000 : 200000;
    std::vector<std::vector<std::string>> rows;
    for (auto const& [name, kind] :
         {std::pair{"global map", ShotKind::Global}, {"caustic map", ShotKind::Caustic}}) {
        PhotonCounts const c = total(shoot(job, kind, 0, shot, {})->by_source);
        rows.push_back({name, thousands(c.emitted), thousands(c.stored), thousands(c.further),
                        thousands(c.landed), thousands(c.elsewhere), thousands(c.absorbed),
                        thousands(c.escaped), thousands(c.too_long), thousands(c.dark), thousands(c.broken)});
    }
    page.text("What becomes of the paths of a pass:");
    page.table({"", "emitted", "photons stored", "… further on", "ended where they landed",
                "left to the other map's", "absorbed", "escaped", "too long", "sent nothing", "not numbers"},
               rows);
}

}  // namespace nephroid::experiment
