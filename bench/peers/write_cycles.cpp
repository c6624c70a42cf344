// For Blender: what cycles.py reads. Numbers in JSON, arrays in one file of little-endian floats and ints beside it.
#include "peer_scene.h"
#include "text_file.h"

#include "image/write.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace nephroid::peers {

namespace {

using nlohmann::json;

json array_of(Vec3 v) { return {v.x, v.y, v.z}; }

/// Appends arrays, and says where each is: [offset in bytes, number of values].
class Arrays {
  public:
    explicit Arrays(std::filesystem::path const& path) : file_(path, std::ios::binary) {}
    template <class T>
    json add(std::vector<T> const& values) {
        std::size_t const bytes = values.size() * sizeof(T);
        file_.write(reinterpret_cast<char const*>(values.data()), static_cast<std::streamsize>(bytes));
        json const where = {at_, bytes / 4};
        at_ += bytes;
        return where;
    }
    void close() {
        file_.close();
        if (!file_) throw Error(ErrorKind::Io, "could not write the arrays of a scene for Blender");
    }

  private:
    std::ofstream file_;
    std::size_t at_ = 0;
};

/// Blender's longitude runs the other way, from the middle of the picture.
Image blender_sky(Image const& sky) {
    Image out = sky;
    int const w = sky.width();
    for (int y = 0; y < sky.height(); ++y)
        for (int x = 0; x < w; ++x)
            for (int k = 0; k < 3; ++k) out.set(x, y, k, sky.get((w / 2 - 1 - x + w) % w, y, k));
    return out;
}

}  // namespace

std::filesystem::path write_cycles(PeerScene const& peer, std::filesystem::path const& folder) {
    Arrays arrays(folder / "scene.bin");
    json j;
    j["resolution"] = {peer.resolution.x, peer.resolution.y};
    j["bounces"] = peer.depth - 1;  // Cycles' 0 is direct light
    PeerCamera const& c = peer.camera;
    j["camera"] = {{"eye", array_of(c.eye)},
                   {"right", array_of(c.right)},
                   {"up", array_of(c.up)},
                   {"forward", array_of(c.forward)},
                   {"fov", c.fov}};
    j["sky"] = array_of(peer.sky);
    if (!peer.sky_picture.empty()) {
        write_exr(folder / "sky-cycles.exr", blender_sky(peer.sky_picture));
        j["sky_picture"] = "sky-cycles.exr";
    }
    auto const pictures = write_pictures(peer, folder);
    for (std::size_t i = 0; i < pictures.size(); ++i)
        j["pictures"].push_back(
            {{"file", pictures[i].filename().string()}, {"nearest", peer.pictures[i].nearest}});
    for (PeerSurface const& s : peer.surfaces) {
        constexpr std::array<char const*, 3> kKinds{"diffuse", "glass", "mirror"};
        j["surfaces"].push_back({{"kind", kKinds[static_cast<std::size_t>(s.kind)]},
                                 {"rgb", array_of(s.rgb)},
                                 {"picture", s.picture},
                                 {"index", s.index}});
    }
    auto const add = [&](TriangleMesh const& m, int surface, Vec3 emission, bool two_sided) {
        j["meshes"].push_back({{"p", arrays.add(m.p)},
                               {"n", arrays.add(m.n)},
                               {"uv", arrays.add(m.uv)},
                               {"triangles", arrays.add(m.triangles)},
                               {"surface", surface},
                               {"emission", array_of(emission)},
                               {"two_sided", two_sided}});
    };
    for (PeerMesh const& m : peer.meshes) add(m.mesh, m.surface, m.emission, m.two_sided);
    for (PeerBall const& b : peer.balls) add(ball_mesh(b), b.surface, b.emission, false);
    arrays.close();
    return write_text(folder / "scene.json", j.dump());
}

}  // namespace nephroid::peers
