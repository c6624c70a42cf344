#include "check.h"
#include "scene/affine_rows.h"

#include <limits>

namespace nephroid {

bool overflows(Mat4 const& m) {
    auto const beyond = [](Mat4 const& a) {
        for (auto const& row : a.m)
            for (double const x : row)
                if (!(std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max()))) return true;
        return false;
    };
    if (beyond(m)) return true;
    auto const inverted = inverse(m);
    return inverted && beyond(*inverted);
}

void check_matrix(Check const& c, Mat4 const& m, char const* what) {
    check_finite(c, m, what);
    if (!is_affine(m))
        c.scene.fail(c.where, std::string(what) + " is projective: its last row must be 0 0 0 1");
    if (make_transform(m)) return;
    if (overflows(m))
        c.scene.fail(c.where, std::string(what) +
                                  " overflows: its numbers, or those of its inverse, are beyond "
                                  "single precision: scale by less");
    c.scene.fail(c.where, std::string(what) + " cannot be inverted: remove the scale by 0");
}

namespace {

void check_object(Check const& c, Object const& object) {
    check_ids(c, object.material, "the object");
    check_ids(c, object.alpha, "the object's alpha");
    check_matrix(c, object.to_group, "the object's transform");
    check_shape(c, object.shape);
    if (object.light)
        check_area_light(c.at(object.light->where.line ? object.light->where : c.where), *object.light);
}

void check_group(Check const& c, Group const& group) {
    for (Object const& object : group.objects) check_object(c.at(object.where), object);
    for (Instance const& instance : group.instances) {
        Check const here = c.at(instance.where);
        here.require(instance.group.valid(), "the instance names no group: name one");
        check_ids(here, instance.group, "the instance");
        check_matrix(here, matrix_of(instance.to_parent), "the instance's transform");
    }
}

}  // namespace

void validate(Scene const& scene) {
    Check const c{scene, {}};
    c.require(!scene.groups.empty(), "there is no world: groups[0] must exist");
    check_settings(c, scene.settings);
    check_camera(c.at(scene.camera.where), scene.camera);
    for (Texture const& texture : scene.textures) check_texture(c.at(texture.where), texture);
    for (Material const& material : scene.materials) check_material(c.at(material.where), material);
    for (Light const& light : scene.lights) check_light(c.at(light.where), light);
    for (Group const& group : scene.groups) check_group(c, group);
    check_graphs(scene);
}

}  // namespace nephroid
