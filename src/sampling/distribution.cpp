#include "sampling/distribution.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {
/// The cell that x in [0, 1] falls into.
std::size_t cell_of(float x, std::size_t cells) {
    return std::min(static_cast<std::size_t>(x * static_cast<float>(cells)), cells - 1);
}
}  // namespace

AliasTable::AliasTable(std::span<float const> weights) {
    double sum = 0;
    for (float const w : weights) sum += w;
    if (!(sum > 0)) return;
    std::size_t const n = weights.size();
    bins_.resize(n);
    // Vose: pair each index below the average with one above it.
    struct Entry {
        double p;  // n * probability
        std::uint32_t i;
    };
    std::vector<Entry> under;
    std::vector<Entry> over;
    for (std::size_t i = 0; i < n; ++i) {
        double const p = weights[i] / sum;
        bins_[i].p = static_cast<float>(p);
        (p * static_cast<double>(n) < 1 ? under : over)
            .push_back({p * static_cast<double>(n), static_cast<std::uint32_t>(i)});
    }
    while (!under.empty() && !over.empty()) {
        Entry const u = under.back();
        under.pop_back();
        Entry& o = over.back();
        bins_[u.i].q = static_cast<float>(u.p);
        bins_[u.i].alias = o.i;
        o.p -= 1 - u.p;
        if (o.p < 1) {
            under.push_back(o);
            over.pop_back();
        }
    }
    // What is left is 1 but for rounding.
    for (auto const* rest : {&under, &over})
        for (Entry const& e : *rest) bins_[e.i].q = 1, bins_[e.i].alias = e.i;
}

Distribution1D::Distribution1D(std::span<float const> f) : cdf_(f.size() + 1), guide_(f.size()) {
    std::size_t const n = f.size();
    auto const value = [&](std::size_t i) { return std::abs(static_cast<double>(f[i])); };
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += value(i);
    integral_ = static_cast<float>(sum / static_cast<double>(n));
    if (integral_ > 0) {
        double const least = 0x1p-8 * sum / static_cast<double>(n);
        auto const raised = [&](std::size_t i) { return value(i) > 0 ? std::max(value(i), least) : 0.0; };
        double total = 0;
        for (std::size_t i = 0; i < n; ++i) total += raised(i);
        // Edges in 2^-24ths: rounded, then pushed apart, upwards and back from the end, where lit cells are empty. Beyond 2^24
        // cells there is not one for each.
        std::vector<std::int64_t> edge(n + 1);
        std::int64_t constexpr end = 1 << 24;
        std::int64_t const one = n < static_cast<std::size_t>(end) ? 1 : 0;
        double running = 0;
        for (std::size_t i = 0; i < n; ++i) {
            running += raised(i);
            edge[i + 1] = value(i) > 0 ? std::max(std::llround(running / total * static_cast<double>(end)),
                                                  static_cast<long long>(edge[i] + one))
                                       : edge[i];
        }
        edge[n] = end;
        for (std::size_t i = n; i-- > 1;) edge[i] = std::min(edge[i], edge[i + 1] - (value(i) > 0 ? one : 0));
        for (std::size_t i = 0; i <= n; ++i) cdf_[i] = static_cast<float>(edge[i]) * 0x1p-24f;
    } else {
        for (std::size_t i = 0; i <= n; ++i)
            cdf_[i] = static_cast<float>(static_cast<double>(i) / static_cast<double>(n));
    }
    for (std::size_t k = 0, i = 0; k < n; ++k) {
        while (i + 1 < n && cdf_[i + 1] <= static_cast<float>(k) / static_cast<float>(n)) ++i;
        guide_[k] = static_cast<std::uint32_t>(i);
    }
}

float Distribution1D::sample(float u, float* pdf, std::size_t* cell) const {
    // The last cell whose cdf is <= u.
    std::size_t const n = guide_.size();
    std::size_t i = guide_[std::min(static_cast<std::size_t>(u * static_cast<float>(n)), n - 1)];
    while (i > 0 && cdf_[i] > u) --i;  // u * n may have been rounded up
    while (i + 1 < n && cdf_[i + 1] <= u) ++i;
    float t = u - cdf_[i];
    float const width = cdf_[i + 1] - cdf_[i];
    if (width > 0) t /= width;
    t = clamp(t, 0.0f, kOneMinusEpsilon);
    if (cell) *cell = i;
    if (pdf) *pdf = density(i);
    float x = std::min((static_cast<float>(i) + t) / static_cast<float>(n), kOneMinusEpsilon);
    // Rounding may have carried x over the cell's edge, where the density is another, or none at all.
    while (cell_of(x, n) > i) x = std::nextafter(x, 0.0f);
    while (cell_of(x, n) < i) x = std::nextafter(x, 1.0f);
    return x;
}

float Distribution1D::pdf(float x) const {
    if (!(x >= 0 && x <= 1) || guide_.empty()) return 0;
    return density(cell_of(x, guide_.size()));
}

std::optional<float> Distribution1D::invert(float x) const {
    if (x < 0 || x > 1 || guide_.empty()) return std::nullopt;
    float const c = x * static_cast<float>(guide_.size());
    std::size_t const i = cell_of(x, guide_.size());
    return lerp(c - static_cast<float>(i), cdf_[i], cdf_[i + 1]);
}

Distribution2D::Distribution2D(std::span<float const> f, int width, int height) {
    std::vector<float> sums;
    auto const w = static_cast<std::size_t>(width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        rows_.emplace_back(f.subspan(y * w, w));
        sums.push_back(rows_.back().integral());
    }
    marginal_ = Distribution1D(sums);
}

Vec2 Distribution2D::sample(Vec2 u, float* pdf) const {
    float p_y = 0;
    float p_x = 0;
    std::size_t row = 0;
    float const y = marginal_.sample(u.y, &p_y, &row);
    float const x = rows_[row].sample(u.x, &p_x);
    if (pdf) *pdf = p_x * p_y;
    return {x, y};
}

float Distribution2D::pdf(Vec2 p) const {
    if (!(p.y >= 0 && p.y <= 1)) return 0;
    std::size_t const row = cell_of(p.y, rows_.size());
    return rows_[row].pdf(p.x) * marginal_.pdf(p.y);
}

std::optional<Vec2> Distribution2D::invert(Vec2 p) const {
    auto const y = marginal_.invert(p.y);
    if (!y) return std::nullopt;
    std::size_t const row = cell_of(p.y, rows_.size());
    auto const x = rows_[row].invert(p.x);
    if (!x) return std::nullopt;
    return Vec2{*x, *y};
}

std::size_t Distribution2D::bytes() const {
    std::size_t n = marginal_.bytes();
    for (auto const& r : rows_) n += r.bytes() + sizeof(r);
    return n;
}

}  // namespace nephroid
