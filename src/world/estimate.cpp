#include "world/estimate.h"

#include "image/exr.h"
#include "scene/match.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

namespace nephroid {

namespace {

// Bytes. Measured: growth of the resident set while compiling, Embree 3.13 and 4, meshes of 10^5 to 4 * 10^6 triangles
// and 10^4 to 10^6 instances. Estimated: sizes of the structs that are made, rounded up.
constexpr std::uint64_t kTriangle =
    110;                               // measured: Embree's triangles and nodes, and its lists while building
constexpr std::uint64_t kPatch = 150;  // estimated: the same for a primitive with callbacks
constexpr std::uint64_t kRefinedTriangle =
    450;  // measured: all levels of a subdivision, and the mesh that it becomes
constexpr std::uint64_t kInstance = 470;  // measured: Embree's instance, its node, and our record
constexpr std::uint64_t kObject = 900;    // estimated: Embree's geometry, and our record with its place
constexpr std::uint64_t kLight =
    64;  // estimated: an entry, its weight, and its bin of the table for choosing
constexpr std::uint64_t kPixelOfPicture =
    16;  // estimated: three channels of bytes or halves, as floats on the way, levels
constexpr std::uint64_t kUnpacking = 20;  // estimated: pixels a byte of a compressed picture may stand for

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
        [&](LoopSubdivision const&) { return times(n, kTriangle + kRefinedTriangle); },
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

/// Without unpacking it: an EXR file says how large it is, others are taken to be well compressed.
std::uint64_t picture_bytes(ImageFile const& image) {
    std::error_code error;
    std::uint64_t const file = std::filesystem::file_size(image.path, error);
    if (error) return 0;  // compile() says that it is missing
    try {
        ExrFile const header = read_exr_header(image.path);
        return times(static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height),
                     kPixelOfPicture);
    } catch (Error const&) {
        return times(file, kUnpacking);
    }
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
    std::uint64_t bytes = held_bytes(scene);
    for (Group const& g : scene.groups)
        for (Object const& o : g.objects) bytes = plus(bytes, plus(made_of(o.shape), kObject));
    for (ImageFile const& image : scene.images) bytes = plus(bytes, picture_bytes(image));
    Appearances const all = appearances(scene);
    bytes = plus(bytes, times(all.instances, kInstance));
    return plus(bytes, times(plus(all.emitters, scene.lights.size()), kLight));
}

}  // namespace nephroid
