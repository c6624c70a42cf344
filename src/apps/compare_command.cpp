#include "commands.h"
#include "image/compare.h"
#include "image/read.h"
#include "math/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nephroid::cli {

namespace {

/// The variance layer of a picture that nephroid wrote, if it has one.
std::optional<Image> variance_layer(std::string const& path) {
    if (path.size() < 4 || path.compare(path.size() - 4, 4, ".exr") != 0) return std::nullopt;
    ExrFile const file = read_exr(path);
    Image v(PixelFormat::Float, file.width, file.height, {"R", "G", "B"});
    char const* names[3] = {"variance.R", "variance.G", "variance.B"};
    for (int c = 0; c < 3; ++c) {
        ExrChannel const* channel = file.find(names[c]);
        if (!channel || channel->data.empty()) return std::nullopt;
        for (int y = 0; y < file.height; ++y)
            for (int x = 0; x < file.width; ++x)
                v.set(x, y, c,
                      channel->data[static_cast<std::size_t>(y) * static_cast<std::size_t>(file.width) +
                                    static_cast<std::size_t>(x)]);
    }
    return v;
}

}  // namespace

int run(CompareOptions const& o) {
    Image const a = read_image(o.a);
    Image const b = read_image(o.b);
    if (a.width() != b.width() || a.height() != b.height())
        throw Error(ErrorKind::Input,
                    fmt::format("{} is {}x{} and {} is {}x{}: only pictures of the same size compare", o.a,
                                a.width(), a.height(), o.b, b.width(), b.height()));
    nlohmann::json j;
    j["rmse"] = rmse(a, b);
    j["relmse"] = rel_mse(a, b);
    j["binned_relmse"] = rel_mse(binned(a, o.bins), binned(b, o.bins));
    j["bins"] = o.bins;
    j["flip"] = mean_flip(a, b);
    j["mean_a"] = channel_means(a);
    j["mean_b"] = channel_means(b);
    auto const va = variance_layer(o.a);
    auto const vb = variance_layer(o.b);
    if (va && vb) {
        WelchResult const w = welch_test({a, *va}, {b, *vb});
        j["welch"] = {
            {"tiles", w.tiles_x * w.tiles_y}, {"smallest_p", w.smallest}, {"corrected_p", w.corrected}};
    }
    if (o.json) {
        fmt::print("{}\n", j.dump(2));
        return kGood;
    }
    fmt::print("RMSE            {:.6g}\n", j["rmse"].get<double>());
    fmt::print("relMSE          {:.6g}   mean (a-b)^2 / (b^2 + 0.01), b = {}\n", j["relmse"].get<double>(),
               o.b);
    fmt::print("relMSE, binned  {:.6g}   after averaging {} x {} pixels\n", j["binned_relmse"].get<double>(),
               o.bins, o.bins);
    fmt::print("FLIP            {:.6g}\n", j["flip"].get<double>());
    auto const ma = channel_means(a);
    auto const mb = channel_means(b);
    for (std::size_t c = 0; c < std::min(ma.size(), mb.size()); ++c)
        fmt::print("mean {:<10} {:.6g} against {:.6g}  ({:+.3f}%)\n", a.channel_names()[c], ma[c], mb[c],
                   mb[c] != 0 ? 100 * (ma[c] / mb[c] - 1) : 0.0);
    if (va && vb)
        fmt::print("Welch           p = {:.4g} for the same mean everywhere (smallest of {} tiles {:.3g})\n",
                   j["welch"]["corrected_p"].get<double>(), j["welch"]["tiles"].get<int>(),
                   j["welch"]["smallest_p"].get<double>());
    return kGood;
}

}  // namespace nephroid::cli
