#include "points_shown.h"

#include "plot.h"

namespace nephroid::experiment {

std::vector<NamedSequence> const& shown_sequences() {
    auto const sequence = [](SequenceKind kind, std::uint32_t strata) {
        Sequence q;
        q.kind = kind, q.x_strata = q.y_strata = strata;
        return q;
    };
    static std::vector<NamedSequence> const all{
        {"independent", sequence(SequenceKind::Independent, 1), 1},
        {"quadrant (16 × 2 × 2)", sequence(SequenceKind::Stratified, 2), 2},
        {"stratified 8 × 8", sequence(SequenceKind::Stratified, 8), 8},
        {"Sobol', Owen's scramble", sequence(SequenceKind::Sobol, 1), 8}};
    return all;
}

std::vector<Vec2> first_points(Sequence const& sequence, std::uint64_t pixel, int count) {
    std::vector<Vec2> points;
    for (int pass = 0; pass < count; ++pass) {
        PathSampler sampler(sequence, 0, pixel, static_cast<std::uint64_t>(pass));
        sampler.at(0);
        points.push_back(sampler.next_2d());
    }
    return points;
}

void points_shown(Page& page) {
    std::vector<PointPanel> panels;
    for (NamedSequence const& s : shown_sequences())
        panels.push_back({s.name, first_points(s.sequence, 0, 64), s.cells});
    page.save("points.svg", point_plot(panels));
    page.image("points.svg", "64 points of the unit square by four samplers");
    page.text(
        "The first 64 points of one two-dimensional draw of one pixel, as `PathSampler` gives them (the "
        "report's Figure 11 is "
        "the first and the third panel). The quadrant sampler puts each four points into four quadrants; 8 × "
        "8 strata hold "
        "one point each; so do all 8 × 8 cells of the Sobol' points, and all 64 × 1, 32 × 2 … as well.");
}

}  // namespace nephroid::experiment
