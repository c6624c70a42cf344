#include "params.h"
#include "shown.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace nephroid {

namespace {

/// Slips from a to b, not minding case: letters added, dropped or changed, and neighbours exchanged.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    auto const lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    // Three rows of the table: the exchange of neighbours looks back two.
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            bool const same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j - 1] + (same ? 0 : 1), last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(last);
        last.swap(row);
    }
    return last.back();
}

}  // namespace

std::string nearest_name(std::string_view word, std::vector<std::string> const& candidates) {
    constexpr std::size_t kLongest = 64;  // a longer word is no slip, and the table is quadratic
    if (word.size() > kLongest) return {};
    std::string best;
    // A third of the letters may be wrong.
    std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (auto const& c : candidates) {
        if (c.size() > kLongest || c == word) continue;
        auto const d = edit_distance(word, c);
        if (d < best_distance) best = c, best_distance = d;
    }
    return best;
}

std::string did_you_mean(std::string_view word, std::vector<std::string> const& candidates) {
    auto const name = nearest_name(word, candidates);
    return name.empty() ? std::string{} : " (did you mean \"" + shown(name) + "\"?)";
}

std::string quoted(std::vector<std::string> const& names) {
    std::string list;
    for (auto const& name : names) list += (list.empty() ? "\"" : ", \"") + name + "\"";
    return list;
}

std::string which_to_use(std::string_view word, std::vector<std::string> const& candidates) {
    auto const near = did_you_mean(word, candidates);
    return near.empty() ? "; use one of " + quoted(candidates) : near;
}

}  // namespace nephroid
