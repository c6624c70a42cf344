// Four float lanes: the one colour type of transport. What the lanes mean is said by the Wavelengths that travel with the
// path: four wavelengths, or linear sRGB in lanes 0..2 (lane 3 then stays 0).
#pragma once

#include "math/vec.h"

#include <cmath>

namespace nephroid {

struct Spectrum {
    typedef float Lanes __attribute__((vector_size(16)));
    Lanes v{0, 0, 0, 0};

    constexpr Spectrum() = default;
    constexpr explicit Spectrum(float s) : v{s, s, s, s} {}
    constexpr Spectrum(float a, float b, float c, float d) : v{a, b, c, d} {}
    constexpr explicit Spectrum(Lanes lanes) : v(lanes) {}

    float operator[](int i) const { return v[i]; }
    void set(int i, float x) { v[i] = x; }

    Spectrum& operator+=(Spectrum b) { return v += b.v, *this; }
    Spectrum& operator*=(Spectrum b) { return v *= b.v, *this; }
    Spectrum& operator*=(float s) { return v *= Spectrum(s).v, *this; }
    Spectrum& operator/=(float s) { return v /= Spectrum(s).v, *this; }

    [[nodiscard]] bool is_black() const { return v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0; }
    [[nodiscard]] float max() const {
        return nephroid::max(nephroid::max(v[0], v[1]), nephroid::max(v[2], v[3]));
    }
    [[nodiscard]] float average() const { return (v[0] + v[1] + v[2] + v[3]) * 0.25f; }
    [[nodiscard]] bool is_finite() const {
        // x*0 is 0 for finite x and NaN for the others.
        Lanes const z = v * Spectrum(0.0f).v;
        return z[0] + z[1] + z[2] + z[3] == 0.0f;
    }
};

inline Spectrum operator+(Spectrum a, Spectrum b) { return Spectrum(a.v + b.v); }
inline Spectrum operator-(Spectrum a, Spectrum b) { return Spectrum(a.v - b.v); }
inline Spectrum operator*(Spectrum a, Spectrum b) { return Spectrum(a.v * b.v); }
inline Spectrum operator*(Spectrum a, float s) { return Spectrum(a.v * Spectrum(s).v); }
inline Spectrum operator*(float s, Spectrum a) { return a * s; }
inline Spectrum operator/(Spectrum a, Spectrum b) { return Spectrum(a.v / b.v); }
inline Spectrum operator/(Spectrum a, float s) { return Spectrum(a.v / Spectrum(s).v); }
inline Spectrum lerp(float t, Spectrum a, Spectrum b) { return a * (1.0f - t) + b * t; }
inline Spectrum clamp(Spectrum a, float lo, float hi) {
    Spectrum const least(lo), most(hi);
    return Spectrum(a.v < least.v ? least.v : (a.v > most.v ? most.v : a.v));
}
inline Spectrum sqrt(Spectrum a) {
    return {std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

}  // namespace nephroid
