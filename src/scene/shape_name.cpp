#include "scene/shape_name.h"

#include "scene/match.h"

namespace nephroid {

char const* name_of(Shape const& shape) {
    return match(
        shape, [](TriangleMesh const&) { return "trianglemesh"; },
        [](BilinearMesh const&) { return "bilinearmesh"; },
        [](LoopSubdivision const&) { return "loopsubdiv"; }, [](Sphere const&) { return "sphere"; },
        [](Cylinder const&) { return "cylinder"; }, [](Disk const&) { return "disk"; },
        [](Box const&) { return "box"; }, [](Quad const&) { return "quad"; });
}

}  // namespace nephroid
