// The directional albedo of surfaces that absorb nothing, by sampling the scattering functions themselves.
#include "sections.h"

#include "measure.h"
#include "model/material.h"
#include "plot.h"
#include "sampling/hash.h"
#include "stage.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::experiment {

namespace {

constexpr std::array kAlphas{0.05, 0.1, 0.2, 0.5, 1.0};
constexpr std::array kAngles{0.0,  10.0, 20.0, 30.0, 40.0, 50.0, 60.0,
                             65.0, 70.0, 75.0, 80.0, 84.0, 87.0, 89.0};

/// Only the material of this scene is looked at.
Setup holder(std::string const& material) {
    return faithful(
        "Option \"string color\" \"rgb\"\nWorldBegin\nLightSource \"infinite\"\n"
        "MakeNamedMaterial \"looked at\" " +
            material + "\nNamedMaterial \"looked at\"\n" + stage::unit_sphere(),
        ".");
}

Bsdf bsdf_of(World const& world) {
    auto const& materials = world.scene().materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        Bsdf b;
        if (materials[i].name == "looked at" &&
            make_bsdf(world.assets(), MaterialId{static_cast<std::uint32_t>(i)}, TexturePoint{},
                      Wavelengths::rgb(), b))
            return b;
    }
    throw std::runtime_error("no material to look at");
}

/// Mean of f cos / pdf over samples: all the light that is scattered of light from this angle. Importance, so that energy is
/// counted, which radiance is not where it is squeezed into glass.
Estimate albedo_by_samples(Bsdf const& bsdf, double degrees, std::uint64_t samples) {
    double const theta = degrees * std::numbers::pi / 180;
    Vec3 const wo{static_cast<float>(std::sin(theta)), 0, static_cast<float>(std::cos(theta))};
    double sum = 0;
    double square = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
        auto const unit = [&](std::uint64_t dimension) {
            return to_unit_float(static_cast<std::uint32_t>(hash_keys(0xf0e2ace, i, dimension)));
        };
        auto const s =
            sample(bsdf, wo, unit(0), {unit(1), unit(2)}, Mode::Importance, HemisphereSampling::Cosine);
        double const v = s && s->pdf > 0 ? static_cast<double>(s->f[1] * abs_cos_theta(s->wi) / s->pdf) : 0;
        sum += v, square += v * v;
    }
    auto const n = static_cast<double>(samples);
    double const m = sum / n;
    return {m, std::sqrt(std::max(0.0, square / n - m * m) / n)};
}

struct Furnace {
    std::string title, file;
    std::string material;  // with {} where alpha goes
};

std::vector<Furnace> furnaces() {
    std::string const raw = R"( "bool remaproughness" false)";
    std::string const comp = R"( "bool multiscatter" true)";
    std::string const metal =
        R"("string type" "conductor" "rgb eta" [ 0 0 0 ] "rgb k" [ 0 0 0 ] "float roughness" {})" + raw;
    std::string const glass = R"("string type" "dielectric" "float roughness" {})" + raw;
    std::string const coat =
        R"("string type" "coateddiffuse" "rgb reflectance" [ 1 1 1 ] "float roughness" {} "float thickness" 0.0001 "integer maxdepth" 255 "string layers" )";
    std::string const coated_metal =
        R"("string type" "coatedconductor" "rgb conductor.eta" [ 0 0 0 ] "rgb conductor.k" [ 0 0 0 ] "float conductor.roughness" 0.2 "float interface.roughness" {} "float thickness" 0.0001 "integer maxdepth" 255 "string layers" )";
    std::string const plastic =
        R"("string type" "plastic" "rgb reflectance" [ 1 1 1 ] "float roughness" {})" + raw;
    return {{"conductor, F = 1", "furnace-conductor.svg", metal},
            {"conductor, F = 1, compensated", "furnace-conductor-compensated.svg", metal + comp},
            {"dielectric, 1.5", "furnace-dielectric.svg", glass},
            {"dielectric, 1.5, compensated", "furnace-dielectric-compensated.svg", glass + comp},
            {"coateddiffuse, white, random walks", "furnace-coated-walks.svg", coat + "\"stochastic\"" + raw},
            {"coateddiffuse, white, closed form", "furnace-coated-closed.svg", coat + "\"closed\"" + raw},
            {"coatedconductor, F = 1, alpha 0.2, random walks", "furnace-coated-metal-walks.svg",
             coated_metal + "\"stochastic\"" + raw},
            {"coatedconductor, F = 1, alpha 0.2, closed form", "furnace-coated-metal-closed.svg",
             coated_metal + "\"closed\"" + raw},
            {"plastic, white", "furnace-plastic.svg", plastic}};
}

/// A table of what is largest over the angles, a row a surface and a column an alpha.
class Summary {
  public:
    void begin(std::string const& title) { row_ = {title}, worst_ = {}, most_ = {}; }
    void add(double alpha, double angle, double value) {
        if (std::abs(value) > std::abs(most_)) most_ = value;
        if (std::abs(value) <= std::abs(worst_)) return;
        worst_ = value;
        where_ = fmt::format("alpha {}, {}°", alpha, angle);
    }
    void end_alpha() { row_.push_back(fixed(most_, 4)), most_ = 0; }
    void end() { row_.push_back(where_), rows_.push_back(row_); }
    void write(Page& page) const {
        std::vector<std::string> head{""};
        for (double const a : kAlphas) head.push_back(fmt::format("alpha {}", a));
        head.emplace_back("largest at");
        page.table(head, rows_);
    }

  private:
    std::vector<std::vector<std::string>> rows_;
    std::vector<std::string> row_;
    std::string where_;
    double worst_ = 0, most_ = 0;
};

std::string with_alpha(std::string material, double alpha) {
    return material.replace(material.find("{}"), 2, number(alpha, 3));
}

}  // namespace

void white_furnace(Lab const& lab) {
    Page& page = lab.page;
    std::uint64_t const samples = lab.quick ? 256 : 1 << 17;
    page.text(fmt::format(
        "The directional albedo: what is scattered at all of light from one direction, the mean of f·|cos|/p "
        "over {} samples of the scattering function. Nothing here absorbs, so that 1 is right. (A coat is a "
        "layer that takes some light even without a medium, in proportion to its thickness, as in pbrt-v4: "
        "here it is 0.0001 thick.)",
        samples));
    Summary deviation;
    std::vector<std::vector<Line>> all;
    double largest_error = 0;
    for (Furnace const& f : furnaces()) {
        std::vector<Line> lines;
        deviation.begin(f.title);
        for (double const alpha : kAlphas) {
            Setup const setup = holder(with_alpha(f.material, alpha));
            Bsdf const bsdf = bsdf_of(setup.world);
            Line line{fmt::format("alpha {}", alpha), {}, {}, {}};
            for (double const angle : kAngles) {
                Estimate const e = albedo_by_samples(bsdf, angle, samples);
                line.x.push_back(angle), line.y.push_back(e.mean);
                largest_error = std::max(largest_error, e.error);
                deviation.add(alpha, angle, e.mean - 1);
            }
            deviation.end_alpha();
            lines.push_back(std::move(line));
        }
        deviation.end();
        page.save(f.file, line_plot(f.title, {"angle of incidence, degrees", false, {0, 20, 40, 60, 80}},
                                    {"directional albedo", false}, lines));
        page.image(f.file, "Directional albedo over the angle: " + f.title);
        all.push_back(std::move(lines));
    }
    page.text(fmt::format(
        "The largest deviation from 1 over {} angles from 0° to 89° (standard errors are at most {}):",
        kAngles.size(), number(largest_error, 2)));
    deviation.write(page);
    page.text(
        "A rough coat takes its share each time that light passes it or is thrown back by it from inside, "
        "and "
        "light below a coat meets it again and again: what is lost is many times what a single boundary "
        "loses. "
        "Closed forms against random walks:");
    Summary difference;
    for (std::size_t const walks : {4u, 6u}) {
        difference.begin(walks == 4 ? "coateddiffuse, closed form less walks"
                                    : "coatedconductor, closed form less walks");
        for (std::size_t k = 0; k < kAlphas.size(); ++k) {
            for (std::size_t i = 0; i < kAngles.size(); ++i)
                difference.add(kAlphas[k], kAngles[i], all[walks + 1][k].y[i] - all[walks][k].y[i]);
            difference.end_alpha();
        }
        difference.end();
    }
    difference.write(page);
    page.text(
        "[Decision 7](../decisions/0007-coats-in-closed-form.md) says where closed forms are the default; it "
        "measured them over copper and over diffuse bases of 0.2 and 0.8. White bases, as here, are the "
        "hardest case: nothing but the coat takes light, however often it comes back.");
}

}  // namespace nephroid::experiment
