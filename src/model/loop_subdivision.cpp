// Loop subdivision surfaces by OpenSubdiv: refine, then move the vertices to the limit surface and take its normals.
#include "math/error.h"
#include "model/shape.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>

namespace nephroid {

namespace {

namespace Far = OpenSubdiv::Far;

/// What OpenSubdiv interpolates: it asks for Clear and AddWithWeight.
struct Point {
    Vec3 v{0, 0, 0};
    void Clear(void* = nullptr) { v = Vec3{0, 0, 0}; }
    void AddWithWeight(Point const& p, float w) { v += w * p.v; }
};

}  // namespace

TriangleMesh subdivide(LoopSubdivision const& control) {
    using Descriptor = Far::TopologyDescriptor;
    std::vector<int> const counts(control.triangles.size(), 3);
    std::vector<int> indices;
    indices.reserve(3 * control.triangles.size());
    for (Vec3i const& t : control.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    Descriptor descriptor;
    descriptor.numVertices = static_cast<int>(control.p.size());
    descriptor.numFaces = static_cast<int>(control.triangles.size());
    descriptor.numVertsPerFace = counts.data();
    descriptor.vertIndicesPerFace = indices.data();

    OpenSubdiv::Sdc::Options scheme;
    scheme.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = Far::TopologyRefinerFactory<Descriptor>;
    std::unique_ptr<Far::TopologyRefiner> const refiner(
        Factory::Create(descriptor, Factory::Options(OpenSubdiv::Sdc::SCHEME_LOOP, scheme)));
    if (!refiner)
        throw Error(ErrorKind::Input,
                    "the subdivision mesh is not a surface: check for repeated or dangling faces");
    Far::TopologyRefiner::UniformOptions uniform(control.levels);
    uniform.fullTopologyInLastLevel = true;  // limits need it
    refiner->RefineUniform(uniform);

    Far::PrimvarRefiner const primvar(*refiner);
    std::vector<Point> points(control.p.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i].v = control.p[i];
    for (int level = 1; level <= control.levels; ++level) {
        std::vector<Point> next(static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
        primvar.Interpolate(level, points, next);
        points = std::move(next);
    }
    std::vector<Point> limit(points.size());
    std::vector<Point> du(points.size());
    std::vector<Point> dv(points.size());
    primvar.Limit(points, limit, du, dv);

    TriangleMesh mesh;
    for (std::size_t i = 0; i < limit.size(); ++i) {
        mesh.p.push_back(limit[i].v);
        Vec3 const n = cross_accurate(du[i].v, dv[i].v);
        float const len = length(n);
        mesh.n.push_back(len > 0.0f ? n / len : Vec3{0, 0, 0});
    }
    auto const& last = refiner->GetLevel(control.levels);
    for (int f = 0; f < last.GetNumFaces(); ++f) {
        auto const v = last.GetFaceVertices(f);
        mesh.triangles.push_back({v[0], v[1], v[2]});
    }
    return mesh;
}

}  // namespace nephroid
