// Figures 14 and 15: the caustic of a glass ball right below a lamp, as it is, and as it becomes when the hemisphere's samples are
// turned to the lamp's normal by a basis that prefers an axis. The latter is shot by a photon tracer of this file: the renderer has no
// such basis (tests/include/faulty_bases.h keeps it for tests that must reject it).
#include "sections.h"

#include "faulty_bases.h"
#include "math/frame.h"
#include "model/fresnel.h"
#include "runs.h"
#include "sampling/hash.h"
#include "sampling/warp.h"
#include "sheet.h"
#include "statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace nephroid::experiment {

namespace {

// What scenes/report/14-caustic.pbrt holds.
constexpr float kLampHeight = 4, kLampSide = 0.3f, kBallHeight = 1.35f, kEta = 1.5f;
constexpr float kHalf = 0.6f;     // of the part of the floor that is drawn
constexpr int kMostBounces = 12;  // within the ball

using Basis = Frame (*)(Vec3);

float number_of(std::uint64_t photon, std::uint64_t dimension) {
    return to_unit_float(static_cast<std::uint32_t>(hash_keys(0xba5e, photon, dimension)));
}

/// Distance to the unit ball's surface, if it is ahead; from inside, or from outside.
std::optional<float> ball_ahead(Vec3 from_centre, Vec3 w, bool inside) {
    float const b = dot(from_centre, w);
    float const root2 = b * b - length_squared(from_centre) + 1;
    if (root2 <= 0) return std::nullopt;
    float const t = inside ? -b + std::sqrt(root2) : -b - std::sqrt(root2);
    return t > 0 ? std::optional(t) : std::nullopt;
}

struct Landing {
    Vec2 at{0, 0};
    bool through_ball = false;
};
/// Where on the floor a photon from p along w ends, if it does; reflections and refractions by chance, as Fresnel says.
std::optional<Landing> trace(Vec3 p, Vec3 w, std::uint64_t photon) {
    Vec3 const centre{0, 0, kBallHeight};
    bool inside = false, through = false;
    for (std::uint64_t bounce = 0; bounce < kMostBounces; ++bounce) {
        // The ball is convex: who leaves it does not meet it again.
        auto const t = bounce == 0 || inside ? ball_ahead(p - centre, w, inside) : std::nullopt;
        if (!t) {
            if (w.z >= 0) return std::nullopt;
            Vec3 const floor = p - w * (p.z / w.z);
            return Landing{{floor.x, floor.y}, through};
        }
        through = true;
        p = p + w * *t;
        Vec3 const n = normalize(p - centre) * (inside ? -1.0f : 1.0f);
        float const cosine = -dot(w, n), eta = inside ? 1 / kEta : kEta;
        if (number_of(photon, 4 + bounce) < fresnel_dielectric(cosine, eta)) {
            w = normalize(w + n * (2 * cosine));
        } else {
            float const out = safe_sqrt(1 - (1 - cosine * cosine) / (eta * eta));
            w = normalize(w / eta + n * (cosine / eta - out));
            inside = !inside;
        }
    }
    return std::nullopt;
}

struct Floor {
    Picture irradiance;                               // grey, in no particular unit
    double left = 0, right = 0, front = 0, back = 0;  // photons that came through the ball
    double lost = 0;                                  // share that left the lamp's plane upwards
};
/// cells x cells photons, one in each cell of the square that is warped to the hemisphere.
Floor shot(Basis basis, int pixels, std::uint64_t cells) {
    Floor f{{pixels, pixels, {}}};
    f.irradiance.rgb.resize(static_cast<std::size_t>(pixels * pixels));
    Frame const frame = basis({0, 0, -1});
    auto const cell = [&](std::uint64_t i, float jitter) {
        return std::min((static_cast<float>(i) + jitter) / static_cast<float>(cells), 0x1.fffffep-1f);
    };
    for (std::uint64_t i = 0; i < cells * cells; ++i) {
        Vec2 const u{cell(i % cells, number_of(i, 0)), cell(i / cells, number_of(i, 1))};
        Vec3 const w = normalize(frame.from_local(square_to_cosine_hemisphere(u)));
        Vec3 const p{(number_of(i, 2) - 0.5f) * kLampSide, (number_of(i, 3) - 0.5f) * kLampSide, kLampHeight};
        if (w.z >= 0) f.lost += 1 / static_cast<double>(cells * cells);
        auto const landed = w.z < 0 ? trace(p, w, i) : std::nullopt;
        if (!landed) continue;
        if (landed->through_ball)
            (landed->at.x < 0 ? f.left : f.right) += 1, (landed->at.y < 0 ? f.front : f.back) += 1;
        float const scale = static_cast<float>(pixels) / (2 * kHalf);
        float const x = (landed->at.x + kHalf) * scale, y = (kHalf - landed->at.y) * scale;
        auto const side = static_cast<float>(pixels);
        if (!(x >= 0 && x < side && y >= 0 && y < side)) continue;
        for (double& v :
             f.irradiance.rgb[static_cast<std::size_t>(static_cast<int>(y) * pixels + static_cast<int>(x))])
            v += 1;
    }
    return f;
}

/// Of two counts.
std::string ratio(double a, double b) { return with_error(a / b, a / b * std::sqrt(1 / a + 1 / b)); }

/// Azimuths about a lamp's normal, in 32 classes: are they as often as each other?
test::ChiSquare azimuths(Basis basis, int samples) {
    std::vector<double> counts(32);
    Frame const frame = basis({0, 0, -1});
    for (int i = 0; i < samples; ++i) {
        auto const key = static_cast<std::uint64_t>(i) + (1ull << 40);
        Vec3 const w =
            normalize(frame.from_local(square_to_cosine_hemisphere({number_of(key, 0), number_of(key, 1)})));
        double const turn =
            std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * std::numbers::pi);
        ++counts[static_cast<std::size_t>(std::clamp((turn + 0.5) * 32, 0.0, 31.0))];
    }
    std::vector<double> const expected(32, samples / 32.0);
    return test::chi_square(counts, expected);
}

/// Sides of the plane x = 0, of the renderer's own caustic photons.
std::pair<double, double> sides_of_photons(Setup const& setup, std::uint64_t paths) {
    RenderJob const job(setup.world, setup.settings);
    std::pair<double, double> sides{0, 0};
    auto const shot = shoot(job, ShotKind::Caustic, 0, paths, {});
    for (Photon const& photon : shot->photons) (photon.p().x < 0 ? sides.first : sides.second) += 1;
    return sides;
}

double left_over_right(Picture const& p) {
    double left = 0, right = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            (2 * x < p.width ? left : right) += p.rgb[static_cast<std::size_t>(y * p.width + x)][1];
    return left / right;
}

}  // namespace

void faulty_basis(Lab const& lab) {
    Page& page = lab.page;
    page.text(
        "A glass ball right below a small lamp. Directions come from a square by a warp to the hemisphere "
        "about "
        "+z, and are turned to the surface's normal by a basis. The report's Figure 15 had a caustic that "
        "leaned "
        "to one side, for its basis preferred an axis; Figure 14 is what became of it. Scene: "
        "`scenes/report/14-caustic.pbrt`.");
    page.text(
        "In the middle and on the right is the bright spot below the ball, from above, as photons draw it "
        "that a "
        "small tracer shoots from the lamp: with the renderer's basis, and with one that takes the fixed "
        "helping "
        "axis itself for a tangent, so that more light goes to the left. The renderer does not have the "
        "latter: "
        "`tests/math/frame_test.cpp` keeps it as an example that has to be rejected.");
    int const n = lab.pixels(200);
    Setup setup = sized_file("report/14-caustic.pbrt", n, n);
    std::string const directives =
        "Integrator \"photonmap\" \"integer indirectphotons\" 100000 \"integer causticphotons\" 1000000 "
        "\"integer nused\" 60 \"bool finalgather\" false\nSampler \"zsobol\" \"integer pixelsamples\" "
        "16";
    page.code(directives);
    setup.settings = with(setup.settings, directives);
    Run const rendered = run(setup, directives, lab.quick ? 1 : 4);
    std::uint64_t const cells = lab.quick ? 100 : 5000;
    Floor const right = shot(frame_from_z, n, cells), wrong = shot(test::skewed_basis, n, cells);
    double const exposure = exposure_for(right.irradiance, 0.985) * 0.8;
    auto const with_exposure = [&](Picture p) {
        for (auto& color : p.rgb)
            for (double& v : color) v *= exposure;
        return p;
    };
    show_sheet(
        lab, "faulty-basis.png",
        "The caustic of a glass ball: rendered, its floor from above, and the same from a faulty basis",
        {"14: rendered", "14: the spot", "15: faulty basis"},
        {{"",
          {exposed(rendered.picture, 0.97), with_exposure(right.irradiance), with_exposure(wrong.irradiance)},
          1}});

    auto const [left, other] = sides_of_photons(setup, lab.quick ? 5000 : 2000000);
    std::vector<std::vector<std::string>> rows{
        {"renderer: its caustic photons", ratio(left, other), "", "", ""},
        {"renderer: the picture", number(left_over_right(rendered.picture), 4), "", "", ""}};
    int const directions = lab.quick ? 3200 : 320000;
    for (auto const& [name, floor, basis] :
         {std::tuple<std::string, Floor const&, Basis>{"our basis", right, frame_from_z},
          {"faulty basis", wrong, test::skewed_basis}}) {
        test::ChiSquare const chi = azimuths(basis, directions);
        rows.push_back({name, ratio(floor.left, floor.right), ratio(floor.front, floor.back),
                        percent(floor.lost),
                        fmt::format("{} (p = {})", number(chi.statistic, 4),
                                    chi.p < 1e-6 ? "below 0.000001" : number(chi.p))});
    }
    page.table({"", "caustic: left / right", "front / back", "sent into the ceiling",
                fmt::format("χ² of azimuths, 31 degrees of freedom, {} directions", directions)},
               rows);
    page.text("Right is 1, 1 and 0. " + time_taken(lab, rendered.seconds) + " for the rendered picture.");
}

}  // namespace nephroid::experiment
