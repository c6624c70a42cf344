// The camera of a .ray file: right-handed, looking along -z of its own space with y up, its field of view that of the height.
#pragma once

#include "ray_input.h"

#include <optional>

namespace nephroid {

class RayCamera {
  public:
    explicit RayCamera(RayInput& in) : in_(in) {}

    /// Reads the block after `camera`. A second one changes what it says.
    void read();
    /// Sets the scene's camera and the size of its picture.
    void finish(SourceLocation file) const;

  private:
    using Triple = std::array<double, 3>;
    void set_view(SourceLocation where, std::optional<Triple> const& view,
                  std::optional<Triple> const& look_at, std::optional<Triple> const& up);
    void set_quaternion(SourceLocation where, std::array<double, 4> const& q);

    RayInput& in_;
    std::optional<SourceLocation> where_;
    Triple position_{0, 0, 0}, view_{0, 0, -1}, up_{0, 1, 0};
    double fov_ =
        0.92729521800161219;  // radians: a picture of height 1 at distance 1, as those programs began
    double aspect_ = 1;
};

}  // namespace nephroid
