#include "film/pass_set.h"

#include "math/error.h"

#include <algorithm>
#include <charconv>

namespace nephroid {

void PassSet::insert(PassRange r) {
    if (r.begin >= r.end) return;
    // Everything that overlaps or touches r melts into it.
    auto const first =
        std::lower_bound(ranges_.begin(), ranges_.end(), r.begin,
                         [](PassRange const& a, std::uint64_t begin) { return a.end < begin; });
    auto last = first;
    for (; last != ranges_.end() && last->begin <= r.end; ++last) {
        r.begin = std::min(r.begin, last->begin);
        r.end = std::max(r.end, last->end);
    }
    ranges_.insert(ranges_.erase(first, last), r);
}

void PassSet::insert(PassSet const& other) {
    if (&other == this) return;
    for (PassRange const& r : other.ranges_) insert(r);
}

bool PassSet::contains(std::uint64_t i) const {
    auto const after =
        std::upper_bound(ranges_.begin(), ranges_.end(), i,
                         [](std::uint64_t pass, PassRange const& r) { return pass < r.begin; });
    return after != ranges_.begin() && i < std::prev(after)->end;
}

PassSet PassSet::intersection(PassSet const& other) const {
    PassSet common;
    auto a = ranges_.begin(), b = other.ranges_.begin();
    while (a != ranges_.end() && b != other.ranges_.end()) {
        PassRange const both{std::max(a->begin, b->begin), std::min(a->end, b->end)};
        if (both.begin < both.end) common.ranges_.push_back(both);
        if (a->end < b->end)
            ++a;
        else
            ++b;
    }
    return common;
}

bool PassSet::intersects(PassSet const& other) const { return !intersection(other).empty(); }

std::uint64_t PassSet::count() const {
    std::uint64_t n = 0;
    for (PassRange const& r : ranges_) n += r.end - r.begin;
    return n;
}

PassSet PassSet::missing(PassRange wanted) const {
    PassSet gaps;
    for (PassRange const& r : ranges_) {
        if (wanted.begin >= wanted.end || r.begin >= wanted.end) break;
        if (r.end <= wanted.begin) continue;
        if (wanted.begin < r.begin) gaps.ranges_.push_back({wanted.begin, r.begin});
        wanted.begin = r.end;
    }
    if (wanted.begin < wanted.end) gaps.ranges_.push_back(wanted);
    return gaps;
}

std::string PassSet::text() const {
    std::string text;
    for (PassRange const& r : ranges_) {
        if (!text.empty()) text += ',';
        text += std::to_string(r.begin) + ':' + std::to_string(r.end);
    }
    return text;
}

PassSet PassSet::parse(std::string const& text) {
    PassSet set;
    char const* at = text.data();
    char const* const end = at + text.size();
    auto const number = [&] {
        std::uint64_t n = 0;
        auto const [stop, error] = std::from_chars(at, end, n);
        if (error != std::errc{} || stop == at)
            throw Error(ErrorKind::Input, "'" + text + "' is no set of passes: write it as 0:64,128:160");
        at = stop;
        return n;
    };
    auto const skip = [&](char c) { return at != end && *at == c ? (++at, true) : false; };
    if (at == end) return set;
    do {
        PassRange r;
        r.begin = number();
        bool const colon = skip(':');
        if (colon) r.end = number();
        if (!colon || r.begin >= r.end)
            throw Error(ErrorKind::Input,
                        "'" + text + "' is no set of passes: each range is begin:end, begin < end");
        set.insert(r);
    } while (skip(','));
    if (at != end)
        throw Error(ErrorKind::Input, "'" + text + "' is no set of passes: write it as 0:64,128:160");
    return set;
}

}  // namespace nephroid
