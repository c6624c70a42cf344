// Dispersion: a slit seen through a prism, against Snell's law.
#include "sections.h"

#include "measure.h"
#include "sheet.h"
#include "spectrum/color.h"
#include "spectrum/named.h"
#include "stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::experiment {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// An equilateral prism whose apex points to +y, a camera before its left face, and a slit that is so far away behind its right
/// face that all light from it has one direction. Angles are in the plane z = 0, from +x towards +y, in radians.
class Arrangement {
  public:
    explicit Arrangement(std::string glass) : glass_(std::move(glass)) {
        // At 550 nm light passes symmetrically, at least deviation.
        double const least = 2 * std::asin(index(550) / 2) - kApex;
        slit_ = -least / 2;
    }
    [[nodiscard]] std::string const& glass() const { return glass_; }
    [[nodiscard]] double index(double lambda) const { return interpolate(*named_spectrum(glass_), lambda); }
    /// Where the camera has to look to see the slit at this wavelength: Snell's law, backwards from the slit. The normals of
    /// the faces make angles of 30 degrees with the x axis.
    [[nodiscard]] double seen_at(double lambda) const {
        double const n = index(lambda);
        double const out = 30 * kDegree - slit_;
        double const inside = kApex - std::asin(std::sin(out) / n);
        return std::asin(n * std::sin(inside)) - 30 * kDegree;
    }
    [[nodiscard]] double deviation(double seen) const { return seen - slit_; }
    [[nodiscard]] double middle() const { return seen_at(550); }

    /// `half`: half of the angle of view; `slit_width`: an angle. `emission`: pbrt's parameters of the light.
    [[nodiscard]] Setup setup(int width, int height, double half, double slit_width,
                              std::string const& emission) const {
        double const t = std::tan(half);
        double const c = std::cos(middle());
        double const s = std::sin(middle());
        double const root3 = std::numbers::sqrt3;
        double const far = 1e5;
        double const w = far * slit_width / 2;
        auto const slit = [&](double across, double z) {
            return fmt::format(" {} {} {}", far * std::cos(slit_) - across * std::sin(slit_),
                               far * std::sin(slit_) + across * std::cos(slit_), z);
        };
        std::string const text =
            fmt::format(
                "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
                "PixelFilter \"box\" \"float xradius\" 0.5 \"float yradius\" 0.5\nScale -1 1 1\n",
                width, height) +
            fmt::format("LookAt {} {} 0  {} {} 0  0 0 1\n", -1 - 2 * c, root3 / 3 - 2 * s, -1 + c,
                        root3 / 3 + s) +
            fmt::format("Camera \"perspective\" \"float fov\" 90 \"float screenwindow\" [ {} {} {} {} ]\n",
                        -t, t, -t * height / width, t * height / width) +
            "WorldBegin\nAttributeBegin\nAreaLightSource \"diffuse\" " + emission +
            " \"bool twosided\" true\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point3 "
            "P\" [" +
            slit(-w, -1e5) + slit(w, -1e5) + slit(w, 1e5) + slit(-w, 1e5) +
            " ]\nAttributeEnd\nMaterial \"dielectric\" \"spectrum eta\" \"" + glass_ + "\"\n" +
            fmt::format(
                "Shape \"trianglemesh\" \"integer indices\" [ 0 2 1  3 4 5  0 1 4 0 4 3  1 2 5 1 5 4  2 0 3 "
                "2 "
                "3 5 ] \"point3 P\" [ -2 {0} -2  2 {0} -2  0 {1} -2  -2 {0} 2  2 {0} 2  0 {1} 2 ]\n",
                -root3 * 2 / 3, root3 * 4 / 3);
        return faithful(text, ".");
    }

  private:
    static constexpr double kApex = 60 * kDegree;
    std::string glass_;
    double slit_ = 0;
};

constexpr char const* kDirectives = "Integrator \"path\" \"integer maxdepth\" 3\nSampler \"zsobol\"";

/// A line of 6 nm around a wavelength, as pbrt's parameter and as a spectrum by twentieths of a nm.
std::string line_of(int lambda) {
    return fmt::format("\"spectrum L\" [ {} 0 {} 1 {} 1 {} 0 ]", lambda - 3, lambda - 2, lambda + 2,
                       lambda + 3);
}
double in_line(double off) { return std::clamp(3 - std::abs(off), 0.0, 1.0); }

/// Where the middle of what is seen of such a line must lie, as an angle from the picture's middle: Snell's law for each of its
/// wavelengths, weighed by luminance, as the picture is.
double predicted(Arrangement const& a, int lambda) {
    TabulatedSpd weight;
    TabulatedSpd moment;
    for (int i = -60; i <= 60; ++i) {
        double const off = i / 20.0;
        double const l = lambda + off;
        weight.lambda.push_back(static_cast<float>(l));
        moment.lambda.push_back(static_cast<float>(l));
        weight.value.push_back(static_cast<float>(in_line(off)));
        moment.value.push_back(static_cast<float>(in_line(off) * std::tan(a.seen_at(l) - a.middle())));
    }
    return std::atan(photometric(moment) / photometric(weight));
}

/// The angle at which the middle of what is seen lies, from the picture's middle; +: towards +y, which is left.
double centroid(Picture const& p, double half) {
    std::vector<double> columns(static_cast<std::size_t>(p.width));
    for (std::size_t i = 0; i < p.rgb.size(); ++i) {
        auto const& [r, g, b] = p.rgb[i];
        columns[i % columns.size()] += static_cast<double>(luminance(Vec3(r, g, b)));
    }
    // Around the brightest column only, lest light that took another way be counted.
    auto const peak = std::max_element(columns.begin(), columns.end()) - columns.begin();
    double sum = 0;
    double moment = 0;
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(peak - 8, 0);
         i <= std::min<std::ptrdiff_t>(peak + 8, p.width - 1); ++i) {
        double const x = 1 - 2 * (static_cast<double>(i) + 0.5) / p.width;
        sum += columns[static_cast<std::size_t>(i)];
        moment += columns[static_cast<std::size_t>(i)] * x;
    }
    return std::atan(moment / sum * std::tan(half));
}

void angles(Lab const& lab) {
    Page& page = lab.page;
    std::vector<std::vector<std::string>> rows;
    double worst = 0;
    double pixel = 0;
    for (char const* glass : {"glass-SF11", "glass-BK7"}) {
        Arrangement const a(glass);
        double const half = 1.2 * std::max(a.seen_at(450) - a.middle(), a.middle() - a.seen_at(650));
        int const width = lab.quick ? 64 : 256;
        pixel = 2 * half / width / kDegree;
        for (int const lambda : {450, 500, 550, 600, 650}) {
            Picture const p = render_picture(a.setup(width, 1, half, 3 * 2 * half / width, line_of(lambda)),
                                             kDirectives, lab.quick ? 2048 : 16384, 1);
            double const seen = a.middle() + centroid(p, half);
            double const measured = a.deviation(seen) / kDegree;
            double const snell = a.deviation(a.middle() + predicted(a, lambda)) / kDegree;
            worst = std::max(worst, std::abs(measured - snell));
            rows.push_back({fmt::format("{}, {} nm", glass, lambda), number(a.index(lambda), 5),
                            fixed(snell, 3) + "°", fixed(measured, 3) + "°", fixed(measured - snell, 4) + "°",
                            fixed((measured - snell) / pixel, 2)});
        }
    }
    page.table({"", "index", "deviation by Snell's law", "as rendered", "difference", "in pixels"}, rows);
    page.text(fmt::format(
        "The slit is three pixels wide and sends 6 nm around the wavelength; its place in the picture is the "
        "centroid of what is seen, and Snell's law is averaged over the 6 nm alike. The largest difference "
        "is {}°.",
        number(worst, 2)));
}

void spectra(Lab const& lab) {
    double const half = [] {
        Arrangement const a("glass-SF11");
        return 1.6 * std::max(a.seen_at(450) - a.middle(), a.middle() - a.seen_at(650));
    }();
    int const width = lab.pixels(480);
    std::vector<SheetRow> rows;
    for (char const* glass : {"sf11", "bk7"}) {
        std::string const name = std::string("glass-") + (glass == std::string("sf11") ? "SF11" : "BK7");
        Picture const p = render_picture(Arrangement(name).setup(width, std::max(4, width / 12), half,
                                                                 0.1 * kDegree, "\"blackbody L\" 6500"),
                                         kDirectives, lab.passes(1024), 1);
        rows.push_back({glass, {p}, 0.7 * exposure_for(p, 0.995)});
    }
    show_sheet(lab, "spectrum.png", "The spectrum of a white slit through prisms of dense flint and of crown",
               {}, rows);
}

void table_top(Lab const& lab) {
    SheetRow row{"", {}, 1};
    Setup setup{prepare_file("prism.pbrt")};
    int const width = lab.pixels(200);
    setup.settings.film.resolution = {width, width * 3 / 4};
    for (ColorMode const mode : {ColorMode::Spectral, ColorMode::Rgb}) {
        setup.settings.color = mode;
        row.pictures.push_back(render_picture(
            setup, "Integrator \"path\" \"integer maxdepth\" 16\nSampler \"zsobol\"", lab.passes(256), 1));
    }
    row.exposure = exposure_for(row.pictures[1], 0.985);
    show_sheet(lab, "prism.png", "A lamp seen through a prism, in spectral mode and in rgb mode",
               {"spectral", "rgb"}, {row});
}

}  // namespace

void prism(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "`scenes/prism.pbrt`: a lamp seen past a prism of dense flint and through it. In rgb mode a glass "
        "has "
        "one index, and the strip stays white.");
    table_top(lab);
    page.subsection("Against Snell's law");
    page.text(
        "An equilateral prism in front of the camera, and a white slit so far away that all its light comes "
        "from one direction: dense flint (SF11) and crown (BK7), at one scale.");
    spectra(lab);
    page.text(
        "Where the slit is seen at a wavelength has a closed form: light leaves the right face at the angle "
        "that the slit has, and Snell's law, twice, with the glass's index, says at which angle it came.");
    angles(lab);
}

}  // namespace nephroid::experiment
