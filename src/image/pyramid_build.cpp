#include "image/pyramid.h"

#include <algorithm>
#include <deque>

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

/// One level while it is made. It takes the rows of the level above from the top, in linear light, and hands its own on to
/// the next level as floats: the rounding of stored bytes does not pile up, and only a few rows are ever held as floats.
class Halving {
  public:
    /// From a level of that size to `stored`. `next` is the level below, if any.
    Halving(int width, int height, Image& stored, Halving* next)
        : stored_(stored),
          next_(next),
          across_(halving(width)),
          down_(halving(height)),
          out_(across_.size() * static_cast<std::size_t>(stored.channels())) {
        for (auto& row : recent_) row.resize(out_.size());
    }

    void push(std::vector<float> const& row) {
        auto const channels = static_cast<std::size_t>(stored_.channels());
        auto& reduced = recent_[static_cast<std::size_t>(arrived_ % 3)];
        std::size_t i = 0;
        for (Taps const& u : across_)
            for (std::size_t c = 0; c < channels; ++c) {
                float sum = 0;
                for (int k = 0; k < u.count; ++k)
                    sum += u.weight[k] * row[static_cast<std::size_t>(u.first + k) * channels + c];
                reduced[i++] = sum;
            }
        ++arrived_;
        if (done_ == stored_.height()) return;
        Taps const& v = down_[static_cast<std::size_t>(done_)];
        if (arrived_ == v.first + v.count) finish_row(v);
    }

  private:
    void finish_row(Taps const& v) {
        for (std::size_t i = 0; i < out_.size(); ++i) {
            float sum = 0;
            for (int k = 0; k < v.count; ++k)
                sum += v.weight[k] * recent_[static_cast<std::size_t>((v.first + k) % 3)][i];
            out_[i] = sum;
        }
        std::size_t i = 0;
        for (int x = 0; x < stored_.width(); ++x)
            for (int c = 0; c < stored_.channels(); ++c) stored_.set(x, done_, c, out_[i++]);
        ++done_;
        if (next_) next_->push(out_);
    }

    Image& stored_;
    Halving* next_;
    std::vector<Taps> across_, down_;
    std::vector<float> recent_[3];  // rows of the level above, halved across; row y at y mod 3
    std::vector<float> out_;
    int arrived_ = 0, done_ = 0;
};

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
    while (levels_.back().width() > 1 || levels_.back().height() > 1) {
        Image const& above = levels_.back();
        levels_.emplace_back(above.format(), std::max(1, above.width() / 2), std::max(1, above.height() / 2),
                             above.channel_names(), above.encoding());
    }
    if (levels_.size() == 1) return;
    std::deque<Halving> halvings;  // the smallest level first; addresses stay
    for (std::size_t i = levels_.size() - 1; i > 0; --i)
        halvings.emplace_back(levels_[i - 1].width(), levels_[i - 1].height(), levels_[i],
                              halvings.empty() ? nullptr : &halvings.back());
    Image const& base = levels_[0];
    std::vector<float> row(static_cast<std::size_t>(base.width()) * static_cast<std::size_t>(channels));
    for (int y = 0; y < base.height(); ++y) {
        std::size_t i = 0;
        for (int x = 0; x < base.width(); ++x)
            for (int c = 0; c < channels; ++c) row[i++] = base.get(x, y, c);
        halvings.back().push(row);
    }
}

std::size_t Pyramid::bytes() const {
    std::size_t sum = 0;
    for (Image const& image : levels_) sum += image.bytes();
    return sum;
}

}  // namespace nephroid
