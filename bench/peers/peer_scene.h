// A scene as every renderer knows it, so that all of them render the same thing: triangles and balls, matt surfaces, clear glass and
// mirrors, light from surfaces and from the sky, a pinhole. Colours are linear sRGB; lengths are the scene's; the world is
// right-handed, z is not special but for the sky, whose picture is by longitude and latitude about it.
#pragma once

#include "image/image.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::peers {

struct PeerSurface {
    enum class Kind { Diffuse, Glass, Mirror } kind = Kind::Diffuse;
    Vec3 rgb{
        0.5f};  // reflectance of Diffuse, and of Mirror at any angle; where a picture is given, that is it
    int picture = -1;    // an index into pictures; for Diffuse
    float index = 1.5f;  // of refraction, on the side that the normal points away from
};
/// Reflectances over (u, v), repeated; v grows upwards, as the rows of the picture do not.
struct PeerPicture {
    Image image;           // floats, linear
    bool nearest = false;  // the nearest texel, not bilinear
};
/// Where an emitting mesh is one parallelogram or one disk, which some renderers know as a light: its centre, and half of its edges,
/// or two radii at right angles.
struct FlatLight {
    Vec3 centre{0}, u{0}, v{0};
    bool disk = false;
};
/// Wound counter-clockwise as seen from the side that its normals are on.
struct PeerMesh {
    TriangleMesh mesh;
    int surface = 0;
    Vec3 emission{0};        // radiance, to the side of the normal …
    bool two_sided = false;  // … or to both
    std::optional<FlatLight> flat;
};
struct PeerBall {
    Vec3 centre{0};
    float radius = 1;
    int surface = 0;
    Vec3 emission{0};  // outwards
};
struct PeerCamera {
    Vec3 eye{0}, right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};  // of length 1, at right angles
    float fov = 1;                                               // radians, of the shorter side
};
struct PeerScene {
    std::vector<PeerSurface> surfaces;
    std::vector<PeerPicture> pictures;
    std::vector<PeerMesh> meshes;
    std::vector<PeerBall> balls;
    Vec3 sky{0};        // radiance from everywhere, unless …
    Image sky_picture;  // … this is not empty: u = longitude / 2 pi from +x to +y, v = 0 is +z
    PeerCamera camera;
    Vec2i resolution{400, 400};
    int depth = 8;  // bounces of a path, as pbrt's maxdepth counts: 1 is direct light alone
};

/// What `scene` is in these terms: groups are flattened, curved shapes but whole spheres become triangles, spectra the rgb that our rgb
/// mode takes them for, metals what they reflect at normal incidence, checkerboards pictures. A world that is seen as in a mirror
/// (pbrt's left-handed camera without a Scale -1) is mirrored instead. Throws Error(Input) as "file:line: …" for what is
/// beyond these terms.
PeerScene make_peer_scene(Scene scene);

/// The same as a scene of ours, which nothing of write_pbrt's portable language is too small for; pictures go to `folder`. Rgb, path
/// integrator, box filter.
Scene plain_scene(PeerScene const& peer, std::filesystem::path const& folder);

/// The side of a mesh that is flat, of length 1.
Vec3 front(TriangleMesh const& mesh);
/// A ball by longitude and latitude, with its normals, for who knows no balls: 4 n^2 triangles or so.
TriangleMesh ball_mesh(PeerBall const& ball, int n = 128);
/// Pictures as every renderer reads them: sRGB, 16 bits. Returns folder/picture-N.png of each.
std::vector<std::filesystem::path> write_pictures(PeerScene const& peer, std::filesystem::path const& folder);

// Writers: each makes the files of one renderer in `folder`, and returns the one that it is to be started with.

struct WriteJob {
    std::filesystem::path folder;
    int samples = 16;  // a pixel
    std::uint64_t seed = 1;
};
/// pbrt-v4, and us.
std::filesystem::path write_pbrt_scene(PeerScene const& peer, WriteJob const& job);
/// A JSON file and arrays beside it, for cycles.py. The number of samples and the seed are arguments of that.
std::filesystem::path write_cycles(PeerScene const& peer, std::filesystem::path const& folder);
/// POV-Ray 3.7 traces no paths: direct light from area lights, diffuse interreflection from its radiosity, caustics from its photons.
/// `quality` multiplies the counts of all of these; 1 is what its manual would have for a final picture.
std::filesystem::path write_povray(PeerScene const& peer, std::filesystem::path const& folder,
                                   double quality);
std::filesystem::path write_mitsuba(PeerScene const& peer, WriteJob const& job);
std::filesystem::path write_tungsten(PeerScene const& peer, WriteJob const& job);

}  // namespace nephroid::peers
