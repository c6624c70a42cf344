// Makes files of measured materials by the recipe of Dupuy & Jakob 2018, the gonio-photometer being a formula: a
// Trowbridge-Reitz metal whose reflectance grows with the wavelength. What is read back can be held against the formula.
#pragma once

#include "sampling/bilinear_warp.h"
#include "support.h"

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace nephroid::test {

/// A tensor file in the making; each field may be made a lie before it is written.
struct TensorMaker {
    struct Field {
        std::string name;
        std::uint8_t type = 1;
        std::vector<std::uint64_t> shape;
        std::string bytes;
    };
    std::vector<Field> fields;

    void add(std::string const& name, std::vector<std::uint64_t> const& shape, std::vector<float> const& x) {
        std::string bytes(x.size() * sizeof(float), '\0');
        if (!x.empty()) std::memcpy(bytes.data(), x.data(), bytes.size());
        fields.push_back({name, 10, shape, bytes});
    }
    void add(std::string const& name, std::string const& x) { fields.push_back({name, 1, {x.size()}, x}); }
    Field& operator[](std::string const& name) {
        for (Field& f : fields)
            if (f.name == name) return f;
        throw std::runtime_error("no field " + name);
    }
    void drop(std::string const& name) {
        std::erase_if(fields, [&](Field const& f) { return f.name == name; });
    }
    [[nodiscard]] std::string file() const {
        auto const little = [](std::uint64_t x, int bytes) {
            std::string s;
            for (int i = 0; i < bytes; ++i) s += static_cast<char>(x >> 8 * i & 255);
            return s;
        };
        std::size_t at = 12 + 2 + 4;
        for (Field const& f : fields) at += 2 + f.name.size() + 2 + 1 + 8 + 8 * f.shape.size();
        std::string head("tensor_file\0\1\0", 14), data;
        head += little(fields.size(), 4);
        for (Field const& f : fields) {
            head += little(f.name.size(), 2) + f.name + little(f.shape.size(), 2) + little(f.type, 1) +
                    little(at + data.size(), 8);
            for (std::uint64_t const n : f.shape) head += little(n, 8);
            data += f.bytes;
        }
        return head + data;
    }
};

/// The material that is measured.
struct MeasuredMetal {
    double ax = 0.3, ay = 0.3;

    [[nodiscard]] static double reflectance(double lambda) { return 0.2 + 0.6 * (lambda - 360) / 470; }
    [[nodiscard]] double d(Vec3 m) const {
        double const x = m.x / ax, y = m.y / ay, z = m.z;
        double const e = x * x + y * y + z * z;
        return 1 / (kPiD * ax * ay * e * e);
    }
    [[nodiscard]] double lambda(Vec3 w) const {
        double const x = w.x * ax, y = w.y * ay, z = w.z;
        return (std::sqrt(1 + (x * x + y * y) / (z * z)) - 1) / 2;
    }
    /// Projected area of the microfacets that are seen from w.
    [[nodiscard]] double sigma(Vec3 w) const { return (1 + lambda(w)) * static_cast<double>(w.z); }
    /// Without reflectance: D G / (4 cos cos), G height-correlated.
    [[nodiscard]] double f(Vec3 wo, Vec3 wi) const {
        Vec3 const m = normalize(wo + wi);
        return d(m) / (1 + lambda(wo) + lambda(wi)) /
               (4 * static_cast<double>(wo.z) * static_cast<double>(wi.z));
    }
};

struct MeasuredPlan {
    MeasuredMetal metal;
    std::vector<float> phi{0}, theta, wavelengths{360, 480, 600, 830};
    std::size_t normals = 64, samples = 24;  // nodes along each side of vndf and of spectra
    bool rgb = false;

    MeasuredPlan() {
        for (int i = 0; i < 16; ++i) theta.push_back(static_cast<float>(1.55 * i / 15));
    }
};

inline TensorMaker measure(MeasuredPlan const& plan) {
    std::size_t const n = plan.normals, m = plan.samples;
    auto const unit = [](std::size_t i, std::size_t count) {
        return static_cast<float>(static_cast<double>(i) / static_cast<double>(count - 1));
    };
    auto const normal = [&](Vec2 u) {
        return direction(static_cast<double>(u.x) * static_cast<double>(u.x) * kPiD / 2,
                         (2 * static_cast<double>(u.y) - 1) * kPiD);
    };
    std::vector<float> ndf, sigma, vndf, luminance, spectra;
    for (std::size_t y = 0; y < n; ++y)
        for (std::size_t x = 0; x < n; ++x) {
            Vec3 const w = normal({unit(x, n), unit(y, n)});
            ndf.push_back(static_cast<float>(plan.metal.d(w)));
            // At the horizon the limit: Lambda cos.
            sigma.push_back(static_cast<float>(plan.metal.sigma({w.x, w.y, std::max(w.z, 1e-4f)})));
        }
    for (float const phi : plan.phi)
        for (float const theta : plan.theta) {
            Vec3 const wo = direction(theta, phi);
            for (std::size_t y = 0; y < n; ++y)
                for (std::size_t x = 0; x < n; ++x) {
                    Vec2 const u{unit(x, n), unit(y, n)};
                    Vec3 const wm = normal(u);
                    vndf.push_back(static_cast<float>(plan.metal.d(wm) *
                                                      std::max(0.0, static_cast<double>(dot(wo, wm))) *
                                                      static_cast<double>(u.x) * std::hypot(wm.x, wm.y)));
                }
        }
    BilinearWarp const warp(vndf, n, n);
    std::vector<double> bands;
    for (float const l : plan.wavelengths) bands.push_back(plan.metal.reflectance(l));
    if (plan.rgb) bands = {0.8, 0.5, 0.2};
    std::size_t slice = 0;
    for (float const phi : plan.phi)
        for (float const theta : plan.theta) {
            Vec3 const wo = direction(theta, phi);
            std::vector<double> value;
            for (std::size_t y = 0; y < m; ++y)
                for (std::size_t x = 0; x < m; ++x) {
                    Vec2 const u = warp.sample(ParameterGrid::only(slice), {unit(x, m), unit(y, m)}).p;
                    Vec3 const wm = normal(u);
                    Vec3 const wi = 2.0f * dot(wo, wm) * wm - wo;
                    double v = 0;
                    if (wi.z > 1e-6f && dot(wo, wm) > 0)
                        v = plan.metal.f(wo, wi) * static_cast<double>(wi.z) * 4 * plan.metal.sigma(wo) /
                            plan.metal.d(wm);
                    value.push_back(v);
                    luminance.push_back(static_cast<float>(v));
                }
            for (double const band : bands)
                for (double const v : value) spectra.push_back(static_cast<float>(v * band));
            ++slice;
        }
    TensorMaker t;
    std::uint64_t const a = plan.phi.size(), b = plan.theta.size();
    t.add("description", "a formula");
    t.add("jacobian", std::string(1, '\1'));
    t.add("phi_i", {a}, plan.phi);
    t.add("theta_i", {b}, plan.theta);
    t.add("ndf", {n, n}, ndf);
    t.add("sigma", {n, n}, sigma);
    t.add("vndf", {a, b, n, n}, vndf);
    t.add("luminance", {a, b, m, m}, luminance);
    if (plan.rgb) {
        t.add("rgb", {a, b, 3, m, m}, spectra);
    } else {
        t.add("wavelengths", {plan.wavelengths.size()}, plan.wavelengths);
        t.add("spectra", {a, b, plan.wavelengths.size(), m, m}, spectra);
    }
    return t;
}

/// A file that goes when it is no longer wanted.
class MadeFile {
  public:
    explicit MadeFile(std::string const& bytes, std::string const& name = "made.bsdf")
        : path_(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "-" + name)) {
        std::ofstream(path_, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    ~MadeFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    MadeFile(MadeFile const&) = delete;
    MadeFile& operator=(MadeFile const&) = delete;
    [[nodiscard]] std::string path() const { return path_.string(); }

  private:
    std::filesystem::path path_;
};

}  // namespace nephroid::test
