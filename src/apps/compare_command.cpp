#include "commands.h"
#include "console.h"
#include "film/develop.h"
#include "image/compare.h"
#include "image/read.h"
#include "math/error.h"
#include "statistics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace nephroid::cli {

namespace {

/// What there is to compare of a file.
struct Picture {
    Image mean;
    std::optional<Image> variance;  // of the mean
    int samples = 0;                // 0: not known
    std::array<int, 2> corner{};    // of an EXR file's data window: where its pixels lie
    bool placed = false;            // it has one
};

std::optional<Image> variance_layer(ExrFile const& header, std::string const& path) {
    std::string const names[3] = {"variance.R", "variance.G", "variance.B"};
    for (std::string const& name : names)
        if (!header.find(name)) return std::nullopt;
    Image v(PixelFormat::Float, header.width, header.height, {"R", "G", "B"});
    read_exr(path, [&](ExrFile const& now) {
        if (now.width != header.width || now.height != header.height)
            throw Error(ErrorKind::Input, path + ": was changed while it was read");
        std::vector<ExrTargetPlane> planes;
        for (std::size_t c = 0; c < 3; ++c)
            planes.push_back(
                {names[c], ExrChannel::Type::Float, reinterpret_cast<std::byte*>(&v.floats()[c]), 12});
        return planes;
    });
    return v;
}

/// A picture of any kind; with its variance when it is an EXR file of ours, or a film.
Picture read_picture(std::string const& path) {
    ExrFile header;
    try {
        header = read_exr_header(path);
    } catch (Error const& e) {
        if (e.kind() == ErrorKind::Io) throw;
        Picture plain;  // another format, or an error that read_image() names
        plain.mean = read_image(path);
        return plain;
    }
    Picture p;
    p.placed = true;
    p.corner = {header.data_x0, header.data_y0};
    if (header.attributes.contains("nephroid.film")) {
        Film const film = read_film(path);
        p.mean = develop(film);
        p.variance = develop_variance(film);
    } else {
        p.mean = read_image(path);
        p.variance = variance_layer(header, path);
    }
    auto const passes = header.attributes.find("nephroid.passes");
    if (passes != header.attributes.end()) try {
            std::uint64_t const n = PassSet::parse(passes->second).count();
            p.samples = static_cast<int>(std::min<std::uint64_t>(n, std::numeric_limits<int>::max()));
        } catch (Error const&) {
            // Then nobody knows.
        }
    return p;
}

std::size_t not_finite(Image const& image) {
    std::size_t count = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            bool finite = true;
            for (int c = 0; c < image.channels(); ++c) finite = finite && std::isfinite(image.get(x, y, c));
            count += finite ? 0 : 1;
        }
    return count;
}

void require_same_window(CompareOptions const& o, Picture const& a, Picture const& b) {
    if (a.mean.width() != b.mean.width() || a.mean.height() != b.mean.height())
        throw Error(ErrorKind::Input,
                    fmt::format("{} is {}x{} and {} is {}x{}: only pictures of the same size compare", o.a,
                                a.mean.width(), a.mean.height(), o.b, b.mean.width(), b.mean.height()));
    if (a.placed && b.placed && a.corner != b.corner)
        throw Error(
            ErrorKind::Input,
            fmt::format("{} begins at pixel ({}, {}) and {} at ({}, {}): they show different parts of a "
                        "picture; compare the same --crop",
                        o.a, a.corner[0], a.corner[1], o.b, b.corner[0], b.corner[1]));
}

}  // namespace

int run(CompareOptions const& o) {
    Picture const pa = read_picture(o.a);
    Picture const pb = read_picture(o.b);
    require_same_window(o, pa, pb);
    Image const &a = pa.mean, &b = pb.mean;
    nlohmann::json j;
    j["rmse"] = rmse(a, b);
    j["relmse"] = rel_mse(a, b);
    j["binned_relmse"] = rel_mse(binned(a, o.bins), binned(b, o.bins));
    j["bins"] = o.bins;
    j["flip"] = mean_flip(a, b);
    j["mean_a"] = channel_means(a);
    j["mean_b"] = channel_means(b);
    std::size_t const bad_a = not_finite(a), bad_b = not_finite(b);
    j["not_finite_a"] = bad_a;
    j["not_finite_b"] = bad_b;
    bool const tested = pa.variance && pb.variance && a.channels() == 3 && b.channels() == 3;
    if (tested) {
        WelchResult const w = welch_test({a, *pa.variance, pa.samples}, {b, *pb.variance, pb.samples});
        j["welch"] = {
            {"tiles", w.tiles_x * w.tiles_y}, {"smallest_p", w.smallest}, {"corrected_p", w.corrected}};
    }
    if (o.json) {
        print("{}\n", json_text(j, 2));
        return kGood;
    }
    for (auto const& [path, bad] : {std::pair(o.a, bad_a), std::pair(o.b, bad_b)})
        if (bad > 0)
            print("NOT FINITE      {} pixel{} of {}: the measures below count them, and say nothing\n", bad,
                  bad == 1 ? "" : "s", path);
    print("RMSE            {:.6g}\n", j["rmse"].get<double>());
    print("relMSE          {:.6g}   mean (a-b)^2 / (b^2 + 0.01), b = {}\n", j["relmse"].get<double>(), o.b);
    print("relMSE, binned  {:.6g}   after averaging {} x {} pixels\n", j["binned_relmse"].get<double>(),
          o.bins, o.bins);
    print("FLIP            {:.6g}\n", j["flip"].get<double>());
    auto const ma = channel_means(a);
    auto const mb = channel_means(b);
    for (std::size_t c = 0; c < std::min(ma.size(), mb.size()); ++c)
        print("mean {:<10} {:.6g} against {:.6g}  ({:+.3f}%)\n", a.channel_names()[c], ma[c], mb[c],
              mb[c] != 0 ? 100 * (ma[c] / mb[c] - 1) : 0.0);
    if (tested)
        print("Welch           p = {:.4g} for the same mean everywhere (smallest of {} tiles {:.3g})\n",
              j["welch"]["corrected_p"].get<double>(), j["welch"]["tiles"].get<int>(),
              j["welch"]["smallest_p"].get<double>());
    return kGood;
}

}  // namespace nephroid::cli
