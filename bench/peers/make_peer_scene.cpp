// From a scene of ours to what every renderer knows.
#include "peer_scene.h"
#include "tessellate.h"

#include "image/pyramid.h"
#include "image/read.h"
#include "math/error.h"
#include "model/fresnel.h"
#include "model/shape.h"
#include "scene/affine_rows.h"
#include "scene/match.h"
#include "spectrum/color.h"
#include "spectrum/runtime.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace nephroid::peers {

namespace {

Vec3 column(Mat4 const& m, std::size_t k) {
    return {static_cast<float>(m.m[0][k]), static_cast<float>(m.m[1][k]), static_cast<float>(m.m[2][k])};
}

class Maker {
  public:
    explicit Maker(Scene& scene) : scene_(scene) {}

    PeerScene make() {
        settings();
        camera();
        lights();
        group(0, to_peers_);
        return std::move(peer_);
    }

  private:
    [[noreturn]] void refuse(SourceLocation where, std::string const& what) const {
        scene_.fail(where, what + ": not every renderer knows it; leave it out of scenes for all of them");
    }
    /// A spectrum as our rgb mode takes it.
    Vec3 rgb(Spd const& spd, SpectrumRole role) { return store_.compile(spd, role).rgb(); }
    Vec3 emission(Spd const& spd, float scale, float target, SourceLocation where) {
        if (target >= 0) refuse(where, "a light given by its power or illuminance");
        double const y = photometric(spd);
        return y > 0 ? rgb(spd, SpectrumRole::Illuminant) * static_cast<float>(scale / y) : Vec3{0};
    }

    // ---- the picture ------------------------------------------------------------------------------------------------

    void settings() {
        Settings const& s = scene_.settings;
        if (s.film.iso * scene_.camera.exposure_time != 100)
            refuse(s.film.where, "a film of another speed than 100 at 1 s");
        if (s.film.white_balance > 0) refuse(s.film.where, "a white balance");
        if (s.film.crop) refuse(s.film.where, "a crop");
        peer_.resolution = s.film.resolution;
        peer_.depth = match(s.integrator, [](auto const& i) { return i.max_depth; });
    }
    void camera() {
        Camera const& c = scene_.camera;
        auto const* perspective = std::get_if<PerspectiveCamera>(&c.kind);
        if (!perspective) refuse(c.where, "a camera that is not \"perspective\"");
        if (perspective->lens_radius > 0) refuse(c.where, "a lens");
        if (c.screen_window || c.frame_aspect_ratio) refuse(c.where, "a screen window");
        // Seen through a left-handed camera the world is mirrored; then it is mirrored here, and the camera as others are.
        Vec3 const x = column(c.to_world, 0), y = column(c.to_world, 1), z = column(c.to_world, 2);
        if (dot(x, cross(z, y)) < 0) to_peers_ = scale(-1, 1, 1);
        Mat4 const placed = to_peers_ * c.to_world;
        peer_.camera = {column(placed, 3), normalize(column(placed, 0)), normalize(column(placed, 1)),
                        normalize(column(placed, 2)), perspective->fov};
    }

    // ---- light ------------------------------------------------------------------------------------------------------

    void lights() {
        for (Light const& light : scene_.lights) {
            auto const* sky = std::get_if<InfiniteLight>(&light.kind);
            if (!sky) refuse(light.where, "a light that is neither a surface nor \"infinite\"");
            if (sky->portal) refuse(light.where, "a portal");
            if (&light != &scene_.lights.front()) refuse(light.where, "a second sky");
            if (sky->image.valid())
                sky_picture(*sky, light);
            else
                peer_.sky = emission(sky->radiance, sky->scale, sky->illuminance, light.where);
        }
    }
    /// Turned until its pole is +z and its first column is at +x.
    void sky_picture(InfiniteLight const& sky, Light const& light) {
        if (sky.illuminance >= 0) refuse(light.where, "a light given by its illuminance");
        Pyramid const picture(read_image(scene_[sky.image].path));
        int const w = picture.level(0).width(), h = picture.level(0).height();
        if (sky.mapping == EnvironmentMapping::EqualArea || w != 2 * h)
            refuse(light.where, "a sky that is not by longitude and latitude, twice as wide as high");
        auto const to_world = make_transform(to_peers_ * light.to_world);
        if (!to_world) refuse(light.where, "a light that is squeezed flat");
        int const finer = is_identity(to_peers_ * light.to_world) ? 1 : 2;
        Image out(PixelFormat::Float, finer * w, finer * h, {"R", "G", "B"});
        float const half = 0.5f / static_cast<float>(h);
        for (int y = 0; y < out.height(); ++y)
            for (int x = 0; x < out.width(); ++x) {
                float const phi = kTwoPi * (static_cast<float>(x) + 0.5f) / static_cast<float>(out.width());
                float const theta = kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(out.height());
                Vec3 const d = to_world->vector_inverse(
                    {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
                float const u = std::atan2(d.y, d.x) / kTwoPi;
                float const v = std::atan2(std::hypot(d.x, d.y), d.z) / kPi;
                Vec3 const c =
                    picture.bilerp_rgb(0, {u < 0 ? u + 1 : u, clamp(v, half, 1 - half)}) * sky.scale;
                for (int k = 0; k < 3; ++k) out.set(x, y, k, max(c[k], 0.0f));
            }
        peer_.sky_picture = std::move(out);
    }

    // ---- surfaces ---------------------------------------------------------------------------------------------------

    std::optional<Vec3> constant(TextureId id) {
        if (!id.valid()) return std::nullopt;
        auto const& kind = scene_[id].kind;
        if (auto const* c = std::get_if<ConstantSpectrumTexture>(&kind)) return rgb(c->value, c->role);
        if (auto const* c = std::get_if<ConstantFloatTexture>(&kind)) return Vec3{c->value};
        if (auto const* s = std::get_if<ScaleTexture>(&kind)) {
            auto const a = constant(s->tex), b = constant(s->scale);
            if (a && b) return *a * *b;
        }
        return std::nullopt;
    }
    bool smooth(Roughness const& r) {
        auto const zero = [&](TextureId id) {
            if (!id.valid()) return true;
            auto const c = constant(id);
            return c && c->x < 1e-4f;
        };
        return zero(r.u) && zero(r.v);
    }
    struct Made {
        int surface = 0;
        Vec2 scale{1}, offset{0};  // of (u, v), to those of its picture
    };
    int add(PeerSurface const& s) {
        return peer_.surfaces.push_back(s), static_cast<int>(peer_.surfaces.size()) - 1;
    }
    int add(PeerPicture p) {
        peer_.pictures.push_back(std::move(p));
        return static_cast<int>(peer_.pictures.size()) - 1;
    }

    Made surface(MaterialId id, SourceLocation where) {
        if (!id.valid()) refuse(where, "a shape without a material");
        auto const known = made_.find(id.value);
        if (known != made_.end()) return known->second;
        Material const& m = scene_[id];
        if (m.displacement.valid() || m.normal_map.image.valid()) refuse(m.where, "bumps");
        Made const made = match(
            m.kind, [&](DiffuseMaterial const& d) { return diffuse(d, m.where); },
            [&](DielectricMaterial const& d) {
                if (!smooth(d.roughness)) refuse(m.where, "rough glass");
                if (!store_.compile(d.interior.absorption, SpectrumRole::Unbounded).is_black())
                    refuse(m.where, "absorption");
                // Glass whose index varies has that of green in all colours.
                return Made{
                    add({PeerSurface::Kind::Glass, Vec3{1}, -1, rgb(d.eta, SpectrumRole::Unbounded).y})};
            },
            [&](ConductorMaterial const& c) {
                if (!smooth(c.roughness)) refuse(m.where, "rough metal");
                return Made{add({PeerSurface::Kind::Mirror, reflectance(c, m.where)})};
            },
            [&](auto const&) -> Made {
                refuse(m.where, "a material that is neither diffuse nor smooth glass or metal");
            });
        return made_[id.value] = made;
    }
    Vec3 reflectance(ConductorMaterial const& c, SourceLocation where) {
        auto const need = [&](TextureId id) {
            auto const value = constant(id);
            if (!value) refuse(where, "a metal that varies");
            return *value;
        };
        if (c.reflectance.valid()) return need(c.reflectance);
        Vec3 const eta = need(c.eta), k = need(c.k);
        Vec3 r;
        for (int i = 0; i < 3; ++i) r[i] = fresnel_conductor(1.0f, eta[i], k[i]);
        return r;
    }
    Made diffuse(DiffuseMaterial const& d, SourceLocation where) {
        if (!d.reflectance.valid()) return {add({PeerSurface::Kind::Diffuse, Vec3{0.5f}})};
        if (auto const c = constant(d.reflectance)) return {add({PeerSurface::Kind::Diffuse, *c})};
        Texture const& t = scene_[d.reflectance];
        if (auto const* picture = std::get_if<ImageTexture>(&t.kind)) return pictured(*picture, t.where);
        if (auto const* board = std::get_if<CheckerboardTexture>(&t.kind)) return checked(*board, t.where);
        refuse(where, "a reflectance that is neither constant nor a picture nor a checkerboard");
    }
    UvMapping mapping(TextureMapping const& m, SourceLocation where) const {
        auto const* uv = std::get_if<UvMapping>(&m);
        if (!uv) refuse(where, "a texture that is not mapped by (u, v)");
        return *uv;
    }
    Made pictured(ImageTexture const& t, SourceLocation where) {
        UvMapping const uv = mapping(t.mapping, where);
        if (t.wrap != WrapMode::Repeat || t.invert)
            refuse(where, "a picture that does not repeat, or is inverted");
        ImageFile const& file = scene_[t.image];
        if (!file.encoding.empty() && file.encoding != "sRGB")
            refuse(where, "a picture of another encoding than sRGB");
        Pyramid const pyramid(read_image(file.path));
        Image const& level = pyramid.level(0);
        Image out(PixelFormat::Float, level.width(), level.height(), {"R", "G", "B"});
        for (int y = 0; y < out.height(); ++y)
            for (int x = 0; x < out.width(); ++x)
                for (int k = 0; k < 3; ++k)
                    out.set(x, y, k, clamp(t.scale * pyramid.texel_rgb(0, x, y)[k], 0, 1));
        int const picture = add(PeerPicture{std::move(out), t.filter == FilterMode::Point});
        return {add({PeerSurface::Kind::Diffuse, Vec3{0.5f}, picture}), {uv.su, uv.sv}, {uv.du, uv.dv}};
    }
    /// Two by two texels, for as many squares.
    Made checked(CheckerboardTexture const& t, SourceLocation where) {
        if (t.dimension != 2) refuse(where, "a checkerboard in space");
        UvMapping const uv = mapping(t.mapping, where);
        auto const one = constant(t.tex1), two = constant(t.tex2);
        if (!one || !two) refuse(where, "a checkerboard of textures");
        Image out(PixelFormat::Float, 2, 2, {"R", "G", "B"});
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x)
                for (int k = 0; k < 3; ++k)  // v grows upwards: square (0, 0) is the lower left texel
                    out.set(x, y, k, (x + (1 - y)) % 2 == 0 ? (*one)[k] : (*two)[k]);
        int const picture = add(PeerPicture{std::move(out), true});
        return {add({PeerSurface::Kind::Diffuse, Vec3{0.5f}, picture}),
                {uv.su / 2, uv.sv / 2},
                {uv.du / 2, uv.dv / 2}};
    }

    // ---- shapes -----------------------------------------------------------------------------------------------------

    void group(std::uint32_t id, Mat4 const& to_world) {
        Group const& g = scene_.groups[id];
        for (Object const& o : g.objects) object(o, to_world * o.to_group);
        for (Instance const& i : g.instances) group(i.group.value, to_world * matrix_of(i.to_parent));
    }
    void object(Object const& o, Mat4 const& to_world) {
        if (o.alpha.valid()) refuse(o.where, "a surface with holes (alpha)");
        Made const made = surface(o.material, o.where);
        Vec3 light{0};
        if (o.light) {
            if (o.light->image.valid() || o.light->texture.valid())
                refuse(o.light->where, "a light with a picture");
            light = emission(o.light->radiance, o.light->scale, o.light->power, o.light->where);
        }
        bool const two_sided = o.light && o.light->two_sided;
        if (auto const ball = whole_ball(o, to_world)) {
            if (two_sided) refuse(o.where, "a ball that shines inwards");
            peer_.balls.push_back({ball->first, ball->second, made.surface, light});
            return;
        }
        PeerMesh out;
        out.mesh = tessellate(o.shape, o.light ? 96 : 512);  // each triangle of a light is a light
        transform_mesh(out.mesh, to_world, o.reverse_orientation);
        wind(out.mesh, o.reverse_orientation != swaps_handedness(to_world));
        if (peer_.surfaces[static_cast<std::size_t>(made.surface)].picture < 0)
            out.mesh.uv.clear();
        else if (out.mesh.uv.empty())
            refuse(o.where, "a picture on a mesh without (u, v)");
        for (Vec2& uv : out.mesh.uv) uv = uv * made.scale + made.offset;
        out.surface = made.surface;
        out.emission = light;
        out.two_sided = two_sided;
        if (o.light) out.flat = flat(o, out.mesh, to_world);
        peer_.meshes.push_back(std::move(out));
    }
    /// Centre and radius of what is still a ball in the world, seen from outside.
    std::optional<std::pair<Vec3, float>> whole_ball(Object const& o, Mat4 const& m) const {
        auto const* s = std::get_if<Sphere>(&o.shape);
        if (!s || o.reverse_orientation || s->phi_max < kTwoPi || std::min(s->z_min, s->z_max) > -s->radius ||
            std::max(s->z_min, s->z_max) < s->radius)
            return std::nullopt;
        Vec3 const x = column(m, 0), y = column(m, 1), z = column(m, 2);
        float const r = length(x);
        auto const off = [&](float a) { return std::abs(a) > 1e-5f * r * r; };
        if (off(dot(x, y)) || off(dot(y, z)) || off(dot(z, x)) || off(r * r - dot(y, y)) ||
            off(r * r - dot(z, z)))
            return std::nullopt;
        if (surface_has_picture(o)) return std::nullopt;  // whose (u, v) others have elsewhere
        return std::pair{column(m, 3), r * s->radius};
    }
    bool surface_has_picture(Object const& o) const {
        return peer_.surfaces[static_cast<std::size_t>(made_.at(o.material.value).surface)].picture >= 0;
    }
    /// A triangle's side is where its normals are, or else by the order of its corners and `flip`.
    static void wind(TriangleMesh& m, bool flip) {
        for (Vec3i& t : m.triangles) {
            auto const i = static_cast<std::size_t>(t.x), j = static_cast<std::size_t>(t.y),
                       k = static_cast<std::size_t>(t.z);
            bool swap = flip;
            if (!m.n.empty())
                swap = dot(cross(m.p[j] - m.p[i], m.p[k] - m.p[i]), m.n[i] + m.n[j] + m.n[k]) < 0;
            if (swap) std::swap(t.y, t.z);
        }
    }
    static std::optional<FlatLight> flat(Object const& o, TriangleMesh const& m, Mat4 const& to_world) {
        if (auto const* d = std::get_if<Disk>(&o.shape)) {
            if (d->inner_radius > 0 || d->phi_max < kTwoPi) return std::nullopt;
            auto const t = make_transform(to_world);
            if (!t) return std::nullopt;
            FlatLight const f{t->point({0, 0, d->height}), t->vector({d->radius, 0, 0}),
                              t->vector({0, d->radius, 0}), true};
            float const r2 = length_squared(f.u);
            if (std::abs(dot(f.u, f.v)) > 1e-4f * r2 || std::abs(length_squared(f.v) - r2) > 1e-4f * r2)
                return std::nullopt;
            return f;
        }
        if (m.p.size() != 4 || m.triangles.size() != 2) return std::nullopt;
        Vec3 const lost = m.p[0] + m.p[2] - m.p[1] - m.p[3];  // of corners in order around
        Vec3 const u = m.p[1] - m.p[0], v = m.p[3] - m.p[0];
        if (length(lost) > 1e-4f * (length(u) + length(v))) return std::nullopt;
        return FlatLight{m.p[0] + 0.5f * (u + v), 0.5f * u, 0.5f * v, false};
    }

    Scene& scene_;
    SpectrumStore store_;
    PeerScene peer_;
    Mat4 to_peers_;
    std::map<std::uint32_t, Made> made_;
};

}  // namespace

PeerScene make_peer_scene(Scene scene) {
    drop_degenerate(scene);
    validate(scene);
    return Maker(scene).make();
}

}  // namespace nephroid::peers
