#include "words.h"

#include <algorithm>
#include <numeric>

namespace nephroid::cli {

namespace {

int edit_distance(std::string const& a, std::string const& b) {
    std::vector<int> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        int diagonal = row[0];
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            int const old = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
            diagonal = old;
        }
    }
    return row.back();
}

}  // namespace

std::string nearest(std::string const& word, std::vector<std::string> const& known) {
    auto const best = std::min_element(known.begin(), known.end(), [&](auto const& a, auto const& b) {
        return edit_distance(word, a) < edit_distance(word, b);
    });
    return best == known.end() ? std::string() : *best;
}

}  // namespace nephroid::cli
