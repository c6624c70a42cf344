// The tables of a measured material, and the mapping that they are made for (Dupuy & Jakob 2018, "An Adaptive Parameterization for
// Efficient Material Acquisition and Rendering"; files of https://rgl.epfl.ch/materials). All directions are above the surface.
//
// Reflection was measured from each incident direction wo on a grid (phi_i, theta_i) at the mirror directions of normals wm that
// lie where microfacets of the material's own distribution are seen from wo. In four steps:
//   wm = half vector of wo and wi
//   u_m = (sqrt(2 theta_m / pi), phi_m / 2 pi + 1/2), azimuths relative to phi_i where the material is isotropic
//   s   = the point of the unit square that the warp `vndf`, given wo, takes to u_m
//   f(wo, wi) |cos wi| = spectra(s; wo, lambda) D(u_m) / (4 sigma(u_o))   (without D / 4 sigma where not `jacobian`)
// `luminance` is the density, over the squares of s, by which s is drawn; D and sigma are the normals' density and projected area.
// wo is whichever direction a sample starts from: measured numbers are only nearly reciprocal (see bsdf_measured.cpp).
#pragma once

#include "math/frame.h"
#include "sampling/bilinear_warp.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace nephroid {

class TensorFile;

/// Numbers at the nodes of a grid over the unit square, bilinear between.
class SquareTable {
  public:
    SquareTable() = default;
    SquareTable(std::vector<float> nodes, std::size_t width, std::size_t height)
        : nodes_(std::move(nodes)), width_(width), height_(height) {}
    [[nodiscard]] float operator()(Vec2 p) const;
    [[nodiscard]] std::size_t bytes() const { return nodes_.size() * sizeof(float); }

  private:
    std::vector<float> nodes_;
    std::size_t width_ = 0, height_ = 0;
};

/// The four nodes about a point of the unit square, by number and weight.
struct SquareCell {
    std::array<std::size_t, 4> node;
    std::array<float, 4> weight;
};
SquareCell square_cell(Vec2 p, std::size_t width, std::size_t height);

class MeasuredTables {
  public:
    /// Throws Error(Io) if the file cannot be read, Error(Input) "path: what, and what to do" if it holds no measured material.
    explicit MeasuredTables(std::filesystem::path const& path);

    struct Value {
        Spectrum f;
        float pdf = 0;  // of wi, by solid angle
    };
    /// f and the density of sample(), each only where it is asked for.
    [[nodiscard]] Value evaluate(Vec3 wo, Vec3 wi, Wavelengths const& lambda, bool want_f,
                                 bool want_pdf) const;
    /// A direction wi above the surface, or nothing.
    [[nodiscard]] std::optional<Vec3> sample(Vec3 wo, Vec2 u) const;
    /// Directional albedo, from a table that was summed up when the file was read.
    [[nodiscard]] Spectrum albedo(Vec3 wo, Wavelengths const& lambda) const;
    [[nodiscard]] bool isotropic() const { return isotropic_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    /// What is looked up once for a direction.
    struct Incident {
        Vec3 w;     // turned to the part of the circle that the file covers
        Vec2 turn;  // by these signs of x and y
        float phi = 0;
        SliceMix mix;
        float sigma = 0;
    };
    [[nodiscard]] Incident incident(Vec3 wo) const;
    void read_angles(TensorFile const& file);
    void read_spectra(TensorFile const& file);
    void sum_up();
    [[nodiscard]] Spectrum spectrum(SliceMix const& mix, SquareCell const& cell,
                                    Wavelengths const& lambda) const;
    /// One number of each wavelength of a stack of rows of `channels_`, as lanes.
    template <class Visit>
    [[nodiscard]] Spectrum lanes(Visit const& rows, Wavelengths const& lambda) const;

    ParameterGrid grid_;  // phi_i, theta_i
    bool isotropic_ = false;
    bool jacobian_ = false;
    int symmetry_ = 1;  // the file covers 1 / symmetry_ of the circle of phi_i
    SquareTable ndf_, sigma_;
    BilinearWarp vndf_, luminance_;
    // By slice, node of the square (row by row), channel. Channels are wavelengths, or red, green and blue.
    std::size_t width_ = 0, height_ = 0, channels_ = 0;
    std::vector<float> wavelengths_;  // nm; empty: the file is of rgb
    std::vector<float> spectra_;
    std::vector<Spectrum> rgb_;  // the same as linear sRGB, without channels
    std::vector<float> albedo_;  // by slice, channel
    std::vector<Spectrum> albedo_rgb_;
};

}  // namespace nephroid
