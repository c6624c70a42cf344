// From what the intersector says to a point on a surface: every path passes here at every hit.
#include "ray_caster.h"
#include "world/world.h"
#include "world_parts.h"

namespace nephroid {

void World::complete(RawHit const& raw, SurfaceHit& hit) const {
    InstanceRecord const* instance = raw.instance == kNoInstance ? nullptr : &parts_->instances[raw.instance];
    std::uint32_t const index = (instance ? instance->first_record : 0) + raw.geometry;
    ObjectRecord const& record = parts_->records[index];
    hit.t = raw.t;
    hit.hit_uv = {raw.u, raw.v};
    hit.record = index;
    hit.part = raw.primitive;
    hit.instance = raw.instance;
    hit.material = record.material;
    hit.emits = record.emits();
    hit.passage = record.passage;
    surface_at(record, instance, {static_cast<double>(raw.t), raw.u, raw.v, raw.primitive}, raw.local,
               record.textured, hit.s);
}

}  // namespace nephroid
