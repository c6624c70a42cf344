// A ball of every scattering model, in one studio.
#include "sections.h"

#include "image/write.h"
#include "measure.h"
#include "measured_maker.h"
#include "sheet.h"
#include "stage.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace nephroid::experiment {

namespace {

struct Ball {
    std::string label;     // below the picture
    std::string material;  // pbrt text, as the page quotes it
    std::string before{};  // textures and named materials that it needs
    std::string shape{};   // parameters of the shapes
    bool hollow = false;   // a red ball of half the size is inside, to be seen through what lets light pass
};
struct Group {
    std::string title, file;
    std::vector<Ball> balls;
};

std::vector<Group> groups() {
    std::string const gold = R"("spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k")";
    std::string const raw = R"( "bool remaproughness" false)";
    std::string const blue = R"("rgb reflectance" [ 0.08 0.22 0.6 ])";
    auto const gltf = [](std::string const& parameters) {
        return "Material \"metallicroughness\" " + parameters;
    };
    return {
        {"Diffuse and coated",
         "balls-coated.png",
         {{"diffuse", "Material \"diffuse\" \"rgb reflectance\" [ 0.7 0.35 0.15 ]"},
          {"transmission",
           "Material \"diffusetransmission\" \"rgb reflectance\" [ 0.3 0.3 0.1 ] \"rgb transmittance\" [ 0.6 "
           "0.25 0.1 ]"},
          {"coateddiffuse", "Material \"coateddiffuse\" " + blue + " \"float roughness\" 0.02" + raw},
          {"coated metal",
           "Material \"coatedconductor\" \"spectrum conductor.eta\" \"metal-Cu-eta\" "
           "\"spectrum conductor.k\" \"metal-Cu-k\" \"float conductor.roughness\" 0.3 "
           "\"float interface.roughness\" 0.005 \"rgb albedo\" [ 0.9 0.4 0.3 ] \"float "
           "thickness\" 0.3" +
               raw},
          {"plastic", "Material \"plastic\" " + blue + " \"float roughness\" 0.1" + raw},
          {"ashikhmin", "Material \"ashikhminshirley\" " + blue +
                            " \"rgb specular\" [ 0.2 0.2 0.2 ] \"float nu\" 10 \"float nv\" 500"}}},
        {"Metals",
         "balls-metals.png",
         {{"gold, smooth", "Material \"conductor\" " + gold},
          {"copper, rough", "Material \"conductor\" \"float roughness\" 0.3" + raw},
          {"aniso. al",
           "Material \"conductor\" \"spectrum eta\" \"metal-Al-eta\" \"spectrum k\" "
           "\"metal-Al-k\" \"float uroughness\" 0.4 \"float vroughness\" 0.05" +
               raw},
          {"reflectance",
           "Material \"conductor\" \"rgb reflectance\" [ 0.3 0.7 0.5 ] \"float roughness\" "
           "0.15 \"string distribution\" \"beckmann\"" +
               raw},
          {"measured", "Material \"measured\" \"string filename\" \"made.bsdf\""},
          {"mix of two",
           "Material \"mix\" \"string materials\" [ \"enamel\" \"gilt\" ] \"texture amount\" "
           "\"checks\"",
           "Texture \"checks\" \"float\" \"checkerboard\" \"float uscale\" 12 \"float vscale\" 6\n"
           "MakeNamedMaterial \"gilt\" \"string type\" \"conductor\" " +
               gold + " \"float roughness\" 0.15" + raw +
               "\nMakeNamedMaterial \"enamel\" \"string type\" \"plastic\" " + blue + "\n"}}},
        {"Dielectrics",
         "balls-dielectrics.png",
         {{"smooth", "Material \"dielectric\""},
          {"rough", "Material \"dielectric\" \"float roughness\" 0.25" + raw},
          {"anisotropic", "Material \"dielectric\" \"float uroughness\" 0.3 \"float vroughness\" 0.03" + raw},
          {"dispersive", "Material \"dielectric\" \"spectrum eta\" \"glass-SF11\""},
          {"absorbing",
           "Material \"dielectric\" \"rgb attenuationcolor\" [ 0.15 0.6 0.35 ] \"float attenuationdistance\" "
           "1"},
          {"thin", "Material \"thindielectric\"", "", "", true}}},
        {"glTF's metallic-roughness",
         "balls-gltf.png",
         {{"metal", gltf("\"rgb basecolor\" [ 0.9 0.6 0.35 ] \"float metallic\" 1 \"float roughness\" 0.4")},
          {"clearcoat", gltf("\"rgb basecolor\" [ 0.5 0.03 0.02 ] \"float metallic\" 0.6 \"float "
                             "roughness\" 0.6 \"float clearcoat\" 1 \"float clearcoatroughness\" 0.05")},
          {"sheen", gltf("\"rgb basecolor\" [ 0.25 0.05 0.12 ] \"float metallic\" 0 \"float roughness\" 0.9 "
                         "\"rgb sheencolor\" [ 0.9 0.7 0.8 ] \"float sheenroughness\" 0.4")},
          {"anisotropy", gltf("\"rgb basecolor\" [ 0.8 0.8 0.85 ] \"float metallic\" 1 \"float roughness\" "
                              "0.45 \"float anisotropy\" 0.9")},
          {"transmission", gltf("\"float metallic\" 0 \"float roughness\" 0 \"float transmission\" 1 \"bool "
                                "thinwalled\" false \"rgb attenuationcolor\" [ 0.85 0.4 0.1 ] \"float "
                                "attenuationdistance\" 1")},
          {"thin wall",
           gltf("\"rgb basecolor\" [ 0.6 0.85 0.9 ] \"float metallic\" 0 \"float roughness\" 0.3 "
                "\"float transmission\" 1"),
           "", "", true}}},
        {"Textures on them",
         "balls-textures.png",
         {{"imagemap", "Material \"plastic\" \"texture reflectance\" \"chart\"",
           "Texture \"chart\" \"spectrum\" \"imagemap\" \"string filename\" \"chart.tga\" \"string filter\" "
           "\"trilinear\" \"float uscale\" 4 \"float vscale\" 2\n"},
          {"normal map",
           "Material \"plastic\" \"rgb reflectance\" [ 0.6 0.1 0.08 ] \"float roughness\" 0.1 \"string "
           "normalmap\" \"studs.png\"" +
               raw},
          {"bumps",
           "Material \"plastic\" \"rgb reflectance\" [ 0.6 0.5 0.35 ] \"texture displacement\" "
           "\"bumps\"",
           "Texture \"noise\" \"float\" \"wrinkled\" \"integer octaves\" 5\n"
           "Texture \"bumps\" \"float\" \"scale\" \"texture tex\" \"noise\" \"float scale\" 0.15\n"},
          {"alpha cut-out", "Material \"diffuse\" \"rgb reflectance\" [ 0.15 0.45 0.3 ]",
           "Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 16 \"float vscale\" 8\n",
           "\"texture alpha\" \"holes\"", true},
          {"marble", "Material \"plastic\" \"texture reflectance\" \"stone\"",
           "Texture \"stone\" \"spectrum\" \"marble\" \"float scale\" 5 \"float variation\" 0.6\n"},
          {"rough, checks", "Material \"conductor\" " + gold + " \"texture roughness\" \"checks\"" + raw,
           "Texture \"checks\" \"float\" \"checkerboard\" \"float tex1\" 0.01 \"float tex2\" 0.4 \"float "
           "uscale\" 10 \"float vscale\" 6\n"}}},
    };
}

/// Half balls, 8 by 4 of them, as normals of a surface whose uv are those of the picture.
void write_studs(std::filesystem::path const& path) {
    constexpr int kWidth = 512, kHeight = 256, kStud = 64;
    Image image(PixelFormat::U8, kWidth, kHeight, default_channel_names(3));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            double const u = ((x % kStud) + 0.5) / kStud * 2 - 1;
            double const v = 1 - ((y % kStud) + 0.5) / kStud * 2;  // rows run downwards
            double const d = std::hypot(u, v);
            // Half as steep as half a ball, which is too steep at its rim to be seen as one.
            double const slope = d < 0.8 ? 0.5 / std::sqrt(1 - d * d) : 0;
            double const length = std::hypot(u * slope, v * slope, 1.0);
            std::array const n{u * slope / length, v * slope / length, 1 / length};
            for (int c = 0; c < 3; ++c)
                image.set(x, y, c, static_cast<float>(n[static_cast<std::size_t>(c)] / 2 + 0.5));
        }
    write_png(path, image);
}

void write_files(Lab const& lab) {
    write_studs(lab.scratch / "studs.png");
    std::filesystem::copy_file(scenes_folder() / "textures/chart.tga", lab.scratch / "chart.tga",
                               std::filesystem::copy_options::overwrite_existing);
    test::MeasuredPlan plan;
    plan.metal.ax = plan.metal.ay = 0.15;
    std::ofstream(lab.scratch / "made.bsdf", std::ios::binary) << test::measure(plan).file();
}

Setup setup(Lab const& lab, Ball const& ball, int pixels) {
    std::string const core =
        "AttributeBegin\nMaterial \"diffuse\" \"rgb reflectance\" [ 0.7 0.12 0.06 ]\nTranslate 0 0 1.303\n"
        "Shape \"sphere\" \"float radius\" 0.5\nAttributeEnd\n";
    return faithful(stage::studio(pixels, pixels) + (ball.hollow ? core : "") + ball.before + ball.material +
                        "\n" + stage::ball_and_plinth(ball.shape),
                    lab.scratch);
}

}  // namespace

void material_balls(Lab const& lab) {
    Page& page = lab.page;
    std::string const directives = "Integrator \"path\" \"integer maxdepth\" 20\nSampler \"zsobol\"";
    std::uint64_t const passes = lab.passes(128);
    page.text(fmt::format(
        "A ball of radius 1 over a plinth of the same material, on a checkered floor, below a lamp, beside a "
        "strip of light, under a dim sky; spectral, 2 × {} samples a pixel. What lets light pass unbent has "
        "a "
        "red ball inside.",
        passes));
    page.code(directives);
    write_files(lab);
    double exposure = 0;
    for (Group const& g : groups()) {
        page.subsection(g.title);
        SheetRow row{"", {}, 1};
        std::vector<std::string> labels;
        std::vector<std::vector<std::string>> rows;
        for (Ball const& b : g.balls) {
            Reference const r = reference_by_samples(setup(lab, b, lab.pixels(104)), directives, passes);
            // All balls are exposed like the first one.
            if (exposure == 0) exposure = 0.9 * exposure_for(r.picture, 0.97);
            row.pictures.push_back(r.picture);
            labels.push_back(b.label);
            rows.push_back({b.label + ": `" + b.material + "`", number(mean(r.picture)), percent(r.error)});
        }
        row.exposure = exposure;
        show_sheet(lab, g.file, g.title, labels, {row});
        page.table({"", "mean radiance", "error"}, rows);
    }
    page.text(
        "The measured material is no real sample's: its file is made by the recipe of Dupuy & Jakob 2018 "
        "from "
        "a formula, a Trowbridge-Reitz metal (alpha 0.15) whose reflectance grows from 0.2 at 360 nm to 0.8 "
        "at 830 nm.");
}

}  // namespace nephroid::experiment
