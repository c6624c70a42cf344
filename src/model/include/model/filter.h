// Pixel reconstruction filters, sampled by importance: a camera sample touches one pixel (Ernst et al. 2006; PBRT 4th ed., 8.8).
#pragma once

#include "math/vec.h"
#include "scene/match.h"
#include "scene/settings.h"

#include <cstdint>
#include <vector>

namespace nephroid {

/// An offset from the pixel's centre (pixels) and the sample's weight f / pdf, normalised so that its mean is 1.
/// Filters with negative lobes give negative weights.
struct FilterSample {
    Vec2 offset{0, 0};
    float weight = 1;
};

/// A pixel that something at a place of the film counts for, and with which weight: f / probability, normalised as above; 0
/// where the filters of no pixels reach.
struct FilterPixel {
    Vec2i pixel{0, 0};
    float weight = 0;
};

/// Not normalised value of the filter at an offset; 0 outside its radius.
float evaluate(Filter const& filter, Vec2 offset);
Vec2 radius(Filter const& filter);

/// All filters here are products of two one-dimensional ones, so each axis has its own sampler.
class FilterSampler {
  public:
    explicit FilterSampler(Filter const& filter);
    [[nodiscard]] FilterSample sample(Vec2 u) const;
    /// One of the pixels whose filters reach `raster`, each as likely as |f| there is large: light that finds the film by
    /// itself touches one pixel, too. The pixel may lie beyond the picture's edge.
    [[nodiscard]] FilterPixel choose_pixel(Vec2 raster, Vec2 u) const;
    /// Density of the offset, per square pixel.
    [[nodiscard]] float pdf(Vec2 offset) const;
    /// Integral of the filter.
    [[nodiscard]] float integral() const { return integral_; }

  private:
    /// |f| of one axis over [-r, r] in cells of constant density, with f itself linear across each cell.
    struct Axis {
        struct Cell {
            float cdf = 0;            // at the cell's left edge
            float inverse_width = 0;  // 1 / (cdf there - cdf here)
            float weight = 0,
                  slope = 0;  // f / density, divided by the axis's integral: at the left edge, and its change
            float density = 0;  // per pixel
        };
        std::vector<Cell> cells;           // and one more, from 1 on, that ends every search
        std::vector<std::uint32_t> guide;  // guide[k]: where the search for u >= k / size starts
        float radius = 0, cell_size = 0, guide_size = 0;

        [[nodiscard]] float sample(float u, float& weight) const;
        [[nodiscard]] float pdf(float offset) const;
    };
    static Axis tabulate(Filter const& filter, int axis, double& integral);

    Filter filter_;
    Vec2 radius_;
    Axis x_, y_;  // unused by box and triangle
    float integral_ = 1;
};

}  // namespace nephroid
