#include "photon_overlay.h"

#include "canvas.h"

#include <algorithm>

namespace nephroid::cli {

namespace {

constexpr Vec3 kPathColor{1, 1, 1}, kNormalColor{0.05f, 0.9f, 0.1f};
constexpr int kPathsBeside = 20, kNormalsBeside = 200;  // of photons, where only they are asked for
constexpr float kNormalPixels = 12;                     // long

/// The first photons of each map, as many from one as from another.
struct Shown {
    PhotonRecord photon;
    Vec3 power;
};
std::vector<Shown> first_photons(RenderJob const& job, std::uint64_t pass, ShotKind kind, std::size_t count) {
    std::vector<Shown> shown;
    Wavelengths const lambda = job.pass_wavelengths(pass);
    std::uint64_t const paths = paths_of_pass(job, kind);
    for (std::uint64_t i = 0; i < paths && shown.size() < count; ++i)
        for (PhotonRecord const& photon : trace_light_path(job, kind, pass, i, paths).photons)
            if (shown.size() < count) shown.push_back({photon, power_rgb(photon, lambda)});
    return shown;
}

PhotonColors colors_of(std::vector<Shown> const& photons) {
    std::vector<float> most;
    most.reserve(photons.size());
    for (Shown const& s : photons) most.push_back(max_component(s.power));
    return PhotonColors(median_of(std::move(most)));
}

}  // namespace

bool draws(OverlayOptions const& o) { return o.photons > 0 || o.paths > 0 || o.normals > 0; }

Image draw_photons(RenderJob const& job, std::uint64_t pass, OverlayOptions const& o) {
    Canvas canvas(job, o.hidden);
    auto const maps = shots_of(shown_map(o.map));
    auto const share = [&](int asked, int otherwise) {
        int const n = asked >= 0 ? asked : o.photons > 0 ? otherwise : 0;
        return (static_cast<std::size_t>(n) + maps.size() - 1) / maps.size();
    };
    std::size_t const photons = share(o.photons, 0), paths = share(o.paths, kPathsBeside),
                      normals = share(o.normals, kNormalsBeside);
    std::vector<Shown> shown;
    for (ShotKind const kind : maps) {
        auto const some = first_photons(job, pass, kind, std::max(photons, normals));
        PhotonColors const colors = colors_of(some);
        for (std::size_t i = 0; i < std::min(photons, some.size()); ++i)
            canvas.point(some[i].photon.p, colors(some[i].power));
        for (std::size_t i = 0; i < std::min(normals, some.size()); ++i) shown.push_back(some[i]);
    }
    for (Shown const& s : shown)
        canvas.line(s.photon.p,
                    s.photon.p + s.photon.n * (kNormalPixels * canvas.dot() * canvas.pixel_at(s.photon.p)),
                    kNormalColor);
    for (ShotKind const kind : maps) {
        std::uint64_t const all = paths_of_pass(job, kind);
        for (std::uint64_t i = 0; i < std::min<std::uint64_t>(paths, all); ++i) {
            TracedPath const path = trace_light_path(job, kind, pass, i, all);
            for (std::size_t k = 1; k < path.vertices.size(); ++k)
                canvas.line(path.vertices[k - 1], path.vertices[k], kPathColor);
        }
    }
    return canvas.take();
}

}  // namespace nephroid::cli
