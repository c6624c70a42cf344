#include "light_gather.h"

#include "emission.h"
#include "scene/match.h"
#include "spectrum/color.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace nephroid {

namespace {

/// Emission beyond floats would be black or NaN somewhere on its way.
void check_emission(Scene const& scene, SourceLocation where, RuntimeSpectrum const& emission) {
    if (!std::isfinite(emission.max_value()))
        scene.fail(where, "the light emits more than floats can hold; make its scale smaller");
}
/// How often a light is chosen. Power is a product with areas, and may leave the range of floats where emission does not.
float weight_of(float power) { return power > 0.0f ? std::fmin(power, 1e30f) : 0.0f; }

// --- flat parts -------------------------------------------------------------------------------------------------------

/// A corner of a part, as its area sampler gives it.
struct Corner {
    Vec3 p, n, p_error;
    Vec2 uv;
};
Corner corner(ObjectRecord const& r, InstanceRecord const* where, std::uint32_t part, Vec2 u) {
    ShapeSample const s = sample_part(r, where, part, u);
    return {s.p, s.n, s.p_error, s.uv};
}

/// A flat part: its first corner and both neighbours; `full`: a parallelogram.
struct Flat {
    Corner at, next1, next2;
    bool full = false;
};

/// Is d opposite a in a parallelogram a b d c, but for the roundings of its corners? Texture coordinates must agree where they
/// matter.
bool is_parallelogram(Corner const& a, Corner const& b, Corner const& c, Corner const& d, bool textured) {
    Vec3 const gap = abs(a.p + d.p - b.p - c.p);
    Vec3 const rounding = 16.0f * kMachineEpsilon * (abs(a.p) + abs(b.p) + abs(c.p) + abs(d.p));
    if (gap.x > rounding.x || gap.y > rounding.y || gap.z > rounding.z) return false;
    // Far from the origin that would let small shapes be anything.
    if (length(gap) > 1e-4f * min(length(b.p - a.p), length(c.p - a.p))) return false;
    if (!textured) return true;
    Vec2 const uv = a.uv + d.uv - b.uv - c.uv;
    return std::abs(uv.x) <= 1e-5f && std::abs(uv.y) <= 1e-5f;
}

/// Nothing where vertex normals turn the emitting side within the part, or where it is not flat.
std::optional<Flat> flatten(ObjectRecord const& r, InstanceRecord const* where, std::uint32_t part,
                            bool textured) {
    // The corners, by the numbers that lead there (sampling/warp.h, square_to_triangle).
    bool const triangle = std::holds_alternative<TriangleMesh>(r.object->shape);
    Flat f{corner(r, where, part, {0, 0}), corner(r, where, part, {1, 0}), corner(r, where, part, {0, 1}),
           !triangle};
    if (triangle) {
        if (f.at.n != f.next1.n || f.at.n != f.next2.n) return std::nullopt;
        return f;
    }
    Corner const last = corner(r, where, part, {1, 1});
    for (Corner const& c : {f.next1, f.next2, last})
        if (!(dot(f.at.n, c.n) > 0.99999f)) return std::nullopt;
    if (!is_parallelogram(f.at, f.next1, f.next2, last, textured)) return std::nullopt;
    return f;
}

/// The parallelogram that two triangles make.
std::optional<Flat> joined(Flat const& a, Flat const& b, bool textured) {
    Corner const* const as[3] = {&a.at, &a.next1, &a.next2};
    Corner const* const bs[3] = {&b.at, &b.next1, &b.next2};
    if (!(dot(a.at.n, b.at.n) > 0.99999f)) return std::nullopt;
    auto const same = [&](Corner const& x, Corner const& y) {
        return x.p == y.p && (!textured || x.uv == y.uv);
    };
    Corner const* own_a = nullptr;
    Corner const* shared[3] = {};
    int count = 0;
    for (Corner const* x : as) {
        bool const found =
            std::any_of(std::begin(bs), std::end(bs), [&](Corner const* y) { return same(*x, *y); });
        if (found)
            shared[count++] = x;
        else
            own_a = x;
    }
    if (count != 2) return std::nullopt;
    for (Corner const* y : bs) {
        if (same(*shared[0], *y) || same(*shared[1], *y)) continue;
        if (!is_parallelogram(*own_a, *shared[0], *shared[1], *y, textured)) return std::nullopt;
        return Flat{*shared[0], *own_a, *y, true};
    }
    return std::nullopt;
}

/// Near enough to a right angle for a sampler of rectangles: the density is off by as much as the cosine between the edges.
bool is_right_angle(Vec3 a, Vec3 b) { return abs_dot(a, b) <= 1e-5f * length(a) * length(b); }

void fill(LightEntry& e, Flat const& f) {
    e.corner = f.at.p;
    e.edge1 = f.next1.p - f.at.p;
    e.edge2 = f.next2.p - f.at.p;
    e.centroid = e.corner + (f.full ? 0.5f : 1.0f / 3.0f) * (e.edge1 + e.edge2);
    Vec3 const area = cross_accurate(e.edge1, e.edge2);
    float const twice = length(area);
    e.area_pdf = (f.full ? 1.0f : 2.0f) / twice;
    e.normal = face_forward(area * (1.0f / twice), f.at.n);
    e.size2 = f.full ? max(length_squared(e.edge1 + e.edge2), length_squared(e.edge1 - e.edge2))
                     : max(length_squared(e.edge1 - e.edge2),
                           max(length_squared(e.edge1), length_squared(e.edge2)));
    e.p_error = max(f.at.p_error, max(f.next1.p_error, f.next2.p_error)) +
                gamma_bound(f.full ? 24 : 5) * (abs(e.corner) + abs(e.edge1) + abs(e.edge2));
    e.shape = !f.full                            ? LightShape::Triangle
              : is_right_angle(e.edge1, e.edge2) ? LightShape::Rectangle
                                                 : LightShape::Parallelogram;
}
bool is_usable(LightEntry const& e) { return e.area_pdf > 0.0f && std::isfinite(e.area_pdf); }

// --- whole shapes -----------------------------------------------------------------------------------------------------

AffineMap map_of(ObjectRecord const& r, InstanceRecord const* where) {
    AffineMap const inner = r.place ? r.place->shape_to_group : AffineMap{};
    if (!where) return inner;
    AffineMap const& outer = where->to_world;
    AffineMap all;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            double sum = j == 3 ? static_cast<double>(outer.m[i][3]) : 0;
            for (std::size_t k = 0; k < 3; ++k)
                sum += static_cast<double>(outer.m[i][k]) * static_cast<double>(inner.m[k][j]);
            all.m[i][j] = static_cast<float>(sum);
        }
    return all;
}

std::optional<LightPlace> light_place(AffineMap const& to_world) {
    Mat4 m;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) m.m[i][j] = static_cast<double>(to_world.m[i][j]);
    auto const t = make_transform(m);
    if (!t) return std::nullopt;
    LightPlace place;
    place.to_world = to_world;
    place.to_shape.m = t->inv;
    place.direction_scale = direction_scale(to_world);
    return place;
}

BoxLight box_light(Box const& box, AffineMap const& map, ObjectRecord const& r, InstanceRecord const* where) {
    BoxLight b;
    Vec3 const size = box.hi - box.lo;
    b.corner = map.point(box.lo);
    // Each map on the way has its bound; that of their product may cancel.
    Vec3 error{0, 0, 0};
    for (std::uint32_t face = 0; face < 6; ++face)
        for (int i = 0; i < 4; ++i)
            error =
                max(error,
                    corner(r, where, face, {static_cast<float>(i & 1), static_cast<float>(i >> 1)}).p_error);
    for (int i = 0; i < 3; ++i) {
        Vec3 edge{0, 0, 0};
        edge[i] = size[i];
        b.edge[static_cast<std::size_t>(i)] = map.vector(edge);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3 const across = cross_accurate(b.edge[(i + 1) % 3], b.edge[(i + 2) % 3]);
        b.area[i] = length(across);
        b.out[i] = face_forward(across * (1.0f / b.area[i]), b.edge[i]);
        b.height[i] = dot(b.out[i], b.edge[i]);
        b.size2 += length_squared(b.edge[i]);
    }
    b.p_error =
        3.0f * error + gamma_bound(8) * (abs(b.corner) + abs(b.edge[0]) + abs(b.edge[1]) + abs(b.edge[2]));
    b.inwards = r.flip;
    b.right_angled = is_right_angle(b.edge[0], b.edge[1]) && is_right_angle(b.edge[1], b.edge[2]) &&
                     is_right_angle(b.edge[2], b.edge[0]);
    return b;
}

Bounds3 mapped(Bounds3 const& b, AffineMap const& map) {
    Bounds3 r;
    for (int i = 0; i < 8; ++i) r.add(map.point(b.corner(i)));
    return r;
}

struct Gatherer {
    Scene& scene;
    Assets& assets;
    WorldParts& parts;
    LightTable& lights;
    int most_cells;  // along a side of a picture's table
    std::vector<float> powers;
    std::vector<LightBounds> bounds;

    void add(LightEntry const& e, float power, LightBounds const& b) {
        lights.entries.push_back(e);
        powers.push_back(weight_of(power));
        bounds.push_back(b);
        bounds.back().intensity = weight_of(b.intensity);
    }

    /// Everything that one emitting object is in one appearance.
    void add_object(std::uint32_t index, std::uint32_t instance) {
        ObjectRecord const& r = parts.records[index];
        InstanceRecord const* where = instance == kNoInstance ? nullptr : &parts.instances[instance];
        Emitter const& e = lights.emitters[r.emitter];
        std::uint32_t const count = part_count(r);
        std::uint64_t flat = 0;
        auto const named = [&](std::uint32_t n) {  // the next n parts are the entry that comes now
            lights.entry_of_part.insert(lights.entry_of_part.end(), n,
                                        static_cast<std::uint32_t>(lights.entries.size()));
        };
        LightEntry const fresh{.record = index, .instance = instance, .emitter = r.emitter};
        if (auto const* box = std::get_if<Box>(&r.object->shape); box && !e.textured()) {
            named(count);
            add_box(fresh, *box, r, where, e);
            return;
        }
        bool const round = std::holds_alternative<Sphere>(r.object->shape) ||
                           std::holds_alternative<Cylinder>(r.object->shape) ||
                           std::holds_alternative<Disk>(r.object->shape);
        for (std::uint32_t part = 0; part < count; ++part) {
            LightEntry entry = fresh;
            entry.part = part;
            if (round) {
                named(1);
                flat += add_round(entry, r, where, e) ? 0 : 1;
                continue;
            }
            auto shape = flatten(r, where, part, e.textured());
            std::uint32_t taken = 1;
            if (shape && !shape->full && part + 1 < count)
                if (auto const second = flatten(r, where, part + 1, e.textured()))
                    if (auto const both = joined(*shape, *second, e.textured())) shape = both, taken = 2;
            named(taken);
            if (shape) fill(entry, *shape);
            flat += add_part(entry, shape, r, where, e) ? 0 : 1;
            part += taken - 1;
        }
        if (flat > 0)
            scene.note(r.object->where,
                       std::to_string(flat) + " light-emitting primitives have no area and were left out");
    }

    float power_of(Emitter const& e, float intensity) const {
        return intensity * kPi * (e.two_sided ? 2.0f : 1.0f);
    }

    void add_box(LightEntry entry, Box const& box, ObjectRecord const& r, InstanceRecord const* where,
                 Emitter const& e) {
        AffineMap const map = map_of(r, where);
        BoxLight const b = box_light(box, map, r, where);
        entry.shape = LightShape::Box;
        entry.more = static_cast<std::uint32_t>(lights.boxes.size());
        float const area = 2.0f * (b.area[0] + b.area[1] + b.area[2]);
        entry.area_pdf = 1.0f / area;
        lights.boxes.push_back(b);
        float const level = e.radiance.max_value() * area;
        add(entry, power_of(e, level), {.box = mapped({box.lo, box.hi}, map), .intensity = level});
    }

    /// False when it has no area.
    bool add_round(LightEntry entry, ObjectRecord const& r, InstanceRecord const* where, Emitter const& e) {
        AffineMap const map = map_of(r, where);
        float const area = part_area(r, where, entry.part);
        auto const place = light_place(map);
        bool const usable = area > 0.0f && std::isfinite(area);
        if (usable && place) {
            entry.shape = LightShape::Analytic;
            entry.more = static_cast<std::uint32_t>(lights.places.size());
            lights.places.push_back(*place);
        }
        LightBounds b;
        b.box = match(
            r.object->shape, [&](Sphere const& s) { return mapped(nephroid::bounds(s), map); },
            [&](Cylinder const& s) { return mapped(nephroid::bounds(s), map); },
            [&](Disk const& s) { return mapped(nephroid::bounds(s), map); },
            [](auto const&) { return Bounds3{}; });
        if (std::holds_alternative<Disk>(r.object->shape)) {
            b.axis = sample_part(r, where, entry.part, {0.5f, 0.5f}).n;
            b.cos_normals = 1;
        }
        return finish(entry, nullptr, r, where, e, area, b);
    }

    bool add_part(LightEntry const& entry, std::optional<Flat> const& flat, ObjectRecord const& r,
                  InstanceRecord const* where, Emitter const& e) {
        LightBounds b;
        float area = 0;
        if (flat) {
            area = is_usable(entry) ? 1.0f / entry.area_pdf : 0.0f;
            b.axis = entry.normal;
            b.cos_normals = 1;
            b.box.add(entry.corner), b.box.add(entry.corner + entry.edge1),
                b.box.add(entry.corner + entry.edge2);
            if (flat->full) b.box.add(entry.corner + entry.edge1 + entry.edge2);
        } else {
            area = part_area(r, where, entry.part);
            cone_of_corners(entry, r, where, b);
        }
        return finish(entry, flat ? &*flat : nullptr, r, where, e, area, b);
    }

    /// The normal of a bilinear patch is a sum, with weights above 0, of those at its corners; a triangle's is the same but for
    /// its side.
    static void cone_of_corners(LightEntry const& entry, ObjectRecord const& r, InstanceRecord const* where,
                                LightBounds& b) {
        Vec3 normals[4];
        Vec3 sum{0, 0, 0};
        for (int i = 0; i < 4; ++i) {
            Corner const c =
                corner(r, where, entry.part, {static_cast<float>(i & 1), static_cast<float>(i >> 1)});
            b.box.add(c.p);
            sum += normals[i] = c.n;
        }
        b.cos_normals = -1;
        if (!(length_squared(sum) > 0.0f)) return;
        b.axis = normalize(sum);
        float least = 1;
        for (Vec3 const n : normals) least = std::fmin(least, dot(n, b.axis));
        // Less than a right angle between any two of them, or the side may change in between.
        if (least > 0.7072f) b.cos_normals = std::fmax(-1.0f, least - 1e-5f);
    }

    bool finish(LightEntry entry, Flat const* flat, ObjectRecord const& r, InstanceRecord const* where,
                Emitter const& e, float area, LightBounds b) {
        bool const usable = area > 0.0f && std::isfinite(area);
        float content = area;
        if (usable && e.textured()) content = add_picture(entry, flat, r, where, e);
        b.intensity = usable ? e.radiance.max_value() * content : 0.0f;
        b.two_sided = e.light->two_sided;
        add(entry, power_of(e, b.intensity), b);
        return usable;
    }

    /// The integral of the emission's level over the part. Where that varies, a table of it over the square by which the part
    /// is sampled becomes the entry's picture.
    float add_picture(LightEntry& entry, Flat const* flat, ObjectRecord const& r, InstanceRecord const* where,
                      Emitter const& e) {
        LightPicture picture;
        if (flat) {
            picture.uv = flat->at.uv;
            picture.duv1 = flat->next1.uv - flat->at.uv;
            picture.duv2 = flat->next2.uv - flat->at.uv;
        }
        auto const [nx, ny] = resolution(picture, flat != nullptr, part_count(r), e);
        // Level times area element.
        auto const value = [&](Vec2 u) -> float {
            ShapeSample s;
            if (flat) {
                Vec2 const b = entry.shape == LightShape::Triangle ? square_to_triangle(u) : u;
                s.p = entry.corner + b.x * entry.edge1 + b.y * entry.edge2;
                s.uv = picture.uv + b.x * picture.duv1 + b.y * picture.duv2;
                s.pdf_area = entry.area_pdf;
            } else {
                s = sample_part(r, where, entry.part, u);
            }
            return s.pdf_area > 0.0f ? emission_level(assets, e, s.p, s.uv) / s.pdf_area : 0.0f;
        };
        std::vector<float> const cells = cell_means(nx, ny, value);
        double sum = 0;
        for (float const cell : cells) sum += static_cast<double>(cell);
        auto const [least, greatest] = std::minmax_element(cells.begin(), cells.end());
        double const mean = sum / static_cast<double>(cells.size());
        if (*greatest > 1.5f * *least) picture.distribution = Distribution2D(cells, nx, ny);
        // Flat parts find their place in the picture by it, even where it is even.
        if (flat || !picture.distribution.empty()) {
            entry.picture = static_cast<std::uint32_t>(lights.pictures.size());
            lights.pictures.push_back(std::move(picture));
        }
        return static_cast<float>(mean);
    }

    /// About a cell a texel, within bounds.
    std::array<int, 2> resolution(LightPicture const& p, bool flat, std::uint32_t parts_of_object,
                                  Emitter const& e) const {
        constexpr float kProcedural = 64;
        float const crowd = std::sqrt(static_cast<float>(parts_of_object));
        float nx = kProcedural / crowd;
        float ny = nx;
        if (e.light->image.valid()) {
            Image const& image = assets.pyramid(e.light->image).level(0);
            Vec2 const texels{static_cast<float>(image.width()), static_cast<float>(image.height())};
            nx = flat ? length_of(p.duv1 * texels) : texels.x / crowd;
            ny = flat ? length_of(p.duv2 * texels) : texels.y / crowd;
        }
        auto const cells = [&](float n) {
            return std::isfinite(n) ? std::clamp(static_cast<int>(std::ceil(n)), 1, most_cells) : most_cells;
        };
        return {cells(std::fmin(nx, 1e4f)), cells(std::fmin(ny, 1e4f))};
    }
    static float length_of(Vec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }

    void add_appearance(std::uint32_t first, std::uint32_t count, std::uint32_t instance) {
        for (std::uint32_t r = first; r < first + count; ++r)
            if (parts.records[r].emits()) add_object(r, instance);
    }

    void add_without_surface(std::uint32_t index, BoundingSphere const& sphere) {
        Light const& light = scene.lights[index];
        lights.data.push_back(prepare(light, assets));
        LightData const& data = lights.data.back();
        check_emission(scene, light.where, data.emission);
        if (!std::isfinite(data.emission.max_value() * data.image_scale * std::fmax(1.0f, data.peak)))
            scene.fail(light.where,
                       "the light's picture emits more than floats can hold; make its scale smaller");
        if (is_infinite(light)) lights.infinite.push_back(LightId{index});
        lights.entry_of_light.push_back(static_cast<std::uint32_t>(lights.entries.size()));
        LightEntry entry{.part = index};
        entry.shape = LightShape::NoSurface;
        auto const b = light_bounds(light, data, assets);
        float const phi = power(light, data, assets, sphere);
        entry.boundless = !b && phi > 0.0f;
        if (entry.boundless) lights.boundless.push_back(static_cast<std::uint32_t>(lights.entries.size()));
        add(entry, phi, b.value_or(LightBounds{}));
    }
};

}  // namespace

std::uint32_t add_emitter(Scene const& scene, Assets& assets, LightTable& lights, ObjectRecord const& r) {
    AreaLight const& l = *r.object->light;
    Emitter e;
    e.light = &l;
    e.alpha = r.object->alpha;
    e.two_sided = l.two_sided;
    e.even = !l.image.valid() && !l.texture.valid() && !e.alpha.valid();
    e.cut = e.alpha.valid() && !assets.data(e.alpha).flat;
    e.unseen = e.alpha.valid() && assets.data(e.alpha).flat && !(assets.data(e.alpha).value > 0.0f);
    // Lumens of a surface of luminance 1: pi * area * sides (* the picture's mean luminance; pbrt-v4's, over the picture).
    double area = 0;
    double content = 0;
    for (std::uint32_t i = 0; i < part_count(r); ++i) {
        auto const a = static_cast<double>(part_area(r, nullptr, i));
        area += a;
        if (!l.texture.valid() || !(l.power >= 0)) continue;
        constexpr int kGrid = 16;
        double mean = 0;
        for (int y = 0; y < kGrid; ++y)
            for (int x = 0; x < kGrid; ++x) {
                ShapeSample const s = sample_part(
                    r, nullptr, i,
                    {(static_cast<float>(x) + 0.5f) / kGrid, (static_cast<float>(y) + 0.5f) / kGrid});
                mean += static_cast<double>(emission_level(assets, e, s.p, s.uv)) / (kGrid * kGrid);
            }
        content += a * mean;
    }
    double unit = static_cast<double>(kPi) * (l.texture.valid() ? content : area) * (l.two_sided ? 2 : 1);
    if (l.image.valid()) {
        Pyramid const& picture = assets.pyramid(l.image);
        Vec3 const mean = picture.bilerp_rgb(picture.levels() - 1, {0.5f, 0.5f}, Wrap::Clamp);
        unit *= static_cast<double>(std::fmax(0.0f, luminance(mean)));
    }
    try {
        e.radiance = emission_spectrum(assets, l.radiance, l.scale, l.power, unit);
    } catch (Error const& error) {
        throw Error(error.kind(), scene.locate(l.where) + ": " + error.what());
    }
    check_emission(scene, l.where, e.radiance);
    lights.emitters.push_back(e);
    return static_cast<std::uint32_t>(lights.emitters.size() - 1);
}

namespace {

/// All tables together hold kMostPictureCells at most (world/estimate.cpp counts on it), and each 256 x 256.
int most_cells(WorldParts const& parts, LightTable const& lights) {
    double textured = 0;
    auto const count = [&](std::uint32_t first, std::uint32_t n) {
        for (std::uint32_t r = first; r < first + n; ++r)
            if (parts.records[r].emits() && lights.emitters[parts.records[r].emitter].textured())
                textured += part_count(parts.records[r]);
    };
    count(parts.first_record[0], parts.record_count[0]);
    for (InstanceRecord const& i : parts.instances) count(i.first_record, parts.count_from(i.first_record));
    if (textured == 0) return 1;
    return static_cast<int>(
        std::clamp(std::sqrt(static_cast<double>(kMostPictureCells) / textured), 1.0, 256.0));
}

}  // namespace

void gather_lights(Scene& scene, Assets& assets, WorldParts& parts, LightTable& lights,
                   BoundingSphere const& sphere) {
    Gatherer g{scene, assets, parts, lights, most_cells(parts, lights), {}, {}};
    g.add_appearance(parts.first_record[0], parts.record_count[0], kNoInstance);
    for (std::uint32_t i = 0; i < parts.instances.size(); ++i) {
        InstanceRecord& instance = parts.instances[i];
        instance.first_light = static_cast<std::uint32_t>(lights.entry_of_part.size());
        g.add_appearance(instance.first_record, parts.count_from(instance.first_record), i);
    }
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) g.add_without_surface(i, sphere);
    lights.entries.shrink_to_fit();
    lights.entry_of_part.shrink_to_fit();
    lights.by_power = AliasTable(g.powers);
    double sum = 0;
    for (float const p : g.powers) sum += static_cast<double>(p);
    lights.total_power = static_cast<float>(sum);
    lights.tree = LightTree(g.bounds);
}

}  // namespace nephroid
