#include "path_trace.h"

#include "scene/shape_name.h"

namespace nephroid {

namespace {

ScatterKind kind_of(Vertex const& v, BsdfSample const& s) {
    if (s.delta) return ScatterKind::Specular;
    bool const lambertian = std::holds_alternative<DiffuseBsdf>(v.bsdf) ||
                            std::holds_alternative<DiffuseTransmissionBsdf>(v.bsdf);
    return lambertian ? ScatterKind::Diffuse : ScatterKind::Glossy;
}

}  // namespace

void PathTrace::begins(PathContext const& c, Vec2 film, CameraRay const& camera) {
    job_ = &c.job;
    record_.film = film;
    record_.ray = camera.ray;
    record_.camera_weight = camera.weight;
    record_.lambda = c.lambda;
}

void PathTrace::ends(SeenLight const& seen, Vec3 value, float filter_weight) {
    record_.seen = seen;
    // As the render adds them up: what was met, and to it what was lit.
    record_.sum = met_;
    record_.sum += lit_;
    record_.value = value;
    record_.weight = filter_weight;
    auto const rgb = [&](Spectrum s) { return job_->sensor()(s * record_.camera_weight, record_.lambda); };
    for (LightTried& t : record_.tried) t.rgb = rgb(t.contribution);
    for (LightMet& m : record_.met) m.rgb = rgb(m.contribution);
}

PathVertex& PathTrace::add(Walk const& walk) {
    PathVertex v;
    v.id = walk.vertex;
    v.parent = at_;
    v.direction = walk.ray.d;
    v.beta = walk.beta;
    at_ = static_cast<int>(record_.vertices.size());
    return record_.vertices.emplace_back(v);
}

void PathTrace::met_light(Walk const& walk, SurfaceHit const& hit, Spectrum seen, float weight,
                          float light_pdf) {
    LightMet m;
    m.vertex = static_cast<std::uint32_t>(record_.vertices.size());  // on the way to the next one
    m.object = job_->world().object_at(hit).where;
    m.p = hit.s.p;
    m.weight = weight;
    m.light_pdf = light_pdf;
    m.path_class = walk.path_class.ends_on_light();
    m.contribution = seen;
    met_[m.path_class] += seen;
    record_.met.push_back(m);
}

void PathTrace::met_sky(Walk const& walk, LightId light, Spectrum seen, float weight, float light_pdf) {
    LightMet m;
    m.vertex = static_cast<std::uint32_t>(record_.vertices.size() - 1);
    m.sky = true;
    m.light = light;
    m.weight = weight;
    m.light_pdf = light_pdf;
    m.path_class = walk.path_class.ends_on_light();
    m.contribution = seen;
    met_[m.path_class] += seen;
    record_.met.push_back(m);
}

void PathTrace::left(Walk const& walk) {
    PathVertex& v = add(walk);
    v.surface = false;
    v.end = PathEnd::LeftScene;
}

void PathTrace::arrived(Walk const& walk, Vertex const& v) {
    Vec3 const before = at_ < 0 ? record_.ray.o : here().p;
    PathVertex& reached = add(walk);
    Object const& object = job_->world().object_at(v.hit);
    reached.p = v.hit.s.p;
    reached.distance = length(reached.p - before);
    reached.ng = v.hit.s.ng;
    reached.ns = v.hit.s.ns;
    reached.material = v.material;
    reached.object = object.where;
    reached.shape = name_of(object.shape);
    reached.end = PathEnd::NoScattering;
}

void PathTrace::scatters(Vertex const& v) {
    PathVertex& from = here();
    from.ns = v.hit.s.ns;
    from.specular = v.is.delta;
    from.near_specular = v.is.near_specular;
    from.end = PathEnd::Length;
}

LightTried& PathTrace::try_light(Walk const& walk, LightSample const& light) {
    LightTried t;
    t.vertex = static_cast<std::uint32_t>(at_);
    t.p = light.p;
    t.wi = light.wi;
    t.at_infinity = light.at_infinity;
    t.delta = light.delta;
    t.pdf = light.pdf;
    t.path_class = walk.path_class.ends_after(here().near_specular);
    return record_.tried.emplace_back(t);
}

void PathTrace::occluded(Walk const& walk, LightSample const& light) { try_light(walk, light); }

void PathTrace::lit(Walk const& walk, LightSample const& light, Spectrum direct, float weight,
                    float passing) {
    LightTried& t = try_light(walk, light);
    t.weight = weight;
    t.passing = passing;
    t.contribution = walk.beta * direct;
    lit_[t.path_class] += t.contribution;
}

void PathTrace::scattered(PathContext const& c, Walk const& walk, Vertex const& v, BsdfSample const& s,
                          Vec3 wi) {
    PathVertex& from = here();
    Scattering& made = from.scatterings.emplace_back();
    made.kind = kind_of(v, s);
    made.transmitted = s.transmitted;
    made.hero_only = s.keep_hero;
    made.wi = wi;
    made.pdf = s.proportional ? pdf(v.bsdf, v.wo_local, s.wi, c.hemisphere) : s.pdf;
    made.beta = walk.beta;
    from.end = walk.beta.is_black()    ? PathEnd::Absorbed
               : walk.beta.is_finite() ? PathEnd::GoesOn
                                       : PathEnd::NotANumber;
}

void PathTrace::absorbed() {
    if (here().scatterings.empty()) here().end = PathEnd::Absorbed;
}

void PathTrace::chance(float survival, bool died) {
    Scattering& s = here().scatterings.back();
    s.survival = survival;
    s.survived = !died;
    if (died)
        here().end = PathEnd::Roulette;
    else
        s.beta /= survival;
}

}  // namespace nephroid
