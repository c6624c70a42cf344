// All lights of a world: what they emit, where they are, and how one of them is chosen.
#pragma once

#include "model/light.h"
#include "records.h"
#include "sampling/distribution.h"
#include "world/light_tree.h"

#include <vector>

namespace nephroid {

/// What an object's surface emits; shared by its parts and appearances.
struct Emitter {
    RuntimeSpectrum radiance;  // scale applied
    AreaLight const* light = nullptr;
    TextureId alpha;   // of the surface; none = it is there everywhere
    bool cut = false;  // alpha varies
    bool two_sided = false;
    bool even = false;    // nothing varies: no picture, no texture and no alpha
    bool unseen = false;  // alpha is 0: it is not there, but shines (pbrt), and only light sampling finds it

    /// The emission depends on the place.
    [[nodiscard]] bool textured() const { return light->image.valid() || light->texture.valid() || cut; }
};

/// How an entry is sampled.
enum class LightShape : std::uint8_t {
    NoSurface,
    Triangle,
    Rectangle,
    Parallelogram,
    Box,       // all six faces; boxes[more]
    Analytic,  // sphere, disk, cylinder, as seen in its own space; places[more]
    Part       // anything else: asks the shape for points, uniform by area
};

/// A light to choose: one without a surface, or a part of an appearance of an emitting object (two triangles that make a
/// parallelogram are one, and so are the faces of a box). Flat ones carry what sampling needs, in world space.
struct LightEntry {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::uint32_t record = kNoInstance;
    std::uint32_t part = 0;  // of the record; NoSurface: the LightId
    std::uint32_t instance = kNoInstance;
    std::uint32_t more = kNone;
    std::uint32_t picture = kNone;  // pictures[picture]: where on the part it is bright
    std::uint32_t emitter = kNone;  // of the record
    LightShape shape = LightShape::Part;
    bool boundless = false;  // at infinity: no tree holds it

    [[nodiscard]] bool flat() const {
        return shape == LightShape::Triangle || shape == LightShape::Rectangle ||
               shape == LightShape::Parallelogram;
    }

    // Flat: corner + s edge1 + t edge2.
    float area_pdf = 0;  // 1 / area
    float size2 = 0;     // the squared diagonal
    Vec3 corner{0, 0, 0}, edge1{0, 0, 0}, edge2{0, 0, 0};
    Vec3 centroid{0, 0, 0};
    Vec3 normal{0, 0, 1};   // of the side that emits
    Vec3 p_error{0, 0, 0};  // of any of its points
};

/// A box in the world, which is a parallelepiped there: corner + sum of s_i edge[i].
struct BoxLight {
    Vec3 corner{0, 0, 0};
    std::array<Vec3, 3> edge;
    std::array<Vec3, 3> out;        // unit normals of the faces s_i = 1
    std::array<float, 3> area{};    // of the faces across edge i
    std::array<float, 3> height{};  // of the box above the face s_i = 0
    Vec3 p_error{0, 0, 0};
    float size2 = 0;
    bool inwards = false;  // the inner sides emit
    bool right_angled = true;
};

/// Where an analytic shape is, both ways.
struct LightPlace {
    AffineMap to_world, to_shape;
    float direction_scale = 0;  // of to_world (math/transform.h)
};

/// A part with a picture or a texture: brightness over the square by which it is sampled by area (empty where it is even), and
/// for flat parts the texture coordinates of corner + s edge1 + t edge2: uv + s duv1 + t duv2.
struct LightPicture {
    Distribution2D distribution;
    Vec2 uv{0, 0}, duv1{0, 0}, duv2{0, 0};
};

inline constexpr std::uint64_t kMostPictureCells = 1u << 21;

class LightTable {
  public:
    std::vector<Emitter> emitters;
    std::vector<LightData> data;           // by LightId
    std::vector<LightId> infinite;         // those that rays which leave the scene see
    std::vector<std::uint32_t> boundless;  // entries that the tree does not hold
    std::vector<LightEntry> entries;
    std::vector<std::uint32_t> entry_of_part;   // by appearance, record and part as the intersector names it
    std::vector<std::uint32_t> entry_of_light;  // by LightId
    std::vector<BoxLight> boxes;
    std::vector<LightPlace> places;
    std::vector<LightPicture> pictures;
    AliasTable by_power;
    float total_power = 0;
    LightTree tree;  // of all but the boundless ones; its lights are entries

    struct Choice {
        std::uint32_t entry = 0;
        float pmf = 0;
    };
    /// One entry, as `how` says; pmf 0 where none can reach the receiver.
    [[nodiscard]] Choice choose(Receiver const& to, LightChoice how, double u) const {
        // One alone is no choice; it is the case of many small scenes.
        return entries.size() == 1 ? Choice{0, by_power.empty() ? 0.0f : 1.0f} : choose_among(to, how, u);
    }
    [[nodiscard]] float pmf(Receiver const& to, LightChoice how, std::uint32_t entry) const;
    /// There is one, flat, which shines everywhere the same and is seen by rays.
    [[nodiscard]] bool lone_flat() const {
        if (entries.size() != 1 || by_power.empty()) return false;
        LightEntry const& e = entries.front();
        return e.flat() && e.area_pdf > 0.0f && emitters[e.emitter].even;
    }
    [[nodiscard]] std::size_t bytes() const;

  private:
    [[nodiscard]] Choice choose_among(Receiver const& to, LightChoice how, double u) const;
    /// The share of choices that the boundless lights get: each counts like the whole tree (PBRT 4th ed., 12.6.3).
    [[nodiscard]] float boundless_share() const {
        auto const n = static_cast<float>(boundless.size());
        return n / (n + (tree.empty() ? 0.0f : 1.0f));
    }
};

}  // namespace nephroid
