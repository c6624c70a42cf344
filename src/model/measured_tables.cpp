#include "measured_tables.h"

#include "spectrum/uplift.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// Spherical coordinates to the unit square and back: theta by its root, for more nodes about the normal.
float theta_to_square(float theta) { return std::sqrt(theta * (2.0f * kInvPi)); }
float square_to_theta(float u) { return sqr(u) * kPiOver2; }
float phi_to_square(float phi) {
    float const u = phi * kInvTwoPi + 0.5f;
    return u - std::floor(u);
}
float square_to_phi(float u) { return (2.0f * u - 1.0f) * kPi; }
/// Not by acos, which loses half of the digits about the normal.
float theta_of(Vec3 w) { return std::atan2(std::sqrt(sqr(w.x) + sqr(w.y)), w.z); }
float phi_of(Vec3 w) { return std::atan2(w.y, w.x); }

/// d wi / d u_m: by theta = u^2 pi/2 and phi = 2 pi u, and by the mirror.
float jacobian(float u_theta, float sin_theta, float cos_mirror) {
    return 2.0f * sqr(kPi) * u_theta * sin_theta * 4.0f * cos_mirror;
}

Spectrum without_negative(Spectrum s) {
    for (int i = 0; i < 4; ++i) s.set(i, max(s[i], 0.0f));
    return s;
}

/// A colour of any brightness at the path's wavelengths.
Spectrum uplifted(Spectrum rgb, Wavelengths const& lambda) {
    // Twice the largest component keeps the sigmoid away from its ends (PBRT 4th ed., 4.6.6).
    float const m = 2.0f * rgb.max();
    if (!(m > 0.0f)) return {};
    return srgb_to_sigmoid(Vec3{rgb[0], rgb[1], rgb[2]} / m)(lambda) * m;
}

}  // namespace

SquareCell square_cell(Vec2 p, std::size_t width, std::size_t height) {
    auto const place = [](float x, std::size_t n, std::size_t& first) {
        float const at = min(max(x, 0.0f), 1.0f) * static_cast<float>(n - 1);
        first = std::min(static_cast<std::size_t>(at), n > 1 ? n - 2 : 0);
        return min(at - static_cast<float>(first), 1.0f);
    };
    std::size_t x = 0;
    std::size_t y = 0;
    float const tx = place(p.x, width, x);
    float const ty = place(p.y, height, y);
    std::size_t const right = width > 1 ? 1 : 0;
    std::size_t const up = height > 1 ? width : 0;
    std::size_t const i = y * width + x;
    return {{i, i + right, i + up, i + up + right},
            {(1 - tx) * (1 - ty), tx * (1 - ty), (1 - tx) * ty, tx * ty}};
}

float SquareTable::operator()(Vec2 p) const {
    SquareCell const c = square_cell(p, width_, height_);
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += c.weight[k] * nodes_[c.node[k]];
    return sum;
}

MeasuredTables::Incident MeasuredTables::incident(Vec3 wo) const {
    Incident in;
    in.turn = {1, 1};
    if (symmetry_ >= 2) {
        in.turn.y = wo.y > 0.0f ? -1.0f : 1.0f;
        in.turn.x = symmetry_ == 4 ? (wo.x > 0.0f ? -1.0f : 1.0f) : in.turn.y;
    }
    in.w = {wo.x * in.turn.x, wo.y * in.turn.y, wo.z};
    in.phi = phi_of(in.w);
    float const theta = theta_of(in.w);
    in.mix = grid_.mix(in.phi, theta);
    in.sigma = sigma_({theta_to_square(theta), phi_to_square(in.phi)});
    return in;
}

template <class Visit>
Spectrum MeasuredTables::lanes(Visit const& rows, Wavelengths const& lambda) const {
    std::array<std::size_t, 4> channel{};
    std::array<std::size_t, 4> next{};
    std::array<float, 4> t{};
    for (std::size_t i = 0; i < 4; ++i) {
        float const x = lambda.lambda(static_cast<int>(i));
        auto const above = static_cast<std::size_t>(
            std::upper_bound(wavelengths_.begin(), wavelengths_.end(), x) - wavelengths_.begin());
        channel[i] = above > 0 ? above - 1 : 0;
        next[i] = std::min(above, channels_ - 1);
        if (next[i] != channel[i])
            t[i] = (x - wavelengths_[channel[i]]) / (wavelengths_[next[i]] - wavelengths_[channel[i]]);
    }
    Spectrum sum;
    rows([&](float const* row, float weight) {
        Spectrum s;
        for (std::size_t i = 0; i < 4; ++i)
            s.set(static_cast<int>(i), lerp(t[i], row[channel[i]], row[next[i]]));
        sum += weight * s;
    });
    return sum;
}

Spectrum MeasuredTables::spectrum(SliceMix const& mix, SquareCell const& cell,
                                  Wavelengths const& lambda) const {
    std::size_t const nodes = width_ * height_;
    if (!lambda.is_rgb() && !wavelengths_.empty())
        return without_negative(lanes(
            [&](auto const& add) {
                for (std::size_t s = 0; s < static_cast<std::size_t>(mix.count); ++s)
                    for (std::size_t k = 0; k < 4; ++k)
                        add(&spectra_[(mix.slice[s] * nodes + cell.node[k]) * channels_],
                            mix.weight[s] * cell.weight[k]);
            },
            lambda));
    Spectrum rgb;
    for (std::size_t s = 0; s < static_cast<std::size_t>(mix.count); ++s)
        for (std::size_t k = 0; k < 4; ++k)
            rgb += mix.weight[s] * cell.weight[k] * rgb_[mix.slice[s] * nodes + cell.node[k]];
    rgb = without_negative(rgb);
    return lambda.is_rgb() ? rgb : uplifted(rgb, lambda);
}

MeasuredTables::Value MeasuredTables::evaluate(Vec3 wo, Vec3 wi, Wavelengths const& lambda, bool want_f,
                                               bool want_pdf) const {
    Value v;
    Incident const in = incident(wo);
    Vec3 const turned{wi.x * in.turn.x, wi.y * in.turn.y, wi.z};
    Vec3 const sum = in.w + turned;
    float const size = length(sum);
    if (!(size > 0.0f)) return v;
    Vec3 const wm = sum / size;
    Vec2 const u_m{theta_to_square(theta_of(wm)), phi_to_square(phi_of(wm) - (isotropic_ ? in.phi : 0.0f))};
    auto const [s, density] = vndf_.invert(in.mix, u_m);
    if (want_pdf) {
        float const stretch = jacobian(u_m.x, std::sqrt(sqr(wm.x) + sqr(wm.y)), min(0.5f * size, 1.0f));
        if (stretch > 0.0f) v.pdf = density * luminance_.pdf(in.mix, s) / stretch;
        if (!std::isfinite(v.pdf)) v.pdf = 0;
    }
    if (want_f) {
        float scale = 1.0f / wi.z;
        if (jacobian_) scale = in.sigma > 0.0f ? scale * max(ndf_(u_m), 0.0f) / (4.0f * in.sigma) : 0.0f;
        v.f = spectrum(in.mix, square_cell(s, width_, height_), lambda) * scale;
        if (!v.f.is_finite()) v.f = {};
    }
    return v;
}

std::optional<Vec3> MeasuredTables::sample(Vec3 wo, Vec2 u) const {
    Incident const in = incident(wo);
    Vec2 const u_m = vndf_.sample(in.mix, luminance_.sample(in.mix, u).p).p;
    float const theta = square_to_theta(u_m.x);
    float const phi = square_to_phi(u_m.y) + (isotropic_ ? in.phi : 0.0f);
    Vec3 const wm = spherical_direction(std::sin(theta), std::cos(theta), phi);
    Vec3 const wi = normalize(2.0f * dot(in.w, wm) * wm - in.w);
    if (!(wi.z > 0.0f)) return std::nullopt;
    return Vec3{wi.x * in.turn.x, wi.y * in.turn.y, wi.z};
}

// The integral of f |cos| over s by the midpoints of the cells of `spectra`, for each node of theta_i and phi_i.
void MeasuredTables::sum_up() {
    std::size_t const nodes = width_ * height_;
    albedo_.assign(grid_.slices() * channels_, 0);
    albedo_rgb_.assign(grid_.slices(), {});
    std::vector<double> sum(channels_);
    for (std::size_t slice = 0; slice < grid_.slices(); ++slice) {
        float const theta_o = grid_.b()[slice % grid_.b().size()];
        float const phi_o = grid_.a()[slice / grid_.b().size()];
        Vec3 const wo = spherical_direction(std::sin(theta_o), std::cos(theta_o), phi_o);
        SliceMix const mix = ParameterGrid::only(slice);
        float const sigma = sigma_({theta_to_square(theta_o), phi_to_square(phi_o)});
        std::fill(sum.begin(), sum.end(), 0.0);
        Spectrum rgb;
        for (std::size_t y = 0; y + 1 < height_; ++y)
            for (std::size_t x = 0; x + 1 < width_; ++x) {
                Vec2 const s{(static_cast<float>(x) + 0.5f) / static_cast<float>(width_ - 1),
                             (static_cast<float>(y) + 0.5f) / static_cast<float>(height_ - 1)};
                auto const [u_m, density] = vndf_.sample(mix, s);
                float const theta = square_to_theta(u_m.x);
                float const phi = square_to_phi(u_m.y) + (isotropic_ ? phi_o : 0.0f);
                Vec3 const wm = spherical_direction(std::sin(theta), std::cos(theta), phi);
                float const k_dot_m = dot(wo, wm);
                if (!(k_dot_m > 0.0f && 2.0f * k_dot_m * wm.z - wo.z > 0.0f)) continue;
                float const facing = jacobian_ ? max(ndf_(u_m), 0.0f) / (4.0f * sigma) : 1.0f;
                float const weight = 0.25f * facing * jacobian(u_m.x, std::sin(theta), k_dot_m) /
                                     (density * static_cast<float>((width_ - 1) * (height_ - 1)));
                if (!std::isfinite(weight)) continue;
                std::size_t const corner = slice * nodes + y * width_ + x;
                for (std::size_t const node : {corner, corner + 1, corner + width_, corner + width_ + 1}) {
                    float const* const row = &spectra_[node * channels_];
                    for (std::size_t c = 0; c < channels_; ++c)
                        sum[c] += static_cast<double>(weight) * static_cast<double>(row[c]);
                    rgb += weight * rgb_[node];
                }
            }
        // Brought into [0, 1], whatever the file says: beyond the floats there would be no mixing.
        for (std::size_t c = 0; c < channels_; ++c)
            albedo_[slice * channels_ + c] = static_cast<float>(std::clamp(sum[c], 0.0, 1.0));
        for (int i = 0; i < 3; ++i) albedo_rgb_[slice].set(i, max(min(rgb[i], 1.0f), 0.0f));
    }
}

Spectrum MeasuredTables::albedo(Vec3 wo, Wavelengths const& lambda) const {
    SliceMix const mix = incident(wo).mix;
    if (!lambda.is_rgb() && !wavelengths_.empty())
        return lanes(
            [&](auto const& add) {
                for (std::size_t s = 0; s < static_cast<std::size_t>(mix.count); ++s)
                    add(&albedo_[mix.slice[s] * channels_], mix.weight[s]);
            },
            lambda);
    Spectrum rgb;
    for (std::size_t s = 0; s < static_cast<std::size_t>(mix.count); ++s)
        rgb += mix.weight[s] * albedo_rgb_[mix.slice[s]];
    return lambda.is_rgb() ? rgb : uplifted(rgb, lambda);
}

std::size_t MeasuredTables::bytes() const {
    return ndf_.bytes() + sigma_.bytes() + vndf_.bytes() + luminance_.bytes() +
           (spectra_.size() + albedo_.size() + wavelengths_.size()) * sizeof(float) +
           (rgb_.size() + albedo_rgb_.size()) * sizeof(Spectrum);
}

}  // namespace nephroid
