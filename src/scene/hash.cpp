// What two scenes must share to be the same scene. Lists enter with their lengths and variants with their index, so that
// nothing can slide from one field into the next.
//
// An id enters as the digest of what it names, made once for each thing. How textures, materials, pictures and groups are
// numbered, which of them nothing uses, and whether one of them is there twice, is thus nobody's business; the order of
// objects, instances and lights, which random choices go by, is.
#include "scene/digest.h"
#include "scene/fields.h"
#include "scene/file_path.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <fstream>

namespace nephroid {

namespace {

/// Numbers by value in 64 bits. Floats by their bits, but -0 is 0: "-0" in a file means nothing else than "0".
template <ScalarType T>
std::uint64_t canonical(T x) {
    if constexpr (std::same_as<T, float>)
        return std::bit_cast<std::uint32_t>(x + 0.0f);
    else if constexpr (std::same_as<T, double>)
        return std::bit_cast<std::uint64_t>(x + 0.0);
    else
        return static_cast<std::uint64_t>(x);
}

/// Lists of float or int vectors, the bulk of a scene: components in blocks, which the compiler turns into vector code.
template <class Component>
requires(sizeof(Component) == 4) void put_bulk(Digest& d, Component const* values, std::size_t count) {
    std::array<std::uint32_t, 1024> block;
    while (count > 0) {
        std::size_t const n = std::min(count, block.size());
        for (std::size_t i = 0; i < n; ++i) block[i] = static_cast<std::uint32_t>(canonical(values[i]));
        d.bytes(block.data(), n * sizeof block[0]);
        values += n, count -= n;
    }
}

void put_text(Digest& d, std::string const& text) {
    d.word(text.size());
    d.bytes(text.data(), text.size());
}

/// The file itself, wherever it lies; one that cannot be read (compile() will say so) is told by its path.
void put_contents(Digest& d, std::string const& path) {
    // A device or a FIFO must not be waited for, nor what calls itself a regular file of no bytes (/proc/kmsg).
    std::error_code error;
    std::ifstream file;
    if (std::filesystem::is_regular_file(path, error) && std::filesystem::file_size(path, error) > 0)
        file.open(path, std::ios::binary);
    d.word(file.is_open());
    if (!file.is_open()) return put_text(d, without_detours(std::filesystem::absolute(path, error)).string());
    std::vector<char> buffer(1 << 20);
    std::uint64_t size = 0;
    while (file) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        auto const n = static_cast<std::size_t>(file.gcount());
        d.bytes(buffer.data(), n);
        size += n;
    }
    d.word(size);
}
/// Digests of the things of a scene; without a scene, of what holds no ids.
class Hasher {
  public:
    explicit Hasher(Scene const* scene = nullptr) : scene_(scene) {
        if (!scene) return;
        images_.resize(scene->images.size());
        textures_.resize(scene->textures.size());
        materials_.resize(scene->materials.size());
        groups_.resize(scene->groups.size());
    }

    void put(Digest& d, std::string const& text) { put_text(d, text); }
    void put(Digest& /*d*/, SourceLocation /*where*/) {}
    void put(Digest& d, ImageId id) { put_named(d, id, scene_->images, images_); }
    void put(Digest& d, TextureId id) { put_named(d, id, scene_->textures, textures_); }
    void put(Digest& d, MaterialId id) { put_named(d, id, scene_->materials, materials_); }
    void put(Digest& d, GroupId id) { put_named(d, id, scene_->groups, groups_); }
    void put(Digest& d, ImageFile const& image) {
        auto const& [path, encoding, where] = image;
        put(d, encoding);
        put_contents(d, path);
    }
    void put(Digest& d, DataFile const& file) {
        auto const& [path, where] = file;
        put_contents(d, path);
    }
    // Names are for people.
    void put(Digest& d, Material const& m) { put_fields_except(d, m, &m.name); }
    void put(Digest& d, Group const& g) { put_fields_except(d, g, &g.name); }
    // Said in two ways: what is beyond the poles is not there …
    void put(Digest& d, Sphere const& s) {
        Sphere cut = s;
        cut.z_min = std::max(s.z_min, -s.radius);
        cut.z_max = std::min(s.z_max, s.radius);
        for_each_field(cut, [&](auto const& field) { put(d, field); });
    }
    // … and v none is as u.
    void put(Digest& d, Roughness const& r) {
        Roughness both = r;
        if (!both.v.valid()) both.v = both.u;
        for_each_field(both, [&](auto const& field) { put(d, field); });
    }

    template <class T>
    void put(Digest& d, T const& x) {
        if constexpr (ScalarType<T>) {
            d.word(canonical(x));
        } else if constexpr (GlmType<T>) {
            for (int i = 0; i < T::length(); ++i) put(d, x[i]);
        } else if constexpr (ArrayType<T>) {
            for (auto const& element : x) put(d, element);
        } else if constexpr (VectorType<T>) {
            put_list(d, x);
        } else if constexpr (OptionalType<T>) {
            d.word(x.has_value());
            if (x) put(d, *x);
        } else if constexpr (VariantType<T>) {
            d.word(x.index());
            std::visit([&](auto const& alternative) { put(d, alternative); }, x);
        } else {
            static_assert(!IdType<T>, "say what it names");
            for_each_field(x, [&](auto const& field) { put(d, field); });
        }
    }

  private:
    struct Named {
        enum class State : std::uint8_t { New, Open, Done } state = State::New;
        std::array<std::uint64_t, 2> words{};
    };

    template <class Tag, class T>
    void put_named(Digest& d, Id<Tag> id, std::vector<T> const& things, std::vector<Named>& digests) {
        d.word(id.valid());
        if (!id.valid()) return;
        // What validate() would refuse, a name of nothing or of itself, at least comes to an end here.
        if (id.value >= things.size()) return d.word(id.value);
        Named& named = digests[id.value];
        if (named.state == Named::State::New) {
            named.state = Named::State::Open;
            Digest own;
            put(own, things[id.value]);
            named.words = own.words();
            named.state = Named::State::Done;
        }
        for (std::uint64_t const word : named.words) d.word(word);
    }

    template <class T>
    void put_list(Digest& d, std::vector<T> const& list) {
        d.word(list.size());
        if (list.empty()) return;
        if constexpr (std::same_as<T, Vec3> || std::same_as<T, Vec2> || std::same_as<T, Vec3i>) {
            static_assert(sizeof(T) == sizeof(list[0][0]) * static_cast<std::size_t>(T::length()));
            put_bulk(d, &list[0][0], list.size() * static_cast<std::size_t>(T::length()));
        } else if constexpr (std::same_as<T, std::array<int, 4>>) {
            put_bulk(d, list[0].data(), list.size() * 4);
        } else if constexpr (std::same_as<T, float>) {
            put_bulk(d, list.data(), list.size());
        } else {
            for (T const& element : list) put(d, element);
        }
    }

    /// All fields but the one at `skipped`.
    template <PlainStruct T>
    void put_fields_except(Digest& d, T const& x, void const* skipped) {
        for_each_field(x, [&](auto const& field) {
            if (static_cast<void const*>(&field) != skipped) put(d, field);
        });
    }

    Scene const* scene_;
    std::vector<Named> images_, textures_, materials_, groups_;
};

}  // namespace

std::string hash(Scene const& scene) {
    // A new field of Scene does not compile here until it is decided whether it shapes the picture.
    auto const& [files, notes, camera, settings, images, textures, materials, lights, groups, image_ids] =
        scene;
    Hasher hasher(&scene);
    Digest d;
    hasher.put(d, camera);
    hasher.put(d, lights);
    hasher.put(d, GroupId{0});
    return d.hex();
}

std::string hash(Settings const& settings) {
    Settings shaping = settings;
    // How many passes, how the sums are written down, and who chose the colours, shape no pass.
    shaping.spp = samples_per_pass(settings);
    if (auto* p = std::get_if<PhotonMapIntegrator>(&shaping.integrator)) p->passes = 0;
    if (auto* p = std::get_if<PhotonMapIntegrator>(&shaping.integrator)) p->passes = 1;
    shaping.color_given = false;
    shaping.film.filename.clear();
    shaping.film.half_float = false;
    Digest d;
    Hasher().put(d, shaping);
    return d.hex();
}

}  // namespace nephroid
