// Points drawn on flat emitters, boxes and pictures, against the density that a ray to them is given: chi square over cells of the
// surfaces. (Round shapes and lights without a surface: tests/model; single triangles and rectangles: tests/sampling.)
#include "emitters.h"
#include "image/write.h"
#include "measure.h"

#include <unistd.h>
#include <filesystem>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// A parallelogram of the surface in the world: corner + s a + t b.
struct Patch {
    D3 corner, a, b;
};
constexpr int kCells = 8;

struct Case {
    std::string name;
    Scene scene;
    std::vector<Patch> patches;
};

Patch patch_of(Mat4 const& m, D3 corner, D3 a, D3 b) {
    D3 const c = apply(m, corner);
    return {c, apply(m, corner + a) - c, apply(m, corner + b) - c};
}
std::vector<Patch> faces(Box const& box, Mat4 const& m) {
    std::vector<Patch> all;
    D3 const lo = doubles(box.lo);
    D3 const size = doubles(box.hi) - lo;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (bool const high : {false, true}) {
            D3 corner = lo;
            D3 a{};
            D3 b{};
            if (high) corner[axis] += size[axis];
            a[(axis + 1) % 3] = size[(axis + 1) % 3];
            b[(axis + 2) % 3] = size[(axis + 2) % 3];
            all.push_back(patch_of(m, corner, a, b));
        }
    return all;
}

/// Over the patch's plane.
double height(Patch const& patch, Vec3 p) {
    D3 const normal = cross(patch.a, patch.b);
    return std::abs(dot(normal, doubles(p) - patch.corner)) / length(normal);
}

/// Chi square of sample_light from one receiver.
ChiSquare chi_square_from(World const& world, std::vector<Patch> const& patches, Receiver const& to,
                          int draws, Random& random) {
    RayStats stats;
    D3 const p = doubles(to.p);
    constexpr int kSub = 6;
    std::vector<double> expected(patches.size() * kCells * kCells + 1);
    double sum = 0;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        D3 const normal = cross(patches[k].a, patches[k].b);
        for (int i = 0; i < kCells * kSub; ++i)
            for (int j = 0; j < kCells * kSub; ++j) {
                double const s = (i + 0.5) / (kCells * kSub);
                double const t = (j + 0.5) / (kCells * kSub);
                D3 const d = patches[k].corner + patches[k].a * s + patches[k].b * t - p;
                double const r2 = dot(d, d);
                Vec3 const w = normalize(
                    Vec3{static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])});
                double const cosine = std::abs(dot(normal, d)) / (length(normal) * std::sqrt(r2));
                SurfaceHit hit;
                if (!world.intersect({to.p, w}, kInfinity, RayKind::Bounce, stats, hit) || !hit.emits)
                    continue;
                // What is behind something nearer belongs to that.
                // (A rounded direction meets the surface elsewhere, the farther the more it grazes.)
                if (length(doubles(hit.s.p) - p - d) > (1e-5 + 5e-6 * std::sqrt(r2)) / cosine) continue;
                double const solid_angle =
                    std::abs(dot(normal, d)) / (r2 * std::sqrt(r2)) / (kCells * kSub * kCells * kSub);
                double const share = static_cast<double>(world.light_pdf(hit, to, {}, w)) * solid_angle;
                expected[(k * kCells + static_cast<std::size_t>(i / kSub)) * kCells +
                         static_cast<std::size_t>(j / kSub)] += share;
                sum += share;
            }
    }
    expected.back() = std::max(0.0, 1 - sum);  // not drawn at all, or on a side that is not seen
    for (double& e : expected) e *= draws;
    std::vector<double> counts(expected.size());
    for (int n = 0; n < draws; ++n) {
        auto const s =
            world.sample_light(to, {}, random.uniform(), {random.unit(), random.unit()}, Wavelengths::rgb());
        std::size_t bin = counts.size() - 1;
        SurfaceHit hit;
        bool const seen =
            s && !s->radiance.is_black() &&
            world.intersect({to.p, s->wi}, kInfinity, RayKind::Bounce, stats, hit) &&
            length(hit.s.p - s->p) < (1e-5f + 5e-6f * length(s->p - to.p)) / abs_dot(s->n, s->wi);
        if (seen) {
            double best = 1e-3;
            for (std::size_t k = 0; k < patches.size(); ++k) {
                D3 const normal = cross(patches[k].a, patches[k].b);
                D3 const v = doubles(s->p) - patches[k].corner;
                double const nn = dot(normal, normal);
                double const x = dot(cross(v, patches[k].b), normal) / nn;
                double const y = dot(cross(patches[k].a, v), normal) / nn;
                double const off = std::abs(dot(v, normal)) / nn;
                if (x < -1e-5 || x > 1.00001 || y < -1e-5 || y > 1.00001 || off > best) continue;
                best = off;
                auto const cell = [](double t) {
                    return static_cast<std::size_t>(std::clamp(static_cast<int>(t * kCells), 0, kCells - 1));
                };
                bin = (k * kCells + cell(x)) * kCells + cell(y);
            }
        }
        counts[bin] += 1;
    }
    // At the outline of what is seen a point may fall into a cell in which the quadrature met nothing: a few may.
    std::vector<double> o;
    std::vector<double> e;
    for (std::size_t i = 0; i + 1 < expected.size(); ++i)
        if (expected[i] > 0 || counts[i] > 1e-4 * draws) o.push_back(counts[i]), e.push_back(expected[i]);
    // What is drawn in vain: known only as what is missing from 1, to the error of the quadrature.
    if (expected.back() > 0.02 * draws) o.push_back(counts.back()), e.push_back(expected.back());
    return chi_square(o, e, false);
}

std::vector<Case> cases(ImageId (*add_picture)(Scene&)) {
    Box const box{{-0.5f, -0.3f, -0.4f}, {0.4f, 0.5f, 0.3f}};
    std::vector<Case> all;
    auto const make = [&](std::string name, Shape const& shape, Mat4 const& m, std::vector<Patch> patches,
                          bool reversed, bool picture, bool two_sided) {
        Case c{std::move(name), {}, std::move(patches)};
        Object& o = add(c.scene, shape);
        o.to_group = m;
        o.reverse_orientation = reversed;
        AreaLight light = white(1, two_sided);
        if (picture) light.image = add_picture(c.scene);
        o.light = light;
        all.push_back(std::move(c));
    };
    Mat4 const turned = rotation(25, 1, 0, 0) * rotation(15, 0, 1, 0);
    Mat4 const sheared = rotation(20, 0, 1, 0) * shear(0.5);
    make("box", box, turned, faces(box, turned), false, false, false);
    make("sheared box", box, sheared, faces(box, sheared), false, false, false);
    make("box, inwards", box, turned, faces(box, turned), true, false, false);
    make("box with a picture", box, turned, faces(box, turned), false, true, true);
    Quad const quad{{-0.5f, -0.4f, 0}, {1, 0, 0}, {0, 0.8f, 0}};
    for (bool const slanted : {false, true}) {
        Mat4 const m = slanted ? sheared : turned;
        std::vector<Patch> const one{
            patch_of(m, doubles(quad.origin), doubles(quad.edge_u), doubles(quad.edge_v))};
        make(slanted ? "sheared quad" : "quad", quad, m, one, false, false, true);
        make(slanted ? "sheared quad with a picture" : "quad with a picture", quad, m, one, false, true,
             true);
        Vec3 const c = quad.origin;
        make("two triangles", rectangle(c, c + quad.edge_u, c + quad.edge_u + quad.edge_v, c + quad.edge_v),
             m, one, false, false, true);
    }
    return all;
}

}  // namespace

TEST_CASE("light chi square: boxes, parallelograms and pictures from near, far, grazing and inside") {
    static std::string const path =
        (std::filesystem::temp_directory_path() / ("nephroid_chi_" + std::to_string(::getpid()) + ".pfm"))
            .string();
    Image image(PixelFormat::Float, 8, 8, {"R", "G", "B"});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, x < 4 ? 0.5f : 2.0f);
    write_pfm(path, image);
    auto all = cases([](Scene& s) { return s.add(ImageFile{path, "", {}}); });
    constexpr int kReceivers = 20;
    int const draws = samples(50000, 1000000);
    double const alpha = sidak(static_cast<int>(all.size()) * kReceivers);
    Random random(29);
    for (Case& c : all) {
        CAPTURE(c.name);
        World const world = compile(c.scene);
        for (int i = 0; i < kReceivers; ++i) {
            CAPTURE(i);
            auto const in = [&random](double a, double b) {
                return static_cast<float>(random.uniform(a, b));
            };
            // Inside boxes; not so near to flat ones that the quadrature does not see the peak.
            float const nearest = c.patches.size() > 1 ? 0.15f : 0.5f;
            float const distance = i < 4 ? nearest : i < 10 ? 1.0f : i < 16 ? 3.0f : 10.0f;
            Receiver to;
            do {
                to.p = distance * normalize(Vec3{in(-1, 1), in(-1, 1), in(-1, 1)});
            } while (c.patches.size() == 1 &&
                     height(c.patches[0], to.p) < 0.12 * static_cast<double>(distance));
            if (i % 2) to.n = normalize(Vec3{in(-1, 1), in(-1, 1), in(-1, 1)}), to.both_sides = i % 4 == 1;
            ChiSquare const chi = chi_square_from(world, c.patches, to, draws, random);
            if (chi.dof < 1) continue;  // nothing is seen from there
            CHECK_MESSAGE(chi.p >= alpha, chi);
        }
    }
    std::filesystem::remove(path);
}
