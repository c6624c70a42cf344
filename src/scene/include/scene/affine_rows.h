// The rows that an instance keeps, and the matrix in double that chains of transforms are multiplied in.
#pragma once

#include "scene/scene.h"

namespace nephroid {

inline Mat4 matrix_of(AffineRows const& rows) {
    Mat4 m;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t k = 0; k < 4; ++k) m.m[r][k] = static_cast<double>(rows[r][k]);
    return m;
}

/// Rounded to float; without the last row, which says nothing in an affine matrix.
inline AffineRows rows_of(Mat4 const& m) {
    AffineRows rows;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t k = 0; k < 4; ++k) rows[r][k] = static_cast<float>(m.m[r][k]);
    return rows;
}

}  // namespace nephroid
