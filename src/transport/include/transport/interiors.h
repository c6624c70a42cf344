// The bodies that a path is in: nested dielectrics (Schmidt & Budge 2002, "Simple Nested Dielectrics in Ray Traced Images").
//
// Bodies may overlap, as a liquid does with the glass that holds it: where they do, the one of the highest priority is there, and
// the boundaries of the others are not. What is there says how much light is absorbed, and what index is outside of the next
// boundary. A body of priority 0 takes no part: all its boundaries are there, with the index as given.
#pragma once

#include "model/material.h"
#include "world/world.h"

#include <array>

namespace nephroid {

/// What a surface is made of, and what a mix of it was resolved to where it was met. A body is what was entered, and is left by its
/// surface, whatever that is there.
struct Boundary {
    MaterialId surface, material;
};

class Interiors {
  public:
    /// Is this boundary, met from outside (inwards) or from inside, within a body that outranks it?
    [[nodiscard]] bool hides(Assets const& assets, Boundary const& b, bool inwards) const;
    void cross(Boundary const& b, bool inwards);
    /// Absorption where the path is, 1 / length.
    [[nodiscard]] Spectrum absorption(Assets const& assets, Wavelengths const& lambda) const;
    /// Makes the index of a boundary relative to what is around it there.
    void immerse(Assets const& assets, Boundary const& b, bool inwards, Wavelengths const& lambda,
                 Bsdf& bsdf) const;
    [[nodiscard]] bool empty() const { return count_ == 0; }

  private:
    /// The body that is there, once the one with the surface `without` that was entered last is left; none for empty space.
    [[nodiscard]] MaterialId highest(Assets const& assets, MaterialId without = {}) const;

    static constexpr std::size_t kMost = 8;  // bodies beyond that are forgotten
    std::array<Boundary, kMost> bodies_;     // in the order in which they were entered
    std::uint32_t count_ = 0;
};

/// The bodies that p is in: a ray to infinity leaves each of them once more often than it enters it.
Interiors interiors_at(World const& world, Vec3 p, RayStats& stats);

}  // namespace nephroid
