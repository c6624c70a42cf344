// All lights of a world, and the choice of one of them with a probability proportional to its power.
#pragma once

#include "model/light.h"
#include "records.h"
#include "sampling/distribution.h"

#include <vector>

namespace nephroid {

/// What an object's surface emits; shared by its parts and appearances.
struct Emitter {
    RuntimeSpectrum radiance;  // scale applied
    AreaLight const* light = nullptr;
    float image_scale = 1;
    float image_mean = 1;  // mean of the picture's luminance
};

/// A part of an appearance of an emitting object, or a light without a surface.
struct LightEntry {
    std::uint32_t record = kNoInstance;  // kNoInstance: `part` is a LightId
    std::uint32_t part = 0;
    std::uint32_t instance = kNoInstance;
    // A triangle that emits the same everywhere, in world space; area_pdf = 0 where the part has to be asked.
    float area_pdf = 0;  // 1 / area
    Vec3 corner{0, 0, 0}, edge1{0, 0, 0}, edge2{0, 0, 0};
    Vec3 normal{0, 0, 1};   // of the side that emits
    Vec3 p_error{0, 0, 0};  // of any of its points
};

class LightTable {
  public:
    std::vector<Emitter> emitters;
    std::vector<LightData> data;  // by LightId
    std::vector<LightId> infinite;
    std::vector<LightEntry> entries;
    std::vector<std::uint32_t> entry_of_light;  // by LightId
    AliasTable choice;

    [[nodiscard]] std::size_t bytes() const;
};

}  // namespace nephroid
