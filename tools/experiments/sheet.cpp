#include "sheet.h"

#include "image/write.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

namespace nephroid::experiment {

namespace {

// A font of 3 x 5 dots: one octal digit a row, the left dot counts 4.
struct Glyph {
    char letter;
    std::array<int, 5> rows;
};
constexpr std::array<Glyph, 45> kFont{{
    {'a', {2, 5, 7, 5, 5}}, {'b', {6, 5, 6, 5, 6}}, {'c', {3, 4, 4, 4, 3}}, {'d', {6, 5, 5, 5, 6}},
    {'e', {7, 4, 6, 4, 7}}, {'f', {7, 4, 6, 4, 4}}, {'g', {3, 4, 5, 5, 3}}, {'h', {5, 5, 7, 5, 5}},
    {'i', {7, 2, 2, 2, 7}}, {'j', {1, 1, 1, 5, 2}}, {'k', {5, 5, 6, 5, 5}}, {'l', {4, 4, 4, 4, 7}},
    {'m', {5, 7, 7, 5, 5}}, {'n', {6, 5, 5, 5, 5}}, {'o', {2, 5, 5, 5, 2}}, {'p', {6, 5, 6, 4, 4}},
    {'q', {2, 5, 5, 6, 3}}, {'r', {6, 5, 6, 5, 5}}, {'s', {3, 4, 2, 1, 6}}, {'t', {7, 2, 2, 2, 2}},
    {'u', {5, 5, 5, 5, 7}}, {'v', {5, 5, 5, 5, 2}}, {'w', {5, 5, 7, 7, 5}}, {'x', {5, 5, 2, 5, 5}},
    {'y', {5, 5, 2, 2, 2}}, {'z', {7, 1, 2, 4, 7}}, {'0', {7, 5, 5, 5, 7}}, {'1', {2, 6, 2, 2, 7}},
    {'2', {6, 1, 2, 4, 7}}, {'3', {6, 1, 2, 1, 6}}, {'4', {5, 5, 7, 1, 1}}, {'5', {7, 4, 6, 1, 6}},
    {'6', {3, 4, 7, 5, 7}}, {'7', {7, 1, 1, 2, 2}}, {'8', {7, 5, 7, 5, 7}}, {'9', {7, 5, 7, 1, 6}},
    {'.', {0, 0, 0, 0, 2}}, {'-', {0, 0, 7, 0, 0}}, {'/', {1, 1, 2, 4, 4}}, {',', {0, 0, 0, 2, 4}},
    {'+', {0, 2, 7, 2, 0}}, {'%', {5, 1, 2, 4, 5}}, {'(', {1, 2, 2, 2, 1}}, {')', {4, 2, 2, 2, 4}},
    {'=', {0, 7, 0, 7, 0}},
}};
constexpr int kDot = 2, kAdvance = 4 * kDot, kLineHeight = 7 * kDot, kGap = 4;

void fill(Image& image, int x0, int y0, int width, int height, float value) {
    for (int y = std::max(0, y0); y < std::min(image.height(), y0 + height); ++y)
        for (int x = std::max(0, x0); x < std::min(image.width(), x0 + width); ++x)
            for (int c = 0; c < image.channels(); ++c) image.set(x, y, c, value);
}

void write(Image& image, int x, int y, std::string_view text) {
    for (char const letter : text) {
        for (Glyph const& g : kFont)
            for (int dot = 0; g.letter == letter && dot < 15; ++dot)
                if (g.rows[static_cast<std::size_t>(dot / 3)] >> (2 - dot % 3) & 1)
                    fill(image, x + dot % 3 * kDot, y + dot / 3 * kDot, kDot, kDot, 0);
        x += kAdvance;
    }
}

void copy(Image& image, int x0, int y0, Picture const& p, double exposure) {
    std::size_t i = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x, ++i)
            for (int c = 0; c < image.channels(); ++c)
                image.set(x0 + x, y0 + y, c,
                          static_cast<float>(p.rgb[i][static_cast<std::size_t>(c)] * exposure));
}

bool is_grey(std::vector<SheetRow> const& rows) {
    for (SheetRow const& r : rows)
        for (Picture const& p : r.pictures)
            for (auto const& c : p.rgb)
                if (std::abs(c[0] - c[1]) + std::abs(c[2] - c[1]) > 1e-3 * std::abs(c[1])) return false;
    return true;
}

std::vector<std::string> words(std::string const& label) {
    std::vector<std::string> w(1);
    for (char const c : label) {
        if (c == ' ') {
            w.emplace_back();
        } else {
            w.back() += c;
        }
    }
    return w;
}

/// Letters and digits, and a dash for each run of anything else.
std::string file_name(std::string const& label) {
    std::string name;
    for (char const c : label) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            name += c;
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    while (name.ends_with('-')) name.pop_back();
    return name;
}

void save_full(std::filesystem::path const& stem, Picture p, double exposure) {
    write_exr(stem.string() + ".exr", image_of(p));
    for (auto& color : p.rgb)
        for (double& v : color) v *= exposure;
    write_png(stem.string() + ".png", image_of(p));
}

}  // namespace

void write_sheet(std::filesystem::path const& path, std::vector<std::string> const& columns,
                 std::vector<SheetRow> const& rows) {
    auto const& first = rows.front().pictures;
    int const width = first.front().width;
    int const height = first.front().height;
    std::size_t widest = 0;
    for (SheetRow const& r : rows)
        for (auto const& w : words(r.label)) widest = std::max(widest, w.size());
    int const left = widest > 0 ? static_cast<int>(widest) * kAdvance + 2 * kGap : 0;
    int const top = columns.empty() ? 0 : kLineHeight;
    Image image(PixelFormat::U8, left + static_cast<int>(first.size()) * (width + kGap) - kGap,
                top + static_cast<int>(rows.size()) * (height + kGap) - kGap,
                default_channel_names(is_grey(rows) ? 1 : 3), Encoding::srgb());
    fill(image, 0, 0, image.width(), image.height(), 1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        int const x = left + static_cast<int>(i) * (width + kGap);
        write(image, std::max(x, x + (width - static_cast<int>(columns[i].size()) * kAdvance) / 2), 1,
              columns[i]);
    }
    int y = top;
    for (SheetRow const& r : rows) {
        int line = y + 2;
        for (auto const& w : words(r.label)) write(image, kDot, line, w), line += kLineHeight;
        int x = left;
        for (Picture const& p : r.pictures) copy(image, x, y, p, r.exposure), x += width + kGap;
        y += height + kGap;
    }
    write_png(path, image);
}

Picture reduced(Picture const& p, int by) {
    Picture r{p.width / by, p.height / by, {}};
    for (int y = 0; y < r.height; ++y)
        for (int x = 0; x < r.width; ++x) {
            std::array<double, 3> sum{};
            for (int j = 0; j < by; ++j)
                for (int i = 0; i < by; ++i)
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[c] +=
                            p.rgb[static_cast<std::size_t>(y * by + j) * static_cast<std::size_t>(p.width) +
                                  static_cast<std::size_t>(x * by + i)][c];
            for (double& s : sum) s /= by * by;
            r.rgb.push_back(sum);
        }
    return r;
}

void show_sheet(Lab const& lab, std::string const& name, std::string const& alt,
                std::vector<std::string> const& columns, std::vector<SheetRow> const& rows) {
    std::vector<SheetRow> small = rows;
    if (lab.enlarge > 1 && !lab.quick)
        for (SheetRow& r : small)
            for (Picture& p : r.pictures) p = reduced(p, lab.enlarge);
    write_sheet(lab.page.file(name), columns, small);
    lab.page.image(name, alt);
    if (lab.full.empty()) return;
    std::string const stem = std::filesystem::path(name).stem().string();
    std::string links;
    for (SheetRow const& r : rows)
        for (std::size_t i = 0; i < r.pictures.size(); ++i) {
            std::string const label =
                (r.label.empty() ? "" : r.label + " ") + (i < columns.size() ? columns[i] : "");
            std::string const file = stem + "-" + file_name(label.empty() ? std::to_string(i + 1) : label);
            save_full(lab.full / file, r.pictures[i], r.exposure);
            std::string const at = std::string(kFullFolder) + "/" + file;
            links += (links.empty() ? "Full size: " : ", ") + std::string("[") +
                     (label.empty() ? "picture" : label) + "](" + at + ".png) ([EXR](" + at + ".exr))";
        }
    lab.page.for_browsers(links);
}

Picture over(Image const& marks, Picture under) {
    std::size_t i = 0;
    for (int y = 0; y < under.height; ++y)
        for (int x = 0; x < under.width; ++x, ++i)
            for (int c = 0; c < 3; ++c) {
                double& v = under.rgb[i][static_cast<std::size_t>(c)];
                v = v * (1 - static_cast<double>(marks.get(x, y, 3))) +
                    static_cast<double>(marks.get(x, y, c));
            }
    return under;
}

double exposure_for(Picture const& p, double share) {
    std::vector<double> values;
    for (auto const& c : p.rgb) values.push_back(std::max({c[0], c[1], c[2]}));
    auto const at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at > 0 ? 0.95 / *at : 1;
}

}  // namespace nephroid::experiment
