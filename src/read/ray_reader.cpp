#include "ray_reader.h"

#include "number.h"
#include "params.h"
#include "scene/match.h"
#include "shown.h"

#include <algorithm>
#include <utility>

namespace nephroid {

namespace {

constexpr int kMaxDepth = 500;                   // the reader calls itself for each
constexpr std::size_t kMaxObjects = 20'000'000;  // 400 bytes each, from as few as 5 in the file
constexpr std::array<std::string_view, 4> kTransforms{"translate", "rotate", "scale", "transform"};

/// What students added to their programs. There is no common form of any.
constexpr std::array<std::string_view, 16> kExtensions{
    "skybox",     "csg",         "metaball",    "spot_light", "shape_light", "paraboloid",
    "hyperbolic", "hyperboloid", "meteorite",   "torus",      "heightfield", "particle_system",
    "fog",        "sky",         "environment", "texture"};

template <class List>
bool has(List const& list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

Bounds3 bounds_of(Shape const& shape) {
    Bounds3 b;
    match(
        shape,
        [&](TriangleMesh const& m) {
            for (auto const& t : m.triangles)
                for (int k = 0; k < 3; ++k) b.add(m.p[static_cast<std::size_t>(t[k])]);
        },
        [&](Sphere const& s) { b.add(Vec3{s.radius}), b.add(Vec3{-s.radius}); },
        [&](Cylinder const& c) {
            b.add({-c.radius, -c.radius, c.z_min}), b.add({c.radius, c.radius, c.z_max});
        },
        [&](Disk const& d) {
            b.add({-d.radius, -d.radius, d.height}), b.add({d.radius, d.radius, d.height});
        },
        [&](Box const& x) { b.add(x.lo), b.add(x.hi); },
        [&](Quad const& q) {
            b.add(q.origin), b.add(q.origin + q.edge_u), b.add(q.origin + q.edge_v);
            b.add(q.origin + q.edge_u + q.edge_v);
        },
        [](auto const&) {});
    return b;
}

}  // namespace

RayReader::RayReader(std::string_view text, std::string const& shown, std::filesystem::path folder)
    : file_{context_.add_file(shown, std::move(folder)), 0},
      in_(context_, file_.file, text),
      shapes_(in_, materials_),
      lights_(in_),
      camera_(in_),
      mapper_(context_),
      default_(std::make_shared<Phong const>(Phong{.where = {file_.file, 1}})) {}

void RayReader::header() {
    if (!in_.peek().is("SBT-raytracer")) in_.expected("\"SBT-raytracer 1.1\", which begins a .ray file,");
    in_.take();
    auto const where = in_.here();
    auto const text = in_.peek().text;
    double const version = in_.number();
    if (version != 0.9 && version != 1.0 && version != 1.1)
        context_.fail(where, "version " + shown(text, 40) + " is not known: 0.9, 1.0 and 1.1 are read");
}

bool RayReader::skip_unsupported() {
    if (in_.peek().kind != RayToken::Kind::Name || !has(kExtensions, in_.peek().text)) return false;
    context_.note(in_.here(),
                  std::string(in_.peek().text) + " is an extension that is not rendered: left out");
    in_.take();
    in_.take_if('=');
    if (!in_.peek().is('{') && !in_.peek().is('(')) in_.expected("\"{\" or \"(\"");
    in_.skip_nest();
    return true;
}

void RayReader::unknown(bool top) const {
    if (in_.peek().kind != RayToken::Kind::Name)
        in_.expected(top ? "a camera, a light, a material or geometry" : "geometry, a transform or a group");
    std::vector<std::string> names = RayShapes::names();
    names.insert(names.end(), kTransforms.begin(), kTransforms.end());
    if (top)
        names.insert(names.end(),
                     {"camera", "ambient_light", "directional_light", "point_light", "area_light"});
    names.emplace_back("material");
    auto const word = in_.peek().text;
    auto const belongs = RayLights::is_light(word) || word == "camera";
    in_.fail(belongs ? std::string(word) + " must not stand inside a transform or group; move it out"
                     : "unknown object \"" + shown(word, 40) + "\"" + which_to_use(word, names));
}

void RayReader::top_level() {
    auto const& next = in_.peek();
    if (next.is("camera")) {
        in_.take();
        camera_.read();
    } else if (next.is("material")) {
        top_material();
    } else if (next.kind == RayToken::Kind::Name && RayLights::is_light(next.text)) {
        auto const name = in_.take().text;
        lights_.read(name);
    } else if (!skip_unsupported()) {
        bool const known =
            next.is('{') || (next.kind == RayToken::Kind::Name &&
                             (has(RayShapes::names(), next.text) || has(kTransforms, next.text)));
        if (!known) unknown(true);
        element({}, default_, 0);
    }
}

/// With "=" it is what follows is made of; without, it only gets its name.
void RayReader::top_material() {
    auto const where = in_.here();
    in_.take();
    bool const sets = in_.take_if('=');
    auto const phong = materials_.read(in_, default_);
    if (sets) {
        default_ = phong;
    } else if (phong->name.empty()) {
        context_.fail(where,
                      "this material has no name, and is of no use; give it one, or write \"material =\"");
    }
}

void RayReader::element(Mat4 const& to_world, SharedPhong const& parent, int depth) {
    if (depth > kMaxDepth)
        throw Error(ErrorKind::Limit, context_.scene.locate(in_.here()) +
                                          ": transforms and groups are nested more than " +
                                          std::to_string(kMaxDepth) + " deep");
    if (in_.peek().is('{')) return group(to_world, parent, depth);
    if (skip_unsupported()) return;
    bool const name = in_.peek().kind == RayToken::Kind::Name;
    if (name && has(kTransforms, in_.peek().text))
        return transformed(in_.take().text, to_world, parent, depth);
    if (name && has(RayShapes::names(), in_.peek().text)) return geometry(in_.take().text, to_world, parent);
    unknown(false);
}

void RayReader::group(Mat4 const& to_world, SharedPhong parent, int depth) {
    auto const open = in_.here();
    in_.need('{');
    while (!in_.take_if('}')) {
        if (in_.take_if(';')) continue;
        if (in_.peek().kind == RayToken::Kind::End) in_.not_closed(open, '{');
        if (in_.peek().is("material")) {
            in_.take();
            in_.need('=');
            parent = materials_.read(in_, parent);
        } else {
            element(to_world, parent, depth + 1);
        }
    }
}

Mat4 RayReader::transform_of(std::string_view name) {
    auto const where = in_.here();
    auto const next = [&] {
        double const x = in_.number();
        in_.need(',');
        return x;
    };
    if (name == "transform") {
        Mat4 m;
        for (auto& row : m.m) {
            row = in_.numbers<4>();
            in_.need(',');
        }
        if (!is_affine(m)) context_.fail(where, "the last row of a transform must be (0, 0, 0, 1)");
        return m;
    }
    double const x = next();
    if (name == "scale" && in_.peek().kind != RayToken::Kind::Number) return scale(x, x, x);
    double const y = next(), z = next();
    if (name == "scale") return scale(x, y, z);
    if (name == "translate") return translate(x, y, z);
    double const turn = next();
    auto const m = rotate(turn * (180 / kPiDouble), x, y, z);
    if (!m) context_.fail(where, "the axis of a rotation must not be (0, 0, 0)");
    return *m;
}

void RayReader::transformed(std::string_view name, Mat4 const& to_world, SharedPhong const& parent,
                            int depth) {
    auto const where = in_.here();
    in_.need('(');
    auto const m = to_world * transform_of(name);
    for (auto const& row : m.m)
        for (double const x : row)
            if (!std::isfinite(x)) context_.fail(where, "the transforms overflow here; use smaller numbers");
    element(m, parent, depth + 1);
    while (in_.take_if(';')) {
    }
    in_.need(')');
}

void RayReader::geometry(std::string_view name, Mat4 const& to_world, SharedPhong const& parent) {
    auto const where = in_.here();
    auto const transform = make_transform(to_world);  // none: flat, and left out later with a note
    auto& objects = context_.scene.world().objects;
    for (auto& piece : shapes_.read(name, parent)) {
        if (objects.size() >= kMaxObjects)
            throw Error(ErrorKind::Limit,
                        context_.scene.locate(where) + ": more than twenty million objects");
        if (transform) {
            auto const box = bounds_of(piece.shape);
            if (!box.empty()) bounds_.add(transform->bounds(box));
        }
        auto const surface = mapper_.surface(*piece.phong, piece.open);
        Object object;
        object.shape = std::move(piece.shape);
        object.to_group = to_world;
        object.material = surface.material;
        object.light = surface.light;
        object.reverse_orientation = piece.reverse_orientation;
        object.where = where;
        objects.push_back(std::move(object));
    }
}

Scene RayReader::read() {
    header();
    while (in_.peek().kind != RayToken::Kind::End)
        if (!in_.take_if(';')) top_level();
    return finish();
}

Scene RayReader::finish() {
    camera_.finish(file_);
    lights_.finish(bounds_);
    if (lights_.ambient())
        for (auto const where : mapper_.other_ambient())
            context_.note(
                where,
                "ambient differs from diffuse: the sky of ambient_light is reflected as \"diffuse\" says");
    auto& settings = context_.scene.settings;
    settings.integrator = PathIntegrator{.max_depth = 10};  // glass takes many
    settings.color = ColorMode::Rgb;  // the format means red, green and blue by its numbers
    settings.color_given = true;
    settings.spp = 64;
    context_.finish_notes();
    return std::move(context_.scene);
}

}  // namespace nephroid
