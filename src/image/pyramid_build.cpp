#include "image/pyramid.h"

#include <algorithm>

namespace nephroid {

namespace {

/// One side's halving. Output texel i of n/2 covers n/(n/2) input texels: two for an even n; for an odd n parts of three,
/// with weights that slide from one end to the other (for 5 -> 2: 2/5 2/5 1/5, then 1/5 2/5 2/5). Every input texel gets
/// the same total weight: the mean stays.
struct Taps {
    int first = 0, count = 1;
    float weight[3] = {1, 0, 0};
};

std::vector<Taps> halving(int n) {
    if (n == 1) return {Taps{}};
    int const m = n / 2;
    std::vector<Taps> taps(static_cast<std::size_t>(m));
    for (int i = 0; i < m; ++i) {
        Taps& t = taps[static_cast<std::size_t>(i)];
        t.first = 2 * i;
        if (n % 2 == 0) {
            t.count = 2;
            t.weight[0] = t.weight[1] = 0.5f;
        } else {
            t.count = 3;
            auto const size = static_cast<float>(n);
            t.weight[0] = static_cast<float>(m - i) / size;
            t.weight[1] = static_cast<float>(m) / size;
            t.weight[2] = static_cast<float>(i + 1) / size;
        }
    }
    return taps;
}

/// Linear floats beside the stored level: halving from these keeps the rounding of bytes from piling up.
struct Plane {
    int width = 0, height = 0, channels = 0;
    std::vector<float> values;
};

template <class Source>
Plane halve(Source&& source, int width, int height, int channels) {
    Plane out{std::max(1, width / 2), std::max(1, height / 2), channels, {}};
    out.values.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) *
                       static_cast<std::size_t>(channels));
    auto const across = halving(width), down = halving(height);
    for (Taps const& v : down)
        for (Taps const& u : across)
            for (int c = 0; c < channels; ++c) {
                float sum = 0;
                for (int j = 0; j < v.count; ++j) {
                    float row = 0;
                    for (int i = 0; i < u.count; ++i)
                        row += u.weight[i] * source(u.first + i, v.first + j, c);
                    sum += v.weight[j] * row;
                }
                out.values.push_back(sum);
            }
    return out;
}

bool has_transparency(Image const& image, int alpha) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (image.get(x, y, alpha) != 1.0f) return true;
    return false;
}

}  // namespace

Pyramid::Pyramid(Image image) {
    if (image.empty()) return;
    int const channels = image.channels();
    bool const color = channels >= 3;
    char const* const names[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) rgb_[c] = color ? image.channel(names[c]).value_or(c) : 0;
    scalar_ = color ? -1 : 0;
    if (auto const alpha = image.channel("A"); color && alpha && has_transparency(image, *alpha))
        scalar_ = *alpha;

    levels_.push_back(std::move(image));
    Plane last;
    while (levels_.back().width() > 1 || levels_.back().height() > 1) {
        Image const& above = levels_.back();
        Plane next;
        if (levels_.size() == 1) {
            next = halve([&](int x, int y, int c) { return above.get(x, y, c); }, above.width(),
                         above.height(), channels);
        } else {
            auto from_plane = [&](int x, int y, int c) {
                return last.values[(static_cast<std::size_t>(y) * static_cast<std::size_t>(last.width) +
                                    static_cast<std::size_t>(x)) *
                                       static_cast<std::size_t>(channels) +
                                   static_cast<std::size_t>(c)];
            };
            next = halve(from_plane, last.width, last.height, channels);
        }
        Image stored(above.format(), next.width, next.height, above.channel_names(), above.encoding());
        std::size_t i = 0;
        for (int y = 0; y < next.height; ++y)
            for (int x = 0; x < next.width; ++x)
                for (int c = 0; c < channels; ++c) stored.set(x, y, c, next.values[i++]);
        levels_.push_back(std::move(stored));
        last = std::move(next);
    }
}

std::size_t Pyramid::bytes() const {
    std::size_t sum = 0;
    for (Image const& image : levels_) sum += image.bytes();
    return sum;
}

}  // namespace nephroid
