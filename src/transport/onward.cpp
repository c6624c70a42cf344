// How many caustic paths go on where they have landed, L S+ D (S|D)* D, so as to leave their share of indirect light.
//
// Of a pass, T is the time that it takes anyway, t what all caustic paths would take that go on, and a share q of them does. Photons are
// independent, or nearly, so that an estimate of the map varies by the sum of their squared powers: by G of the paths that are not
// aimed, and by g / q of those that are, since there are fewer the more each stands for. What a picture costs is variance x time,
//
//   (G + g / q) (T + q t),   which is least where   q = sqrt((g / G) (T / t)).
//
// Where paths of one kind are as good as those of the other that comes to photons of about equal power (Jensen 2001, 5.2). Where
// hardly any path finds the scene that is not aimed, as from a sky that is wider by far, all that have found it go on.
#include "photon_plan.h"
#include "transport/shooting.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

constexpr std::uint64_t kPilotPaths = 4096;
/// Of camera paths, about.
constexpr double kRaysPerPixel = 4;
/// A pilot does not see what counts in the picture: this share of its time a pass spends on going on, however little that seems to be
/// worth.
constexpr double kLeastTime = 0.02;

/// Photons that weigh a quarter of others may lie in one map with them; far less, and they want a smaller radius.
constexpr double kAlike = 0.25;

/// Sums over photons.
struct Powers {
    double sum = 0, squares = 0;

    explicit Powers(std::vector<Photon> const& photons) {
        for (Photon const& p : photons) {
            auto const power = static_cast<double>(p.power().max());
            sum += power;
            squares += power * power;
        }
    }
    /// The mean of a photon's power, by power.
    [[nodiscard]] double typical() const { return sum > 0 ? squares / sum : 0; }
};
double rays_of(Shot const& shot) {
    double sum = 0;
    for (std::uint64_t const n : shot.rays.rays) sum += static_cast<double>(n);
    return sum;
}

}  // namespace

void find_onward(RenderJob const& job, PhotonPlan& plan) {
    if (!(plan.onward > 0.0f)) return;
    /// `n` paths of a pilot stand for all of a pass, and it stands for: of squared power, less by that, too, since each carries less.
    struct Pilot {
        Shot shot;
        double times;
    };
    auto const pilot = [&](ShotKind kind, std::uint64_t paths) {
        std::uint64_t const n = std::min(paths, kPilotPaths);
        return Pilot{std::move(*shoot(job, kind, kPilotPass, n, {})),
                     n > 0 ? static_cast<double>(paths) / static_cast<double>(n) : 0};
    };
    Pilot const global = pilot(plan.global_kind, plan.global_paths);
    plan.onward = 0;
    Pilot const landing = pilot(ShotKind::Caustic, plan.caustic_paths);
    plan.onward = 1;
    Pilot const going_on = pilot(ShotKind::Caustic, plan.caustic_paths);

    Vec2i const size = job.settings().film.resolution;
    double const pixels = static_cast<double>(size.x) * static_cast<double>(size.y);
    double const anyway =
        kRaysPerPixel * pixels + rays_of(global.shot) * global.times + rays_of(landing.shot) * landing.times;
    double const further = (rays_of(going_on.shot) - rays_of(landing.shot)) * landing.times;
    Powers const others(global.shot.photons);
    Powers const own(going_on.shot.further);
    // Nothing is to be weighed where the others leave nothing, or where it costs nothing.
    if (!(others.squares > 0 && further > 0)) return;
    double const ratio = anyway / further;
    double const worth = own.squares / landing.times / (others.squares / global.times);
    double const q = std::min(1.0, std::max(kLeastTime * ratio, std::sqrt(worth * ratio)));
    plan.onward = static_cast<float>(q);
    plan.further_in_global = plan.further_in_global ||
                             own.typical() / landing.times / q > kAlike * others.typical() / global.times;
}

}  // namespace nephroid
