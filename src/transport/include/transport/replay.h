// One sample of one pixel again, with everything that happened on its path: to look at, and to find out what is wrong with a pixel.
//
// A pass is a pure function and its pixels do not know of each other, so the path of (pass, pixel) can be walked again at any
// time, by the code that renders: the record is what that code says while it goes. Spectra are in the lanes of `lambda`.
#pragma once

#include "transport/light_class.h"
#include "transport/render_pass.h"

#include <cstdint>
#include <vector>

namespace nephroid {

/// How a path goes on from a vertex.
enum class ScatterKind : std::uint8_t {
    Diffuse,  // by a model that is Lambertian in itself
    Glossy,   // by another one with a density
    Specular  // by a delta
};
struct Scattering {
    ScatterKind kind = ScatterKind::Diffuse;
    bool transmitted = false;
    bool hero_only = false;  // the direction holds for the hero wavelength alone: the others end
    Vec3 wi{0, 0, 1};        // unit, world, away from the surface
    float pdf = 0;           // by solid angle, 1/sr; of a delta, the probability of having chosen it
    float survival = 1;      // by Russian roulette; 1 where it was not played
    bool survived = true;
    Spectrum beta;  // throughput afterwards, what roulette makes up for included
};

/// Why a path goes no further.
enum class PathEnd : std::uint8_t {
    GoesOn,
    LeftScene,
    NoScattering,  // a surface without a material
    Absorbed,      // no direction, or one that carries nothing
    Roulette,
    NotANumber,
    Length  // the integrator does not ask further: its depth, or direct light has been found
};

struct PathVertex {
    /// Names its random numbers. Vertices count from 0; in Whitted's tree the children of node i are 2i and 2i + 1 down to depth
    /// 27 and hashes of these below, and the root is 0.
    std::uint32_t id = 0;
    int parent = -1;             // index of the vertex before; -1: the camera
    bool surface = true;         // false where the ray left the scene
    Vec3 direction{0, 0, 1};     // unit, of the ray that got here
    float distance = kInfinity;  // scene units, from the vertex before
    // Of a surface:
    Vec3 p{0, 0, 0};                // world
    Vec3 ng{0, 0, 1}, ns{0, 0, 1};  // unit; the shading normal with bumps
    MaterialId material;            // that of a mix has been chosen
    SourceLocation object;          // what was hit
    char const* shape = "";
    bool specular = false;                // nothing but delta parts here: no light is sampled
    bool near_specular = false;           // … or nearly so: counts as specular among the classes of paths
    Spectrum beta;                        // throughput on arrival
    std::vector<Scattering> scatterings;  // one, two where Whitted's tree branches, or none
    PathEnd end = PathEnd::Length;
};

/// A light that was sampled at a vertex, and could send something that the surface would scatter.
struct LightTried {
    std::uint32_t vertex = 0;  // index
    Vec3 p{0, 0, 0};           // on the light, unless at infinity
    Vec3 wi{0, 0, 1};          // unit, towards it
    bool at_infinity = false, delta = false;
    float pdf = 0;      // 1/sr with the choice of the light; the latter alone where it is a delta
    float passing = 0;  // share of the light that gets here; 0: occluded
    float weight = 0;   // of multiple importance sampling; 0 where occluded
    LightClass path_class = LightClass::Direct;
    Spectrum contribution;  // to the pixel's radiance, beta and weight included
    Vec3 rgb{0, 0, 0};      // … as the film sees it
};
/// Emission that the path ran into.
struct LightMet {
    std::uint32_t vertex = 0;  // index: at it, at an interface on the way to it, or where the scene was left
    bool sky = false;
    LightId light;          // of the sky
    SourceLocation object;  // of a surface
    Vec3 p{0, 0, 0};        // of a surface
    float weight = 0;       // of multiple importance sampling
    float light_pdf = 0;    // 1/sr with which light sampling would have found it
    LightClass path_class = LightClass::Direct;
    Spectrum contribution;
    Vec3 rgb{0, 0, 0};
};

struct PathRecord {
    std::uint64_t pass = 0;
    Vec2i pixel{0, 0};
    Vec2 film{0, 0};  // raster coordinates of the sample, pixels
    Ray ray;          // from the camera
    Wavelengths lambda;
    std::vector<PathVertex> vertices;
    std::vector<LightTried> tried;
    std::vector<LightMet> met;
    /// Contributions as they came, by class. Of `path` and `direct` the same bits as `seen`; Whitted's tree adds branch by branch.
    SeenLight sum;
    SeenLight seen;           // what the integrator said
    float camera_weight = 1;  // times seen …
    Vec3 value{0, 0,
               0};  // … by the sensor: linear sRGB, what the film adds; NaN where something was not a number
    float weight = 1;  // of the pixel's filter, with which the film adds it
};

/// Whether the job's integrator has paths that replay() can follow: path, direct, whitted.
[[nodiscard]] bool can_replay(Integrator const& integrator);

/// The sample that pass `pass` adds to a pixel (of the whole picture; it need not be in the job's crop window). `value` and
/// `weight` are the bits that render_pass gives the film, which adds them in double:
/// rgb += double(weight) * double(value).
/// Throws Error(Input) for a pixel outside the picture and for integrators without such paths.
PathRecord replay(RenderJob const& job, std::uint64_t pass, Vec2i pixel);

}  // namespace nephroid
