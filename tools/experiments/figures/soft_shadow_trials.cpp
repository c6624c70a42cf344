// Shirley's trials: what 1, 4, 16 and 64 samples make of a shadow (Figure 6 of the report).
#include "soft_shadow_trials.h"
#include "runs.h"

#include "sheet.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::experiment {

namespace {

constexpr std::array kCounts{1, 4, 16, 64};

}  // namespace

std::string light_samples(std::string const& shapes, std::string const& sampler) {
    return R"(Integrator "direct" "string strategy" "light" "string shapesampling" ")" + shapes +
           "\"\nSampler \"" + sampler + "\"";
}

std::string ball_under(std::string const& light) {
    return "Include \"include/ball-under-light.pbrt\"\n" + light;
}

// Not faithful(): that a light is in an object is a note.
Setup Trial::at(int width, int height) const { return sized(prepare(scene, scenes_folder()), width, height); }

void trial_sheet(Lab const& lab, std::string const& file, std::string const& alt,
                 std::vector<Trial> const& trials) {
    std::uint64_t const many = lab.quick ? 64 : 256;
    std::vector<std::string> columns;
    columns.reserve(std::size(kCounts) + 1);
    for (int const n : kCounts) columns.push_back(std::to_string(n));
    columns.push_back(std::to_string(many));
    std::vector<SheetRow> rows;
    for (Trial const& t : trials) {
        Setup const setup = t.at(lab.pixels(120), lab.pixels(90));
        SheetRow row{t.label, {}, 1};
        for (int const n : kCounts)
            row.pictures.push_back(
                render_picture(setup, light_samples(t.shapes, "zsobol"), static_cast<std::uint64_t>(n), 1));
        row.pictures.push_back(render_picture(setup, light_samples(t.shapes, "zsobol"), many, 1));
        row.exposure = exposure_for(row.pictures.back());
        rows.push_back(std::move(row));
    }
    show_sheet(lab, file, alt, columns, rows);
}

void trial_table(Lab const& lab, std::vector<Trial> const& trials) {
    std::vector<std::vector<std::string>> rows;
    std::string last;
    Reference reference;
    for (Trial const& t : trials) {
        Setup const setup = t.at(lab.measured(48), lab.measured(36));
        if (t.scene != last)
            reference = reference_by_samples(setup,
                                             "Integrator \"direct\" \"string strategy\" \"mis\"\nSampler "
                                             "\"zsobol\"",
                                             lab.passes(2048));
        last = t.scene;
        for (std::string const sampler : {"independent", "zsobol"}) {
            std::vector<std::string> row{t.name, "`" + sampler + "`"};
            for (double const e : rmse_over_samples(setup, light_samples(t.shapes, sampler), kCounts,
                                                    lab.seeds(4), reference.picture))
                row.push_back(percent(e));
            row.push_back(percent(reference.error));
            rows.push_back(row);
        }
    }
    lab.page.table({"error: light", "sampler", "1 sample", "4", "16", "64", "reference"}, rows);
}

void square_lights(Lab const& lab) {
    std::vector<Trial> trials;
    for (auto const& [size, side] : {std::pair{"small", "0.25"}, {"middle", "1"}, {"large", "3"}})
        trials.push_back({fmt::format("side {}", side), fmt::format("square, side {}", side),
                          fmt::format("Include \"report/06-soft-shadow-{}.pbrt\"\n", size)});
    lab.page.text(
        "A ball of radius 0.5 hangs at a height of 0.8 above a floor; a horizontal square of side 0.25, 1 or "
        "3 and of the same power shines at a height of 3. Rows: the sides. Columns: samples a pixel.");
    lab.page.code(light_samples("solidangle", "zsobol"));
    trial_sheet(lab, "square.png",
                "Shadows of a ball under squares of three sizes, 1 to 64 samples and the limit", trials);
    trial_table(lab, trials);
    lab.page.text(
        "The small light throws an edge, and only the pixels on it are uncertain; the larger the light, the "
        "wider the penumbra, and the more pixels have to count how much of the light they see. Points that "
        "are well spread (`zsobol`) settle that count sooner than independent ones.");
}

}  // namespace nephroid::experiment
