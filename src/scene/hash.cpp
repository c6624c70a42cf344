// What two scenes must share to be the same scene. Lists enter with their lengths and variants with their index, so that
// nothing can slide from one field into the next.
#include "scene/digest.h"
#include "scene/fields.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <fstream>

namespace nephroid {

namespace {

// Everything that does not enter field by field is declared before the first template, which would not find it later.
void put(Digest& d, std::string const& text);
void put(Digest&, SourceLocation) {}
void put(Digest& d, ImageFile const& image);
void put(Digest& d, DataFile const& file);
void put(Digest& d, Material const& m);
void put(Digest& d, Group const& g);
template <class T>
void put(Digest& d, T const& x);

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

void put(Digest& d, std::string const& text) {
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
    if (!file.is_open()) return put(d, path);
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
void put(Digest& d, ImageFile const& image) {
    auto const& [path, encoding, where] = image;
    put(d, encoding);
    put_contents(d, path);
}
void put(Digest& d, DataFile const& file) {
    auto const& [path, where] = file;
    put_contents(d, path);
}

/// All fields but the one at `skipped`.
template <PlainStruct T>
void put_fields_except(Digest& d, T const& x, void const* skipped) {
    for_each_field(x, [&](auto const& field) {
        if (static_cast<void const*>(&field) != skipped) put(d, field);
    });
}
// Names are for people.
void put(Digest& d, Material const& m) { put_fields_except(d, m, &m.name); }
void put(Digest& d, Group const& g) { put_fields_except(d, g, &g.name); }

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
        std::visit([&d](auto const& alternative) { put(d, alternative); }, x);
    } else {
        for_each_field(x, [&d](auto const& field) { put(d, field); });
    }
}

}  // namespace

std::string hash(Scene const& scene) {
    // A new field of Scene does not compile here until it is decided whether it shapes the picture.
    auto const& [files, notes, camera, settings, images, textures, materials, lights, groups, image_ids] =
        scene;
    Digest d;
    put(d, camera);
    put(d, images);
    put(d, textures);
    put(d, materials);
    put(d, lights);
    put(d, groups);
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
    put(d, shaping);
    return d.hex();
}

}  // namespace nephroid
