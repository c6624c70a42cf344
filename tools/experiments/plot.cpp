#include "plot.h"

#include "page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::experiment {

namespace {

constexpr std::array<char const*, 8> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};
constexpr double kLeft = 70, kTop = 34, kWidth = 380, kHeight = 290, kBottom = 48, kLegend = 220;

std::string escaped(std::string const& s) {
    std::string r;
    for (char const c : s) {
        if (c == '&') {
            r += "&amp;";
        } else if (c == '<') {
            r += "&lt;";
        } else {
            r += c;
        }
    }
    return r;
}

std::string text(double x, double y, std::string const& s, char const* anchor = "middle",
                 std::string const& more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       escaped(s));
}

std::string segment(double x0, double y0, double x1, double y1, std::string const& style) {
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", x0, y0, x1, y1, style);
}

std::string frame(double x, double y, double width, double height) {
    return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#444\"/>\n",
                       x, y, width, height);
}

std::string head(double width, double height) {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} "
        "{1:.0f}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"12\" fill=\"#222\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        width, height);
}

/// Shapes that stay apart where lines cross.
std::string marker(std::size_t kind, double x, double y) {
    char const* const colour = kColours[kind % kColours.size()];
    switch (kind % 4) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x, y, colour);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"6\" fill=\"{}\"/>\n",
                               x - 3, y - 3, colour);
        case 2:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4 7h-8z\" fill=\"{}\"/>\n", x, y - 4.5, colour);
        default:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4 4l-4 4l-4 -4z\" fill=\"{}\"/>\n", x, y - 4,
                               colour);
    }
}

struct Range {
    double lo = 1e300, hi = -1e300;
    void add(double v) { lo = std::min(lo, v), hi = std::max(hi, v); }
};

/// From numbers to pixels.
struct Scale {
    Axis const* axis;
    double from, to;
    Range range = {};

    [[nodiscard]] bool shows(double v) const { return !axis->logarithmic || v > 0; }
    [[nodiscard]] double warp(double v) const { return axis->logarithmic ? std::log10(v) : v; }
    double operator()(double v) const {
        double const a = warp(range.lo);
        double const b = warp(range.hi);
        return from + (to - from) * (warp(v) - a) / (b - a);
    }
};

struct Tick {
    double value;
    std::string label;  // empty: a small one
};

/// 10⁻⁴ where 0.0001 would be long.
std::string power_of_ten(int exponent) {
    if (exponent > -4 && exponent < 5) return number(std::pow(10.0, exponent), 1);
    constexpr std::array<char const*, 10> kRaised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string s = exponent < 0 ? "10⁻" : "10";
    for (char const digit : std::to_string(std::abs(exponent)))
        s += kRaised[static_cast<std::size_t>(digit - '0')];
    return s;
}

std::vector<Tick> logarithmic_ticks(Range r) {
    bool const few = r.hi / r.lo < 30;  // then 2 and 5 have labels too
    std::vector<Tick> ticks;
    for (int e = static_cast<int>(std::floor(std::log10(r.lo))); std::pow(10.0, e) <= r.hi; ++e)
        for (int m = 1; m < 10; ++m) {
            double const v = m * std::pow(10.0, e);
            if (v < r.lo || v > r.hi) continue;
            bool const named = m == 1 || (few && (m == 2 || m == 5));
            ticks.push_back({v, m == 1 ? power_of_ten(e) : named ? number(v, 1) : ""});
        }
    return ticks;
}

std::vector<Tick> linear_ticks(Range r) {
    double const size = std::pow(10.0, std::floor(std::log10((r.hi - r.lo) / 4)));
    double step = 10 * size;
    for (double const s : {5.0, 2.0, 1.0})
        if ((r.hi - r.lo) / (s * size) <= 7) step = s * size;
    int const decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    std::vector<Tick> ticks;
    int const last = static_cast<int>(std::floor(r.hi / step + 1e-9));
    for (int k = static_cast<int>(std::ceil(r.lo / step - 1e-9)); k <= last; ++k)
        ticks.push_back({k * step, fixed(k * step, decimals)});
    return ticks;
}

std::vector<Tick> ticks_of(Scale const& s) {
    if (s.axis->ticks.empty())
        return s.axis->logarithmic ? logarithmic_ticks(s.range) : linear_ticks(s.range);
    std::vector<Tick> ticks;
    for (double const v : s.axis->ticks)
        if (v >= s.range.lo && v <= s.range.hi)
            ticks.push_back({v, v == std::round(v) ? fixed(v, 0) : number(v)});
    return ticks;
}

/// Room around the numbers; a logarithmic axis ends at least a factor of 4 after it begins.
Range widened(Range r, Axis const& axis, bool values) {
    if (r.lo > r.hi) r = {1, 2};
    if (axis.logarithmic) {
        double const edge = values ? 1.3 : 1.12;
        r = {r.lo / edge, r.hi * edge};
        if (r.hi < 4 * r.lo) r = {std::sqrt(r.lo * r.hi) / 2, std::sqrt(r.lo * r.hi) * 2};
    } else if (values) {
        r = {std::min(0.0, r.lo), r.hi > 0 ? r.hi * 1.08 : 1};
    } else if (!(r.hi > r.lo)) {
        r = {r.lo - 1, r.hi + 1};
    }
    return r;
}

std::string axes(Scale const& sx, Scale const& sy) {
    std::string const grid = "stroke=\"#e4e4e4\"";
    std::string const line = "stroke=\"#444\"";
    std::string s;
    for (Tick const& t : ticks_of(sx)) {
        double const x = sx(t.value);
        if (!t.label.empty()) s += segment(x, kTop, x, kTop + kHeight, grid);
        s += segment(x, kTop + kHeight, x, kTop + kHeight + (t.label.empty() ? 3 : 6), line);
        if (!t.label.empty()) s += text(x, kTop + kHeight + 19, t.label);
    }
    for (Tick const& t : ticks_of(sy)) {
        double const y = sy(t.value);
        if (!t.label.empty()) s += segment(kLeft, y, kLeft + kWidth, y, grid);
        s += segment(kLeft - (t.label.empty() ? 3 : 6), y, kLeft, y, line);
        if (!t.label.empty()) s += text(kLeft - 9, y + 4, t.label, "end");
    }
    double const middle = kTop + kHeight / 2;
    return s + frame(kLeft, kTop, kWidth, kHeight) +
           text(kLeft + kWidth / 2, kTop + kHeight + 38, sx.axis->label) +
           text(16, middle, sy.axis->label, "middle",
                fmt::format(" transform=\"rotate(-90 16 {:.0f})\"", middle));
}

/// Lines that lie on each other show through each other's gaps.
std::string style_of(std::size_t kind) {
    constexpr std::array<char const*, 4> kDashes{"none", "9 4", "3 3", "9 3 2 3"};
    return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" stroke-dasharray=\"{}\"",
                       kColours[kind % kColours.size()], kDashes[kind % kDashes.size()]);
}

std::string drawn(Line const& l, std::size_t kind, Scale const& sx, Scale const& sy, bool markers) {
    std::string path;
    std::string marks;
    for (std::size_t i = 0; i < l.x.size(); ++i) {
        if (!sx.shows(l.x[i]) || !sy.shows(l.y[i])) continue;
        double const x = sx(l.x[i]);
        double const y = sy(l.y[i]);
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
        if (markers) marks += marker(kind, x, y);
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" " + style_of(kind) + "/>\n" + marks;
}

std::string legend(Line const& l, std::size_t kind, bool markers) {
    double const x = kLeft + kWidth + 14;
    double const y = kTop + 12 + 36 * static_cast<double>(kind);
    std::string s = segment(x, y, x + 26, y, style_of(kind));
    if (markers) s += marker(kind, x + 13, y);
    s += text(x + 33, y + 4, l.name, "start");
    if (!l.note.empty()) s += text(x + 33, y + 18, l.note, "start", " font-size=\"11\" fill=\"#555\"");
    return s;
}

}  // namespace

std::string line_plot(std::string const& title, Axis const& x, Axis const& y, std::vector<Line> const& lines,
                      std::vector<Guide> const& guides, bool markers) {
    Scale sx{&x, kLeft, kLeft + kWidth};
    Scale sy{&y, kTop + kHeight, kTop};
    for (Line const& l : lines)
        for (std::size_t i = 0; i < l.x.size(); ++i)
            if (sx.shows(l.x[i]) && sy.shows(l.y[i])) sx.range.add(l.x[i]), sy.range.add(l.y[i]);
    sx.range = widened(sx.range, x, false);
    sy.range = widened(sy.range, y, true);

    std::string s = head(kLeft + kWidth + kLegend, kTop + kHeight + kBottom);
    s += text(kLeft + kWidth / 2, 20, title, "middle", " font-weight=\"bold\"");
    s += axes(sx, sy);
    for (Guide const& g : guides) {
        s += segment(sx(g.x), kTop, sx(g.x), kTop + kHeight, "stroke=\"#666\" stroke-dasharray=\"2 3\"");
        s += text(sx(g.x) + 4, kTop + 14, g.label, "start", " font-size=\"11\"");
    }
    for (std::size_t k = 0; k < lines.size(); ++k)
        s += drawn(lines[k], k, sx, sy, markers) + legend(lines[k], k, markers);
    return s + "</svg>\n";
}

std::string point_plot(std::vector<PointPanel> const& panels) {
    constexpr double kSide = 190, kGap = 22, kTitle = 28;
    std::string s =
        head(kGap + (kSide + kGap) * static_cast<double>(panels.size()), kTitle + kSide + kGap / 2);
    double left = kGap;
    for (PointPanel const& p : panels) {
        s += text(left + kSide / 2, 19, p.title);
        for (int i = 1; i < p.cells; ++i) {
            double const at = kSide * i / p.cells;
            s += segment(left + at, kTitle, left + at, kTitle + kSide, "stroke=\"#ddd\"");
            s += segment(left, kTitle + at, left + kSide, kTitle + at, "stroke=\"#ddd\"");
        }
        s += frame(left, kTitle, kSide, kSide);
        for (Vec2 const q : p.points)
            s += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"/>\n",
                             left + kSide * static_cast<double>(q.x),
                             kTitle + kSide * (1 - static_cast<double>(q.y)), kColours[0]);
        left += kSide + kGap;
    }
    return s + "</svg>\n";
}

}  // namespace nephroid::experiment
