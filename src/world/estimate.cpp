#include "world/estimate.h"
#include "light_table.h"

#include "image/image.h"
#include "image/peek.h"
#include "scene/match.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace nephroid {

namespace {

// Bytes. Measured: growth of the resident set while compiling with Embree 3.13, rounded up by a tenth: a mesh of 2 * 10^6
// triangles (88 a triangle), 5 * 10^5 instances (456), 2 * 10^5 spheres (425), a
// tetrahedron refined nine times (266 a triangle). Estimated: sizes of the structs that are made, rounded up.
constexpr std::uint64_t kStart = 8 << 20;  // measured: Embree, threads, tables of spectra
constexpr std::uint64_t kTriangle = 97;    // measured: Embree's triangles, nodes, and lists while building
constexpr std::uint64_t kPatch = 150;      // estimated: the same for a primitive with callbacks
constexpr std::uint64_t kRefined = 196;    // measured: all levels of a subdivision, and its mesh
constexpr std::uint64_t kInstance = 500;   // measured: Embree's instance, its node, and our record
constexpr std::uint64_t kObject = 320;     // measured: Embree's geometry, and our record with its place
// Estimated: an entry of 92 and bounds of 56 in lists that double, two nodes of a tree, weight, bin for choosing.
constexpr std::uint64_t kLight = 420;
constexpr std::uint64_t kPixel = 16;       // measured for PNG (10), estimated for halves: picture, levels
constexpr std::uint64_t kPixelOfSky = 12;  // measured: what choosing directions by a picture adds
constexpr std::uint64_t kMostPixelsPerByte =
    8256;  // deflate makes at most 1032 bytes of one, of 8 pixels each
constexpr std::uint64_t kPixelsPerByte =
    1;  // a guess: of a file that does not say how large it is, and will be refused

std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
    return a > std::numeric_limits<std::uint64_t>::max() - b ? std::numeric_limits<std::uint64_t>::max()
                                                             : a + b;
}
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    return b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b
               ? std::numeric_limits<std::uint64_t>::max()
               : a * b;
}

template <class T>
std::uint64_t size_of(std::vector<T> const& v) {
    return v.size() * sizeof(T);
}

std::uint64_t held(Shape const& shape) {
    return match(
        shape,
        [](TriangleMesh const& m) {
            return size_of(m.p) + size_of(m.n) + size_of(m.uv) + size_of(m.triangles);
        },
        [](BilinearMesh const& m) {
            return size_of(m.p) + size_of(m.n) + size_of(m.uv) + size_of(m.patches);
        },
        [](LoopSubdivision const& m) { return size_of(m.p) + size_of(m.triangles); },
        [](auto const&) { return std::uint64_t{0}; });
}

/// Each level makes four triangles of one.
std::uint64_t refined(LoopSubdivision const& m) {
    return times(m.triangles.size(), std::uint64_t{1} << (2 * std::clamp(m.levels, 0, 20)));
}
std::uint64_t primitives(Shape const& shape) {
    return match(
        shape, [](TriangleMesh const& m) { return std::uint64_t{m.triangles.size()}; },
        [](BilinearMesh const& m) { return std::uint64_t{m.patches.size()}; },
        [](LoopSubdivision const& m) { return refined(m); }, [](auto const&) { return std::uint64_t{1}; });
}
std::uint64_t made_of(Shape const& shape) {
    std::uint64_t const n = primitives(shape);
    return match(
        shape, [&](TriangleMesh const&) { return times(n, kTriangle); },
        [&](BilinearMesh const&) { return times(n, kPatch); },
        [&](LoopSubdivision const&) { return times(n, kTriangle + kRefined); },
        [](auto const&) { return kPatch; });
}

/// How often things appear once all instances of a group are multiplied out.
struct Appearances {
    std::uint64_t instances = 0, emitters = 0;
    enum class State { New, Open, Done } state = State::New;
};

/// Children first, with a stack of our own: nesting may be deep and, in a scene that is not valid, go in circles.
Appearances appearances(Scene const& scene) {
    std::vector<Appearances> groups(scene.groups.size());
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        std::uint32_t const g = stack.back();
        Appearances& sum = groups[g];
        Group const& group = scene.groups[g];
        if (sum.state == Appearances::State::New) {
            sum.state = Appearances::State::Open;
            for (Instance const& i : group.instances)
                if (i.group.value < groups.size() && groups[i.group.value].state == Appearances::State::New)
                    stack.push_back(i.group.value);
            continue;
        }
        stack.pop_back();
        if (sum.state == Appearances::State::Done) continue;
        sum.state = Appearances::State::Done;
        for (Object const& o : group.objects)
            if (o.light) sum.emitters = plus(sum.emitters, primitives(o.shape));
        for (Instance const& i : group.instances) {
            if (i.group.value >= groups.size() || groups[i.group.value].state != Appearances::State::Done)
                continue;
            Appearances const& part = groups[i.group.value];
            sum.instances = plus(sum.instances, plus(part.instances, 1));
            sum.emitters = plus(sum.emitters, part.emitters);
        }
    }
    return groups.front();
}

/// Without unpacking it. Files that claim more than is read, or than their bytes can hold, are refused by name when they are.
std::uint64_t pixels_of(ImageFile const& image) {
    std::error_code error;
    std::uint64_t const file = std::filesystem::file_size(image.path, error);
    if (error) return 0;
    auto const size = peek_size(image.path);
    if (!size) return times(file, kPixelsPerByte);
    auto const [width, height] = *size;
    if (width < 0 || height < 0 || width > kMaxImageSide || height > kMaxImageSide) return 0;
    if (width * height > kMaxImageBytes) return 0;
    return std::min(static_cast<std::uint64_t>(width * height), times(file, kMostPixelsPerByte));
}

/// A cell for each pair of angles, of which none is further from the next than 2.5 degrees (model/light_measured.cpp).
std::uint64_t measured_bytes(IntensityTable const& t) {
    return times(times(t.vertical.size() + 72, t.horizontal.size() + 144), kPixelOfSky);
}

std::uint64_t picture_bytes(Scene const& scene) {
    std::uint64_t bytes = 0;
    std::uint64_t largest = 0;  // files are read one at a time, and lie in memory while they are decoded
    for (ImageFile const& image : scene.images) {
        std::error_code error;
        std::uint64_t const file = std::filesystem::file_size(image.path, error);
        if (!error) largest = std::max(largest, file);
        bytes = plus(bytes, times(pixels_of(image), kPixel));
    }
    bytes = plus(bytes, largest);
    auto const by_picture = [&](ImageId image) {
        return image.value < scene.images.size() ? times(pixels_of(scene[image]), kPixelOfSky) : 0;
    };
    for (Light const& light : scene.lights)
        bytes = plus(bytes, match(
                                light.kind, [&](InfiniteLight const& l) { return by_picture(l.image); },
                                [&](GoniometricLight const& l) { return by_picture(l.image); },
                                [&](ProjectionLight const& l) { return by_picture(l.image); },
                                [](MeasuredLight const& l) { return measured_bytes(l.table); },
                                [](auto const&) { return std::uint64_t{0}; }));
    return bytes;
}

/// Tables of measured materials, one for each path. Of a file of rgb, which grows the most, 2.4 times its bytes are kept; the bytes
/// and a copy of the numbers lie beside them while it is read.
std::uint64_t measured_material_bytes(Scene const& scene) {
    std::set<std::string> seen;
    std::uint64_t bytes = 0;
    std::uint64_t largest = 0;
    for (Material const& m : scene.materials) {
        auto const* const measured = std::get_if<MeasuredMaterial>(&m.kind);
        if (!measured || !seen.insert(measured->file.path).second) continue;
        std::error_code error;
        std::uint64_t const file = std::filesystem::file_size(measured->file.path, error);
        if (error) continue;
        bytes = plus(bytes, times(file, 3));
        largest = std::max(largest, file);
    }
    return plus(bytes, times(largest, 2));
}

/// Tables of where textured emitters are bright, or there.
std::uint64_t light_picture_bytes(Scene const& scene, Appearances const& all) {
    bool textured = false;
    for (Group const& g : scene.groups)
        for (Object const& o : g.objects)
            textured = textured ||
                       (o.light && (o.light->image.valid() || o.light->texture.valid() || o.alpha.valid()));
    constexpr std::uint64_t kCell = 16;
    return textured ? std::min(times(all.emitters, 256 * 256), kMostPictureCells) * kCell : 0;
}

}  // namespace

std::uint64_t held_bytes(Scene const& scene) {
    std::uint64_t bytes = 0;
    for (Group const& g : scene.groups) {
        bytes += size_of(g.objects) + size_of(g.instances);
        for (Object const& o : g.objects) bytes += held(o.shape);
    }
    return bytes;
}

std::uint64_t estimated_bytes(Scene const& scene) {
    std::uint64_t bytes = plus(held_bytes(scene), kStart);
    for (Group const& g : scene.groups)
        for (Object const& o : g.objects) bytes = plus(bytes, plus(made_of(o.shape), kObject));
    bytes = plus(bytes, plus(picture_bytes(scene), measured_material_bytes(scene)));
    Appearances const all = appearances(scene);
    bytes = plus(bytes, light_picture_bytes(scene, all));
    bytes = plus(bytes, times(all.instances, kInstance));
    return plus(bytes, times(plus(all.emitters, scene.lights.size()), kLight));
}

}  // namespace nephroid
