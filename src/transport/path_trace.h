// What the walk says of its path while it goes, where somebody asked (transport/replay.h). A render asks for nothing: each of these
// calls is behind a test of one pointer, and cold, so that its code and its registers are out of the way.
#pragma once

#include "transport/replay.h"
#include "walk.h"

namespace nephroid {

class PathTrace {
  public:
    explicit PathTrace(PathRecord& record) : record_(record) {}

    [[gnu::cold]] void begins(PathContext const& c, Vec2 film, CameraRay const& camera);
    [[gnu::cold]] void ends(SeenLight const& seen, Vec3 value, float filter_weight);

    // Along the ray.
    [[gnu::cold]] void met_light(Walk const& walk, SurfaceHit const& hit, Spectrum seen, float weight,
                                 float light_pdf);
    [[gnu::cold]] void met_sky(Walk const& walk, LightId light, Spectrum seen, float weight, float light_pdf);
    [[gnu::cold]] void left(Walk const& walk);
    [[gnu::cold]] void arrived(Walk const& walk, Vertex const& v);
    // At the vertex.
    [[gnu::cold]] void scatters(Vertex const& v);
    [[gnu::cold]] void occluded(Walk const& walk, LightSample const& light);
    /// `direct` is without the walk's beta.
    [[gnu::cold]] void lit(Walk const& walk, LightSample const& light, Spectrum direct, float weight,
                           float passing);
    /// No direction came out.
    [[gnu::cold]] void absorbed();
    [[gnu::cold]] void scattered(PathContext const& c, Walk const& walk, Vertex const& v, BsdfSample const& s,
                                 Vec3 wi);
    [[gnu::cold]] void chance(float survival, bool died);

    /// Where the path is: the index of the vertex that was reached last, or gone back to for the next branch of a tree.
    [[nodiscard]] int at() const { return at_; }
    [[gnu::cold]] void back_to(int vertex) { at_ = vertex; }

  private:
    PathVertex& here() { return record_.vertices[static_cast<std::size_t>(at_)]; }
    /// One more, which is where the walk's ray goes from here.
    PathVertex& add(Walk const& walk);
    LightTried& try_light(Walk const& walk, LightSample const& light);

    PathRecord& record_;
    SeenLight met_, lit_;  // emission that the path ran into, and light that was sampled
    RenderJob const* job_ = nullptr;
    int at_ = -1;  // the camera
};

}  // namespace nephroid
