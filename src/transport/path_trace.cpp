#include "path_trace.h"

#include "scene/match.h"

namespace nephroid {

namespace {

char const* name_of(Shape const& shape) {
    return match(
        shape, [](TriangleMesh const&) { return "trianglemesh"; },
        [](BilinearMesh const&) { return "bilinearmesh"; },
        [](LoopSubdivision const&) { return "loopsubdiv"; }, [](Sphere const&) { return "sphere"; },
        [](Cylinder const&) { return "cylinder"; }, [](Disk const&) { return "disk"; },
        [](Box const&) { return "box"; }, [](Quad const&) { return "quad"; });
}

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
    record_.value = value;
    record_.weight = filter_weight;
    auto const rgb = [&](Spectrum s) { return job_->sensor()(s * record_.camera_weight, record_.lambda); };
    for (LightTried& t : record_.tried) t.rgb = rgb(t.contribution);
    for (LightMet& m : record_.met) m.rgb = rgb(m.contribution);
}

PathVertex& PathTrace::vertex(std::uint32_t id) {
    std::size_t i = record_.vertices.size() - 1;
    while (i > 0 && record_.vertices[i].id != id) --i;
    return record_.vertices[i];
}

PathVertex& PathTrace::add(Walk const& walk) {
    PathVertex v;
    v.id = walk.vertex;
    if (v.id > 0) {
        bool const tree = std::holds_alternative<WhittedIntegrator>(job_->settings().integrator);
        std::uint32_t const before = !tree ? v.id - 1 : v.id / 2 > 1 ? v.id / 2 : 0;
        v.parent = static_cast<int>(&vertex(before) - record_.vertices.data());
    }
    v.direction = walk.ray.d;
    v.beta = walk.beta;
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
    record_.sum[m.path_class] += seen;
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
    record_.sum[m.path_class] += seen;
    record_.met.push_back(m);
}

void PathTrace::left(Walk const& walk) {
    PathVertex& v = add(walk);
    v.surface = false;
    v.end = PathEnd::LeftScene;
}

void PathTrace::arrived(Walk const& walk, Vertex const& v) {
    PathVertex& here = add(walk);
    Vec3 const before =
        here.parent < 0 ? record_.ray.o : record_.vertices[static_cast<std::size_t>(here.parent)].p;
    Object const& object = job_->world().object_at(v.hit);
    here.p = v.hit.s.p;
    here.distance = length(here.p - before);
    here.ng = v.hit.s.ng;
    here.ns = v.hit.s.ns;
    here.material = v.material;
    here.object = object.where;
    here.shape = name_of(object.shape);
    here.end = PathEnd::NoScattering;
}

void PathTrace::scatters(Walk const& walk, Vertex const& v) {
    PathVertex& here = vertex(walk.vertex);
    here.ns = v.hit.s.ns;
    here.specular = v.is.delta;
    here.near_specular = v.is.near_specular;
    here.end = PathEnd::Length;
}

LightTried& PathTrace::try_light(Walk const& walk, LightSample const& light) {
    LightTried t;
    t.vertex = static_cast<std::uint32_t>(&vertex(walk.vertex) - record_.vertices.data());
    t.p = light.p;
    t.wi = light.wi;
    t.at_infinity = light.at_infinity;
    t.delta = light.delta;
    t.pdf = light.pdf;
    t.path_class = walk.path_class.ends_after(record_.vertices[t.vertex].near_specular);
    return record_.tried.emplace_back(t);
}

void PathTrace::occluded(Walk const& walk, LightSample const& light) { try_light(walk, light); }

void PathTrace::lit(Walk const& walk, LightSample const& light, Spectrum direct, float weight,
                    float passing) {
    LightTried& t = try_light(walk, light);
    t.weight = weight;
    t.passing = passing;
    t.contribution = walk.beta * direct;
    record_.sum[t.path_class] += t.contribution;
}

void PathTrace::scattered(PathContext const& c, Walk const& walk, Vertex const& v, BsdfSample const& s,
                          Vec3 wi) {
    PathVertex& here = vertex(walk.vertex);
    Scattering& made = here.scatterings.emplace_back();
    made.kind = kind_of(v, s);
    made.transmitted = s.transmitted;
    made.hero_only = s.keep_hero;
    made.wi = wi;
    made.pdf = s.proportional ? pdf(v.bsdf, v.wo_local, s.wi, c.hemisphere) : s.pdf;
    made.beta = walk.beta;
    here.end = walk.beta.is_black()    ? PathEnd::Absorbed
               : walk.beta.is_finite() ? PathEnd::GoesOn
                                       : PathEnd::NotANumber;
}

void PathTrace::absorbed(Walk const& walk) {
    PathVertex& here = vertex(walk.vertex);
    if (here.scatterings.empty()) here.end = PathEnd::Absorbed;
}

void PathTrace::chance(std::uint32_t id, float survival, bool died) {
    PathVertex& here = vertex(id);
    Scattering& s = here.scatterings.back();
    s.survival = survival;
    s.survived = !died;
    if (died)
        here.end = PathEnd::Roulette;
    else
        s.beta /= survival;
}

}  // namespace nephroid
