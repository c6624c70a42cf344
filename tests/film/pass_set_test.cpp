#include "film/pass_set.h"

#include "math/error.h"

#include <doctest/doctest.h>

#include <random>
#include <set>

using namespace nephroid;

namespace {

using Model = std::set<std::uint64_t>;

Model model_of(PassSet const& set) {
    Model model;
    for (PassRange const& r : set.ranges())
        for (std::uint64_t i = r.begin; i < r.end; ++i) model.insert(i);
    return model;
}

/// Sorted, not empty, neither overlapping nor touching: so that equal sets have equal representations.
bool is_canonical(PassSet const& set) {
    auto const& r = set.ranges();
    for (std::size_t i = 0; i < r.size(); ++i)
        if (r[i].begin >= r[i].end || (i > 0 && r[i - 1].end >= r[i].begin)) return false;
    return true;
}

void same(PassSet const& set, Model const& model) {
    CHECK(is_canonical(set));
    CHECK(model_of(set) == model);
    CHECK(set.count() == model.size());
}

}  // namespace

TEST_CASE("pass sets behave as sets of numbers") {
    std::mt19937 random(1);
    auto const below = [&](std::uint32_t n) { return std::uint64_t{random() % n}; };
    for (int round = 0; round < 300; ++round) {
        PassSet a, b;
        Model ma, mb;
        for (int step = 0; step < 12; ++step) {
            bool const first = below(2) == 0;
            PassSet& set = first ? a : b;
            Model& model = first ? ma : mb;
            if (below(3) == 0) {
                std::uint64_t const i = below(40);
                set.insert(i);
                model.insert(i);
            } else {
                PassRange const r{below(40), below(40)};  // often empty: begin >= end
                set.insert(r);
                for (std::uint64_t i = r.begin; i < r.end; ++i) model.insert(i);
            }
        }
        same(a, ma);
        same(b, mb);
        Model common, both = ma;
        for (std::uint64_t const i : ma)
            if (mb.contains(i)) common.insert(i);
        both.insert(mb.begin(), mb.end());
        same(a.intersection(b), common);
        CHECK(a.intersects(b) == !common.empty());
        CHECK(b.intersects(a) == !common.empty());
        PassRange const wanted{below(42), below(42)};
        Model gaps;
        for (std::uint64_t i = wanted.begin; i < wanted.end; ++i)
            if (!ma.contains(i)) gaps.insert(i);
        same(a.missing(wanted), gaps);
        for (std::uint64_t i = 0; i < 42; ++i) CHECK(a.contains(i) == ma.contains(i));
        CHECK(PassSet::parse(a.text()) == a);
        a.insert(b);
        same(a, both);
    }
}

TEST_CASE("pass sets read and write text") {
    PassSet set;
    CHECK(set.text() == "");
    CHECK(PassSet::parse("").empty());
    set.insert(PassRange{0, 64});
    set.insert(PassRange{128, 160});
    CHECK(set.text() == "0:64,128:160");
    CHECK(PassSet::parse("128:160,0:10,10:64") == set);
    set.insert(set);
    CHECK(set.text() == "0:64,128:160");
    CHECK(PassSet(PassRange{0, 18446744073709551614u}).count() == 18446744073709551614u);
    for (char const* bad : {"1", "1:", ":2", "2:2", "3:2", "0:1,", ",0:1", "0:1;2:3", " 0:1", "0:1 ", "-1:2",
                            "a:b", "0:99999999999999999999", "0x1:2", "0:1,,2:3"})
        CHECK_THROWS_AS(PassSet::parse(bad), Error);
}
