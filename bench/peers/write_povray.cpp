// POV-Ray 3.7: meshes as mesh2, emitters as area lights beside surfaces that glow, matt surfaces lit by radiosity, glass and mirrors
// by photons. It is no path tracer, and its picture converges to something of its own.
#include "peer_scene.h"
#include "text_file.h"

#include "image/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::peers {

namespace {

std::string v(Vec3 a) { return fmt::format("<{},{},{}>", a.x, a.y, a.z); }

/// `lit`: an emitter that is a light as well, which radiosity must not find again.
std::string texture(PeerScene const& peer, PeerSurface const& s, Vec3 emission, bool lit,
                    std::vector<std::filesystem::path> const& pictures) {
    if (emission != Vec3{0})
        return fmt::format(
            "texture{{pigment{{rgb {}}} finish{{ambient 0 diffuse 0 emission 1}}}} no_shadow{}", v(emission),
            lit ? " no_radiosity" : "");
    if (s.kind == PeerSurface::Kind::Glass)
        return fmt::format(
            "texture{{pigment{{rgbt 1}} finish{{ambient 0 diffuse 0 specular 0 reflection{{0,1 fresnel on}} "
            "conserve_energy}}}} interior{{ior {}}} photons{{target refraction on reflection on collect "
            "off}}",
            s.index);
    if (s.kind == PeerSurface::Kind::Mirror)
        return fmt::format(
            "texture{{pigment{{rgb 0}} finish{{ambient 0 diffuse 0 specular 0 reflection{{rgb {}}}}}}} "
            "photons{{target reflection on collect off}}",
            v(s.rgb));
    std::string pigment = fmt::format("rgb {}", v(s.rgb));
    if (s.picture >= 0) {
        auto const i = static_cast<std::size_t>(s.picture);
        pigment =
            fmt::format("uv_mapping image_map{{png \"{}\" gamma srgb {}}}", pictures[i].filename().string(),
                        peer.pictures[i].nearest ? "" : "interpolate 2");
    }
    return fmt::format("texture{{pigment{{{}}} finish{{ambient 0 diffuse 1 emission 0}}}}", pigment);
}

template <class T, class F>
std::string list(char const* name, std::vector<T> const& values, F&& text) {
    if (values.empty()) return "";
    std::string t = fmt::format("{}{{{}", name, values.size());
    for (T const& x : values) t += "," + text(x);
    return t + "}\n";
}
std::string mesh(TriangleMesh const& m) {
    return "mesh2{\n" + list("vertex_vectors", m.p, v) + list("normal_vectors", m.n, v) +
           list("uv_vectors", m.uv, [](Vec2 a) { return fmt::format("<{},{}>", a.x, a.y); }) +
           list("face_indices", m.triangles,
                [](Vec3i t) { return fmt::format("<{},{},{}>", t.x, t.y, t.z); });
}

/// Lights of POV-Ray lose their strength as 2 / (1 + (d / fade_distance)^fade_power): the square of the distance only from far beyond
/// fade_distance on. So that is tiny here, a share of the light's own size; but not 0, which its photons take for no loss at all.
constexpr float kFade = 1e-3f;

/// An area light to the side of the normal `n`: it goes down with the cosine to that (tightness 1; radius 90 keeps off the
/// spline that is multiplied in between radius and falloff), and with the square of the distance. Its diffuse reflection leaves out
/// 1 / pi, so radiance x area / pi is what it has to be at distance 1, where the fading above makes 2 fade_distance^2 of it.
std::string light(FlatLight const& f, Vec3 emission, Vec3 n, double quality, std::size_t lights) {
    float const area = length(cross(f.u, f.v)) * (f.disk ? kPi : 4.0f);
    float const size = std::max(length(f.u), length(f.v)), fade = kFade * size;
    Vec3 const from = f.centre + 1e-3f * size * n;
    int const grid = lights > 16 ? 2 : std::max(2, static_cast<int>(std::lround(8 * std::sqrt(quality))));
    return fmt::format(
        "light_source{{{} rgb {} area_light {},{},{},{} {} jitter adaptive 2 area_illumination on "
        "fade_distance {} fade_power 2 spotlight point_at {} radius 90 falloff 90 tightness 1 "
        "photons{{refraction on reflection on area_light}}}}\n",
        v(from), v(emission * (area * kInvTwoPi / sqr(fade))), v(2.0f * f.u), v(2.0f * f.v), grid, grid,
        f.disk ? "circular" : "", fade, v(from + size * n));
}

}  // namespace

std::filesystem::path write_povray(PeerScene const& peer, std::filesystem::path const& folder,
                                   double quality) {
    auto const pictures = write_pictures(peer, folder);
    auto const special = [&](int s) {
        return peer.surfaces[static_cast<std::size_t>(s)].kind != PeerSurface::Kind::Diffuse;
    };
    bool const photons =
        std::any_of(peer.meshes.begin(), peer.meshes.end(),
                    [&](auto const& m) { return special(m.surface); }) ||
        std::any_of(peer.balls.begin(), peer.balls.end(), [&](auto const& b) { return special(b.surface); });
    auto const lights = static_cast<std::size_t>(std::count_if(
        peer.meshes.begin(), peer.meshes.end(), [](auto const& m) { return m.emission != Vec3{0}; }));
    std::string t = fmt::format(
        "#version 3.7;\nglobal_settings{{assumed_gamma 1 max_trace_level {} radiosity{{pretrace_start 0.08 "
        "pretrace_end {} count {} "
        "nearest_count 10 error_bound {} recursion_limit {} brightness 1 low_error_factor 0.5 gray_threshold "
        "0 minimum_reuse 0.005 "
        "always_sample off}}{}}}\n",
        peer.depth + 2, 0.01 / std::sqrt(quality), std::min(1600, static_cast<int>(200 * quality)),
        0.3 / std::sqrt(quality), std::min(4, std::max(1, peer.depth - 1)),
        photons ? fmt::format(" photons{{count {} max_trace_level {}}}", static_cast<int>(200000 * quality),
                              peer.depth)
                : "");
    PeerCamera const& c = peer.camera;
    float const aspect = static_cast<float>(peer.resolution.x) / static_cast<float>(peer.resolution.y);
    float const reach = 0.5f / std::tan(c.fov / 2);  // of a shorter side of 1
    t += fmt::format("camera{{location {} direction {} right {} up {}}}\n", v(c.eye), v(reach * c.forward),
                     v(c.right * std::max(aspect, 1.0f)), v(c.up / std::min(aspect, 1.0f)));
    if (!peer.sky_picture.empty()) {
        // Its pictures lie around y and go from +x towards +z. That is turned to z, which sends +z to -y, and mirrored.
        write_hdr(folder / "sky-povray.hdr", peer.sky_picture);
        t += "sky_sphere{pigment{image_map{hdr \"sky-povray.hdr\" map_type 1 interpolate 2} rotate <90,0,0> "
             "scale <1,-1,1>}}\n";
    } else if (peer.sky != Vec3{0}) {
        t += fmt::format("sky_sphere{{pigment{{rgb {}}}}}\n", v(peer.sky));
    }
    for (PeerMesh const& m : peer.meshes) {
        t += mesh(m.mesh) +
             texture(peer, peer.surfaces[static_cast<std::size_t>(m.surface)], m.emission, m.flat.has_value(),
                     pictures) +
             "}\n";
        if (m.emission == Vec3{0} || !m.flat) continue;
        Vec3 const n = front(m.mesh);
        t += light(*m.flat, m.emission, n, quality, lights);
        if (m.two_sided) t += light(*m.flat, m.emission, -n, quality, lights);
    }
    for (PeerBall const& b : peer.balls)
        t += fmt::format(
            "sphere{{{},{} {}}}\n", v(b.centre), b.radius,
            texture(peer, peer.surfaces[static_cast<std::size_t>(b.surface)], b.emission, false, pictures));
    return write_text(folder / "scene.pov", t);
}

}  // namespace nephroid::peers
