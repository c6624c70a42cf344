#include "measure_peers.h"

#include "image/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

namespace nephroid::peers {

namespace {

constexpr int kMostSamples = 1 << 16;
constexpr std::uint64_t kReferenceSeed = 977;

/// One renderer in one scene.
struct Runner {
    Renderer const* renderer;
    RenderFunction render;
    Image reference;
    int reference_samples = 0;
    Result result;

    [[nodiscard]] bool povray() const { return renderer->key == "povray"; }
};

Image rgb_of(Image const& image) {
    Image out(PixelFormat::Float, image.width(), image.height(), {"R", "G", "B"});
    int const c[3] = {image.channel("R").value_or(0), image.channel("G").value_or(1),
                      image.channel("B").value_or(2)};
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int k = 0; k < 3; ++k) out.set(x, y, k, image.get(x, y, c[k]));
    return out;
}

/// As many samples as take the time that is wanted, from a try of few; a second try where the first says little.
int calibrate(Runner const& r, double seconds) {
    int samples = 4;
    for (int attempt = 0; attempt < 3; ++attempt) {
        double const took = std::max(r.render({samples, 1}).seconds, 1e-3);
        double const wanted = samples * seconds / took;
        samples = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMostSamples)));
        if (took > 0.25 * seconds) break;
    }
    return samples;
}

/// relMSE against the reference. Its own noise adds to that of an unbiased render as n_test / n_reference, and is taken out.
double error_of(Runner const& r, Image const& image, int samples) {
    double const measured = rel_mse(rgb_of(image), r.reference);
    if (!r.renderer->path_tracer) return measured;
    return measured / (1 + static_cast<double>(samples) / r.reference_samples);
}

}  // namespace

Result const* find(SceneResult const& scene, std::string const& renderer) {
    for (Result const& r : scene.results)
        if (r.renderer == renderer && r.failure.empty()) return &r;
    return nullptr;
}

std::vector<std::string> complaints(std::vector<SceneResult> const& scenes) {
    std::vector<std::string> found;
    for (SceneResult const& s : scenes) {
        Result const* const us = find(s, kPath);
        for (Result const& r : s.results)
            if (!r.failure.empty())
                found.push_back(s.scene + ": " + r.renderer + " failed");
            else if (us && r.path_tracer && !(std::abs(r.mean / us->mean - 1) < kSameMean))
                found.push_back(s.scene + ": the mean of " + r.renderer + " is not ours: another picture");
    }
    return found;
}

double median(std::vector<double> v) {
    if (v.empty()) return 0;
    std::sort(v.begin(), v.end());
    std::size_t const n = v.size();
    return n % 2 ? v[n / 2] : 0.5 * (v[n / 2 - 1] + v[n / 2]);
}

std::vector<double> efficiencies(Result const& r) {
    std::vector<double> each;
    for (std::size_t i = 0; i < r.seconds.size(); ++i) {
        if (!(r.errors[i] > 0)) return {};
        each.push_back(1 / (r.errors[i] * r.seconds[i]));
    }
    return each;
}

SceneResult measure_scene(std::string const& name, PeerScene const& peer,
                          std::vector<Renderer const*> const& renderers, Plan const& plan, bool equal_samples,
                          std::filesystem::path const& scratch) {
    SceneResult scene{name, "", peer.resolution, 0, peer.balls.size(), {}};
    for (PeerMesh const& m : peer.meshes) scene.triangles += m.mesh.triangles.size();

    std::vector<Runner> runners;
    for (Renderer const* renderer : renderers) {
        Runner r{renderer, {}, {}, 0, {}};
        r.result.renderer = renderer->name;
        r.result.path_tracer = renderer->path_tracer;
        std::fprintf(stderr, "peers: %s, %s: reference\n", name.c_str(), renderer->name.c_str());
        try {
            auto const folder = scratch / name / renderer->key;
            std::filesystem::create_directories(folder);
            r.render = renderer->prepare(peer, folder);
            // POV-Ray has a quality, and no seconds that it could be asked for.
            r.result.samples = r.povray() ? 1 : calibrate(r, plan.seconds);
            r.reference_samples = r.povray() ? 2 : static_cast<int>(r.result.samples * plan.reference);
            r.reference = rgb_of(r.render({r.reference_samples, kReferenceSeed}).image);
            for (double const m : channel_means(r.reference)) r.result.mean += m / 3;
        } catch (std::exception const& e) {
            r.result.failure = e.what();
            std::fprintf(stderr, "peers: %s\n", e.what());
        }
        r.result.reference = "own";
        runners.push_back(std::move(r));
    }

    // Interleaved, so that what else the machine does is shared out.
    auto const each = [&](auto&& action) {
        for (Runner& r : runners) {
            if (!r.result.failure.empty()) continue;
            try {
                action(r);
            } catch (std::exception const& e) {
                r.result.failure = e.what();
                std::fprintf(stderr, "peers: %s\n", e.what());
            }
        }
    };
    // A photon integrator's error is against our path tracer's picture, if that is good enough to judge it.
    std::map<Runner*, std::vector<Image>> pictures;
    for (int i = 0; i < plan.repetitions; ++i) {
        std::fprintf(stderr, "peers: %s: round %d of %d\n", name.c_str(), i + 1, plan.repetitions);
        each([&](Runner& r) {
            auto done = r.render({r.result.samples, static_cast<std::uint64_t>(i) + 1});
            r.result.seconds.push_back(done.seconds);
            r.result.process_seconds.push_back(done.process_seconds);
            r.result.errors.push_back(error_of(r, done.image, r.result.samples));
            if (r.renderer->key == "nephroid-sppm") pictures[&r].push_back(rgb_of(done.image));
            if (i == 0) r.result.picture = rgb_of(done.image);
            if (equal_samples && !r.povray()) {
                auto const timed = r.render({64, static_cast<std::uint64_t>(i) + 1, true});
                r.result.seconds64.push_back(timed.seconds);
                r.result.process_seconds64.push_back(timed.process_seconds);
            }
        });
    }
    auto const ours = std::find_if(runners.begin(), runners.end(),
                                   [](Runner const& r) { return r.renderer->key == "nephroid"; });
    for (auto& [sppm, images] : pictures) {
        if (ours == runners.end() || !ours->result.failure.empty()) continue;
        Runner& r = *sppm;
        double const noise = median(ours->result.errors) * ours->result.samples / ours->reference_samples;
        std::vector<double> errors;
        for (Image const& image : images) errors.push_back(rel_mse(image, ours->reference));
        if (noise > 0.1 * median(errors)) continue;
        r.reference = ours->reference;
        r.result.reference = "path";
        r.result.errors = errors;
    }
    std::fprintf(stderr, "peers: %s: error over time\n", name.c_str());
    double const kShares[4] = {1.0 / 16, 1.0 / 4, 1, 4};
    for (double const share : kShares)
        each([&](Runner& r) {
            if (r.povray()) return;
            int const samples = std::max(1, static_cast<int>(std::lround(r.result.samples * share)));
            auto const done = r.render({samples, 101});
            r.result.curve.push_back({done.seconds, error_of(r, done.image, samples)});
        });
    for (Runner& r : runners) scene.results.push_back(std::move(r.result));
    return scene;
}

}  // namespace nephroid::peers
