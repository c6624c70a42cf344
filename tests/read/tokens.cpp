// The lexical level: numbers, strings, comments, encodings.
#include "helpers.h"

using namespace nephroid;
using namespace nephroid::test;

TEST_CASE("numbers are read as pbrt reads them") {
    struct Case {
        char const* text;
        float value;
    };
    for (auto const& [text, value] : {Case{"2", 2},
                                      {"+1", 1},
                                      {".5", 0.5f},
                                      {"1e-3", 1e-3f},
                                      {"1.", 1},
                                      {"1.5E+2", 150},
                                      {"0x10", 16},
                                      {"1e-60", 0},
                                      {"0.1", 0.1f},
                                      {"000000000000000000001", 1}}) {
        CAPTURE(text);
        auto const scene = read_world(std::string("Shape \"cylinder\" \"float zmax\" ") + text);
        auto const& c = shape_of<Cylinder>(scene);
        CHECK(std::max(c.z_max, c.z_min) == value);
    }
    for (char const* text :
         {"nan", "inf", "-inf", "1e39", "1..2", "++1", "+-1", "1,5", "one", "0x", "1e", "1f"}) {
        CAPTURE(text);
        auto const e = error_in_world(std::string("Shape \"sphere\"\n \"float radius\" ") + text);
        CHECK(e == "t.pbrt:3: parameter \"float radius\": " + std::string(text) + " is not a finite number");
    }
    for (char const* text : {"1.5", "1e3", "2147483648", "-2147483649", "true"}) {
        CAPTURE(text);
        CHECK(contains(error_in(std::string("Sampler \"sobol\" \"integer pixelsamples\" ") + text),
                       "is not a 32-bit integer"));
    }
}

TEST_CASE("strings know escapes") {
    CHECK(as<InfiniteLight>(
              read_world(R"(LightSource "infinite" "string filename" "a\\b\"c\td")").lights[0].kind)
              .image.valid());
    CHECK(read_world(R"(LightSource "infinite" "string filename" "/a\\b\"c\td")").images[0].path ==
          "/a\\b\"c\td");
    CHECK(error_in_world("Shape \"a\\qb\"") ==
          "t.pbrt:2: unknown escape \\q in a string: write \\\\ for a backslash");
    CHECK(contains(error_in_world("\nShape \"sph\nere\""), "t.pbrt:3: unterminated string"));
    CHECK(contains(error_in_world("Shape \"sphere"), "t.pbrt:2: unterminated string"));
    CHECK(contains(error_in_world("Shape \"sphere\\"), "t.pbrt:2: unterminated string"));
}

TEST_CASE("comments, line ends and encodings") {
    CHECK(read("\xef\xbb\xbfWorldBegin\r\n# caf\xe9 \"x [\r\nShape # here\n \"sphere\"#there\n")
              .world()
              .objects.size() == 1);
    CHECK(read("WorldBegin # no newline at the end").world().objects.empty());
    CHECK(error_in("\xff\xfeW\0o\0") == "t.pbrt:1: the file is UTF-16; save it as UTF-8");
    CHECK(error_in(std::string("WorldBegin\nShape \"sph\0ere\"", 24)) ==
          "t.pbrt:2: a NUL byte; scene files are text");
    std::string const mega(3 << 20, 'x');
    CHECK(error_in_world(mega) == "t.pbrt:2: a word of more than 1 MB");
    CHECK(error_in_world("Shape \"" + mega + "\"") == "t.pbrt:2: a string of more than 1 MB");
    CHECK(read("#" + mega + "\nWorldBegin").world().objects.empty());
}

TEST_CASE("an empty file, and one that stops early") {
    CHECK(contains(error_in(""), "t.pbrt: the file ends before WorldBegin"));
    CHECK(contains(error_in_world("Translate 1 2"), "t.pbrt:2: Translate: the file ends"));
    CHECK(contains(error_in_world("Shape"), "t.pbrt:2: Shape: the file ends"));
    CHECK(contains(error_in_world("Shape \"sphere\" \"float radius\""),
                   "t.pbrt:2: parameter \"radius\": the file ends"));
    CHECK(contains(error_in_world("Shape \"sphere\" \"float radius\" [ 1"),
                   "t.pbrt:2: parameter \"radius\": the file ends"));
}
