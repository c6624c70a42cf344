// Mitsuba 3's XML, with meshes as PLY. Not run by whoever wrote this: from the language's documentation.
#include "peer_scene.h"
#include "text_file.h"

#include "image/write.h"

#include <fmt/format.h>

namespace nephroid::peers {

namespace {

std::string rgb(char const* name, Vec3 c) {
    return fmt::format("<rgb name=\"{}\" value=\"{}, {}, {}\"/>", name, c.x, c.y, c.z);
}
std::string emitter(Vec3 emission) {
    return emission == Vec3{0} ? "" : "<emitter type=\"area\">" + rgb("radiance", emission) + "</emitter>";
}

/// ASCII PLY with what the mesh has.
void write_ply(std::filesystem::path const& path, TriangleMesh const& m) {
    std::string t = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
        m.p.size());
    if (!m.n.empty()) t += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!m.uv.empty()) t += "property float u\nproperty float v\n";
    t += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                     m.triangles.size());
    for (std::size_t i = 0; i < m.p.size(); ++i) {
        t += fmt::format("{} {} {}", m.p[i].x, m.p[i].y, m.p[i].z);
        if (!m.n.empty()) t += fmt::format(" {} {} {}", m.n[i].x, m.n[i].y, m.n[i].z);
        if (!m.uv.empty())
            t += fmt::format(" {} {}", m.uv[i].x, 1 - m.uv[i].y);  // its pictures begin at the top
        t += '\n';
    }
    for (Vec3i const f : m.triangles) t += fmt::format("3 {} {} {}\n", f.x, f.y, f.z);
    write_text(path, t);
}

std::string bsdf(PeerScene const& peer, PeerSurface const& s,
                 std::vector<std::filesystem::path> const& pictures) {
    if (s.kind == PeerSurface::Kind::Glass)
        return fmt::format(
            "<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"{}\"/><float name=\"ext_ior\" "
            "value=\"1\"/></bsdf>",
            s.index);
    if (s.kind == PeerSurface::Kind::Mirror)
        return "<bsdf type=\"twosided\"><bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/>" +
               rgb("specular_reflectance", s.rgb) + "</bsdf></bsdf>";
    std::string reflectance = rgb("reflectance", s.rgb);
    if (s.picture >= 0) {
        auto const i = static_cast<std::size_t>(s.picture);
        reflectance = fmt::format(
            "<texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" value=\"{}\"/>"
            "<string name=\"filter_type\" value=\"{}\"/></texture>",
            pictures[i].filename().string(), peer.pictures[i].nearest ? "nearest" : "bilinear");
    }
    return "<bsdf type=\"twosided\"><bsdf type=\"diffuse\">" + reflectance + "</bsdf></bsdf>";
}

}  // namespace

std::filesystem::path write_mitsuba(PeerScene const& peer, WriteJob const& job) {
    auto const pictures = write_pictures(peer, job.folder);
    PeerCamera const& c = peer.camera;
    Vec3 const at = c.eye + c.forward;
    std::string t = fmt::format(
        "<scene version=\"3.0.0\">\n<integrator type=\"path\"><integer name=\"max_depth\" "
        "value=\"{}\"/></integrator>\n"
        "<sensor type=\"perspective\"><float name=\"fov\" value=\"{}\"/><string name=\"fov_axis\" "
        "value=\"smaller\"/>"
        "<transform name=\"to_world\"><lookat origin=\"{}, {}, {}\" target=\"{}, {}, {}\" up=\"{}, {}, "
        "{}\"/></transform>\n"
        "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"{}\"/><integer name=\"seed\" "
        "value=\"{}\"/></sampler>\n<film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer "
        "name=\"height\" "
        "value=\"{}\"/><string name=\"pixel_format\" value=\"rgb\"/><string name=\"component_format\" "
        "value=\"float32\"/>"
        "<rfilter type=\"box\"/></film></sensor>\n",
        peer.depth + 1, degrees(c.fov), c.eye.x, c.eye.y, c.eye.z, at.x, at.y, at.z, c.up.x, c.up.y, c.up.z,
        job.samples, job.seed, peer.resolution.x, peer.resolution.y);
    if (!peer.sky_picture.empty()) {
        // y is up there, and the picture begins at -z and goes to +x: ours, the other way round, and turned.
        Image sky = peer.sky_picture;
        for (int y = 0; y < sky.height(); ++y)
            for (int x = 0; x < sky.width(); ++x)
                for (int k = 0; k < 3; ++k) sky.set(x, y, k, peer.sky_picture.get(sky.width() - 1 - x, y, k));
        write_exr(job.folder / "sky-mitsuba.exr", sky);
        t += "<emitter type=\"envmap\"><string name=\"filename\" value=\"sky-mitsuba.exr\"/><transform "
             "name=\"to_world\">"
             "<matrix value=\"0 0 -1 0 -1 0 0 0 0 1 0 0 0 0 0 1\"/></transform></emitter>\n";
    } else if (peer.sky != Vec3{0}) {
        t += "<emitter type=\"constant\">" + rgb("radiance", peer.sky) + "</emitter>\n";
    }
    int number = 0;
    for (PeerMesh const& m : peer.meshes) {
        std::string const file = fmt::format("mitsuba-{}.ply", number++);
        write_ply(job.folder / file, m.mesh);
        auto const& s = peer.surfaces[static_cast<std::size_t>(m.surface)];
        t += fmt::format(
            "<shape type=\"ply\"><string name=\"filename\" value=\"{}\"/><boolean name=\"face_normals\" "
            "value=\"{}\"/>{}{}</shape>\n",
            file, m.mesh.n.empty(), bsdf(peer, s, pictures), emitter(m.emission));
        if (m.two_sided && m.emission != Vec3{0}) {  // its lights have one side
            TriangleMesh back = m.mesh;
            for (Vec3i& f : back.triangles) std::swap(f.y, f.z);
            for (Vec3& n : back.n) n = -n;
            std::string const other = fmt::format("mitsuba-{}.ply", number++);
            write_ply(job.folder / other, back);
            t += fmt::format("<shape type=\"ply\"><string name=\"filename\" value=\"{}\"/>{}{}</shape>\n",
                             other, bsdf(peer, s, pictures), emitter(m.emission));
        }
    }
    for (PeerBall const& b : peer.balls)
        t += fmt::format(
            "<shape type=\"sphere\"><point name=\"center\" x=\"{}\" y=\"{}\" z=\"{}\"/><float "
            "name=\"radius\" "
            "value=\"{}\"/>{}{}</shape>\n",
            b.centre.x, b.centre.y, b.centre.z, b.radius,
            bsdf(peer, peer.surfaces[static_cast<std::size_t>(b.surface)], pictures), emitter(b.emission));
    return write_text(job.folder / "mitsuba.xml", t + "</scene>\n");
}

}  // namespace nephroid::peers
