#include "peers_page.h"
#include "targets.h"
#include "yardsticks.h"

#include "image/write.h"
#include "page.h"
#include "plot.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

namespace nephroid::peers {

namespace {

using namespace experiment;

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}
std::string load() {
    std::ifstream file("/proc/loadavg");
    std::string one;
    file >> one;
    return one;
}

std::string with_range(std::vector<double> const& v) {
    auto const [lo, hi] = std::minmax_element(v.begin(), v.end());
    return fmt::format("{} ({} to {})", number(median(v)), number(*lo), number(*hi));
}
void show_targets(Page& page, std::vector<SceneResult> const& scenes) {
    std::vector<std::vector<std::string>> rows;
    for (Target const& t : targets(scenes))
        rows.push_back({(t.bridged ? "*bridged* " : "") + t.what,
                        fmt::format("{} {}", t.least ? "≥" : "≤", number(t.bound)),
                        t.rounds.empty() ? "not measured" : with_range(t.rounds),
                        t.rounds.empty() ? ""
                        : t.met()        ? "met"
                                         : "**not met**"});
    page.section("Targets");
    if (rows.empty()) {
        page.text("None of this run's scenes and renderers has one.");
        return;
    }
    page.table({"", "target", "measured: median (range)", ""}, rows);
    page.text(
        "Ratios are taken round by round, each round a render of either: their median, and the range of all "
        "rounds. Above 1 is in our favour, but for spectral / rgb and where seconds are named.");
    page.text(fmt::format(
        "*Bridged* ones compare with what was not rendered here. Those renderers, and Cycles, rendered the "
        "same two scenes with the same samples on one other machine (bench/peers/yardsticks.h has their "
        "seconds: single runs, two threads of an AMD EPYC, whole processes but for Cycles). The ratio is "
        "(theirs / Cycles' there) x (Cycles' here / ours here, our whole process); it holds as far as two "
        "machines favour the same renderers, and not to less than 10%. Of photons, each emits 64 x 160,000 "
        "in all and begins with a radius of 0.03; our sppm is told so with `{}`.",
        kSppmYardstick));
}

/// What POV-Ray cannot do with a scene, which its mean is therefore not compared in; nothing where it can.
std::string povray_lacks(std::string const& scene) {
    if (scene == "pool")
        return "water is a sheet between two media here; rays of its radiosity that begin below it take it "
               "for "
               "the way in";
    return "";
}
void means(Page& page, std::vector<SceneResult> const& scenes) {
    std::vector<std::vector<std::string>> rows;
    for (SceneResult const& s : scenes) {
        Result const* us = find(s, kPath);
        if (!us) continue;
        for (Result const& r : s.results) {
            if (!r.failure.empty() || &r == us) continue;
            double const off = r.mean / us->mean - 1;
            std::string const lacks = r.renderer == kPovray ? povray_lacks(s.scene) : "";
            rows.push_back({s.scene, r.renderer, number(r.mean, 4),
                            fmt::format("{}{:.2f}%", off < 0 ? "−" : "+", 100 * std::abs(off)),
                            !lacks.empty()              ? "not compared: " + lacks
                            : std::abs(off) < kSameMean ? "agrees"
                                                        : "**differs**"});
        }
    }
    page.section("Is it the same picture?");
    page.text(
        "Means of the references, beside that of our path tracer's; within 5% they agree. A path tracer that "
        "differs makes the program end with exit code 1; sppm and POV-Ray, whose pictures are their own, do "
        "not.");
    if (!rows.empty()) page.table({"scene", "renderer", "mean", "off by", ""}, rows);
}

void show(Page& page, SceneResult const& s) {
    page.section(s.scene);
    page.text(fmt::format("{} x {} pixels, {} triangles, {} balls.", s.resolution.x, s.resolution.y,
                          s.triangles, s.balls));
    std::vector<std::vector<std::string>> rows;
    std::vector<Line> lines;
    for (Result const& r : s.results) {
        if (!r.failure.empty()) {
            rows.push_back({r.renderer, "failed", "", "", "", "", ""});
            continue;
        }
        bool const counts = r.renderer != kPovray;
        double const paths = static_cast<double>(r.samples) * s.resolution.x * s.resolution.y;
        rows.push_back(
            {r.renderer, counts ? std::to_string(r.samples) : "–", with_range(r.seconds),
             number(median(r.process_seconds)), counts ? number(paths / median(r.seconds) / 1e6) : "–",
             fmt::format("{}{}", with_range(r.errors), r.reference == "own" ? "" : " (against path)"),
             counts && !efficiencies(r).empty() ? with_range(efficiencies(r)) : "–"});
        Line line{r.renderer, {}, {}, ""};
        for (TimedError const& e : r.curve)
            if (e.seconds > 0 && e.error > 0) line.x.push_back(e.seconds), line.y.push_back(e.error);
        if (line.x.size() > 1) lines.push_back(std::move(line));
    }
    page.table(
        {"renderer", "samples a pixel", "render, s", "process, s", "M samples/s", "relMSE", "1 / (relMSE s)"},
        rows);
    if (!lines.empty()) {
        std::string const name = s.scene + ".svg";
        page.save(name, line_plot(s.scene, {"render, s", true, {}}, {"relMSE", true, {}}, lines));
        page.image(name, "Error over time in " + s.scene);
    }
    // Side by side, as bytes.
    std::vector<Result const*> shown;
    for (Result const& r : s.results)
        if (r.failure.empty() && !r.picture.empty() && r.renderer != kSpectral) shown.push_back(&r);
    if (shown.empty()) return;
    int const w = s.resolution.x / 2, h = s.resolution.y / 2;
    Image sheet(PixelFormat::Float, w * static_cast<int>(shown.size()), h, {"R", "G", "B"});
    std::string names;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        names += (i ? " | " : "") + shown[i]->renderer;
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                for (int k = 0; k < 3; ++k) {
                    float sum = 0;
                    for (int b = 0; b < 4; ++b)
                        sum += shown[i]->picture.get(2 * x + b % 2, 2 * y + b / 2, k) / 4;
                    sheet.set(x + w * static_cast<int>(i), y, k, sum);
                }
    }
    write_jpeg(page.file(s.scene + ".jpg"), sheet, 88);
    page.image(s.scene + ".jpg", names);
    page.text("From the left: " + names + ", of the table's samples.");
}

}  // namespace

void write_peers_page(std::filesystem::path const& folder, std::vector<SceneResult> const& scenes,
                      std::vector<Renderer> const& renderers, Plan const& plan, int threads, bool quick) {
    Page page(folder, "peers", "Beside other renderers");
    page.text(
        "    ./dev peers        measures all of this again and writes this page; `./dev peers --help` lists "
        "what can be chosen");
    auto const now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    page.text(fmt::format(
        "{:%Y-%m-%d}, {}, {} threads, load {} at the end.{}", fmt::gmtime(now), processor(), threads, load(),
        quick ? " **A quick run: short renders and small references; good for ratios of 20% and more.**"
              : ""));
    std::vector<std::string> versions;
    for (Renderer const& r : renderers) versions.push_back(r.name + ": " + r.version);
    page.list(versions);
    page.section("How it is measured");
    page.list(
        {"**The same scene**: every renderer has the same triangles, balls, rgb reflectances, radiances, "
         "pinhole, pixels and bounces, a box filter, and as many threads.",
         fmt::format("**Rounds**: samples of a pixel are chosen so that a render takes {} s. Then come {} "
                     "rounds, in each of which every renderer renders once, under a new seed. Numbers are "
                     "medians of the rounds, with their range.",
                     fmt::format("{:g}", plan.seconds), plan.repetitions),
         "**Times** of a render are what a renderer says itself, with the building of its trees, without its "
         "start and reading (Cycles: the call of its renderer); those of a process are from start to exit.",
         fmt::format(
             "**Errors** are relMSE, the mean of (x − r)² / (r² + 0.01), against a picture r of the "
             "renderer's *own*, of {0} times the samples, so that what renderers mean differently does not "
             "count. That picture has noise of its own: where the variance of n samples is V / n, the "
             "difference has V / n + V / ({0} n). So what is measured is divided by 1 + 1 / {0}, that is "
             "1 + n / n_reference, to give the error against a picture without noise.",
             fmt::format("{:g}", plan.reference)),
         "**Caustics** that a path tracer meets by rare chance are missing in most pixels of its reference "
         "too, and a pixel where both miss them counts as right. There the errors of path tracers are "
         "understated, and what others gain over them is as well.",
         "**sppm** is no average of independent samples: nothing is divided. Its reference is our path "
         "tracer's, where that has noise below a tenth of the error, and else its own, which hides what bias "
         "the two share; the table says which.",
         "**POV-Ray** is no path tracer, and has no samples to count. Its time is its whole process, for a "
         "final picture with its manual's settings; its error is against its own of twice the "
         "counts. It is left out of *ball*, since it finds the sun in a picture of a sky by chance only, and "
         "of "
         "*many_lights*, since it asks every lamp everywhere, for minutes."});
    show_targets(page, scenes);
    means(page, scenes);
    for (SceneResult const& s : scenes) show(page, s);
    page.write();
}

}  // namespace nephroid::peers
