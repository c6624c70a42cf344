// Films on disk: an EXR file that any viewer shows, with the exact bits of every sum beside the picture.
#include "beauty.h"
#include "film/develop.h"
#include "image/exr.h"
#include "math/error.h"
#include "planes.h"

#include <charconv>

namespace nephroid {

namespace {

constexpr char const* kVersion = "1";
std::string const kPrefix = "film.";

std::string hex(std::uint64_t v) {
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[i] = "0123456789abcdef"[(v >> (60 - 4 * i)) & 15u];
    return text;
}

[[noreturn]] void refuse(std::filesystem::path const& path, std::string const& message) {
    throw Error(ErrorKind::Input, path.string() + ": " + message);
}

std::string attribute(ExrFile const& file, std::string const& name, std::filesystem::path const& path) {
    auto const found = file.attributes.find("nephroid." + name);
    if (found == file.attributes.end())
        refuse(path,
               "is no film: its header does not hold nephroid." + name + "; give a film that `render` wrote");
    return found->second;
}

std::uint64_t number(ExrFile const& file, std::string const& name, std::filesystem::path const& path) {
    std::string const text = attribute(file, name, path);
    std::uint64_t n = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc{} || end != text.data() + text.size())
        refuse(path, "the film is damaged: nephroid." + name + " is no number; use another copy");
    return n;
}

std::vector<std::uint32_t> const& plane(ExrFile const& file, std::string const& name,
                                        std::filesystem::path const& path) {
    ExrChannel const* channel = file.find(kPrefix + name);
    if (!channel || channel->type != ExrChannel::Type::Uint)
        refuse(path, "the film is damaged: channel " + kPrefix + name + " is missing; use another copy");
    return channel->uints;
}

void add_plane(ExrFile& file, std::string const& name, std::vector<std::uint32_t> values) {
    file.channels.push_back(
        {.name = kPrefix + name, .type = ExrChannel::Type::Uint, .uints = std::move(values)});
}

template <class Sums, std::size_t N>
void write_words(ExrFile& file, std::array<char const*, N> const& names, std::vector<Sums> const& sums) {
    for (std::size_t k = 0; k < N; ++k) {
        std::vector<std::uint32_t> hi(sums.size()), lo(sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            std::uint64_t const w = get_word(sums[i], k);
            hi[i] = static_cast<std::uint32_t>(w >> 32);
            lo[i] = static_cast<std::uint32_t>(w);
        }
        add_plane(file, std::string(names[k]) + ".hi", std::move(hi));
        add_plane(file, std::string(names[k]) + ".lo", std::move(lo));
    }
}

template <class Sums, std::size_t N>
void read_words(ExrFile const& file, std::array<char const*, N> const& names, std::vector<Sums>& sums,
                std::filesystem::path const& path) {
    for (std::size_t k = 0; k < N; ++k) {
        auto const& hi = plane(file, std::string(names[k]) + ".hi", path);
        auto const& lo = plane(file, std::string(names[k]) + ".lo", path);
        for (std::size_t i = 0; i < sums.size(); ++i)
            set_word(sums[i], k, (std::uint64_t{hi[i]} << 32) | lo[i]);
    }
}

template <class Sums>
void add_words(Checksum& sum, std::vector<Sums> const& sums, std::size_t words) {
    for (Sums const& s : sums)
        for (std::size_t k = 0; k < words; ++k) sum.word(get_word(s, k));
}

/// What the EXR reader of the image room is ready to read; a film that could not be read again must not be written.
void require_readable_size(std::filesystem::path const& path, ExrFile const& file) {
    std::int64_t bytes = 0;
    for (ExrChannel const& c : file.channels) bytes += c.type == ExrChannel::Type::Half ? 2 : 4;
    bytes *= std::int64_t{file.width} * file.height;
    if (bytes > kMaxImageBytes)
        throw Error(ErrorKind::Limit,
                    path.string() + ": the film would take " + std::to_string(bytes >> 20) +
                        " MiB, and 2048 MiB is the most: render it in several crop windows");
}

}  // namespace

/// Reaches into films.
class FilmFile {
  public:
    static std::string checksum(Film const& film) {
        Checksum sum;
        sum.text(kVersion);
        sum.text(film.identity_.scene_hash);
        sum.text(film.identity_.settings_hash);
        sum.word(film.identity_.seed);
        sum.text(film.passes_.text());
        sum.word(film.dropped_);
        for (int const v : {film.resolution_.x, film.resolution_.y, film.crop_[0], film.crop_[1],
                            film.crop_[2], film.crop_[3], int{film.has_aovs()}})
            sum.word(static_cast<std::uint64_t>(v));
        add_words(sum, film.pixels_, kPixelWords.size());
        add_words(sum, film.aovs_, kAovWords.size());
        for (AovSums const& s : film.aovs_) sum.word(s.material);
        return hex(sum.value());
    }

    static ExrFile encode(Film const& film, DevelopSettings const& settings) {
        ExrFile file = develop_beauty_exr(film, settings);
        file.attributes["nephroid.film"] = kVersion;
        file.attributes["nephroid.aovs"] = film.has_aovs() ? "1" : "0";
        file.attributes["nephroid.checksum"] = checksum(film);
        write_words(file, kPixelWords, film.pixels_);
        if (film.has_aovs()) {
            write_words(file, kAovWords, film.aovs_);
            std::vector<std::uint32_t> ids;
            ids.reserve(film.aovs_.size());
            for (AovSums const& sums : film.aovs_) ids.push_back(sums.material);
            add_plane(file, "material.id", std::move(ids));
        }
        return file;
    }

    static Film decode(ExrFile const& file, std::filesystem::path const& path) {
        if (std::string const version = attribute(file, "film", path); version != kVersion)
            refuse(path, "is a film of version " + version + ", and only version " + kVersion +
                             " is known: use the program that wrote it");
        FilmIdentity identity{attribute(file, "scene", path), attribute(file, "settings", path),
                              number(file, "seed", path)};
        std::array<int, 4> const crop{file.data_x0, file.data_x0 + file.width, file.data_y0,
                                      file.data_y0 + file.height};
        Film film({file.display_width, file.display_height}, crop, number(file, "aovs", path) != 0,
                  std::move(identity));
        film.passes_ = PassSet::parse(attribute(file, "passes", path));
        film.dropped_ = number(file, "dropped", path);
        read_words(file, kPixelWords, film.pixels_, path);
        if (film.has_aovs()) {
            read_words(file, kAovWords, film.aovs_, path);
            auto const& ids = plane(file, "material.id", path);
            for (std::size_t i = 0; i < film.aovs_.size(); ++i) film.aovs_[i].material = ids[i];
        }
        if (checksum(film) != attribute(file, "checksum", path))
            refuse(path, "the film is damaged: its checksum does not fit; use another copy");
        return film;
    }
};

void write_film(std::filesystem::path const& path, Film const& film, DevelopSettings const& settings) {
    ExrFile const file = FilmFile::encode(film, settings);
    require_readable_size(path, file);
    write_exr(path, file);
}

Film read_film(std::filesystem::path const& path) {
    try {
        return FilmFile::decode(read_exr(path), path);
    } catch (Error const& e) {
        if (e.kind() == ErrorKind::Io) throw;
        // A damaged header may claim any size: to the user that is a bad file, not a limit.
        std::string const message = e.what();
        if (message.starts_with(path.string())) throw Error(ErrorKind::Input, message);
        refuse(path, "the film is damaged: " + message);
    }
}

}  // namespace nephroid
