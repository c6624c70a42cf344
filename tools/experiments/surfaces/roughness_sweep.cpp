// Spheres over roughness and anisotropy, by distribution, with and without compensation.
#include "sections.h"

#include "measure.h"
#include "sheet.h"
#include "stage.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::experiment {

namespace {

constexpr std::array kAlphas{0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0};
constexpr std::array kSides{0.02, 0.05, 0.1, 0.3, 0.8};
constexpr std::array<char const*, 3> kDistributions{"ggx", "beckmann", "blinn"};
constexpr char const* kPath = "Integrator \"path\" \"integer maxdepth\" 20\nSampler \"zsobol\"";

std::string rough(std::string const& material, double u, double v, std::string const& distribution,
                  bool compensated) {
    return fmt::format(
        "Material {} \"float uroughness\" {} \"float vroughness\" {} \"string distribution\" \"{}\" \"bool "
        "remaproughness\" false \"bool multiscatter\" {}\n",
        material, u, v, distribution, compensated);
}

Picture picture_of(Lab const& lab, int side, std::string const& material) {
    Setup const setup = faithful(stage::studio(side, side) + material + stage::ball(), ".");
    return render_picture(setup, kPath, lab.passes(160), 1);
}

std::string const kMetal = R"("conductor" "spectrum eta" "metal-Al-eta" "spectrum k" "metal-Al-k")";
std::string const kGlass = R"("dielectric")";
std::string const kPlastic = R"("plastic" "rgb reflectance" [ 0.08 0.22 0.6 ])";

void isotropic(Lab const& lab) {
    struct Kind {
        std::string label, material, distribution;
        bool compensated;
    };
    std::vector<Kind> kinds;
    for (auto const& [name, material] : {std::pair("al", kMetal), std::pair("glass", kGlass)}) {
        for (std::string const d : kDistributions) kinds.push_back({name + (" " + d), material, d, false});
        kinds.push_back({name + std::string(" ggx comp."), material, "ggx", true});
    }
    for (std::string const d : kDistributions) kinds.push_back({"plastic " + d, kPlastic, d, false});
    std::vector<SheetRow> rows;
    std::vector<std::string> columns;
    columns.reserve(kAlphas.size());
    for (double const a : kAlphas) columns.push_back(fmt::format("{}", a));
    double exposure = 0;
    for (Kind const& k : kinds) {
        SheetRow row{k.label, {}, 1};
        for (double const a : kAlphas)
            row.pictures.push_back(
                picture_of(lab, lab.pixels(40), rough(k.material, a, a, k.distribution, k.compensated)));
        if (exposure == 0) exposure = 0.75 * exposure_for(row.pictures.back(), 0.97);
        row.exposure = exposure;
        rows.push_back(std::move(row));
    }
    show_sheet(lab, "roughness.png", "Spheres of aluminium, glass and plastic over alpha, by distribution",
               columns, rows);
}

void anisotropic(Lab const& lab) {
    std::vector<SheetRow> rows;
    std::vector<std::string> columns;
    columns.reserve(kSides.size());
    for (double const x : kSides) columns.push_back(fmt::format("ax {}", x));
    double exposure = 0;
    for (double const y : kSides) {
        SheetRow row{fmt::format("ay {}", y), {}, 1};
        for (double const x : kSides)
            row.pictures.push_back(picture_of(lab, lab.pixels(48), rough(kMetal, x, y, "ggx", false)));
        if (exposure == 0) exposure = exposure_for(row.pictures.back(), 0.97);
        row.exposure = exposure;
        rows.push_back(std::move(row));
    }
    show_sheet(lab, "anisotropy.png",
               "Spheres of aluminium: alpha along the circles of latitude (ax) and "
               "across them (ay)",
               columns, rows);
}

/// What a sphere gives back of a white sky, if facets themselves absorb nothing.
void albedos(Lab const& lab, std::string const& what, std::string const& material) {
    std::vector<std::string> head{what};
    for (double const a : kAlphas) head.push_back(fmt::format("alpha {}", a));
    std::vector<std::vector<std::string>> rows;
    for (std::string const d : kDistributions)
        for (bool const compensated : {false, true}) {
            std::vector<std::string> row{d + (compensated ? ", compensated" : "")};
            for (double const a : kAlphas) {
                Setup const setup = faithful(stage::white_sky(lab.pixels(24)) +
                                                 rough(material, a, a, d, compensated) + stage::unit_sphere(),
                                             ".");
                row.push_back(
                    fixed(stage::over_disk(render_picture(
                              setup, "Integrator \"path\" \"integer maxdepth\" 100\nSampler \"zsobol\"",
                              lab.passes(512), 1)),
                          3));
            }
            rows.push_back(row);
        }
    lab.page.table(head, rows);
}

}  // namespace

void roughness_sweep(Lab const& lab) {
    Page& page = lab.page;
    page.text(fmt::format(
        "Spheres in the studio, {} samples a pixel. Columns: alpha. Rows: aluminium, glass and plastic, with "
        "normals spread as by Trowbridge & Reitz (ggx), Beckmann and Blinn; `comp.`: with compensation.",
        lab.passes(160)));
    isotropic(lab);
    page.text(
        "Beckmann's highlight ends where Trowbridge's has its long tails; Blinn's, a power of the cosine "
        "with the exponent 2/alpha² − 2, is Beckmann's as long as alpha is small.");
    anisotropic(lab);
    page.subsection("What is lost");
    page.text(
        "A sphere under a white sky, in the mean over its disk; facets absorb nothing, so that 1 is right. "
        "What is missing is light that facets throw onto other facets. Through the glass sphere light "
        "passes two boundaries or more.");
    albedos(lab, "mirrors (F = 1)", R"("conductor" "rgb eta" [ 0 0 0 ] "rgb k" [ 0 0 0 ])");
    albedos(lab, "glass 1.5", kGlass);
}

}  // namespace nephroid::experiment
