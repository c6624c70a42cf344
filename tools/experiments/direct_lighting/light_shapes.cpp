// Each shape as a light: uniform by area and chosen by power, against what is the default.
#include "sections.h"

#include "measure.h"
#include "scenes.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::experiment {

namespace {

constexpr char const* kBefore =
    R"(Integrator "direct" "string strategy" "light" "string lightsampler" "power" "string shapesampling" "area")";
constexpr char const* kAfter =
    R"(Integrator "direct" "string strategy" "light" "string lightsampler" "bvh" "string shapesampling" "solidangle")";
constexpr char const* kSampler = "\nSampler \"independent\"";

struct Emitter {
    std::string name, shape;  // around the origin, down to z = -0.5 or less far, the flat ones looking down
};
std::vector<Emitter> emitters() {
    return {
        {"sphere, radius 0.5", "Shape \"sphere\" \"float radius\" 0.5\n"},
        {"disk, radius 0.5", "Translate 0 0 -0.5\nReverseOrientation\nShape \"disk\" \"float radius\" 0.5\n"},
        {"cylinder, radius 0.3, length 1.4, lying",
         "Translate 0 0 -0.2\nRotate 90 0 1 0\nShape \"cylinder\" \"float radius\" 0.3 \"float zmin\" -0.7 "
         "\"float zmax\" 0.7\n"},
        {"rectangle of two triangles, 1 × 1",
         "Shape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2 ]\n"
         "    \"point3 P\" [ -0.5 -0.5 -0.5  0.5 -0.5 -0.5  0.5 0.5 -0.5  -0.5 0.5 -0.5 ]\n"},
        {"quad, 1 × 1",
         "Shape \"quad\" \"point3 origin\" [ -0.5 -0.5 -0.5 ] \"vector3 u\" [ 0 1 0 ] \"vector3 v\" [ 1 0 0 "
         "]\n"},
        {"box, 0.8 × 0.8 × 0.6, turned by 20°",
         "Rotate 20 0 0 1\nShape \"box\" \"point3 lo\" [ -0.4 -0.4 -0.5 ] \"point3 hi\" [ 0.4 0.4 0.1 ]\n"},
        {"sphere of 320 triangles, radius 0.5", scenes::icosphere()},
    };
}

}  // namespace

void light_shapes(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "One light of each shape above 2 × 2 units of a floor, near (its lowest point at a height of 0.5) "
        "and far (at 8), "
        "nothing in the way: the variance of one light sample. Before: points uniform over the surface, "
        "triangles chosen by "
        "power. After: points by what the receiver sees, triangles by what they may contribute. The last "
        "column is what must "
        "not change: the mean of after against that of before, with its standard error.");
    page.code(std::string("# before\n") + kBefore + "\n# after\n" + kAfter + "\n# both" + kSampler);
    std::vector<std::vector<std::string>> rows;
    int const n = lab.pixels(32);
    for (auto const& [where, height] : {std::pair{"near", 1.0f}, std::pair{"far", 8.5f}})
        for (Emitter const& e : emitters()) {
            Setup const setup = prepare(
                scenes::floor_view(n, n, scenes::Pixels::Points, -1, 1, -1, 1) + scenes::matte(0.5f) +
                scenes::floor() + scenes::light(1, fmt::format("Translate 0 0 {}\n", height) + e.shape));
            std::uint64_t const passes = lab.passes(512);
            int const seeds = lab.seeds(4);
            auto const before = variance_per_sample(setup, std::string(kBefore) + kSampler, passes, seeds);
            auto const after = variance_per_sample(setup, std::string(kAfter) + kSampler, passes, seeds);
            rows.push_back({e.name, where, with_error(before.relative, before.error),
                            with_error(after.relative, after.error),
                            after.relative > 0 ? number(before.relative / after.relative) : "no noise left",
                            with_error(100 * (after.mean / before.mean - 1),
                                       100 * std::hypot(after.mean_error, before.mean_error) / before.mean) +
                                "%"});
        }
    page.table({"light", "receivers", "variance before", "after", "before / after", "mean"}, rows);
    page.text(
        "The ratio is how many samples the old way needs for one of the new. Far from a flat light little is "
        "to be gained: all "
        "of its points look alike from there. Of a closed one half is turned away at any distance, and a "
        "sample by area finds "
        "that out the hard way.");
}

}  // namespace nephroid::experiment
