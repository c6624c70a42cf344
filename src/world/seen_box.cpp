#include "seen_box.h"

#include "seen_flat.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

SeenBox::SeenBox(BoxLight const& box, Receiver const& to, ShapeSampling how, bool two_sided)
    : box_(box), to_(to), how_(how) {
    Vec3 const v = to.p - box.corner;
    for (std::size_t i = 0; i < 3; ++i) above_[i] = dot(box.out[i], v);
    // Far away the faces' solid angles are their projected areas.
    Vec3 const centre = box.corner + 0.5f * (box.edge[0] + box.edge[1] + box.edge[2]);
    if (how_ == ShapeSampling::SolidAngle && distance_squared(centre, to.p) > kFar2 * box.size2)
        how_ = ShapeSampling::Projected;
    for (std::uint32_t i = 0; i < 6; ++i) {
        float& weight = weight_[i];
        float const area = box.area[i / 2];
        if (how_ == ShapeSampling::Area) {
            weight = area;
        } else if (emits_to(i, two_sided)) {
            visible_area_ += area;
            Face const f = face(i);
            switch (how_) {
                case ShapeSampling::VisibleArea:
                    weight = area;
                    break;
                case ShapeSampling::VisibleUnweighed:
                    weight = 1;
                    break;
                case ShapeSampling::Projected: {
                    Vec3 const middle =
                        f.corner + 0.5f * (box.edge[(f.axis + 1) % 3] + box.edge[(f.axis + 2) % 3]);
                    Vec3 const d = middle - to.p;
                    weight = area * abs_dot(box.out[f.axis], d) / length(d);
                    break;
                }
                default:
                    weight = seen_solid_angle(f.corner - to.p, box.edge[(f.axis + 1) % 3],
                                              box.edge[(f.axis + 2) % 3], box.right_angled);
            }
            if (!(weight >= 0.0f) || !std::isfinite(weight)) weight = 0;
        }
        sum_ += weight;
    }
}

SeenBox::Face SeenBox::face(std::uint32_t i) const {
    std::size_t const axis = i / 2;
    bool const far_end = i % 2 != 0;
    return {far_end ? box_.corner + box_.edge[axis] : box_.corner, axis, far_end};
}

bool SeenBox::emits_to(std::uint32_t i, bool two_sided) const {
    std::size_t const axis = i / 2;
    float const h = above_[axis];
    bool const outside = i % 2 != 0 ? h > box_.height[axis] : h < 0.0f;
    if (!two_sided) return outside != box_.inwards;
    // From outside the near faces hide the others.
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && above_[k] >= 0.0f && above_[k] <= box_.height[k];
    return outside || inside;
}

float SeenBox::claimed_area_pdf(std::uint32_t i) const {
    // The one that is wrong on purpose: faces are as likely as each other, and counted as if the visible area were.
    if (how_ == ShapeSampling::VisibleUnweighed) return 1.0f / visible_area_;
    return weight_[i] / (sum_ * box_.area[i / 2]);
}

bool SeenBox::sample(Vec2 u, LightSample& s) const {
    if (!(sum_ > 0.0f)) return false;
    // The face by u.x, which is then spread anew.
    float left = u.x * sum_;
    std::uint32_t chosen = 6;
    for (std::uint32_t i = 0; i < 6; ++i) {
        if (!(weight_[i] > 0.0f)) continue;
        chosen = i;
        if (left < weight_[i]) break;
        left -= weight_[i];
    }
    u.x = min(max(left, 0.0f) / weight_[chosen], kOneMinusEpsilon);
    Face const f = face(chosen);
    Vec3 const a = box_.edge[(f.axis + 1) % 3];
    Vec3 const b = box_.edge[(f.axis + 2) % 3];
    if (how_ == ShapeSampling::SolidAngle) u = sample_seen(f.corner - to_.p, a, b, box_.right_angled, u);
    s.p = f.corner + u.x * a + u.y * b;
    s.p_error = box_.p_error;
    s.n = f.far_end == box_.inwards ? -box_.out[f.axis] : box_.out[f.axis];
    Vec3 const d = s.p - to_.p;
    float const r2 = length_squared(d);
    if (!(r2 > 0.0f)) return false;
    s.wi = d * (1.0f / std::sqrt(r2));
    s.pdf = pdf(chosen, s.p, s.wi);
    return s.pdf > 0.0f && std::isfinite(s.pdf);
}

float SeenBox::pdf(std::uint32_t i, Vec3 p, Vec3 w) const {
    if (!(weight_[i] > 0.0f)) return 0.0f;
    if (how_ == ShapeSampling::SolidAngle) return 1.0f / sum_;
    float const cosine = abs_dot(box_.out[i / 2], w);
    return cosine > 0.0f ? claimed_area_pdf(i) * distance_squared(p, to_.p) / cosine : 0.0f;
}

}  // namespace nephroid
