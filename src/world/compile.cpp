// compile(Scene) -> World: validate, bake, flatten, build, and gather the lights.
#include "light_gather.h"
#include "ray_caster.h"
#include "records.h"
#include "scene/affine_rows.h"
#include "scene/match.h"
#include "world/world.h"
#include "world_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace nephroid {

namespace {

AffineMap to_map(Mat4 const& m) { return {rows_of(m)}; }

/// AffineMap::round_trip of a chain of instances; nothing when it is singular.
std::optional<float> round_trip(Mat4 const& m) {
    auto const inv = inverse(m);
    if (!inv) return std::nullopt;
    double largest = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) row += std::abs(m.m[i][k] * inv->m[k][j]);
        largest = std::max(largest, row);
    }
    return static_cast<float>(largest);
}

bool is_mesh(Shape const& s) {
    return std::holds_alternative<TriangleMesh>(s) || std::holds_alternative<BilinearMesh>(s);
}

/// Embree reads 16 bytes at each vertex: leave room behind the last.
void pad(TriangleMesh& m) { m.p.reserve(m.p.size() + 2); }

/// Triangles of no area cannot be seen, and must not be chosen as lights: the scene becomes the one without them.
void drop_flat_triangles(Scene& scene, Object const& o, TriangleMesh& m) {
    auto const corner = [&m](int i) { return m.p[static_cast<std::size_t>(i)]; };
    std::size_t const dropped = std::erase_if(m.triangles, [&](Vec3i const t) {
        return cross_accurate(corner(t.y) - corner(t.x), corner(t.z) - corner(t.x)) == Vec3(0);
    });
    if (dropped > 0)
        scene.note(o.where, std::to_string(dropped) + (dropped == 1 ? " triangle has" : " triangles have") +
                                " no area: skipped");
}

/// Meshes into their group's space; subdivision surfaces become triangles.
void bake(Scene& scene) {
    for (Group& group : scene.groups)
        for (Object& o : group.objects) {
            if (auto const* loop = std::get_if<LoopSubdivision>(&o.shape)) {
                try {
                    o.shape = subdivide(*loop);
                } catch (Error const& e) {
                    scene.fail(o.where, e.what());
                }
            }
            if (!is_mesh(o.shape)) continue;
            match(
                o.shape,
                [&](TriangleMesh& m) {
                    transform_mesh(m, o.to_group, o.reverse_orientation);
                    drop_flat_triangles(scene, o, m);
                    pad(m);
                },
                [&](BilinearMesh& m) { transform_mesh(m, o.to_group, o.reverse_orientation); }, [](auto&) {});
        }
}

/// Which side the normal is on: pbrt turns it for ReverseOrientation, and for meshes under a mirroring transform, whose
/// vertex order is then the other one. Analytic shapes keep "outside" outside.
bool flips(Object const& o) {
    return o.reverse_orientation != (is_mesh(o.shape) && swaps_handedness(o.to_group));
}

std::unique_ptr<AnalyticPlace> place_of(Scene const& scene, Object const& o) {
    if (is_mesh(o.shape) || is_identity(o.to_group)) return nullptr;
    auto const inv = inverse(o.to_group);
    if (!inv) scene.fail(o.where, "the shape's transform cannot be inverted; remove a scale by 0");
    auto p = std::make_unique<AnalyticPlace>();
    for (std::size_t i = 0; i < 3; ++i) p->group_to_shape[i] = inv->m[i];
    p->shape_to_group = to_map(o.to_group);
    return p;
}

Passage passage_of(Scene const& scene, Assets const& assets, Object const& o) {
    if (!o.material.valid()) return Passage::Solid;
    if (std::holds_alternative<InterfaceMaterial>(scene[o.material].kind)) return Passage::Interface;
    return assets.data(o.material).passes ? Passage::Partly : Passage::Solid;
}
/// Interfaces are invisible unless they emit: without media there is nothing to do at them.
bool is_invisible(Scene const& scene, Assets const& assets, Object const& o) {
    return !o.light && passage_of(scene, assets, o) == Passage::Interface;
}

/// Paths know the bodies that they are in by the boundaries that they cross.
void note_open_body(Scene& scene, Assets const& assets, Object const& o) {
    if (!o.material.valid() || !assets.data(o.material).encloses) return;
    bool const holes = o.alpha.valid() || assets.data(o.material).passes;
    if (holes)
        scene.note(o.where,
                   "light that enters or leaves an absorbing or nested body by holes of alpha or of an "
                   "\"interface\" is taken to stay where it was");
}

struct Builder {
    Scene& scene;
    Assets& assets;
    RayCaster& caster;
    WorldParts& parts;
    LightTable& lights;
    WorldCounts& counts;

    std::vector<std::uint32_t> first_record, record_count, caster_group;  // by GroupId
    std::vector<std::uint32_t> group_of_instance;

    static constexpr std::uint32_t kNotBuilt = 0xFFFFFFFFu;

    void records() {
        std::size_t total = 0;
        for (Group const& g : scene.groups) total += g.objects.size();
        parts.records.reserve(total);  // addresses are kept
        for (Group const& g : scene.groups) {
            first_record.push_back(static_cast<std::uint32_t>(parts.records.size()));
            std::uint32_t lights_of_group = 0;
            for (Object const& o : g.objects) {
                if (is_invisible(scene, assets, o)) continue;
                note_open_body(scene, assets, o);
                ObjectRecord r;
                r.object = &o;
                r.material = o.material;
                r.flip = flips(o);
                r.passage = passage_of(scene, assets, o);
                parts.partly = parts.partly || r.passage == Passage::Partly;
                r.place = place_of(scene, o);
                r.textured = (o.material.valid() && assets.data(o.material).textured) ||
                             (o.alpha.valid() && !assets.data(o.alpha).flat);
                if (o.light) {
                    r.first_light = lights_of_group;
                    lights_of_group += part_count(r);
                    r.emitter = add_emitter(scene, assets, lights, r);
                }
                ++counts.objects;
                if (auto const* m = std::get_if<TriangleMesh>(&o.shape)) {
                    counts.triangles += m->triangles.size();
                } else {
                    ++counts.analytic;
                }
                parts.records.push_back(std::move(r));
            }
            record_count.push_back(static_cast<std::uint32_t>(parts.records.size()) - first_record.back());
        }
    }

    void build_groups() {
        for (std::uint32_t g = 0; g < scene.groups.size(); ++g) {
            if (g != 0 && record_count[g] == 0) {
                caster_group.push_back(kNotBuilt);
                continue;
            }
            caster_group.push_back(caster.add_group(parts.records, first_record[g], record_count[g]));
        }
    }

    [[nodiscard]] std::vector<PlainMesh> plain_meshes() const {
        std::vector<PlainMesh> plain(record_count[0]);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            ObjectRecord const& r = parts.records[i];
            if (r.emits() || r.passage != Passage::Solid || !r.material.valid() || r.object->alpha.valid())
                continue;
            MaterialData const& data = assets.data(r.material);
            if (data.plain)
                plain[i] = {std::get_if<TriangleMesh>(&r.object->shape), r.flip, data.reflectance};
        }
        return plain;
    }

    /// The box of a surface in the world.
    static Bounds3 box_of(ObjectRecord const& r, InstanceRecord const* instance) {
        Bounds3 const box = match(
            r.object->shape, [](LoopSubdivision const&) { return Bounds3{}; },
            [](auto const& shape) { return bounds(shape); });
        Bounds3 around;
        for (int c = 0; c < 8 && !box.empty(); ++c) {
            Vec3 p = box.corner(c);
            if (r.place) p = r.place->shape_to_group.point(p);
            around.add(instance ? instance->to_world.point(p) : p);
        }
        return around;
    }
    /// Calls f(record, instance) for all that there is in the world, instance by instance.
    template <class F>
    void each_appearance(F&& f) const {
        auto const all = [&](std::uint32_t first, std::uint32_t count, InstanceRecord const* instance) {
            for (std::uint32_t i = first; i < first + count; ++i) f(parts.records[i], instance);
        };
        all(first_record[0], record_count[0], nullptr);
        for (InstanceRecord const& i : parts.instances)
            all(i.first_record, parts.count_from(i.first_record), &i);
    }

    /// Of what encloses, by material: a body's surface may be of several objects.
    std::vector<Bounds3> bodies() const {
        std::vector<Bounds3> boxes(scene.materials.size());
        each_appearance([&](ObjectRecord const& r, InstanceRecord const* instance) {
            if (r.material.valid() && assets.data(r.material).encloses)
                boxes[r.material.value].add(box_of(r, instance));
        });
        std::erase_if(boxes, [](Bounds3 const& box) { return box.empty(); });
        return boxes;
    }
    /// Around all surfaces that emit, a little wider: where Embree meets them is rounded.
    Bounds3 emitting() const {
        Bounds3 box;
        each_appearance([&](ObjectRecord const& r, InstanceRecord const* instance) {
            if (r.emits()) box.add(box_of(r, instance));
        });
        if (box.empty()) return box;
        Vec3 const slack = 1e-4f * Vec3(length(box.diagonal())) + 1e-5f * max(abs(box.lo), abs(box.hi));
        return {box.lo - slack, box.hi + slack};
    }

    /// Depth first through the groups' instances; Embree's instances have one level, so chains are multiplied out. `validate`
    /// has excluded cycles and more than 2^31 instances.
    void flatten(GroupId group, Mat4 const& to_world) {
        for (Instance const& i : scene[group].instances) {
            Mat4 const m = to_world * matrix_of(i.to_parent);
            if (caster_group[i.group.value] != kNotBuilt) {
                AffineMap map = to_map(m);
                auto const there_and_back = round_trip(m);
                if (!there_and_back || !(std::abs(map.determinant()) > 0.0f) ||
                    !std::isfinite(map.determinant())) {
                    scene.note(i.where, "an instance with a singular transform was left out");
                } else {
                    map.round_trip = *there_and_back;
                    parts.instances.push_back({map, first_record[i.group.value], 0});
                    group_of_instance.push_back(caster_group[i.group.value]);
                }
            }
            flatten(i.group, m);
        }
    }
};

}  // namespace

World compile(Scene scene_in) {
    drop_degenerate(scene_in);
    validate(scene_in);
    World w;
    w.hash_ = hash(scene_in);
    w.scene_ = std::make_unique<Scene>(std::move(scene_in));
    Scene& scene = *w.scene_;
    bake(scene);
    w.assets_ = std::make_unique<Assets>(scene);
    w.caster_ = std::make_unique<RayCaster>(*w.assets_);
    w.lights_ = std::make_unique<LightTable>();
    w.parts_ = std::make_unique<WorldParts>();

    Builder b{scene, *w.assets_, *w.caster_, *w.parts_, *w.lights_, w.counts_, {}, {}, {}, {}};
    b.records();
    b.build_groups();
    b.flatten(GroupId{0}, Mat4{});
    for (Group const& group : scene.groups)
        for (Object const& o : group.objects)
            w.encloses_ = w.encloses_ || (o.material.valid() && w.assets_->data(o.material).encloses);
    w.counts_.instances = w.parts_->instances.size();
    w.caster_->finish(w.parts_->instances, b.group_of_instance);
    w.bounds_ = w.caster_->bounds();
    w.parts_->first_record = b.first_record;
    w.parts_->record_count = b.record_count;
    w.plain_meshes_ = b.plain_meshes();
    if (w.encloses_) w.bodies_ = b.bodies();
    gather_lights(scene, *w.assets_, *w.parts_, *w.lights_, bounding_sphere(w.bounds_));
    Vec3 const all(kInfinity);
    w.emitting_ = w.lights_->infinite.empty() ? b.emitting() : Bounds3{-all, all};
    w.counts_.lights = w.lights_->entries.size();
    w.counts_.infinite_lights = w.lights_->infinite.size();
    return w;
}

}  // namespace nephroid
