// Reading a measured material: the file's fields held against each other, and brought into the order that looking up wants.
#include "image/tensor.h"
#include "measured_tables.h"
#include "spectrum/albedo_weights.h"

#include <cmath>
#include <string>

namespace nephroid {

namespace {

using Field = TensorFile::Field;

std::string extents(std::vector<std::size_t> const& shape) {
    std::string s;
    for (std::size_t const n : shape) s += (s.empty() ? "" : " x ") + std::to_string(n);
    return s;
}

/// A list of numbers that ascends strictly.
std::vector<float> ascending(TensorFile const& file, char const* name) {
    std::vector<float> r = file.floats(file.field(name, TensorFile::Type::Float32, 1));
    bool rises = !r.empty();
    for (std::size_t i = 1; i < r.size(); ++i) rises = rises && r[i] > r[i - 1];
    if (!rises)
        file.fail("the field \"" + std::string(name) +
                  "\" must hold numbers, each larger than the one before; get a complete copy");
    return r;
}

/// A field whose first extents are given and whose last two are a grid of `least` x `least` nodes or more.
Field const& grid_field(TensorFile const& file, char const* name, std::vector<std::size_t> const& first,
                        std::size_t least) {
    Field const& f = file.field(name, TensorFile::Type::Float32, first.size() + 2);
    bool fits = f.shape[first.size()] >= least && f.shape[first.size() + 1] >= least;
    for (std::size_t i = 0; i < first.size(); ++i) fits = fits && f.shape[i] == first[i];
    if (!fits)
        file.fail("the field \"" + std::string(name) + "\" has " + extents(f.shape) + " numbers where " +
                  (first.empty() ? "" : extents(first) + " x ") + "a grid of at least " +
                  std::to_string(least) + " x " + std::to_string(least) + " is wanted; get a complete copy");
    return f;
}

SquareTable square_table(TensorFile const& file, char const* name) {
    Field const& f = grid_field(file, name, {}, 1);
    return {file.floats(f), f.shape[1], f.shape[0]};
}

BilinearWarp square_warp(TensorFile const& file, char const* name, std::vector<std::size_t> const& slices) {
    Field const& f = grid_field(file, name, slices, 2);
    return {file.floats(f), f.shape[3], f.shape[2]};
}

}  // namespace

MeasuredTables::MeasuredTables(std::filesystem::path const& path) {
    TensorFile const file(path);
    read_angles(file);
    Field const& jacobian = file.field("jacobian", TensorFile::Type::UInt8, 1);
    if (jacobian.count != 1) file.fail("the field \"jacobian\" must be one byte; get a complete copy");
    jacobian_ = file.byte(jacobian, 0) != 0;
    ndf_ = square_table(file, "ndf");
    sigma_ = square_table(file, "sigma");
    std::vector<std::size_t> const slices{grid_.a().size(), grid_.b().size()};
    vndf_ = square_warp(file, "vndf", slices);
    luminance_ = square_warp(file, "luminance", slices);
    read_spectra(file);
    sum_up();
}

void MeasuredTables::read_angles(TensorFile const& file) {
    std::vector<float> const theta = ascending(file, "theta_i");
    std::vector<float> const phi = ascending(file, "phi_i");
    // Room for rounding at the horizon.
    if (theta.front() < 0.0f || theta.back() > kPiOver2 + 1e-5f)
        file.fail("the field \"theta_i\" must be angles from 0 to pi/2, in radians; get a complete copy");
    isotropic_ = phi.size() <= 2;
    if (!isotropic_) {
        float const range = phi.back() - phi.front();
        symmetry_ = static_cast<int>(std::lround(clamp(kTwoPi / range, 0.0f, 100.0f)));
        // Half of the circle stands for a material that looks alike after half a turn, a quarter for a mirrored one.
        bool const known = symmetry_ == 1 || symmetry_ == 2 || symmetry_ == 4;
        if (!known || std::abs(phi.front() + kPi) > 0.01f ||
            std::abs(range * static_cast<float>(symmetry_) - kTwoPi) > 0.01f)
            file.fail("the field \"phi_i\" goes from " + std::to_string(phi.front()) + " to " +
                      std::to_string(phi.back()) +
                      "; -pi to pi, to 0 or to -pi/2 can be used: measure or resample it so");
    }
    grid_ = ParameterGrid(phi, theta);
}

void MeasuredTables::read_spectra(TensorFile const& file) {
    std::vector<std::size_t> first{grid_.a().size(), grid_.b().size(), 3};
    bool const spectral = file.has("spectra");
    if (spectral) {
        wavelengths_ = ascending(file, "wavelengths");
        if (!(wavelengths_.front() > 0.0f))
            file.fail("the field \"wavelengths\" must be above 0, in nm; get a complete copy");
        first[2] = wavelengths_.size();
    } else if (!file.has("rgb")) {
        file.fail("has neither a field \"spectra\" nor \"rgb\"; name a .bsdf file of the RGL database");
    }
    Field const& f = grid_field(file, spectral ? "spectra" : "rgb", first, 2);
    std::vector<float> const as_read = file.floats(f);
    channels_ = first[2];
    height_ = f.shape[3];
    width_ = f.shape[4];
    // The channels of a node side by side: a look-up wants all that it needs of a node at once. Noise about 0 is left in, so
    // that interpolation can take it out; what is negative then is 0.
    std::size_t const nodes = width_ * height_;
    spectra_.resize(as_read.size());
    for (std::size_t s = 0; s < grid_.slices(); ++s)
        for (std::size_t c = 0; c < channels_; ++c)
            for (std::size_t i = 0; i < nodes; ++i)
                spectra_[(s * nodes + i) * channels_ + c] = as_read[(s * channels_ + c) * nodes + i];
    std::vector<Vec3> const weights =
        spectral ? albedo_to_srgb_weights(wavelengths_) : std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    rgb_.resize(grid_.slices() * nodes);
    for (std::size_t i = 0; i < rgb_.size(); ++i) {
        Vec3 sum{0, 0, 0};
        for (std::size_t c = 0; c < channels_; ++c) sum += spectra_[i * channels_ + c] * weights[c];
        rgb_[i] = Spectrum(sum.x, sum.y, sum.z, 0);
    }
}

}  // namespace nephroid
