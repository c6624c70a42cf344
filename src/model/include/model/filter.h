// Pixel reconstruction filters, sampled by importance: a camera sample touches one pixel (Ernst et al. 2006; PBRT 4th ed., 8.8).
#pragma once

#include "sampling/distribution.h"
#include "scene/match.h"
#include "scene/settings.h"

namespace nephroid {

/// An offset from the pixel's centre (pixels) and the sample's weight f / pdf, normalised so that its mean is 1.
/// Filters with negative lobes give negative weights.
struct FilterSample {
    Vec2 offset{0, 0};
    float weight = 1;
};

/// Not normalised value of the filter at an offset; 0 outside its radius.
float evaluate(Filter const& filter, Vec2 offset);
Vec2 radius(Filter const& filter);

/// All filters here are products of two one-dimensional ones, so each axis has its own sampler.
class FilterSampler {
  public:
    explicit FilterSampler(Filter const& filter);
    [[nodiscard]] FilterSample sample(Vec2 u) const;
    /// Density of the offset, per square pixel.
    [[nodiscard]] float pdf(Vec2 offset) const;
    /// Integral of the filter.
    [[nodiscard]] float integral() const { return integral_; }

  private:
    Filter filter_;
    Vec2 radius_;
    Distribution1D x_, y_;  // |f| tabulated over [-r, r]; unused by box and triangle
    float integral_ = 1;
};

}  // namespace nephroid
