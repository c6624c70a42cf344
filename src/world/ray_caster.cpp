#include "ray_caster.h"

#include "few_spheres.h"
#include "model/texture.h"
#include "sampling/hash.h"
#include "scene/match.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define NEPHROID_EMBREE 4
#else
#include <embree3/rtcore.h>
#define NEPHROID_EMBREE 3
#endif

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

namespace nephroid {

/// What a hit is completed with while Embree is still looking.
struct CastScene {
    Assets const* assets;
    std::vector<InstanceRecord> const* instances = nullptr;
    std::uint32_t first_instance = 0;

    [[nodiscard]] InstanceRecord const* instance(std::uint32_t geometry) const {
        return &(*instances)[geometry - first_instance];
    }
};

namespace {

/// What callbacks need: of an analytic shape, or of any that an alpha texture cuts.
struct UserGeometry {
    ObjectRecord const* record;
    CastScene const* scene;
};

/// Is the surface there at a hit, where its alpha is between 0 and 1 by chance? The chance is a hash of the direction and of the place
/// on the surface: another ray has another, the same ray always the same, and a scaled scene keeps them. A triangle's place counts,
/// too, lest parallel rays all have one where its texture coordinates are all the same. Looked up at its finest: what a ray hits must
/// not depend on what it is for.
bool covers(UserGeometry const& g, std::uint32_t geometry, std::uint32_t instance, ShapeHit const& hit,
            Vec3 local, Vec3 direction) {
    TextureId const alpha = g.record->object->alpha;
    SurfacePoint s;
    surface_at(*g.record, instance == RTC_INVALID_GEOMETRY_ID ? nullptr : g.scene->instance(instance), hit,
               local, true, s);
    TexturePoint at;
    at.p = s.p;
    at.uv = s.uv;
    at.n = s.ng;
    float const opacity = evaluate_float(*g.scene->assets, alpha, at);
    if (opacity >= 1.0f) return true;
    if (!(opacity > 0.0f)) return false;
    auto const bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    std::uint64_t const key = hash_keys(bits(direction.x), bits(direction.y), bits(direction.z), bits(s.uv.x),
                                        bits(s.uv.y), bits(static_cast<float>(hit.u)),
                                        bits(static_cast<float>(hit.v)), hit.part, geometry, instance);
    return to_unit_double(key) < static_cast<double>(opacity);
}

/// A ray of a callback's n, in the space of the shape's group and in the shape's own.
struct UserRay {
    Ray3d local;
    double t_min, t_max;
    Vec3 direction;

    UserRay(UserGeometry const& g, RTCRayN* rays, unsigned n, unsigned i)
        : t_min(static_cast<double>(RTCRayN_tnear(rays, n, i))),
          t_max(static_cast<double>(RTCRayN_tfar(rays, n, i))),
          direction{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)} {
        local = g.record->in_shape(
            {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
             {direction.x, direction.y, direction.z}});
    }
};

/// A hit and its point in the shape's own space.
struct LocalHit : ShapeHit {
    Vec3 p;
};

/// False where the ray misses.
bool intersect_user(UserGeometry const& g, std::uint32_t prim, std::uint32_t geometry, std::uint32_t instance,
                    UserRay const& ray, LocalHit& found) {
    double t_min = ray.t_min;
    return match(
        g.record->object->shape, [](TriangleMesh const&) { return false; },
        [](LoopSubdivision const&) { return false; },
        [&](auto const& shape) {
            // Where alpha lets the ray through, the shape may be met once more.
            constexpr int kMostHits = 8;
            for (int i = 0; i < kMostHits; ++i) {
                auto const hit = intersect(shape, prim, ray.local, t_min, ray.t_max);
                if (!hit) return false;
                static_cast<ShapeHit&>(found) = *hit;
                for (int k = 0; k < 3; ++k) {
                    auto const axis = static_cast<std::size_t>(k);
                    found.p[k] = static_cast<float>(ray.local.o[axis] + hit->t * ray.local.d[axis]);
                }
                if (!g.record->object->alpha.valid() ||
                    covers(g, geometry, instance, *hit, found.p, ray.direction))
                    return true;
                t_min = hit->t;
            }
            return false;
        });
}

#if NEPHROID_EMBREE == 4
using Context = RTCRayQueryContext;
void begin(Context& context) { rtcInitRayQueryContext(&context); }
#else
using Context = RTCIntersectContext;
void begin(Context& context) { rtcInitIntersectContext(&context); }
#endif

/// Which surface each ray of a packet has met so far: the nearest and, of several at one distance, that of the least (instance, geometry,
/// primitive). Embree takes them in an order that depends on the rays beside it, and a picture must not. It also passes by boxes that
/// begin a rounding behind what was met, so that it is told that everything is met a little later than it is.
struct PacketContext : Context {
    struct Met {
        float t = kInfinity;
        std::uint32_t instance = ~0u, geometry = ~0u, primitive = ~0u;
    };
    std::array<Met, kLanes> met;

    static float told(float t) { return t * (1.0f + 0x1p-16f); }
    /// Is this what the lane's ray meets, as far as is known? Then it is kept.
    bool takes(std::size_t lane, Met const& hit) {
        Met& m = met[lane];
        bool const first =
            hit.t < m.t || (hit.t == m.t && std::tie(hit.instance, hit.geometry, hit.primitive) <
                                                std::tie(m.instance, m.geometry, m.primitive));
        if (first) m = hit;
        return first;
    }
};

/// Of every triangle that a ray of a packet may meet.
void packet_filter(RTCFilterFunctionNArguments const* args) {
    auto& context = *static_cast<PacketContext*>(args->context);
    constexpr unsigned n = kLanes;  // packets are of eight
    LaneMask asked = 0;
    for (unsigned i = 0; i < n; ++i) asked |= static_cast<LaneMask>(args->valid[i] != 0) << i;
    for (; asked != 0; asked &= asked - 1) {
        auto const i = static_cast<unsigned>(std::countr_zero(asked));
        float const t = RTCRayN_tfar(args->ray, n, i);
        if (context.takes(i, {t, RTCHitN_instID(args->hit, n, i, 0), RTCHitN_geomID(args->hit, n, i),
                              RTCHitN_primID(args->hit, n, i)}))
            RTCRayN_tfar(args->ray, n, i) = PacketContext::told(t);
        else
            args->valid[i] = 0;
    }
}

/// For triangles that alpha cuts; Embree says the rest.
void filter_callback(RTCFilterFunctionNArguments const* args) {
    auto const& g = *static_cast<UserGeometry const*>(args->geometryUserPtr);
    unsigned const n = args->N;
    for (unsigned i = 0; i < n; ++i) {
        if (args->valid[i] == 0) continue;
        RTCRay const ray = rtcGetRayFromRayN(args->ray, n, i);
        RTCHit const hit = rtcGetHitFromHitN(args->hit, n, i);
        ShapeHit const at{static_cast<double>(ray.tfar), hit.u, hit.v, hit.primID};
        if (!covers(g, hit.geomID, hit.instID[0], at, {}, {ray.dir_x, ray.dir_y, ray.dir_z}))
            args->valid[i] = 0;
    }
}

void intersect_callback(RTCIntersectFunctionNArguments const* args) {
    auto const& g = *static_cast<UserGeometry const*>(args->geometryUserPtr);
    unsigned const n = args->N;
    RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, n);
    RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, n);
    bool const in_packet = n > 1;
    std::uint32_t const instance = args->context->instID[0];
    for (unsigned i = 0; i < n; ++i) {
        if (args->valid[i] == 0) continue;
        LocalHit hit;
        if (!intersect_user(g, args->primID, args->geomID, instance, UserRay(g, rays, n, i), hit)) continue;
        float const t = static_cast<float>(hit.t);
        if (in_packet &&
            !static_cast<PacketContext*>(args->context)->takes(i, {t, instance, args->geomID, hit.part}))
            continue;
        RTCRayN_tfar(rays, n, i) = in_packet ? PacketContext::told(t) : t;
        RTCHitN_u(hits, n, i) = hit.u;
        RTCHitN_v(hits, n, i) = hit.v;
        // Embree hands the normal on as it is: it carries the point in the shape's own space, which was found in double.
        RTCHitN_Ng_x(hits, n, i) = hit.p.x;
        RTCHitN_Ng_y(hits, n, i) = hit.p.y;
        RTCHitN_Ng_z(hits, n, i) = hit.p.z;
        RTCHitN_primID(hits, n, i) = hit.part;
        RTCHitN_geomID(hits, n, i) = args->geomID;
        RTCHitN_instID(hits, n, i, 0) = instance;
    }
}
void occluded_callback(RTCOccludedFunctionNArguments const* args) {
    auto const& g = *static_cast<UserGeometry const*>(args->geometryUserPtr);
    unsigned const n = args->N;
    for (unsigned i = 0; i < n; ++i) {
        if (args->valid[i] == 0) continue;
        LocalHit hit;
        if (intersect_user(g, args->primID, args->geomID, args->context->instID[0],
                           UserRay(g, args->ray, n, i), hit))
            RTCRayN_tfar(args->ray, n, i) = -kInfinity;
    }
}

/// Group-space bounds of one primitive of an analytic shape, a little wider than computed: the shape is exact, its box rounds.
Bounds3 bounds_of(ObjectRecord const& record, std::uint32_t primitive) {
    Bounds3 const local = match(
        record.object->shape, [](TriangleMesh const&) { return Bounds3{}; },
        [](LoopSubdivision const&) { return Bounds3{}; },
        [&](auto const& shape) { return primitive_bounds(shape, primitive); });
    Bounds3 b;
    if (record.place) {
        for (int i = 0; i < 8; ++i) {
            Vec3 const p = record.place->shape_to_group.point(local.corner(i));
            Vec3 const e = record.place->shape_to_group.point_error(local.corner(i), Vec3{0, 0, 0});
            b.add(p - e);
            b.add(p + e);
        }
    } else {
        b = local;
    }
    Vec3 const slack = gamma_bound(4) * max(abs(b.lo), abs(b.hi));
    return {b.lo - slack, b.hi + slack};
}
void bounds_callback(RTCBoundsFunctionArguments const* args) {
    auto const& g = *static_cast<UserGeometry const*>(args->geometryUserPtr);
    Bounds3 const b = bounds_of(*g.record, args->primID);
    args->bounds_o->lower_x = b.lo.x;
    args->bounds_o->lower_y = b.lo.y;
    args->bounds_o->lower_z = b.lo.z;
    args->bounds_o->upper_x = b.hi.x;
    args->bounds_o->upper_y = b.hi.y;
    args->bounds_o->upper_z = b.hi.z;
}

}  // namespace

struct RayCaster::Impl {
    RTCDevice device = nullptr;
    std::vector<RTCScene> groups;
    FewSpheres spheres;  // of the root, which Embree does not know
    Bounds3 spheres_bounds;
    std::vector<std::unique_ptr<UserGeometry>> users;
    CastScene scene{};
    std::atomic<std::int64_t> bytes{0};

    UserGeometry* add_user(ObjectRecord const& record) {
        users.push_back(std::make_unique<UserGeometry>(UserGeometry{&record, &scene}));
        return users.back().get();
    }
    void check(char const* doing) const {
        RTCError const e = rtcGetDeviceError(device);
        if (e == RTC_ERROR_NONE) return;
        if (e == RTC_ERROR_OUT_OF_MEMORY)
            throw Error(ErrorKind::Limit,
                        std::string("out of memory while ") + doing + "; use fewer triangles");
        throw Error(ErrorKind::Limit,
                    std::string("Embree refused (error ") + std::to_string(e) + ") while " + doing);
    }
};

RayCaster::RayCaster(Assets const& assets) : impl_(std::make_unique<Impl>()) {
    impl_->scene.assets = &assets;
    // A fixed instruction set: Embree's hits differ in the last bits between them, and pictures must not (docs/conventions.md).
    impl_->device = rtcNewDevice("isa=avx2");
    if (!impl_->device) throw Error(ErrorKind::Limit, "Embree cannot start on this machine");
    rtcSetDeviceMemoryMonitorFunction(
        impl_->device,
        [](void* self, ssize_t n, bool) {
            static_cast<Impl*>(self)->bytes += n;
            return true;
        },
        impl_.get());
}

RayCaster::~RayCaster() {
    for (RTCScene const s : impl_->groups)
        if (s) rtcReleaseScene(s);
    if (impl_->device) rtcReleaseDevice(impl_->device);
}

std::uint32_t RayCaster::add_group(std::vector<ObjectRecord> const& records, std::size_t first,
                                   std::size_t count) {
    RTCScene const scene = rtcNewScene(impl_->device);
    bool const root = impl_->groups.empty();
    impl_->groups.push_back(scene);
    if (root) impl_->spheres.take({records.data() + first, count});
#if NEPHROID_EMBREE == 4
    constexpr auto kFilter = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
    constexpr auto kFilter = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | kFilter));
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    for (std::size_t i = 0; i < count; ++i) {
        ObjectRecord const& record = records[first + i];
        if (root && impl_->spheres.has(static_cast<std::uint32_t>(i))) {
            impl_->spheres_bounds.add(bounds_of(record, 0));
            continue;
        }
        RTCGeometry geometry = nullptr;
        if (auto const* mesh = std::get_if<TriangleMesh>(&record.object->shape)) {
            geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
            // Shared with the scene's arrays; compile() left room for the 16-byte loads at their ends.
            rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->p.data(),
                                       0, sizeof(Vec3), mesh->p.size());
            rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                       mesh->triangles.data(), 0, sizeof(Vec3i), mesh->triangles.size());
            if (record.object->alpha.valid()) {
                rtcSetGeometryUserData(geometry, impl_->add_user(record));
                rtcSetGeometryIntersectFilterFunction(geometry, filter_callback);
                rtcSetGeometryOccludedFilterFunction(geometry, filter_callback);
            }
        } else {
            geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_USER);
            rtcSetGeometryUserPrimitiveCount(
                geometry, match(record.object->shape, [](auto const& s) { return primitive_count(s); }));
            rtcSetGeometryUserData(geometry, impl_->add_user(record));
            rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
            rtcSetGeometryIntersectFunction(geometry, intersect_callback);
            rtcSetGeometryOccludedFunction(geometry, occluded_callback);
        }
        rtcSetGeometryMask(geometry, seen(record.passage));
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    // The root is committed when its instances are in.
    if (root) {
        first_instance_ = static_cast<std::uint32_t>(count);
    } else {
        rtcCommitScene(scene);
    }
    impl_->check("building the acceleration structure");
    return static_cast<std::uint32_t>(impl_->groups.size() - 1);
}

void RayCaster::finish(std::vector<InstanceRecord> const& instances,
                       std::vector<std::uint32_t> const& group_of_instance) {
    RTCScene const root = impl_->groups.front();
    unsigned const id = first_instance_;  // after the world's own objects
    impl_->scene.instances = &instances;
    impl_->scene.first_instance = first_instance_;
    instanced_ = !instances.empty();
    for (std::size_t i = 0; i < instances.size(); ++i) {
        RTCGeometry const geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, impl_->groups[group_of_instance[i]]);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, instances[i].to_world.m.data());
        rtcSetGeometryMask(geometry, kAll);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(root, geometry, id + static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(root);
    impl_->check("building the acceleration structure");
}

namespace {
// Not 0: a surface in a coordinate plane has no rounding error to be moved away from, and its own hit is at exactly 0.
constexpr float kLeastT = std::numeric_limits<float>::min();

void fill(RTCRay& r, Ray const& ray, float t_max, std::uint32_t mask) {
    r.org_x = ray.o.x, r.org_y = ray.o.y, r.org_z = ray.o.z;
    r.dir_x = ray.d.x, r.dir_y = ray.d.y, r.dir_z = ray.d.z;
    r.tnear = kLeastT;
    r.tfar = t_max;
    r.time = 0;
    r.mask = mask;
    r.id = 0;
    r.flags = 0;
}

/// How far Embree should look: past a sphere by so little that whatever is as near as the sphere is found for sure, and compared here.
float told(float t_max, SphereMet const& sphere) {
    return min(t_max, PacketContext::told(static_cast<float>(sphere.t)));
}

struct alignas(32) Valid : std::array<int, kLanes> {};

void fill(RTCRay8& r, RayPacket const& rays, LaneMask lanes, std::uint32_t mask, Valid& valid) {
    auto const copy = [](float(&to)[kLanes], FloatLanes const& from) {
        std::copy(from.begin(), from.end(), to);
    };
    copy(r.org_x, rays.o.x), copy(r.org_y, rays.o.y), copy(r.org_z, rays.o.z);
    copy(r.dir_x, rays.d.x), copy(r.dir_y, rays.d.y), copy(r.dir_z, rays.d.z);
    copy(r.tfar, rays.t_max);
    for (std::size_t i = 0; i < kLanes; ++i) {
        valid[i] = (lanes >> i & 1u) != 0 ? -1 : 0;
        r.tnear[i] = kLeastT;
        r.time[i] = 0;
        r.mask[i] = mask;
        r.id[i] = 0;
        r.flags[i] = 0;
    }
}
}  // namespace

bool RayCaster::nearest(Ray const& ray, float t_max, RawHit& hit, std::uint32_t sees) const {
    SphereMet const sphere = impl_->spheres.nearest(ray, kLeastT, t_max, sees);
    RTCRayHit rh;
    fill(rh.ray, ray, told(t_max, sphere), sees);
    rh.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if NEPHROID_EMBREE == 4
    rtcIntersect1(impl_->groups.front(), &rh);
#else
    Context context;
    begin(context);
    rtcIntersect1(impl_->groups.front(), &context, &rh);
#endif
    hit.found = rh.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    if (sphere.found() && !(hit.found && rh.ray.tfar <= sphere.t)) {
        impl_->spheres.complete(ray, sphere, hit);
        return true;
    }
    if (!hit.found) return false;
    hit.t = rh.ray.tfar;
    hit.u = rh.hit.u;
    hit.v = rh.hit.v;
    hit.local = {rh.hit.Ng_x, rh.hit.Ng_y, rh.hit.Ng_z};
    hit.geometry = rh.hit.geomID;
    hit.primitive = rh.hit.primID;
    hit.instance = instance_of(rh.hit.instID[0]);
    return true;
}

bool RayCaster::any(Ray const& ray, float t_max) const {
    if (impl_->spheres.nearest(ray, kLeastT, t_max, seen(Passage::Solid)).found()) return true;
    RTCRay r;
    fill(r, ray, t_max, seen(Passage::Solid));
#if NEPHROID_EMBREE == 4
    rtcOccluded1(impl_->groups.front(), &r);
#else
    Context context;
    begin(context);
    rtcOccluded1(impl_->groups.front(), &context, &r);
#endif
    return r.tfar < 0.0f;
}

void RayCaster::nearest(RayPacket const& rays, LaneMask lanes, std::array<RawHit, kLanes>& hits) const {
    RTCRayHit8 rh;
    Valid valid;
    fill(rh.ray, rays, lanes, kAll, valid);
    for (std::size_t i = 0; i < kLanes; ++i) {
        rh.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        rh.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    PacketContext context;
    begin(context);
    SphereMetLanes spheres;
    impl_->spheres.nearest(rays, lanes, kLeastT, kAll, spheres);
    for (std::size_t i = 0; i < kLanes; ++i) {
        SphereMet const sphere = spheres[i];
        rh.ray.tfar[i] = told(rays.t_max[i], sphere);
        if (sphere.found())
            context.met[i] = {static_cast<float>(sphere.t), RTC_INVALID_GEOMETRY_ID,
                              impl_->spheres.geometry(sphere), 0};
    }
#if NEPHROID_EMBREE == 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_COHERENT |
                                                    RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
    arguments.context = &context;
    arguments.filter = packet_filter;
    rtcIntersect8(valid.data(), impl_->groups.front(), &rh, &arguments);
#else
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.filter = packet_filter;
    rtcIntersect8(valid.data(), impl_->groups.front(), &context, &rh);
#endif
    for (std::size_t i = 0; i < kLanes; ++i) {
        RawHit& hit = hits[i];
        hit.found = rh.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        if (!hit.found) {
            // Embree found nothing nearer.
            if (spheres[i].found() && (lanes >> i & 1u) != 0)
                impl_->spheres.complete(rays.ray(i), spheres[i], hit);
            continue;
        }
        hit.t = context.met[i].t;
        hit.u = rh.hit.u[i];
        hit.v = rh.hit.v[i];
        hit.local = {rh.hit.Ng_x[i], rh.hit.Ng_y[i], rh.hit.Ng_z[i]};
        hit.geometry = rh.hit.geomID[i];
        hit.primitive = rh.hit.primID[i];
        hit.instance = instance_of(rh.hit.instID[0][i]);
    }
}

LaneMask RayCaster::any(RayPacket const& rays, LaneMask lanes) const {
    LaneMask met = 0;
    if (instanced_) {
        for (LaneMask left = lanes; left != 0; left &= left - 1) {
            auto const i = static_cast<std::size_t>(std::countr_zero(left));
            met |= static_cast<LaneMask>(any(rays.ray(i), rays.t_max[i])) << i;
        }
        return met;
    }
    if (!impl_->spheres.empty()) {
        SphereMetLanes spheres;
        impl_->spheres.nearest(rays, lanes, kLeastT, seen(Passage::Solid), spheres);
        for (std::size_t i = 0; i < kLanes; ++i) met |= static_cast<LaneMask>(spheres[i].found()) << i;
        met &= lanes;
        lanes &= ~met;
        if (lanes == 0) return met;
    }
    RTCRay8 r;
    Valid valid;
    fill(r, rays, lanes, seen(Passage::Solid), valid);
#if NEPHROID_EMBREE == 4
    rtcOccluded8(valid.data(), impl_->groups.front(), &r);
#else
    Context context;
    begin(context);
    rtcOccluded8(valid.data(), impl_->groups.front(), &context, &r);
#endif
    LaneMask hidden = 0;
    for (std::size_t i = 0; i < kLanes; ++i) hidden |= static_cast<LaneMask>(r.tfar[i] < 0.0f) << i;
    return met | (hidden & lanes);
}

Bounds3 RayCaster::bounds() const {
    RTCBounds b;
    rtcGetSceneBounds(impl_->groups.front(), &b);
    Bounds3 all = impl_->spheres_bounds;
    if (b.lower_x <= b.upper_x)
        all.add({{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}});
    return all;
}

std::size_t RayCaster::bytes() const {
    return static_cast<std::size_t>(std::max<std::int64_t>(0, impl_->bytes.load())) + impl_->spheres.bytes();
}

}  // namespace nephroid
