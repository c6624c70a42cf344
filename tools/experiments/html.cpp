#include "html.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

namespace nephroid::experiment {

namespace {

constexpr char const* kStyle =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "img{max-width:100%}pre{background:#f4f4f4;padding:.6rem;overflow-x:auto}code{font-size:.92em}"
    "table{border-collapse:collapse;font-size:.92em;display:block;overflow-x:auto}"
    "td,th{border:1px solid #ccc;padding:.2rem "
    ".5rem;text-align:right}td:first-child,th:first-child{text-align:left}"
    "h2{margin-top:3rem;border-top:1px solid #ccc;padding-top:1rem}";

std::string escaped(std::string_view text) {
    std::string out;
    for (char const c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

/// What stands within a paragraph, a cell or a heading.
std::string inlined(std::string_view text) {
    std::string out;
    auto const until = [&](std::size_t from, std::string_view mark) { return text.find(mark, from); };
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = std::string_view::npos;
        if (text[i] == '`' && (end = until(i + 1, "`")) != std::string_view::npos) {
            out += "<code>" + escaped(text.substr(i + 1, end - i - 1)) + "</code>";
            i = end + 1;
        } else if (text.substr(i, 2) == "**" && (end = until(i + 2, "**")) != std::string_view::npos) {
            out += "<b>" + inlined(text.substr(i + 2, end - i - 2)) + "</b>";
            i = end + 2;
        } else if (text[i] == '*' && (end = until(i + 1, "*")) != std::string_view::npos) {
            out += "<i>" + inlined(text.substr(i + 1, end - i - 1)) + "</i>";
            i = end + 1;
        } else if (bool const picture = text.substr(i, 2) == "!["; picture || text[i] == '[') {
            std::size_t const first = i + (picture ? 2 : 1), middle = until(first, "](");
            end = middle == std::string_view::npos ? middle : until(middle, ")");
            if (end == std::string_view::npos) {
                out += escaped(text.substr(i++, 1));
                continue;
            }
            std::string_view const words = text.substr(first, middle - first),
                                   target = text.substr(middle + 2, end - middle - 2);
            out += picture ? "<img src=\"" + escaped(target) + "\" alt=\"" + escaped(words) + "\">"
                           : "<a href=\"" + escaped(target) + "\">" + inlined(words) + "</a>";
            i = end + 1;
        } else {
            out += escaped(text.substr(i++, 1));
        }
    }
    return out;
}

std::string table_row(std::string_view line, char const* cell) {
    std::string out = "<tr>";
    // "| a | b |"; a bar within `code` parts nothing.
    std::size_t begin = 1;
    bool code = false;
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (line[i] == '`') code = !code;
        if (line[i] != '|' || code) continue;
        std::string_view words = line.substr(begin, i - begin);
        while (words.starts_with(' ')) words.remove_prefix(1);
        while (words.ends_with(' ')) words.remove_suffix(1);
        out += std::string("<") + cell + ">" + inlined(words) + "</" + cell + ">";
        begin = i + 1;
    }
    return out + "</tr>\n";
}

std::string list_or_table(std::vector<std::string> const& lines) {
    std::string out;
    if (lines.front().starts_with("- ")) {
        for (std::string const& l : lines) out += "<li>" + inlined(std::string_view(l).substr(2)) + "</li>\n";
        return "<ul>\n" + out + "</ul>\n";
    }
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (i != 1) out += table_row(lines[i], i == 0 ? "th" : "td");  // line 1 says how columns are aligned
    return "<table>\n" + out + "</table>\n";
}

std::string block(std::vector<std::string> const& lines) {
    std::string const& first = lines.front();
    if (first.starts_with("- ") || first.starts_with("| ")) return list_or_table(lines);
    std::string text;
    for (std::string const& l : lines) text += (text.empty() ? "" : "\n") + l;
    std::size_t const level = first.find_first_not_of('#');
    if (level > 0 && level < 4 && first[level] == ' ') {
        std::string const tag = "h" + std::to_string(level) + ">";
        return "<" + tag + inlined(std::string_view(text).substr(level + 1)) + "</" + tag + "\n";
    }
    std::string_view words = text;
    if (words.starts_with("<!-- ") && words.ends_with(" -->")) words = words.substr(5, words.size() - 9);
    return "<p>" + inlined(words) + "</p>\n";
}

}  // namespace

std::string html_of(std::string const& markdown) {
    std::istringstream in(markdown);
    std::string body, title;
    std::vector<std::string> lines;
    auto const finish = [&] {
        if (!lines.empty()) body += block(lines);
        lines.clear();
    };
    for (std::string line; std::getline(in, line);) {
        if (line == "```") {
            finish();
            body += "<pre>";
            while (std::getline(in, line) && line != "```") body += escaped(line) + "\n";
            body += "</pre>\n";
        } else if (line.empty()) {
            finish();
        } else {
            if (title.empty() && line.starts_with("# ")) title = line.substr(2);
            lines.push_back(line);
        }
    }
    finish();
    return std::string("<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>") +
           escaped(title) + "</title>\n<style>" + kStyle + "</style>\n" + body + "</html>\n";
}

}  // namespace nephroid::experiment
