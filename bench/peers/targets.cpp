#include "targets.h"

#include "yardsticks.h"

#include <fmt/format.h>

#include <utility>

namespace nephroid::peers {

namespace {

SceneResult const* find(std::vector<SceneResult> const& scenes, std::string const& name) {
    for (SceneResult const& s : scenes)
        if (s.scene == name) return &s;
    return nullptr;
}

/// Round by round, so that what slows a round is in both. Empty where one of them has no such rounds.
std::vector<double> ratios(std::vector<double> const& a, std::vector<double> const& b, double times = 1) {
    std::vector<double> r;
    if (a.size() != b.size()) return r;
    for (std::size_t i = 0; i < a.size(); ++i) r.push_back(times * a[i] / b[i]);
    return r;
}
std::vector<double> efficiency_ratios(Result const* a, Result const* b) {
    if (!a || !b) return {};
    return ratios(efficiencies(*a), efficiencies(*b));
}

/// What is measured of these two itself, of yardsticks' 64 samples.
void equal_samples(std::vector<Target>& t, SceneResult const& s) {
    Result const *us = find(s, kPath), *them = find(s, kCycles), *spectral = find(s, kSpectral);
    if (us && them)
        t.push_back({s.scene + ": time of Cycles / ours, 64 samples", 2.8, true, false,
                     ratios(them->seconds64, us->seconds64)});
    if (us && spectral)
        t.push_back({s.scene + ": time of spectral / rgb, 64 samples", 1.25, false, false,
                     ratios(spectral->seconds64, us->seconds64)});
}
/// Theirs there / Cycles' there x Cycles' here / ours here. Whole processes of ours, as theirs are.
void bridged(std::vector<Target>& t, SceneResult const& s) {
    Result const *us = find(s, kPath), *sppm = find(s, kSppm), *them = find(s, kCycles);
    if (!them || s.resolution != kYardstickSize) return;
    for (Bridge const& bridge : kBridges) {
        if (s.scene != bridge.scene) continue;
        for (Yardstick const& y : kYardsticks) {
            Result const* const ours = y.sppm ? sppm : us;
            if (s.scene != y.scene || !ours) continue;
            t.push_back({fmt::format("{}: time of {} / our {}, 64 samples", s.scene, y.renderer,
                                     y.sppm ? "sppm" : "path"),
                         y.least, true, true,
                         ratios(them->seconds64, ours->process_seconds64, y.seconds / bridge.seconds)});
        }
        if (sppm && s.scene == std::string("cornell_glass"))
            t.push_back({fmt::format("{}: seconds of sppm, 64 passes x 160,000 photons, were Cycles' here {}",
                                     s.scene, bridge.seconds),
                         kSppmMost, false, true,
                         ratios(sppm->process_seconds64, them->seconds64, bridge.seconds)});
    }
}
/// Time of a sample, where samples of a pixel are what each does in a given time.
void big_mesh(std::vector<Target>& t, SceneResult const& s) {
    Result const *us = find(s, kPath), *them = find(s, kCycles);
    if (us && them)
        t.push_back({s.scene + ": time of Cycles / ours, a sample", 2, true, false,
                     ratios(them->seconds, us->seconds, static_cast<double>(us->samples) / them->samples)});
}

}  // namespace

bool Target::met() const {
    if (rounds.empty()) return false;
    return least ? median(rounds) >= bound : median(rounds) <= bound;
}

std::vector<Target> targets(std::vector<SceneResult> const& scenes) {
    std::vector<Target> t;
    for (char const* name : {"cornell", "cornell_glass"})
        if (SceneResult const* s = find(scenes, name)) equal_samples(t, *s), bridged(t, *s);
    if (SceneResult const* s = find(scenes, "ball")) big_mesh(t, *s);
    for (SceneResult const& s : scenes)
        if (Result const* us = find(s, kPath), *them = find(s, kCycles); us && them)
            t.push_back(
                {s.scene + ": efficiency of ours / Cycles'", 1, true, false, efficiency_ratios(us, them)});
    for (char const* name : {"cornell_glass", "pool", "cup"}) {
        SceneResult const* s = find(scenes, name);
        Result const* sppm = s ? find(*s, kSppm) : nullptr;
        if (!sppm) continue;
        for (auto const& [who, of] : {std::pair{"our path", kPath}, std::pair{"Cycles'", kCycles}})
            if (Result const* other = find(*s, of))
                t.push_back({fmt::format("{}: efficiency of sppm / {}", name, who), 50, true, false,
                             efficiency_ratios(sppm, other)});
    }
    return t;
}

}  // namespace nephroid::peers
