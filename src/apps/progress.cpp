#include "progress.h"

#include "console.h"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace nephroid::cli {

namespace {

std::string clock_text(double seconds) {
    auto const s = static_cast<long>(std::lround(seconds));
    if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    return fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

ProgressStyle progress_style(bool quiet, std::string const& log) {
    if (log == "json") return ProgressStyle::Json;
    if (quiet) return ProgressStyle::Quiet;
    return isatty(STDERR_FILENO) ? ProgressStyle::Bar : ProgressStyle::Lines;
}

void ProgressPrinter::operator()(RenderProgress const& p) {
    if (style_ == ProgressStyle::Quiet) return;
    bool const done = p.passes_done == p.passes_wanted;
    double const interval = style_ == ProgressStyle::Bar ? 0.1 : 5.0;
    if (!done && p.seconds - last_printed_ < interval) return;
    last_printed_ = p.seconds;
    double const left = p.fraction > 0 ? p.seconds * (1 - p.fraction) / p.fraction : 0;
    if (style_ == ProgressStyle::Json) {
        nlohmann::json const j{{"event", "progress"},
                               {"passes", p.passes_done},
                               {"of", p.passes_wanted},
                               {"fraction", p.fraction},
                               {"seconds", p.seconds}};
        say("{}\n", j.dump());
        return;
    }
    // Rounded down, so that 100% is the end and nothing else.
    double const percent = std::floor(100 * p.fraction);
    bool const open_ended = p.passes_wanted > (1ull << 40);
    std::string const passes = open_ended ? fmt::format("{} passes", p.passes_done)
                                          : fmt::format("{} / {} passes", p.passes_done, p.passes_wanted);
    std::string const time = done ? fmt::format("{}", clock_text(p.seconds))
                                  : fmt::format("{}, {} left", clock_text(p.seconds), clock_text(left));
    if (style_ == ProgressStyle::Lines) {
        say("rendering: {:3.0f}%  {}  {}\n", percent, passes, time);
        return;
    }
    constexpr int width = 40;
    auto const filled = static_cast<int>(std::lround(width * p.fraction));
    std::string bar;
    for (int i = 0; i < width; ++i) bar += i < filled ? "█" : "░";
    say("\r{} {:3.0f}%  {}  {}\033[K", bar, percent, passes, time);
    open_line_ = true;
    if (done) finish();
}

void ProgressPrinter::finish() {
    if (open_line_) say("\n");
    open_line_ = false;
}

}  // namespace nephroid::cli
