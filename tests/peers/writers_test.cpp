// What each renderer is told of one scene: its own language, and the numbers that mean there what they mean here.
#include "support.h"

#include "image/read.h"
#include "math/error.h"
#include "read/read.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <regex>
#include <vector>

using namespace nephroid;
using namespace nephroid::peers;
using namespace nephroid::test;
namespace fs = std::filesystem;

namespace {

/// The numbers between <> that follow `mark`.
std::vector<double> vector_after(std::string const& text, std::string const& mark) {
    auto at = text.find(mark);
    REQUIRE(at != std::string::npos);
    at = text.find('<', at) + 1;
    std::istringstream list(text.substr(at, text.find('>', at) - at));
    std::vector<double> v;
    for (std::string one; std::getline(list, one, ',');) v.push_back(std::stod(one));
    return v;
}
double number_after(std::string const& text, std::string const& mark) {
    auto const at = text.find(mark);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + mark.size()));
}
std::size_t count(std::string const& text, std::string const& part) {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}
std::string attribute(std::string const& text, std::string const& name) {
    std::smatch m;
    REQUIRE(std::regex_search(text, m, std::regex("name=\"" + name + "\" value=\"([^\"]*)\"")));
    return m[1];
}
/// Every tag that is opened is closed, in order, and what is named is there once.
bool well_formed(std::string const& xml) {
    std::vector<std::string> open;
    std::regex const tag("<(/?)([a-z_]+)((?: [a-z_]+=\"[^\"<>]*\")*)(/?)>");
    std::string rest;
    auto at = xml.begin();
    for (std::sregex_iterator i(xml.begin(), xml.end(), tag), end; i != end; ++i) {
        rest.append(at, xml.begin() + i->position());
        at = xml.begin() + i->position() + i->length();
        if ((*i)[1].length()) {
            if (open.empty() || open.back() != (*i)[2]) return false;
            open.pop_back();
        } else if (!(*i)[4].length()) {
            open.push_back((*i)[2]);
        }
    }
    rest.append(at, xml.end());
    return open.empty() && rest.find_first_not_of(" \n") == std::string::npos;
}

}  // namespace

TEST_CASE("POV-Ray's light is as strong as the lamp, by its own law of fading") {
    PeersFolder const folder;
    PeerScene scene = one_of_each();
    std::string const t = text_of(write_povray(scene, folder.path(), 1));
    std::string const light = t.substr(t.find("light_source"));
    // Straight below, far away: radiance x area / distance^2 is the irradiance, of which its diffuse reflection leaves out 1 / pi.
    double const fade = number_after(light, "fade_distance "), d = 3;
    double const left = 2 / (1 + std::pow(d / fade, number_after(light, "fade_power ")));
    auto const rgb = vector_after(light, "rgb ");
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(rgb[k] * left == doctest::Approx(scene.meshes[0].emission[static_cast<int>(k)] * (2 * 0.5) /
                                               (3.14159265358979 * d * d))
                                   .epsilon(1e-3));
    // The cosine alone: within radius there is no spline. It looks down from a little below the lamp.
    CHECK(number_after(light, "radius ") == 90);
    CHECK(number_after(light, "tightness ") == 1);
    auto const from = vector_after(light, "light_source{"), to = vector_after(light, "point_at ");
    CHECK(from[2] < 3);
    CHECK(from[2] > 2.99);
    CHECK(to[2] < from[2]);
    CHECK(vector_after(light, "area_light ") == std::vector<double>{2, 0, 0});
    CHECK(count(t, "light_source") == 1);
    CHECK(count(t, "no_radiosity") == 1);  // the lamp is counted once
    CHECK(count(t, "ior 1.25") == 1);
    CHECK(count(t, "mesh2") == 3);
    CHECK(count(t, "vertex_vectors{4,") == 3);
    CHECK(count(t, "picture-0.png\" gamma srgb ") == 1);
    CHECK(fs::exists(folder.path() / "picture-0.png"));

    // A sky whose pole is +z, and which goes from +x to +y: pattern y -> z -> z, and z -> -y -> y.
    scene.sky_picture = Image(PixelFormat::Float, 8, 4, {"R", "G", "B"});
    CHECK(count(text_of(write_povray(scene, folder.path(), 1)), "rotate <90,0,0> scale <1,-1,1>") == 1);
    CHECK(fs::exists(folder.path() / "sky-povray.hdr"));

    scene.meshes[0].two_sided = true;
    CHECK(count(text_of(write_povray(scene, folder.path(), 1)), "light_source") == 2);
    scene.meshes[0].flat.reset();  // what is no light there is left to its radiosity
    std::string const glow = text_of(write_povray(scene, folder.path(), 1));
    CHECK(count(glow, "light_source") == 0);
    CHECK(count(glow, "no_radiosity") == 0);
}

TEST_CASE("POV-Ray's camera has the angle on the shorter side") {
    PeersFolder const folder;
    PeerScene scene = one_of_each();
    for (Vec2i const size : {Vec2i{60, 40}, Vec2i{40, 60}}) {
        scene.resolution = size;
        std::string const t = text_of(write_povray(scene, folder.path(), 1));
        auto const right = vector_after(t, "right "), up = vector_after(t, "up "),
                   ahead = vector_after(t, "direction ");
        double const w = right[0], h = up[2];
        CHECK(w / h == doctest::Approx(static_cast<double>(size.x) / size.y));
        CHECK(2 * std::atan(std::min(w, h) / 2 / ahead[1]) == doctest::Approx(0.5));
    }
}

TEST_CASE("Mitsuba's scene is well formed and has our numbers") {
    PeersFolder const folder;
    std::string const t = text_of(write_mitsuba(one_of_each(), {folder.path(), 24, 7}));
    CHECK(well_formed(t));
    CHECK_FALSE(well_formed(t + "</scene>"));
    CHECK(attribute(t, "max_depth") == "6");  // there 1 is what shines itself
    CHECK(attribute(t, "sample_count") == "24");
    CHECK(attribute(t, "seed") == "7");
    CHECK(attribute(t, "width") == "60");
    CHECK(attribute(t, "height") == "40");
    CHECK(std::stod(attribute(t, "fov")) == doctest::Approx(28.6479));
    CHECK(attribute(t, "radiance") == "8, 4, 2");
    CHECK(attribute(t, "int_ior") == "1.25");
    CHECK(attribute(t, "specular_reflectance") == "0.9, 0.8, 0.7");
    CHECK(attribute(t, "component_format") == "float32");
    CHECK(count(t, "<shape type=\"ply\">") == 3);
    CHECK(count(t, "<shape type=\"sphere\">") == 1);
    std::string const ply = text_of(folder.path() / "mitsuba-1.ply");
    CHECK(count(ply, "element vertex 4\n") == 1);
    CHECK(count(ply, "element face 2\n") == 1);
    CHECK(count(ply, "-4 -4 0 0 1\n") == 1);  // v from the top
}

TEST_CASE("Tungsten's JSON is JSON and has our numbers") {
    PeersFolder const folder;
    PeerScene scene = one_of_each();
    auto const j = nlohmann::json::parse(text_of(write_tungsten(scene, {folder.path(), 24, 7})));
    CHECK(j["integrator"]["max_bounces"] == 6);
    CHECK(j["renderer"]["spp"] == 24);
    CHECK(j["renderer"]["adaptive_sampling"] == false);
    CHECK(j["camera"]["resolution"] == nlohmann::json({60, 40}));
    // The angle across: that of the shorter side is 0.5.
    CHECK(std::tan(j["camera"]["fov"].get<double>() * 3.14159265358979 / 360) ==
          doctest::Approx(1.5 * std::tan(0.25)));
    REQUIRE(j["bsdfs"].size() == 4);
    CHECK(j["bsdfs"][2]["ior"] == 1.25);
    CHECK(j["bsdfs"][1]["albedo"]["interpolate"] == false);
    REQUIRE(j["primitives"].size() == 4);
    CHECK(j["primitives"][0]["emission"] == nlohmann::json({8, 4, 2}));
    CHECK(j["primitives"][3]["transform"]["scale"] == 0.625);
    for (int i = 0; i < 3; ++i) {
        std::string const obj = text_of(folder.path() / j["primitives"][i]["file"].get<std::string>());
        CHECK(count(obj, "\nf ") == 2);
    }
    scene.meshes[0].two_sided = true;
    CHECK_THROWS_AS(write_tungsten(scene, {folder.path(), 24, 7}), Error);
    scene.meshes[0].two_sided = false;
    scene.sky_picture = Image(PixelFormat::Float, 4, 2, {"R", "G", "B"});
    CHECK_THROWS_AS(write_tungsten(scene, {folder.path(), 24, 7}), Error);
}

TEST_CASE("Blender's JSON says where in its arrays everything is") {
    PeersFolder const folder;
    PeerScene scene = one_of_each();
    auto const j = nlohmann::json::parse(text_of(write_cycles(scene, folder.path())));
    CHECK(j["bounces"] == 4);  // there 0 is direct light
    CHECK(j["camera"]["fov"] == 0.5);
    CHECK(j["surfaces"][2]["kind"] == "glass");
    CHECK(j["surfaces"][2]["index"] == 1.25);
    CHECK(j["pictures"][0]["nearest"] == true);
    REQUIRE(j["meshes"].size() == 4);  // the ball as one
    CHECK(j["meshes"][0]["emission"] == nlohmann::json({8, 4, 2}));
    std::string const arrays = text_of(folder.path() / "scene.bin");
    std::size_t at = 0;
    for (auto const& mesh : j["meshes"])
        for (char const* name : {"p", "n", "uv", "triangles"}) {
            CHECK(mesh[name][0] == at);
            at += 4 * mesh[name][1].get<std::size_t>();
        }
    CHECK(arrays.size() == at);
    float x = 0;
    std::memcpy(&x, arrays.data() + j["meshes"][1]["p"][0].get<std::size_t>(), sizeof x);
    CHECK(x == -4);

    // Longitude 0, where our sky begins, is the middle of Blender's, and from there it goes the other way.
    scene.sky_picture = Image(PixelFormat::Float, 8, 4, {"R", "G", "B"});
    scene.sky_picture.set(0, 1, 0, 1);
    auto const sky = nlohmann::json::parse(text_of(write_cycles(scene, folder.path())))["sky_picture"];
    Image const turned = read_image(folder.path() / sky.get<std::string>());
    for (int c = 0; c < 8; ++c) CHECK(turned.get(c, 1, *turned.channel("R")) == (c == 3 ? 1 : 0));
}

TEST_CASE("what we and pbrt-v4 are given reads back as the same scene, without a note") {
    PeersFolder const folder;
    PeerScene const scene = one_of_each();
    Scene const read = read_scene(write_pbrt_scene(scene, {folder.path(), 24, 7}));
    CHECK(read.notes.empty());
    CHECK(read.settings.spp == 24);
    PeerScene const again = make_peer_scene(read);
    CHECK(again.resolution == scene.resolution);
    CHECK(again.depth == 5);
    REQUIRE(again.meshes.size() == 3);
    REQUIRE(again.balls.size() == 1);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(again.meshes[i].mesh.p == scene.meshes[i].mesh.p);
        CHECK(dot(front(again.meshes[i].mesh), front(scene.meshes[i].mesh)) > 0.99f);
        CHECK(again.meshes[i].mesh.uv.size() == scene.meshes[i].mesh.uv.size());
    }
    for (int k = 0; k < 3; ++k) {
        CHECK(again.meshes[0].emission[k] == doctest::Approx(scene.meshes[0].emission[k]).epsilon(1e-3));
        CHECK(again.camera.eye[k] == doctest::Approx(scene.camera.eye[k]));
        CHECK(again.camera.right[k] == doctest::Approx(scene.camera.right[k]));
    }
    CHECK(again.balls[0].radius == doctest::Approx(0.625f));
    CHECK(again.surfaces[static_cast<std::size_t>(again.balls[0].surface)].index == doctest::Approx(1.25f));
}
