#include "spectrum/runtime.h"

#include "dense.h"
#include "spectrum/color.h"
#include "spectrum/uplift.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

void check(Vec3 rgb) {
    if (!is_finite(rgb)) refuse_spectrum("an rgb value is not a finite number");
    if (rgb.x < 0 || rgb.y < 0 || rgb.z < 0)
        refuse_spectrum("an rgb value is negative; it must be at least 0");
}

DenseTable sampled(Dense const& values) {
    DenseTable d;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = static_cast<float>(values[i]);
    return d;
}

/// Integral of table * weight * (x-bar, y-bar, z-bar), divided by `norm`, as linear sRGB.
Vec3 rgb_of(DenseTable const& table, Dense const* weight, double norm) {
    Observer const& o = cie_1931();
    double xyz[3] = {0, 0, 0};
    for (std::size_t i = 0; i < kDenseCount; ++i) {
        double const v = static_cast<double>(table[i]) * (weight ? (*weight)[i] : 1.0);
        xyz[0] += v * o.x[i], xyz[1] += v * o.y[i], xyz[2] += v * o.z[i];
    }
    return xyz_to_srgb({static_cast<float>(xyz[0] / norm), static_cast<float>(xyz[1] / norm),
                        static_cast<float>(xyz[2] / norm)});
}

Vec3 rgb_in_role(DenseTable const& table, SpectrumRole role) {
    // Colours beyond sRGB have negative components: those are cut off, as light and reflectance have none.
    if (role == SpectrumRole::Illuminant) return max(rgb_of(table, nullptr, 1), Vec3{0, 0, 0});
    static double const white = photometric(RgbIlluminantSpd{{1, 1, 1}});
    Vec3 const rgb = max(rgb_of(table, &illuminant_d65(), white), Vec3{0, 0, 0});
    return role == SpectrumRole::Albedo ? min(rgb, Vec3{1, 1, 1}) : rgb;
}

}  // namespace

bool RuntimeSpectrum::is_black() const { return !(max_value() > 0); }

float RuntimeSpectrum::at(float lambda) const {
    float const x = clamp(lambda - kLambdaMin, 0.0f, static_cast<float>(kDenseCount - 1));
    auto const i = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kDenseCount - 2));
    float const t = x - static_cast<float>(i);
    float const dense = table_ ? lerp(t, (*table_)[i], (*table_)[i + 1]) : 1.0f;
    float const sigmoid =
        kind_ == Kind::Sigmoid || kind_ == Kind::SigmoidTimesDense ? sigmoid_.at(lambda) : 1.0f;
    return scale_ * dense * sigmoid;
}

float RuntimeSpectrum::max_value() const {
    float m = max_component(rgb_);
    if (kind_ == Kind::Constant) return std::fmax(m, scale_);
    for (int i = 0; i < kDenseCount; ++i) m = std::fmax(m, at(kLambdaMin + static_cast<float>(i)));
    // A sigmoid's maximum may lie between two nm, at its parabola's vertex.
    if (kind_ == Kind::Sigmoid && sigmoid_.c0 < 0)
        m = std::fmax(m, at(clamp(-sigmoid_.c1 / (2 * sigmoid_.c0), kLambdaMin, kLambdaMax)));
    return m;
}

RuntimeSpectrum RuntimeSpectrum::scaled(float s) const {
    RuntimeSpectrum r = *this;
    r.scale_ *= s;
    r.rgb_ *= s;
    return r;
}

DenseTable const* SpectrumStore::keep(DenseTable const& t) {
    auto const it = std::find(tables_.begin(), tables_.end(), t);
    if (it != tables_.end()) return &*it;
    tables_.push_back(t);
    return &tables_.back();
}

RuntimeSpectrum SpectrumStore::compile(Spd const& spd, SpectrumRole role) {
    using Kind = RuntimeSpectrum::Kind;
    RuntimeSpectrum r;
    if (auto const* s = std::get_if<ConstantSpd>(&spd)) {
        if (!std::isfinite(s->value)) refuse_spectrum("a spectrum is not a finite number");
        r.kind_ = Kind::Constant;
        r.scale_ = s->value;
        if (role == SpectrumRole::Illuminant) {
            DenseTable ones;
            ones.fill(s->value);
            r.rgb_ = rgb_in_role(ones, role);
        } else {
            r.rgb_ = Vec3{role == SpectrumRole::Albedo ? clamp(s->value, 0, 1) : s->value};
        }
        return r;
    }
    if (auto const* s = std::get_if<RgbAlbedoSpd>(&spd)) {
        check(s->rgb);
        r.kind_ = Kind::Sigmoid;
        r.scale_ = 1;
        r.rgb_ = min(s->rgb, Vec3{1, 1, 1});
        r.sigmoid_ = srgb_to_sigmoid(s->rgb);
        return r;
    }
    auto const scaled_sigmoid = [&](Vec3 rgb) {
        check(rgb);
        // Twice the largest component keeps the sigmoid away from its ends (PBRT 4th ed., 4.6.6).
        float const m = 2 * max_component(rgb);
        r.scale_ = m;
        r.sigmoid_ = srgb_to_sigmoid(m > 0 ? rgb / m : Vec3{0, 0, 0});
        r.rgb_ = rgb;
    };
    if (auto const* s = std::get_if<RgbUnboundedSpd>(&spd)) {
        scaled_sigmoid(s->rgb);
        r.kind_ = Kind::Sigmoid;
        return r;
    }
    if (auto const* s = std::get_if<RgbIlluminantSpd>(&spd)) {
        scaled_sigmoid(s->rgb);
        r.kind_ = Kind::SigmoidTimesDense;
        DenseTable const white = sampled(illuminant(s->white));
        r.table_ = keep(white);
        // White light of D65 is (1, 1, 1) by definition, so its integral alone counts.
        static float const d65 = static_cast<float>(photometric(RgbIlluminantSpd{{1, 1, 1}}));
        r.rgb_ = s->rgb * (s->white == RgbWhite::D65 ? Vec3{d65} : rgb_in_role(white, role));
        return r;
    }
    r.kind_ = Kind::Dense;
    r.scale_ = 1;
    DenseTable const table = sampled(dense_values(spd));
    r.table_ = keep(table);
    r.rgb_ = rgb_in_role(table, role);
    return r;
}

}  // namespace nephroid
