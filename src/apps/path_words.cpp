#include "path_words.h"

#include "names.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::cli {

namespace {

std::string light_text(Scene const& scene, LightMet const& m) {
    if (m.sky)
        return fmt::format("the {} light, {}", name_of(scene[m.light].kind),
                           scene.locate(scene[m.light].where));
    return fmt::format("the lamp, {}", scene.locate(m.object));
}
std::string place_text(LightTried const& t) {
    return t.at_infinity ? fmt::format("towards {}", numbers_text(t.wi))
                         : fmt::format("at {}", numbers_text(t.p));
}

void add_vertex(std::string& text, RenderJob const& job, PathRecord const& r, std::size_t i) {
    Scene const& scene = job.world().scene();
    PathVertex const& v = r.vertices[i];
    // In a tree it is not always the one above.
    std::string const from = v.parent + 1 == static_cast<int>(i)
                                 ? ""
                                 : fmt::format(" from {}", vertex_label(static_cast<std::size_t>(v.parent)));
    if (v.surface) {
        text += fmt::format("{:<4}{}  {}\n", vertex_label(i), numbers_text(v.p), surface_text(scene, v));
        text += fmt::format("    {:.4g} along the ray{}; normal {}", v.distance, from, numbers_text(v.ng));
        if (!(v.ns == v.ng)) text += fmt::format(", of shading {}", numbers_text(v.ns));
        text += "\n";
    } else {
        text += fmt::format("{:<4}out of the scene{}, towards {}\n", vertex_label(i), from,
                            numbers_text(v.direction));
    }
    for (LightMet const& m : r.met)
        if (m.vertex == i)
            text += fmt::format("    meets {}: weight {:.3g}, adds {} ({})\n", light_text(scene, m), m.weight,
                                numbers_text(m.rgb), class_text(m.path_class));
    for (LightTried const& t : r.tried) {
        if (t.vertex != i) continue;
        text += fmt::format("    asks for the light {}: ", place_text(t));
        if (t.passing == 0) {
            text += "occluded\n";
            continue;
        }
        if (t.passing < 1) text += fmt::format("{:.3g} of it passes, ", t.passing);
        text += fmt::format("pdf {:.3g}, weight {:.3g}, adds {} ({})\n", t.pdf, t.weight, numbers_text(t.rgb),
                            class_text(t.path_class));
    }
    for (Scattering const& s : v.scatterings) {
        text += fmt::format("    {}, pdf {:.3g}", kind_text(s), s.pdf);
        if (s.survival < 1)
            text += fmt::format(", {} with probability {:.3g}", s.survived ? "survives" : "does not survive",
                                s.survival);
        text += fmt::format(", beta {}\n", beta_text(s.beta, r.lambda));
    }
    if (v.end != PathEnd::GoesOn && v.end != PathEnd::LeftScene)
        text += fmt::format("    {}\n", end_text(v.end));
}

}  // namespace

std::string vertex_label(std::size_t index) { return fmt::format("x{}", index + 1); }
std::string numbers_text(Vec3 v) { return fmt::format("{:.3g} {:.3g} {:.3g}", v.x, v.y, v.z); }

std::string beta_text(Spectrum beta, Wavelengths const& lambda) {
    if (lambda.is_rgb()) return numbers_text({beta[0], beta[1], beta[2]});
    if (beta[1] == 0 && beta[2] == 0 && beta[3] == 0) return fmt::format("{:.3g} (hero)", beta[0]);
    return fmt::format("{:.3g} {:.3g} {:.3g} {:.3g}", beta[0], beta[1], beta[2], beta[3]);
}

std::string kind_text(Scattering const& s) {
    constexpr std::array kNames{"diffuse", "glossy", "specular"};
    return fmt::format("{} {}", kNames[static_cast<std::size_t>(s.kind)],
                       s.transmitted ? "transmission" : "reflection");
}

std::string end_text(PathEnd end) {
    constexpr std::array kTexts{
        "goes on",
        "leaves the scene",
        "ends: nothing scatters here",
        "ends: absorbed",
        "ends: by Russian roulette",
        "ends: NOT A NUMBER, the sample is dropped",
        "ends: the integrator asks no further",
    };
    return kTexts[static_cast<std::size_t>(end)];
}

std::string class_text(LightClass c) {
    constexpr std::array kNames{"direct", "caustic", "indirect", "specular"};
    return kNames[static_cast<std::size_t>(c)];
}

std::string surface_text(Scene const& scene, PathVertex const& v) {
    std::string text = fmt::format("{}, {}", v.shape, scene.locate(v.object));
    if (!v.material.valid()) return text + "; no material";
    Material const& m = scene[v.material];
    text += "; " + name_of(m.kind);
    if (!m.name.empty()) text += fmt::format(" \"{}\"", m.name);
    return text + ", " + scene.locate(m.where);
}

std::string path_table(RenderJob const& job, PathRecord const& r) {
    Settings const& s = job.settings();
    std::string text =
        fmt::format("pass {}, pixel {},{} of {}x{}: {}, seed {}, ", r.pass, r.pixel.x, r.pixel.y,
                    s.film.resolution.x, s.film.resolution.y, name_of(s.integrator), s.seed);
    if (r.lambda.is_rgb())
        text += "rgb\n";
    else
        text += fmt::format("at {:.1f} (the hero), {:.1f}, {:.1f}, {:.1f} nm\n", r.lambda.lambda(0),
                            r.lambda.lambda(1), r.lambda.lambda(2), r.lambda.lambda(3));
    text += fmt::format("x0  {}  the camera, through {:.2f},{:.2f} of the film, towards {}\n",
                        numbers_text(r.ray.o), r.film.x, r.film.y, numbers_text(r.ray.d));
    for (std::size_t i = 0; i < r.vertices.size(); ++i) add_vertex(text, job, r, i);
    text += fmt::format("the film adds {} with weight {:.4g}\n", numbers_text(r.value), r.weight);
    return text;
}

}  // namespace nephroid::cli
