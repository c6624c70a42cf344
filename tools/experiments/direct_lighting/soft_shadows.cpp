// Shirley's trials: what 1, 4, 16 and 64 samples make of the shadows of lights of several sizes and shapes.
#include "measure.h"
#include "scenes.h"
#include "sections.h"
#include "sheet.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::experiment {

namespace {

constexpr std::array kCounts{1, 4, 16, 64};

std::string direct(std::string const& shapes, std::string const& sampler) {
    return R"(Integrator "direct" "string strategy" "light" "string shapesampling" ")" + shapes +
           "\"\nSampler \"" + sampler + "\"";
}

/// A scene at any size.
struct Trial {
    std::string label;  // on the sheet
    std::string name;   // in the table
    std::string world;  // what follows view()
    Vec3 eye{0, -5, 2.5f}, target{0, 0.2f, 0.25f};
    std::string shapes = "solidangle";

    [[nodiscard]] Setup at(int width, int height) const {
        return prepare(scenes::view(width, height, scenes::Pixels::Whole, eye, target, 36) + world);
    }
};

std::string ball_on_floor() {
    return scenes::matte(0.6f) + scenes::floor() +
           "AttributeBegin\nTranslate 0 0 0.8\nShape \"sphere\" \"float radius\" 0.5\nAttributeEnd\n";
}

void sheet(Lab const& lab, std::string const& file, std::string const& alt,
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
                render_picture(setup, direct(t.shapes, "zsobol"), static_cast<std::uint64_t>(n), 1));
        row.pictures.push_back(render_picture(setup, direct(t.shapes, "zsobol"), many, 1));
        row.exposure = exposure_for(row.pictures.back());
        rows.push_back(std::move(row));
    }
    show_sheet(lab, file, alt, columns, rows);
}

/// Errors of the same views at a smaller size. Trials that differ by their sampling alone share a reference.
void table(Lab const& lab, std::vector<Trial> const& trials) {
    std::vector<std::vector<std::string>> rows;
    std::string last;
    Reference reference;
    for (Trial const& t : trials) {
        Setup const setup = t.at(lab.pixels(48), lab.pixels(36));
        if (t.world != last)
            reference = reference_by_samples(setup,
                                             "Integrator \"direct\" \"string strategy\" \"mis\"\nSampler "
                                             "\"zsobol\"",
                                             lab.passes(2048));
        last = t.world;
        for (std::string const sampler : {"independent", "zsobol"}) {
            std::vector<std::string> row{t.name, "`" + sampler + "`"};
            for (double const e : rmse_over_samples(setup, direct(t.shapes, sampler), kCounts, lab.seeds(4),
                                                    reference.picture))
                row.push_back(percent(e));
            row.push_back(percent(reference.error));
            rows.push_back(row);
        }
    }
    lab.page.table({"error: light", "sampler", "1 sample", "4", "16", "64", "reference"}, rows);
}

void squares(Lab const& lab) {
    lab.page.subsection("A square light of three sizes");
    std::vector<Trial> trials;
    for (float const side : {0.25f, 1.0f, 3.0f}) {
        std::string const name = fmt::format("side {}", side);
        // The same power, so that pictures are equally bright.
        trials.push_back(
            {name, "square, " + name, ball_on_floor() + scenes::square_light(24 / (side * side), side, 3)});
    }
    lab.page.text(
        "A ball of radius 0.5 hangs at a height of 0.8 above a floor; a horizontal square of side 0.25, 1 or "
        "3 and of the same power shines at a height of 3. Rows: the sides. Columns: samples a pixel.");
    lab.page.code(direct("solidangle", "zsobol"));
    sheet(lab, "square.png", "Shadows of a ball under squares of three sizes, 1 to 64 samples and the limit",
          trials);
    table(lab, trials);
    lab.page.text(
        "The small light throws an edge, and only the pixels on it are uncertain; the larger the light, the "
        "wider the penumbra, and the more pixels have to count how much of the light they see. Points that "
        "are well spread (`zsobol`) settle that count sooner than independent ones.");
}

/// One light, its points drawn by area and by solid angle.
void two_ways(Lab const& lab, std::string const& title, std::string const& what, std::string const& file,
              Trial trial, std::string const& learned) {
    lab.page.subsection(title);
    lab.page.text(what +
                  " Rows: points drawn uniformly over the surface (`area`), and by what the receiver sees "
                  "(`solidangle`, the default). Columns: samples a pixel.");
    lab.page.code(direct("area|solidangle", "zsobol"));
    std::string const name = trial.name;
    std::vector<Trial> trials;
    for (std::string const shapes : {"area", "solidangle"}) {
        trial.label = shapes == "area" ? "area" : "solid angle";
        trial.name = name + ", `" + shapes + "`";
        trial.shapes = shapes;
        trials.push_back(trial);
    }
    sheet(lab, file, title + ", 1 to 64 samples and the limit", trials);
    table(lab, trials);
    lab.page.text(learned);
}

std::string shaded_cylinder() {
    return scenes::matte(0.6f) + scenes::floor() +
           "Shape \"quad\" \"point3 origin\" [ -40 0.6 0 ] \"vector3 u\" [ 80 0 0 ] \"vector3 v\" [ 0 0 40 "
           "]\n"
           "ObjectBegin \"lamp\"\n" +
           scenes::light(
               60, "Shape \"cylinder\" \"float radius\" 0.05 \"float zmin\" -0.15 \"float zmax\" 0.15\n") +
           "AttributeBegin\n" + scenes::matte(0) +
           "Shape \"cylinder\" \"float radius\" 0.3 \"float zmin\" -0.4 \"float zmax\" 0.4\nAttributeEnd\n"
           "ObjectEnd\n"
           "AttributeBegin\nTranslate 0 0 1.6\nRotate 12 0 1 0\nObjectInstance \"lamp\"\nAttributeEnd\n";
}

}  // namespace

void soft_shadows(Lab const& lab) {
    squares(lab);
    two_ways(lab, "A sphere light", "The same ball under a sphere of radius 0.5 at (−1, 0.5, 2.6).",
             "sphere.png",
             {"", "sphere",
              ball_on_floor() +
                  scenes::light(20, "Translate -1 0.5 2.6\nShape \"sphere\" \"float radius\" 0.5\n")},
             "Half of a sphere's surface never sees the receiver: points drawn there are lost, and whether a "
             "sample is lost is noise even where nothing casts a shadow.");
    two_ways(
        lab, "A box light",
        "The same ball under a box of 1 × 0.6 × 0.5 at the same place, turned by 30° about the vertical.",
        "box.png",
        {"", "box",
         ball_on_floor() +
             scenes::light(18,
                           "Translate -1 0.5 2.6\nRotate 30 0 0 1\nShape \"box\" \"point3 lo\" [ "
                           "-0.5 -0.3 -0.25 ] \"point3 hi\" [ 0.5 0.3 0.25 ]\n")},
        "A box shows at most three of its six faces. [Below](#a-box-light-five-ways) the ways to choose "
        "among them are held side by side.");
    two_ways(
        lab, "A cylinder light in a shade, open at both ends",
        "A cylinder light of radius 0.05 and length 0.3 stands within a black shade of radius 0.3 and length "
        "0.8; both are open at both ends. The lamp is one object, and its instance leans by 12° before a "
        "wall "
        "at a distance of 0.6.",
        "cylinder.png", {"", "cylinder in a shade", shaded_cylinder(), {0, -4.5f, 1.8f}, {0, 0.6f, 1.6f}},
        "Light leaves the shade as two cones, and the wall cuts them in the two branches of a hyperbola, "
        "whose axis leans with the lamp: an instance's transform moves an emitter as it moves a shade. The "
        "length of the light makes the penumbra.");
}

}  // namespace nephroid::experiment
