// Estimates from the maps, shown as they are (Figures 20 to 22 of the report).
#include "figures.h"
#include "runs.h"

#include "sheet.h"

#include <fmt/format.h>

#include <tuple>

namespace nephroid::experiment {

namespace {

constexpr int kSamples = 16;  // a pixel: what is shown is the estimate, not edges

std::string show(std::string const& view, std::uint64_t global, std::uint64_t caustic, int k) {
    return fmt::format(
        "Integrator \"photonmap\" \"string visualize\" \"{}\" \"integer indirectphotons\" {} \"integer "
        "causticphotons\" {} \"integer nused\" {}\nSampler \"zsobol\" \"integer pixelsamples\" {}",
        view, global, caustic, k, kSamples);
}

std::vector<std::string> counted(Lab const& lab, std::string const& what, std::uint64_t wanted,
                                 std::vector<PhotonCounts> const& counts, double seconds) {
    PhotonCounts const c = total(counts);
    return {what,
            thousands(wanted),
            thousands(c.emitted),
            thousands(c.stored),
            number(static_cast<double>(c.stored) / static_cast<double>(c.emitted)),
            time_taken(lab, seconds)};
}
std::vector<std::string> const kCounts{"", "wanted", "emitted", "stored", "stored per path", "time"};

struct Seen {
    std::string directives;  // as they were run
    Run run;
};
/// One of the maps, with about so many photons.
Seen map_seen(Setup const& setup, ShotKind kind, std::uint64_t photons, int k) {
    auto const directives = [&](std::uint64_t paths) {
        return kind == ShotKind::Caustic ? show("caustic", 0, paths, k) : show("global", paths, 0, k);
    };
    std::string const asked = directives(paths_that_store(setup, directives(1000), kind, photons));
    return {asked, run(setup, asked, 1)};
}

void add_code(std::string& code, std::string const& label, std::string const& directives) {
    code += "# " + label + "\n" + directives + "\n";
}

void global_counts(Lab const& lab) {
    Page& page = lab.page;
    page.subsection("The global map with 10,000, 50,000 and 500,000 photons");
    int const n = lab.pixels(200);
    Setup const setup = sized_file("report/16-spheres.pbrt", n, n);
    page.text(
        "The report's Figure 20. The radiance that the global map says is there, at the first surface that "
        "is not specular: direct light, caustics and all, with nothing sampled. 100 photons an estimate.");
    SheetRow row{"", {}, 1};
    std::string code;
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;
    for (std::uint64_t const wanted : {10000u, 50000u, 500000u}) {
        std::uint64_t const photons = lab.quick ? wanted / 50 : wanted;
        auto [directives, r] = map_seen(setup, ShotKind::Global, photons, 100);
        labels.push_back(thousands(photons) + " photons");
        add_code(code, labels.back(), directives);
        rows.push_back(counted(lab, "global map", photons, r.photons.global, r.seconds));
        row.pictures.push_back(std::move(r.picture));
    }
    row.exposure = exposure_for(row.pictures.back(), 0.93);
    page.code(code);
    show_sheet(lab, "global.png", "The global map, seen: 10,000, 50,000 and 500,000 photons", labels, {row});
    page.table(kCounts, rows);
}

void caustics(Lab const& lab) {
    Page& page = lab.page;
    page.subsection("The caustic map: mirror boxes, glass balls, mirror balls");
    page.text(
        "The report's Figure 21: caustics alone, 60 photons an estimate; each picture with an exposure of "
        "its own. Plane "
        "mirrors throw patches, glass gathers spots, round mirrors spread the light.");
    int const n = lab.pixels(200);
    std::uint64_t const photons = lab.quick ? 4000 : 1000000;
    std::vector<SheetRow> sheet(1);
    std::string code;
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;
    for (auto const& [label, file, share] : {std::tuple{"mirror boxes", "21-mirror-boxes", 0.98},
                                             {"glass balls", "21-glass-balls", 0.9945},
                                             {"mirror balls", "21-mirror-balls", 0.985}}) {
        Setup const setup = sized_file(std::string("report/") + file + ".pbrt", n, n);
        auto [directives, r] = map_seen(setup, ShotKind::Caustic, photons, 60);
        labels.emplace_back(label);
        add_code(code, fmt::format("scenes/report/{}.pbrt", file), directives);
        rows.push_back(counted(lab, label, photons, r.photons.caustic, r.seconds));
        sheet[0].pictures.push_back(exposed(std::move(r.picture), share));
    }
    page.code(code);
    show_sheet(lab, "caustics.png", "The caustic map, seen: mirror boxes, glass balls and mirror balls",
               labels, sheet);
    page.table(kCounts, rows);
}

void both_maps(Lab const& lab) {
    Page& page = lab.page;
    page.subsection("Global, caustic, both");
    page.text(
        "The report's Figure 22: each map, and their sum; 88 photons an estimate. By itself the global map "
        "holds "
        "all photons, those of caustics as well; in the sum it leaves them to the other.");
    int const n = lab.pixels(200);
    Setup const setup = sized_file("report/16-spheres.pbrt", n, n);
    std::uint64_t const photons = lab.quick ? 1000 : 50000;
    std::string const pilot = show("both", 1000, 1000, 88);
    std::uint64_t const global = paths_that_store(setup, pilot, ShotKind::Global, photons);
    std::uint64_t const caustic = paths_that_store(setup, pilot, ShotKind::Caustic, photons);
    SheetRow row{"", {}, 1};
    std::string code;
    std::vector<std::vector<std::string>> rows;
    for (std::string const view : {"global", "caustic", "both"}) {
        std::string const directives = show(view, global, caustic, 88);
        add_code(code, view, directives);
        Run r = run(setup, directives, 1);
        PhotonCounts const g = total(r.photons.global), c = total(r.photons.caustic);
        rows.push_back({view, thousands(g.stored), thousands(c.stored), number(mean(r.picture)),
                        time_taken(lab, r.seconds)});
        row.pictures.push_back(std::move(r.picture));
    }
    row.exposure = exposure_for(row.pictures.back(), 0.93);
    page.code(code);
    show_sheet(lab, "maps.png", "Global map, caustic map, and both", {"global", "caustic", "both"}, {row});
    page.table({"", "global photons stored", "caustic photons stored", "mean radiance", "time"}, rows);
}

}  // namespace

void estimates_shown(Lab const& lab) {
    global_counts(lab);
    caustics(lab);
    both_maps(lab);
}

}  // namespace nephroid::experiment
