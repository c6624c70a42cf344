// From sums to pictures.
#pragma once

#include "film/film.h"
#include "image/image.h"
#include "image/write.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nephroid {

struct DevelopSettings {
    bool half_float = true;
    float exposure = 0;                           // stops, for 8-bit pictures only
    bool in_a_hurry = false;                      // EXR files may be larger if they are written sooner
    std::map<std::string, std::string> metadata;  // into the header of EXR files
    /// Drawn over the beauty of pictures, never of films: RGBA of the crop window's size, R G B times A, as bright as after exposure.
    Image const* over = nullptr;
};

/// Beauty, linear sRGB, 3 channels float: sum / weight; 0 where there is no weight. Covers the crop window.
Image develop(Film const& film);
/// Estimated variance of each pixel's mean (3 channels), of the samples as if they were independent. Well-spread samples
/// (Sobol', stratified) converge faster than that: for them it is an overestimate, and batches of passes with different
/// seeds are the way to know more. A lone sample counts as if the true mean were 0.
Image develop_variance(Film const& film);
/// Every layer as EXR channels, named as pbrt-v4 and Mitsuba 3 name theirs: R G B; variance.R .G .B; and with AOVs
/// albedo.R .G .B, N.X .Y .Z (geometric normal), Ns.X .Y .Z (shading normal), P.X .Y .Z (world position), Z (depth along
/// the ray), material.id (uint, 0xFFFFFFFF = nothing hit); the light by its ways, direct caustic indirect specular, each
/// .R .G .B (together they are R G B); where photons were asked, radius (scene units) and photons of the estimates.
/// Variances, positions, depths, radii and counts are floats, for they leave the range of halves; the rest is half or float
/// as the settings say, and float where a number is too large for a half.
/// The header tells which passes of which render they are.
ExrFile develop_exr(Film const& film, DevelopSettings const& settings);
/// Writes by extension: .exr, .png, .jpg/.jpeg, .pfm, .hdr; anything else is Error(Input). Returns the first channels of
/// those layers of an EXR file that were wanted as halves and had to become floats.
std::vector<std::string> write_picture(std::filesystem::path const& path, Film const& film,
                                       DevelopSettings const& settings);

/// The film itself as an EXR file: the beauty as plain R G B for any viewer, and the exact bits of every sum as pairs of
/// uint channels; identity, pass set and a checksum in the header. Run-length encoded, for a signal does not wait long.
void write_film(std::filesystem::path const& path, Film const& film, DevelopSettings const& settings);
/// Throws Error(Input) when the file is no film, is damaged (checksum) or of an unknown version.
Film read_film(std::filesystem::path const& path);
/// The same without the sums, and without a look at the checksum.
FilmHeader read_film_header(std::filesystem::path const& path);
/// Does the file say that it is a film, damaged or not?
bool is_film(std::filesystem::path const& path);

}  // namespace nephroid
