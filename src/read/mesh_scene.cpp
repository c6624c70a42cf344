#include "mesh_scene.h"

#include "mesh_file.h"

#include <cmath>

namespace nephroid {

namespace {

/// From above the right shoulder, just far enough away to see all of the bounding sphere. Meshes are right-handed with y
/// up; the camera's own space is left-handed, hence the mirror.
Camera framing_camera(Bounds3 const& bounds, float aspect) {
    PerspectiveCamera const kind{radians(40.0f), 0, 1e6f};
    auto sphere = bounding_sphere(bounds);
    if (!(sphere.radius > 0)) sphere.radius = 1;  // a single point: still somewhere to stand
    double const distance = 1.05 * sphere.radius / std::sin(0.5 * kind.fov);
    std::array<double, 3> const from{0.5, 0.4, 1};
    double const length = std::sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
    std::array<double, 3> eye{}, target{};
    for (int i = 0; i < 3; ++i) {
        auto const k = static_cast<std::size_t>(i);
        target[k] = sphere.centre[i];
        eye[k] = target[k] + distance * from[k] / length;
    }
    Camera camera;
    camera.kind = kind;
    auto const view = look_at(eye, target, {0, 1, 0});
    auto const to_world = view ? inverse(scale(-1, 1, 1) * *view) : std::nullopt;
    if (to_world)
        camera.to_world =
            *to_world;  // else the mesh is so far out that the eye is at its centre: validate() speaks
    camera.frame_aspect_ratio = aspect;
    return camera;
}

}  // namespace

Scene mesh_scene(std::filesystem::path const& path) {
    Context context;
    SourceLocation const where{context.add_file(path.string(), path.parent_path()), 0};
    auto file = read_mesh(context, where, path);
    for (auto const& text : file.notes) context.note(where, text);

    auto& scene = context.scene;
    scene.settings.film.resolution = {800, 600};
    Bounds3 bounds;
    for (auto const& p : file.mesh.p) bounds.add(p);
    scene.camera = framing_camera(bounds, 800.0f / 600.0f);
    scene.camera.where = where;

    auto const gray =
        scene.add(Texture{ConstantSpectrumTexture{ConstantSpd{0.5f}, SpectrumRole::Albedo}, where});
    Object object;
    object.shape = std::move(file.mesh);
    object.material = scene.add(Material{DiffuseMaterial{gray}, {}, where});
    object.where = where;
    scene.world().objects.push_back(std::move(object));
    scene.add(Light{InfiniteLight{}, {}, where});
    context.finish_notes();
    return std::move(scene);
}

}  // namespace nephroid
