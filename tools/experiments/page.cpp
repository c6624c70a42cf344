#include "page.h"

#include "html.h"

#include "image/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace nephroid::experiment {

namespace {

void check(double value) {
    if (!std::isfinite(value)) throw std::runtime_error("a number for the page is not finite");
}

void write_text(std::filesystem::path const& path, std::string const& text) {
    write_file_atomically(path, std::as_bytes(std::span(text)));
}

std::string row(std::vector<std::string> const& cells) {
    std::string s = "|";
    for (auto const& c : cells) s += " " + c + " |";
    return s + "\n";
}

}  // namespace

std::string number(double value, int digits) {
    check(value);
    if (value == 0) return "0";
    // Rounded first: 0.0009999 has as many decimals as 0.001.
    double const size = std::abs(std::stod(fmt::format("{:.{}e}", value, digits - 1)));
    if (size < 0.001 || size >= 1e5) return fmt::format("{:.{}e}", value, digits - 1);
    int const decimals = digits - 1 - static_cast<int>(std::floor(std::log10(size) + 1e-12));
    return fixed(value, std::max(0, decimals));
}

std::string fixed(double value, int decimals) {
    check(value);
    std::string s = fmt::format("{:.{}f}", std::abs(value), decimals);
    bool const zero = s.find_first_not_of("0.") == std::string::npos;
    return (value < 0 && !zero ? "−" : "") + s;
}

std::string percent(double share) { return number(100 * share, 2) + "%"; }

std::string with_error(double value, double error) {
    check(value), check(error);
    if (!(error > 0)) return number(value);
    int const exponent = static_cast<int>(std::floor(std::log10(error)));
    bool const two = error / std::pow(10.0, exponent) < 1.95;
    int const decimals = std::clamp(-exponent + (two ? 1 : 0), 0, 9);
    return fixed(value, decimals) + " ± " + fixed(error, decimals);
}

Page::Page(std::filesystem::path folder, std::string name, std::string const& title)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      pictures_(folder_ / name_),
      text_("# " + title + "\n") {}

void Page::section(std::string const& title) { text_ += "\n## " + title + "\n"; }
void Page::subsection(std::string const& title) { text_ += "\n### " + title + "\n"; }
void Page::text(std::string const& paragraph) { text_ += "\n" + paragraph + "\n"; }
void Page::list(std::vector<std::string> const& items) {
    text_ += "\n";
    for (auto const& i : items) text_ += "- " + i + "\n";
}
void Page::code(std::string const& text) {
    text_ += "\n```\n" + text + (text.ends_with('\n') ? "" : "\n") + "```\n";
}
void Page::table(std::vector<std::string> const& head, std::vector<std::vector<std::string>> const& rows) {
    text_ += "\n" + row(head) + "|---";
    for (std::size_t i = 1; i < head.size(); ++i) text_ += "|--:";
    text_ += "|\n";
    for (auto const& r : rows) text_ += row(r);
}
void Page::image(std::string const& name, std::string const& alt) {
    text_ += "\n![" + alt + "](" + name_ + "/" + name + ")\n";
}
std::filesystem::path Page::file(std::string const& name) const { return pictures_.path() / name; }
void Page::save(std::string const& name, std::string const& text) const { write_text(file(name), text); }
void Page::for_browsers(std::string const& paragraph) { text_ += "\n<!-- " + paragraph + " -->\n"; }
void Page::write(bool html) {
    pictures_.keep();
    write_text(folder_ / (name_ + ".md"), text_);
    if (html) write_text(folder_ / (name_ + ".html"), html_of(text_));
}

}  // namespace nephroid::experiment
