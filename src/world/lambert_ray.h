// How a surface that shines sends light: by the cosine, on either side where both shine.
#pragma once

#include "math/frame.h"
#include "sampling/warp.h"

namespace nephroid {

inline float lambert_density(float cosine, bool two_sided) {
    return cosine_hemisphere_pdf(cosine) * (two_sided ? 0.5f : 1.0f);
}

struct LambertRay {
    Vec3 n, d;      // n: of the side that was chosen
    float pdf = 0;  // by solid angle

    [[gnu::always_inline]] LambertRay(Vec3 normal, bool two_sided, Vec2 u) {
        // Said without a choice between the two cases, so that lanes may use it.
        float const sides = two_sided ? 2.0f : 1.0f;
        bool const back = sides * u.x >= 1.0f;
        u.x = min(sides * (back ? u.x - 0.5f : u.x), kOneMinusEpsilon);
        n = normal * (back ? -1.0f : 1.0f);
        d = normalize(frame_from_z(n).from_local(square_to_cosine_hemisphere(u)));
        pdf = lambert_density(dot(n, d), two_sided);
    }
};

}  // namespace nephroid
