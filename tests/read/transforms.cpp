// Transform directives against matrices worked out by hand.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// The transform of a sphere after `text`.
Mat4 ctm(std::string const& text) {
    return read_world(text + "\nShape \"sphere\"").world().objects.at(0).to_group;
}

void check_equal(Mat4 const& a, std::array<std::array<double, 4>, 4> const& b) {
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) CHECK(a.m[i][j] == doctest::Approx(b[i][j]).epsilon(1e-14));
}

}  // namespace

TEST_CASE("each transform multiplies from the right") {
    check_equal(ctm(""), {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}});
    check_equal(ctm("Translate 1 2 3"), {{{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}, {0, 0, 0, 1}}});
    check_equal(ctm("Scale 2 3 4 Translate 1 1 1"),
                {{{2, 0, 0, 2}, {0, 3, 0, 3}, {0, 0, 4, 4}, {0, 0, 0, 1}}});
    check_equal(ctm("Translate 1 1 1 Scale 2 3 4"),
                {{{2, 0, 0, 1}, {0, 3, 0, 1}, {0, 0, 4, 1}, {0, 0, 0, 1}}});
    check_equal(ctm("Rotate 90 0 0 2"), {{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}});
    check_equal(ctm("Scale 2 2 2 Identity"), {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}});
}

TEST_CASE("matrices stand column by column") {
    char const* const m = "[1 0 0 0  0 2 0 0  0 0 3 0  4 5 6 1]";
    check_equal(ctm("Translate 9 9 9 Transform " + std::string(m)),
                {{{1, 0, 0, 4}, {0, 2, 0, 5}, {0, 0, 3, 6}, {0, 0, 0, 1}}});
    check_equal(ctm("Translate 1 1 1 ConcatTransform " + std::string(m)),
                {{{1, 0, 0, 5}, {0, 2, 0, 6}, {0, 0, 3, 7}, {0, 0, 0, 1}}});
    CHECK(contains(error_in_world("Transform 1 0 0 0"), "t.pbrt:2: Transform: sixteen numbers in brackets"));
    CHECK(
        contains(error_in_world("Transform [1 0 0 0]"), "t.pbrt:2: Transform: \"]\" is not a finite number"));
}

TEST_CASE("LookAt is the world-to-camera matrix; the camera gets its inverse") {
    // Eye at (1,2,3), looking along +x: right is up x view = (0,1,0) x (1,0,0) = (0,0,-1).
    auto const scene = read("LookAt 1 2 3  5 2 3  0 1 0 Camera \"perspective\" WorldBegin");
    check_equal(scene.camera.to_world, {{{0, 0, 1, 1}, {0, 1, 0, 2}, {-1, 0, 0, 3}, {0, 0, 0, 1}}});
    CHECK(contains(error_in("LookAt 0 0 0 0 0 0 0 1 0"), "t.pbrt:1: LookAt: the eye is at the target"));
    CHECK(contains(error_in("LookAt 0 0 0 0 1 0 0 1 0"), "or up is along the view"));
    CHECK(contains(error_in_world("Rotate 1 0 0 0"), "t.pbrt:2: Rotate: the axis is zero"));
    CHECK(contains(error_in("Scale 0 1 1 Camera \"perspective\""), "cannot be inverted"));
    CHECK(contains(error_in_world("Scale 1e300 1 1 Scale 1e300 1 1"),
                   "t.pbrt:2: the current transform overflows"));
}

TEST_CASE("WorldBegin starts from the identity, and names it") {
    check_equal(read("Translate 1 0 0 WorldBegin Shape \"sphere\"").world().objects[0].to_group,
                {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}});
    check_equal(ctm("Translate 1 0 0 CoordinateSystem \"a\" Scale 2 2 2 CoordSysTransform \"world\" "
                    "CoordSysTransform \"a\""),
                {{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}});
    check_equal(
        read(
            "Translate 1 2 3 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" Shape \"sphere\"")
            .world()
            .objects[0]
            .to_group,
        {{{1, 0, 0, -1}, {0, 1, 0, -2}, {0, 0, 1, -3}, {0, 0, 0, 1}}});
    CHECK(contains(
        notes(read_world("CoordSysTransform \"wrold\"")),
        "t.pbrt:2: no coordinate system \"wrold\" is defined (did you mean \"world\"?): the transform "
        "stays as it is"));
}

TEST_CASE("motion: the start transform is used, and noted") {
    auto const scene = read_world(
        "Translate 1 0 0 ActiveTransform EndTime Translate 0 5 0\nShape \"sphere\"\nActiveTransform All "
        "Identity Shape \"sphere\"");
    check_equal(scene.world().objects[0].to_group,
                {{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}});
    REQUIRE(scene.notes.size() == 1);
    CHECK(contains(notes(scene), "t.pbrt:3: motion is not rendered yet"));
    check_equal(ctm("ActiveTransform StartTime Translate 1 0 0"),
                {{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}});
    CHECK(notes(read("TransformTimes 0 1 WorldBegin")).empty());
    CHECK(contains(error_in("ActiveTransform Some"), "t.pbrt:1: ActiveTransform must be followed by"));
}
