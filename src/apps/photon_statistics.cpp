#include "photon_statistics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>

namespace nephroid::cli {

namespace {

/// How a path may end, in the words of the reports.
struct Fate {
    char const* key;
    char const* text;
    std::uint64_t PhotonCounts::*count;
};
constexpr Fate kFates[] = {{"escaped", "left the scene", &PhotonCounts::escaped},
                           {"absorbed", "absorbed", &PhotonCounts::absorbed},
                           {"too_long", "too long", &PhotonCounts::too_long},
                           {"landed", "landed (caustic)", &PhotonCounts::landed},
                           {"elsewhere", "the other map's", &PhotonCounts::elsewhere},
                           {"dark", "sent nothing", &PhotonCounts::dark},
                           {"broken", "not a number", &PhotonCounts::broken}};
/// The table names so many lights, those that sent the most paths.
constexpr std::size_t kLightsShown = 6;

std::string source_name(RunStatistics const& s, std::size_t i) {
    return i < s.photon_sources.size() ? s.photon_sources[i] : fmt::format("light {}", i);
}
PhotonCounts at(std::vector<PhotonCounts> const& list, std::size_t i) {
    return i < list.size() ? list[i] : PhotonCounts{};
}
std::size_t sources(PhotonReport const& r) { return std::max(r.global.size(), r.caustic.size()); }

/// "81920", "2.31 M".
std::string amount(std::uint64_t n) {
    return n < 100000 ? std::to_string(n) : fmt::format("{:.2f} M", static_cast<double>(n) / 1e6);
}
double millions(double n) { return n / 1e6; }

std::string fates(PhotonCounts const& c) {
    std::string t;
    for (Fate const& fate : kFates)
        if (std::uint64_t const n = c.*fate.count; n > 0)
            t += fmt::format(
                "{}{} {:.1f}%", t.empty() ? "" : ", ", fate.text,
                100 * static_cast<double>(n) / static_cast<double>(std::max<std::uint64_t>(1, c.emitted)));
    return t;
}

nlohmann::json to_json(PhotonCounts const& c, double seconds) {
    nlohmann::json j{{"emitted", c.emitted}, {"stored", c.stored}, {"further", c.further}};
    j["emitted_per_second"] = rate(c.emitted, seconds);
    j["stored_per_second"] = rate(c.stored, seconds);
    for (Fate const& fate : kFates) j[fate.key] = c.*fate.count;
    return j;
}

}  // namespace

PhotonCounts total_of(std::vector<PhotonCounts> const& by_source) {
    PhotonCounts all;
    for (PhotonCounts const& c : by_source) all.add(c);
    return all;
}

bool shot_photons(RunStatistics const& s) {
    return total_of(s.photons.global).emitted + total_of(s.photons.caustic).emitted > 0;
}

std::string photon_table(RunStatistics const& s) {
    if (!shot_photons(s)) return {};
    PhotonReport const& r = s.photons;
    std::string t;
    for (auto const& [name, list] : {std::pair("global", &r.global), std::pair("caustic", &r.caustic)}) {
        PhotonCounts const c = total_of(*list);
        if (c.emitted == 0) continue;
        std::string const ends = fates(c);
        std::string const further = c.further > 0 ? fmt::format(", {} further on", amount(c.further)) : "";
        t += fmt::format("{} {:<8} {} paths, {} photons stored{}{}{}\n", t.empty() ? "photons" : "       ",
                         name, amount(c.emitted), amount(c.stored), further, ends.empty() ? "" : "; ", ends);
    }
    PhotonCounts all = total_of(r.global);
    all.add(total_of(r.caustic));
    t += fmt::format(
        "        shooting {:.2f} s ({:.2f} M paths/s, {:.2f} M photons/s), building {:.2f} s, maps of a pass "
        "{}\n",
        r.shooting_seconds, millions(rate(all.emitted, r.shooting_seconds)),
        millions(rate(all.stored + all.further, r.shooting_seconds)), r.building_seconds,
        bytes_text(r.bytes));
    std::size_t const n = sources(r);
    if (n < 2) return t;
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return at(r.global, a).emitted + at(r.caustic, a).emitted >
               at(r.global, b).emitted + at(r.caustic, b).emitted;
    });
    for (std::size_t k = 0; k < std::min(n, kLightsShown); ++k) {
        PhotonCounts const g = at(r.global, order[k]), c = at(r.caustic, order[k]);
        t += fmt::format("        {}: {} paths, {} photons (caustic: {}, {})\n", source_name(s, order[k]),
                         g.emitted, g.stored, c.emitted, c.stored);
    }
    if (n > kLightsShown)
        t += fmt::format("        and {} lights more (--stats has them all)\n", n - kLightsShown);
    return t;
}

nlohmann::json photons_to_json(RunStatistics const& s) {
    PhotonReport const& r = s.photons;
    nlohmann::json j{{"global", to_json(total_of(r.global), r.shooting_seconds)},
                     {"caustic", to_json(total_of(r.caustic), r.shooting_seconds)},
                     {"bytes", r.bytes},
                     {"seconds", {{"shooting", r.shooting_seconds}, {"building", r.building_seconds}}}};
    j["lights"] = nlohmann::json::array();
    for (std::size_t i = 0; i < sources(r); ++i)
        j["lights"].push_back({{"name", source_name(s, i)},
                               {"global", to_json(at(r.global, i), r.shooting_seconds)},
                               {"caustic", to_json(at(r.caustic, i), r.shooting_seconds)}});
    return j;
}

}  // namespace nephroid::cli
