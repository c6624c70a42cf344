// Tungsten's JSON, with meshes as OBJ. Not run by whoever wrote this. A sky of its picture is left to its own default turn, y up,
// so scenes with one are refused.
#include "peer_scene.h"
#include "text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nephroid::peers {

namespace {

using nlohmann::json;
json array_of(Vec3 v) { return {v.x, v.y, v.z}; }

void write_obj(std::filesystem::path const& path, TriangleMesh const& m) {
    std::string t;
    for (Vec3 const p : m.p) t += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (Vec3 const n : m.n) t += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
    for (Vec2 const uv : m.uv) t += fmt::format("vt {} {}\n", uv.x, uv.y);
    auto const corner = [&](int i) {
        return fmt::format("{}{}{}", i + 1,
                           m.uv.empty() ? (m.n.empty() ? "" : "/") : fmt::format("/{}", i + 1),
                           m.n.empty() ? "" : fmt::format("/{}", i + 1));
    };
    for (Vec3i const f : m.triangles) t += fmt::format("f {} {} {}\n", corner(f.x), corner(f.y), corner(f.z));
    write_text(path, t);
}

}  // namespace

std::filesystem::path write_tungsten(PeerScene const& peer, WriteJob const& job) {
    if (!peer.sky_picture.empty())
        throw Error(ErrorKind::Input, "scenes under a picture of a sky are not written for Tungsten");
    for (PeerMesh const& m : peer.meshes)
        if (m.two_sided && m.emission != Vec3{0})
            throw Error(ErrorKind::Input, "lights with two sides are not written for Tungsten");
    auto const pictures = write_pictures(peer, job.folder);
    json j;
    for (std::size_t i = 0; i < peer.surfaces.size(); ++i) {
        PeerSurface const& s = peer.surfaces[i];
        json b = {{"name", fmt::format("s{}", i)}, {"albedo", array_of(s.rgb)}};
        b["type"] = s.kind == PeerSurface::Kind::Diffuse ? "lambert"
                    : s.kind == PeerSurface::Kind::Glass ? "dielectric"
                                                         : "mirror";
        if (s.kind == PeerSurface::Kind::Glass) b["ior"] = s.index, b["albedo"] = 1;
        if (s.picture >= 0) {
            auto const n = static_cast<std::size_t>(s.picture);
            b["albedo"] = {{"type", "bitmap"},
                           {"file", pictures[n].filename().string()},
                           {"interpolate", !peer.pictures[n].nearest}};
        }
        j["bsdfs"].push_back(b);
    }
    j["media"] = json::array();
    for (std::size_t i = 0; i < peer.meshes.size(); ++i) {
        PeerMesh const& m = peer.meshes[i];
        std::string const file = fmt::format("tungsten-{}.obj", i);
        write_obj(job.folder / file, m.mesh);
        json p = {{"type", "mesh"},
                  {"file", file},
                  {"smooth", !m.mesh.n.empty()},
                  {"backface_culling", false},
                  {"bsdf", fmt::format("s{}", m.surface)}};
        if (m.emission != Vec3{0}) p["emission"] = array_of(m.emission);
        j["primitives"].push_back(p);
    }
    for (PeerBall const& b : peer.balls) {
        json p = {{"type", "sphere"},
                  {"transform", {{"position", array_of(b.centre)}, {"scale", b.radius}}},
                  {"bsdf", fmt::format("s{}", b.surface)}};
        if (b.emission != Vec3{0}) p["emission"] = array_of(b.emission);
        j["primitives"].push_back(p);
    }
    if (peer.sky != Vec3{0})
        j["primitives"].push_back(
            {{"type", "infinite_sphere"}, {"emission", array_of(peer.sky)}, {"sample", true}});
    PeerCamera const& c = peer.camera;
    // Its angle is the horizontal one.
    float const aspect = static_cast<float>(peer.resolution.x) / static_cast<float>(peer.resolution.y);
    float const across = aspect > 1 ? 2 * std::atan(std::tan(c.fov / 2) * aspect) : c.fov;
    j["camera"] = {
        {"type", "pinhole"},
        {"fov", degrees(across)},
        {"resolution", {peer.resolution.x, peer.resolution.y}},
        {"reconstruction_filter", "box"},
        {"transform",
         {{"position", array_of(c.eye)}, {"look_at", array_of(c.eye + c.forward)}, {"up", array_of(c.up)}}}};
    j["integrator"] = {{"type", "path_tracer"},
                       {"min_bounces", 0},
                       {"max_bounces", peer.depth + 1},
                       {"enable_light_sampling", true},
                       {"enable_two_sided_shading", true}};
    j["renderer"] = {
        {"hdr_output_file", "out.pfm"}, {"output_file", "out.png"}, {"overwrite_output_files", true},
        {"adaptive_sampling", false},   {"spp", job.samples},       {"spp_step", job.samples}};
    return write_text(job.folder / "tungsten.json", j.dump(1));
}

}  // namespace nephroid::peers
