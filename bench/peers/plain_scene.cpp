// Back again: the peers' scene as one of ours, which is what we and pbrt-v4 render.
#include "peer_scene.h"
#include "tessellate.h"

#include "image/pyramid.h"
#include "image/write.h"
#include "sampling/warp.h"
#include "write/write.h"

#include <cmath>
#include <string>
#include <utility>

namespace nephroid::peers {

namespace {

Mat4 columns(Vec3 x, Vec3 y, Vec3 z, Vec3 origin) {
    Mat4 m;
    for (int r = 0; r < 3; ++r) {
        auto const row = static_cast<std::size_t>(r);
        m.m[row] = {static_cast<double>(x[r]), static_cast<double>(y[r]), static_cast<double>(z[r]),
                    static_cast<double>(origin[r])};
    }
    return m;
}

TextureId constant(Scene& scene, Vec3 rgb) {
    return scene.add(Texture{ConstantSpectrumTexture{RgbAlbedoSpd{rgb}, SpectrumRole::Albedo}, {}});
}

MaterialKind material(Scene& scene, PeerScene const& peer, PeerSurface const& s,
                      std::vector<std::filesystem::path> const& pictures) {
    if (s.kind == PeerSurface::Kind::Glass) return DielectricMaterial{ConstantSpd{s.index}, {}, {}};
    if (s.kind == PeerSurface::Kind::Mirror) {
        ConductorMaterial metal;
        metal.reflectance = constant(scene, s.rgb);
        return metal;
    }
    if (s.picture < 0) return DiffuseMaterial{constant(scene, s.rgb)};
    auto const i = static_cast<std::size_t>(s.picture);
    ImageTexture t;
    t.image = scene.add(ImageFile{pictures[i].string(), "", {}});
    t.filter = peer.pictures[i].nearest ? FilterMode::Point : FilterMode::Bilinear;
    return DiffuseMaterial{scene.add(Texture{t, {}})};
}

std::optional<AreaLight> light(Vec3 emission, bool two_sided) {
    if (emission == Vec3{0}) return std::nullopt;
    AreaLight l;
    l.radiance = RgbIlluminantSpd{
        emission};  // which is what rgb mode and pbrt-v4 both make of it: white has luminance 1
    l.two_sided = two_sided;
    return l;
}

/// The square that pbrt-v4 wants: four texels where the other has its smallest.
Image equal_area(Image const& by_angle) {
    int const side = 2 * by_angle.height();
    Pyramid const from(by_angle);
    float const half = 0.5f / static_cast<float>(by_angle.height());
    Image out(PixelFormat::Float, side, side, {"R", "G", "B"});
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            Vec3 const d = equal_area_square_to_sphere(
                Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} / static_cast<float>(side));
            float const u = std::atan2(d.y, d.x) * kInvTwoPi,
                        v = std::atan2(std::hypot(d.x, d.y), d.z) * kInvPi;
            Vec3 const c = from.bilerp_rgb(0, {u < 0 ? u + 1 : u, clamp(v, half, 1 - half)});
            for (int k = 0; k < 3; ++k) out.set(x, y, k, c[k]);
        }
    return out;
}

}  // namespace

Vec3 front(TriangleMesh const& m) {
    Vec3i const t = m.triangles.front();
    Vec3 const p = m.p[static_cast<std::size_t>(t.x)];
    return normalize(cross(m.p[static_cast<std::size_t>(t.y)] - p, m.p[static_cast<std::size_t>(t.z)] - p));
}

TriangleMesh ball_mesh(PeerBall const& ball, int n) {
    TriangleMesh m = tessellate(Sphere{ball.radius, -ball.radius, ball.radius}, 2 * n);
    m.uv.clear();
    for (Vec3i& t : m.triangles) std::swap(t.y, t.z);  // longitude x angle from +z points inwards
    for (Vec3& p : m.p) p += ball.centre;
    return m;
}

std::vector<std::filesystem::path> write_pictures(PeerScene const& peer,
                                                  std::filesystem::path const& folder) {
    std::vector<std::filesystem::path> files;
    for (PeerPicture const& p : peer.pictures) {
        files.push_back(folder / ("picture-" + std::to_string(files.size()) + ".png"));
        write_png(files.back(), p.image, 16);
    }
    return files;
}

Scene plain_scene(PeerScene const& peer, std::filesystem::path const& folder) {
    Scene scene;
    auto const pictures = write_pictures(peer, folder);

    Settings& settings = scene.settings;
    settings.filter = BoxFilter{};
    settings.integrator = PathIntegrator{.max_depth = peer.depth};
    settings.color = ColorMode::Rgb;
    settings.color_given = true;
    settings.film.resolution = peer.resolution;
    settings.film.half_float = false;
    PeerCamera const& c = peer.camera;
    // Columns right, up, forward: of a right-handed world, a mirror image to pbrt.
    scene.camera.kind = PerspectiveCamera{peer.camera.fov};
    scene.camera.to_world = columns(c.right, c.up, c.forward, c.eye);

    std::vector<MaterialId> materials;
    for (PeerSurface const& s : peer.surfaces) {
        MaterialKind kind = material(scene, peer, s, pictures);
        materials.push_back(scene.add(Material{std::move(kind), "", {}}));
    }
    auto const object = [&](Shape shape, int surface, Vec3 emission, bool two_sided) -> Object& {
        Object o;
        o.shape = std::move(shape);
        o.material = materials[static_cast<std::size_t>(surface)];
        o.light = light(emission, two_sided);
        scene.world().objects.push_back(std::move(o));
        return scene.world().objects.back();
    };
    for (PeerMesh const& m : peer.meshes) {
        if (m.flat && m.flat->disk) {
            Object& o = object(Disk{0, length(m.flat->u)}, m.surface, m.emission, m.two_sided);
            Vec3 const n = front(m.mesh), x = normalize(m.flat->u);
            o.to_group = columns(x, cross(n, x), n, m.flat->centre);
        } else {
            object(m.mesh, m.surface, m.emission, m.two_sided);
        }
    }
    for (PeerBall const& b : peer.balls)
        object(Sphere{b.radius, -b.radius, b.radius}, b.surface, b.emission, false).to_group =
            translate(static_cast<double>(b.centre.x), static_cast<double>(b.centre.y),
                      static_cast<double>(b.centre.z));

    if (!peer.sky_picture.empty()) {
        auto const file = folder / "sky.exr";
        write_exr(file, equal_area(peer.sky_picture));
        InfiniteLight sky;
        sky.image = scene.add(ImageFile{file.string(), "", {}});
        scene.add(Light{sky, {}, {}});
    } else if (peer.sky != Vec3{0}) {
        InfiniteLight sky;
        sky.radiance = RgbIlluminantSpd{peer.sky};
        scene.add(Light{sky, {}, {}});
    }
    return scene;
}

std::filesystem::path write_pbrt_scene(PeerScene const& peer, WriteJob const& job) {
    Scene scene = plain_scene(peer, job.folder);
    scene.settings.spp = job.samples;
    scene.settings.seed = job.seed;
    auto const path = job.folder / "scene.pbrt";
    write_pbrt(scene, path, {.portable = true});
    return path;
}

}  // namespace nephroid::peers
