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

class LightTable {
  public:
    /// One entry: a part of an appearance of an emitting object, or a light without a surface.
    struct Entry {
        std::uint32_t record = kNoInstance;  // kNoInstance: `part` is a LightId
        std::uint32_t part = 0;
        std::uint32_t instance = kNoInstance;
        float area_pdf =
            0;  // 1 / area of a triangle, whose density is the same everywhere; else 0: ask the part
    };

    std::vector<Emitter> emitters;
    std::vector<LightData> data;  // by LightId
    std::vector<LightId> infinite;
    std::vector<Entry> entries;
    std::vector<std::uint32_t> entry_of_light;  // by LightId
    AliasTable choice;

    [[nodiscard]] std::size_t bytes() const;
};

}  // namespace nephroid
