#include "image/pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nephroid {

namespace {

constexpr float kMostAnisotropy = 64.0f;
constexpr int kFalloffSize = 128;

/// EWA's weight by squared radius: a Gaussian exp(-2 r^2), lowered to reach 0 at the ellipse's edge.
std::array<float, kFalloffSize> make_falloff() {
    std::array<float, kFalloffSize> table{};
    for (int i = 0; i < kFalloffSize; ++i) {
        float const r2 = static_cast<float>(i) / static_cast<float>(kFalloffSize - 1);
        table[static_cast<std::size_t>(i)] = std::exp(-2.0f * r2) - std::exp(-2.0f);
    }
    return table;
}
std::array<float, kFalloffSize> const falloff = make_falloff();

int modulo(int a, int n) {
    int const r = a % n;
    return r < 0 ? r + n : r;
}

/// floor as int, for any float: what is not finite or far outside becomes a harmless number.
int floor_to_int(float x) {
    if (!(std::abs(x) < 1e9f)) return 0;
    return static_cast<int>(std::floor(x));
}

float width_to_level(float width, Image const& base) {
    return std::log2(std::max(width, 1e-8f) * static_cast<float>(std::max(base.width(), base.height())));
}

/// The filters, for any number of channels at a time: T is float or Vec3, fetch(level, x, y) gives a T.
template <class T, class Fetch>
class Sampler {
  public:
    Sampler(Pyramid const& pyramid, Fetch fetch) : pyramid_(pyramid), fetch_(fetch) {}

    T bilerp(int level, Vec2 st) const {
        Image const& image = pyramid_.level(level);
        float const x = st.x * static_cast<float>(image.width()) - 0.5f;
        float const y = st.y * static_cast<float>(image.height()) - 0.5f;
        int const xi = floor_to_int(x), yi = floor_to_int(y);
        float const dx = clamp(x - static_cast<float>(xi), 0.0f, 1.0f);
        float const dy = clamp(y - static_cast<float>(yi), 0.0f, 1.0f);
        return (1 - dx) * (1 - dy) * fetch_(level, xi, yi) + dx * (1 - dy) * fetch_(level, xi + 1, yi) +
               (1 - dx) * dy * fetch_(level, xi, yi + 1) + dx * dy * fetch_(level, xi + 1, yi + 1);
    }

    T lookup(Vec2 st, TextureFilter filter, Vec2 dst0, Vec2 dst1, float max_anisotropy) const {
        if (!std::isfinite(st.x + st.y)) st = Vec2(0);
        if (!std::isfinite(dst0.x + dst0.y + dst1.x + dst1.y)) dst0 = dst1 = Vec2(0);
        if (filter == TextureFilter::Ewa)
            return ewa(st, dst0, dst1, clamp(max_anisotropy, 1.0f, kMostAnisotropy));
        float const width =
            2.0f * std::max({std::abs(dst0.x), std::abs(dst0.y), std::abs(dst1.x), std::abs(dst1.y)});
        float const level = width_to_level(width, pyramid_.level(0));
        int const top = pyramid_.levels() - 1;
        if (level >= static_cast<float>(top)) return fetch_(top, 0, 0);
        int const base = std::max(0, floor_to_int(level));
        if (filter == TextureFilter::Point) {
            Image const& image = pyramid_.level(base);
            return fetch_(base, floor_to_int(st.x * static_cast<float>(image.width())),
                          floor_to_int(st.y * static_cast<float>(image.height())));
        }
        if (filter == TextureFilter::Bilinear || level <= 0.0f) return bilerp(base, st);
        float const t = level - static_cast<float>(base);
        return (1 - t) * bilerp(base, st) + t * bilerp(base + 1, st);
    }

  private:
    /// Elliptically weighted average (Greene & Heckbert 1986), between two levels chosen by the shorter axis.
    T ewa(Vec2 st, Vec2 dst0, Vec2 dst1, float max_anisotropy) const {
        auto norm = [](Vec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); };
        if (norm(dst0) < norm(dst1)) std::swap(dst0, dst1);
        float const longer = norm(dst0);
        float shorter = norm(dst1);
        if (shorter > 0.0f && shorter * max_anisotropy < longer) {
            float const scale = longer / (shorter * max_anisotropy);
            dst1 *= scale;
            shorter *= scale;
        }
        if (!(shorter > 0.0f) || !std::isfinite(shorter)) return bilerp(0, st);
        float const level = std::max(0.0f, width_to_level(shorter, pyramid_.level(0)));
        if (level >= static_cast<float>(pyramid_.levels() - 1)) return fetch_(pyramid_.levels() - 1, 0, 0);
        int const base = floor_to_int(level);
        float const t = level - static_cast<float>(base);
        return (1 - t) * ewa_at(base, st, dst0, dst1) + t * ewa_at(base + 1, st, dst0, dst1);
    }

    T ewa_at(int level, Vec2 st, Vec2 dst0, Vec2 dst1) const {
        Image const& image = pyramid_.level(level);
        Vec2 const size(static_cast<float>(image.width()), static_cast<float>(image.height()));
        Vec2 const center = st * size - 0.5f;
        dst0 *= size;
        dst1 *= size;
        // The ellipse A x^2 + B x y + C y^2 < 1; the +1 keeps it at least a texel wide.
        float a = sqr(dst0.y) + sqr(dst1.y) + 1.0f;
        float b = -2.0f * (dst0.x * dst0.y + dst1.x * dst1.y);
        float c = sqr(dst0.x) + sqr(dst1.x) + 1.0f;
        float const inv_f = 1.0f / (a * c - 0.25f * b * b);
        a *= inv_f;
        b *= inv_f;
        c *= inv_f;
        float const det = 4.0f * a * c - b * b;
        float const half_x = 2.0f * safe_sqrt(det * c) / det, half_y = 2.0f * safe_sqrt(det * a) / det;
        // The anisotropy limit bounds the ellipse to a few dozen texels; anything larger comes from broken numbers.
        if (!(half_x < 256.0f) || !(half_y < 256.0f)) return bilerp(level, st);
        int const x0 = floor_to_int(std::ceil(center.x - half_x)), x1 = floor_to_int(center.x + half_x);
        int const y0 = floor_to_int(std::ceil(center.y - half_y)), y1 = floor_to_int(center.y + half_y);
        T sum(0);
        float weights = 0.0f;
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                float const u = static_cast<float>(x) - center.x, v = static_cast<float>(y) - center.y;
                float const r2 = a * u * u + b * u * v + c * v * v;
                if (!(r2 < 1.0f)) continue;
                int const i = std::min(static_cast<int>(std::max(r2, 0.0f) * kFalloffSize), kFalloffSize - 1);
                float const weight = falloff[static_cast<std::size_t>(i)];
                sum += weight * fetch_(level, x, y);
                weights += weight;
            }
        return weights > 0.0f ? sum / weights : bilerp(level, st);
    }

    Pyramid const& pyramid_;
    Fetch fetch_;
};

template <class T, class Fetch>
Sampler<T, Fetch> make_sampler(Pyramid const& pyramid, Fetch fetch) {
    return {pyramid, fetch};
}

}  // namespace

bool wrap_texel(Wrap wrap, int width, int height, int& x, int& y) {
    if (x >= 0 && x < width && y >= 0 && y < height) return true;
    switch (wrap) {
        case Wrap::Repeat:
            x = modulo(x, width);
            y = modulo(y, height);
            return true;
        case Wrap::Black:
            return false;
        case Wrap::Clamp:
            break;
        case Wrap::OctahedralSphere:
            // Crossing an edge comes back through the same edge, mirrored about its middle. Texel -1 is texel 0's mirror.
            x = modulo(x, 2 * width);  // far coordinates: going twice across is going once around
            y = modulo(y, 2 * height);
            if (x >= width) {
                x = 2 * width - 1 - x;
                y = y < height ? height - 1 - y : 3 * height - 1 - y;
            }
            if (y >= height) {
                y = 2 * height - 1 - y;
                x = width - 1 - x;
            }
            return true;
    }
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return true;
}

float Pyramid::texel(int level, int x, int y, int c, Wrap wrap) const {
    Image const& image = levels_[static_cast<std::size_t>(level)];
    return wrap_texel(wrap, image.width(), image.height(), x, y) ? image.get(x, y, c) : 0.0f;
}

namespace {

auto fetch_rgb(Pyramid const& pyramid, int const* rgb, Wrap wrap) {
    return [&pyramid, rgb, wrap](int level, int x, int y) {
        Image const& image = pyramid.level(level);
        if (!wrap_texel(wrap, image.width(), image.height(), x, y)) return Vec3(0);
        if (rgb[0] == rgb[1]) return Vec3(image.get(x, y, rgb[0]));
        return Vec3(image.get(x, y, rgb[0]), image.get(x, y, rgb[1]), image.get(x, y, rgb[2]));
    };
}

}  // namespace

float Pyramid::bilerp(int level, Vec2 st, int c, Wrap wrap) const {
    return make_sampler<float>(*this, [&](int l, int x, int y) { return texel(l, x, y, c, wrap); })
        .bilerp(level, st);
}

Vec3 Pyramid::bilerp_rgb(int level, Vec2 st, Wrap wrap) const {
    return make_sampler<Vec3>(*this, fetch_rgb(*this, rgb_, wrap)).bilerp(level, st);
}

Vec3 Pyramid::lookup_rgb(Vec2 st, TextureFilter filter, Wrap wrap, Vec2 dst0, Vec2 dst1,
                         float max_anisotropy) const {
    return make_sampler<Vec3>(*this, fetch_rgb(*this, rgb_, wrap))
        .lookup(st, filter, dst0, dst1, max_anisotropy);
}

float Pyramid::lookup(Vec2 st, TextureFilter filter, Wrap wrap, Vec2 dst0, Vec2 dst1,
                      float max_anisotropy) const {
    if (scalar_ < 0) {
        Vec3 const rgb = lookup_rgb(st, filter, wrap, dst0, dst1, max_anisotropy);
        return (rgb.x + rgb.y + rgb.z) / 3.0f;
    }
    auto fetch = [&](int l, int x, int y) { return texel(l, x, y, scalar_, wrap); };
    return make_sampler<float>(*this, fetch).lookup(st, filter, dst0, dst1, max_anisotropy);
}

}  // namespace nephroid
