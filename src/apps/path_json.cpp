#include "path_json.h"

#include "names.h"
#include "path_words.h"

namespace nephroid::cli {

namespace {

nlohmann::json json_of(Vec3 v) { return {v.x, v.y, v.z}; }
nlohmann::json json_of(Spectrum s) { return {s[0], s[1], s[2], s[3]}; }

nlohmann::json json_of(Scene const& scene, PathVertex const& v) {
    nlohmann::json j{{"parent", v.parent < 0 ? "x0" : vertex_label(static_cast<std::size_t>(v.parent))},
                     {"direction", json_of(v.direction)},
                     {"betaOnArrival", json_of(v.beta)},
                     {"end", end_text(v.end)}};
    if (v.surface) {
        j["distance"] = v.distance;
        j["position"] = json_of(v.p);
        j["normal"] = json_of(v.ng);
        j["shadingNormal"] = json_of(v.ns);
        j["shape"] = v.shape;
        j["object"] = scene.locate(v.object);
    }
    if (v.material.valid()) {
        Material const& m = scene[v.material];
        j["material"] = {{"kind", name_of(m.kind)}, {"name", m.name}, {"where", scene.locate(m.where)}};
    }
    j["scatterings"] = nlohmann::json::array();
    for (Scattering const& s : v.scatterings)
        j["scatterings"].push_back({{"kind", kind_text(s)},
                                    {"direction", json_of(s.wi)},
                                    {"pdf", s.pdf},
                                    {"heroOnly", s.hero_only},
                                    {"survival", s.survival},
                                    {"survived", s.survived},
                                    {"beta", json_of(s.beta)}});
    return j;
}

}  // namespace

nlohmann::json to_json(RenderJob const& job, PathRecord const& r) {
    Scene const& scene = job.world().scene();
    nlohmann::json j{
        {"pass", r.pass},
        {"pixel", {r.pixel.x, r.pixel.y}},
        {"film", {r.film.x, r.film.y}},
        {"integrator", name_of(job.settings().integrator)},
        {"seed", job.settings().seed},
        {"camera",
         {{"origin", json_of(r.ray.o)}, {"direction", json_of(r.ray.d)}, {"weight", r.camera_weight}}},
        {"value", json_of(r.value)},
        {"filterWeight", r.weight},
        {"radiance", json_of(r.seen.total())}};
    if (r.lambda.is_rgb())
        j["wavelengths"] = "rgb";
    else
        j["wavelengths"] = {r.lambda.lambda(0), r.lambda.lambda(1), r.lambda.lambda(2), r.lambda.lambda(3)};
    for (char const* list : {"vertices", "lightsSampled", "lightsMet"}) j[list] = nlohmann::json::array();
    for (std::size_t i = 0; i < r.vertices.size(); ++i) {
        j["vertices"].push_back(json_of(scene, r.vertices[i]));
        j["vertices"].back()["name"] = vertex_label(i);
    }
    for (LightTried const& t : r.tried) {
        nlohmann::json one{{"vertex", vertex_label(t.vertex)},
                           {"direction", json_of(t.wi)},
                           {"pdf", t.pdf},
                           {"delta", t.delta},
                           {"passing", t.passing},
                           {"weight", t.weight},
                           {"class", class_text(t.path_class)},
                           {"contribution", json_of(t.contribution)},
                           {"rgb", json_of(t.rgb)}};
        if (!t.at_infinity) one["position"] = json_of(t.p);
        j["lightsSampled"].push_back(std::move(one));
    }
    for (LightMet const& m : r.met) {
        nlohmann::json one{{"vertex", vertex_label(m.vertex)},
                           {"light", scene.locate(m.sky ? scene[m.light].where : m.object)},
                           {"weight", m.weight},
                           {"lightPdf", m.light_pdf},
                           {"class", class_text(m.path_class)},
                           {"contribution", json_of(m.contribution)},
                           {"rgb", json_of(m.rgb)}};
        if (!m.sky) one["position"] = json_of(m.p);
        j["lightsMet"].push_back(std::move(one));
    }
    return j;
}

}  // namespace nephroid::cli
