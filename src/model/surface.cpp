#include "model/surface.h"

namespace nephroid {

namespace {

/// Bound on the error of a mapped point, as seen by a ray that the intersector maps *back* into the surface's own space:
/// that rounding happens again on the way in, so it is added to the offset (in target-space units).
Vec3 round_trip_error(AffineMap const& map, Vec3 p_local, Vec3 p_error) {
    Vec3 const forward = map.point_error(p_local, p_error);
    // Mapping back rounds, and so does the inverse that does it: by a few ulps of |M^-1| (|p| + |t|) in local space, which are
    // R (|p| + |t|) out here, R = |M| |M^-1|. R's diagonal is at least 1 and its rows sum to at most round_trip, so that
    // (R b)_i <= b_i + (round_trip - 1) max b.
    Vec3 const t = abs(Vec3{map.m[0][3], map.m[1][3], map.m[2][3]});
    Vec3 const b = map.magnify(abs(p_local)) + t;
    return forward + gamma_bound(8) * (b + Vec3{(map.round_trip - 1.0f) * max_component(b)});
}

}  // namespace

SurfacePoint transformed(AffineMap const& map, SurfacePoint const& s) {
    float const side = map.determinant() < 0.0f ? -1.0f : 1.0f;
    SurfacePoint r;
    r.p = map.point(s.p);
    r.p_error = round_trip_error(map, s.p, s.p_error);
    r.ng = normalize(map.area_vector(s.ng) * side);
    r.ns = s.ns == s.ng ? r.ng : normalize(map.area_vector(s.ns) * side);  // most have one normal
    r.uv = s.uv;
    r.dpdu = map.vector(s.dpdu);
    r.dpdv = map.vector(s.dpdv);
    return r;
}

ShapeSample transformed(AffineMap const& map, ShapeSample const& s) {
    Vec3 const area = map.area_vector(s.n);
    float const stretch = length(area);
    ShapeSample r;
    r.p = map.point(s.p);
    r.p_error = round_trip_error(map, s.p, s.p_error);
    r.n = area * ((map.determinant() < 0.0f ? -1.0f : 1.0f) / stretch);
    r.uv = s.uv;
    r.pdf_area = s.pdf_area / stretch;
    return r;
}

}  // namespace nephroid
