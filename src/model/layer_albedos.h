// Directional albedos that have no closed form, as tools/layer_albedos.cpp computes them during the build:
// GGX with Schlick's Fresnel reflectance, and sheen. Nodes lie at equal steps of sqrt(mu), because albedos
// bend most at grazing angles, and of roughness = sqrt(alpha); between them they are linear, and the means
// are those of just that.
#pragma once

#include <array>

namespace nephroid {

struct LayerAlbedos {
    static constexpr int kAngles = 48, kRough = 64;                              // cells
    static constexpr int kMajor = 16, kRatio = 10, kTurns = 8, kFewAngles = 24;  // of anisotropic facets

    template <int N>
    using Row = std::array<float, N + 1>;
    /// Isotropic facets, roughness 0 ... 1: with F = 1, and with F = (1 - c)^5.
    std::array<Row<kAngles>, kRough + 1> one, edge;
    Row<kRough> one_mean, edge_mean;
    /// Anisotropic ones: roughness along x 0 ... 1, that along y as a part of it, azimuth 0 ... pi / 2 from
    /// x.
    using Azimuths = std::array<Row<kFewAngles>, kTurns + 1>;
    std::array<std::array<Azimuths, kRatio + 1>, kMajor + 1> anisotropic_one, anisotropic_edge;
    std::array<Row<kRatio>, kMajor + 1> anisotropic_one_mean, anisotropic_edge_mean;
    /// What isotropic facets of a solid's boundary scatter in all, linear in its f0 and f90: base + f0 first
    /// + f90 edge. From outside and from inside; 1 / index from 1 / kIndexMax to 1, roughness 0 ... 1.
    static constexpr int kIndices = 12, kSolidRough = 20;
    static constexpr float kIndexMax = 3;
    struct Solid {
        float base, first, edge;
    };
    template <class X>
    using BySolid = std::array<std::array<std::array<X, kSolidRough + 1>, kIndices + 1>, 2>;
    BySolid<std::array<Solid, kFewAngles + 1>> solid;
    BySolid<Solid> solid_mean;
    /// White sheen, from its least roughness to 1.
    std::array<Row<kAngles>, kRough + 1> sheen;
};

}  // namespace nephroid

/// tools/layer_albedos's output, put here by the build (cmake/built_table.cmake).
extern nephroid::LayerAlbedos const nephroid_layer_albedos;
