#include "model/pictures.h"

#include "image/read.h"

#include <sys/stat.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace nephroid {

namespace {

std::optional<Encoding> encoding_of(Scene const& scene, ImageFile const& file) {
    if (file.encoding.empty()) return std::nullopt;
    if (file.encoding == "linear") return Encoding::linear();
    if (file.encoding == "sRGB") return Encoding::srgb();
    if (file.encoding.rfind("gamma ", 0) == 0) {
        float const g = std::strtof(file.encoding.c_str() + 6, nullptr);
        if (g > 0.0f && std::isfinite(g)) return Encoding::power(g);
    }
    scene.fail(file.where, "unknown encoding \"" + file.encoding + "\"; use linear, sRGB or gamma <number>");
}

/// What a file is, whatever it is called: its device and its number there, or its path where it is not found.
using FileKey = std::tuple<dev_t, ino_t, std::string>;
FileKey key_of(std::string const& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return {0, 0, path};
    return {status.st_dev, status.st_ino, {}};
}

using EncodingKey = std::tuple<Encoding::Kind, float>;

}  // namespace

Pictures::Pictures(Scene const& scene) {
    std::map<FileKey, std::map<EncodingKey, std::uint32_t>> known;
    for (ImageFile const& file : scene.images) {
        std::optional<Encoding> const named = encoding_of(scene, file);
        try {
            Encoding const encoding =
                stores_light(file.path) ? Encoding::linear() : named.value_or(Encoding::srgb());
            auto& same_file = known[key_of(file.path)];
            auto const [entry, is_new] = same_file.try_emplace({encoding.kind, encoding.gamma},
                                                               static_cast<std::uint32_t>(pyramids_.size()));
            slots_.push_back(entry->second);
            if (!is_new) continue;
            if (same_file.size() == 1) ++files_;
            Image image;
            for (auto const& [other_encoding, slot] : same_file) {
                if (slot >= pyramids_.size()) continue;  // the new one itself
                Image const& other = pyramids_[slot].level(0);
                if (other.format() == PixelFormat::U8) image = other.with_encoding(encoding);
            }
            bool const shared = !image.empty();
            if (!shared) {
                image = read_image(file.path, encoding);
                sanitize(image);
                store_as_halves_if_exact(image);
            }
            pyramids_.emplace_back(std::move(image));
            Pyramid const& made = pyramids_.back();
            bytes_ += made.bytes() - (shared ? made.level(0).bytes() : 0);
        } catch (Error const& e) {
            throw Error(e.kind(), scene.locate(file.where) + ": " + e.what());
        }
    }
}

}  // namespace nephroid
