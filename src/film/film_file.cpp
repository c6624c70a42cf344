// Films on disk: an EXR file that any viewer shows, with the exact bits of every sum beside the picture.
#include "beauty.h"
#include "film/develop.h"
#include "image/exr.h"
#include "math/error.h"
#include "planes.h"

#include <bit>
#include <charconv>

namespace nephroid {

namespace {

constexpr char const* kVersion = "3";
std::string const kPrefix = "film.";
std::string const kWords = "nephroid.option ";

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

/// The halves of each word as planes of the file, where they lie in the sums: nothing is copied.
static_assert(std::endian::native == std::endian::little);
template <class Plane, class Sums, std::size_t N>
void add_planes(std::vector<Plane>& planes, std::array<char const*, N> const& names, Sums& sums) {
    using Byte = std::remove_reference_t<decltype(*Plane::base)>;
    auto* const base = reinterpret_cast<Byte*>(sums.data());
    for (std::size_t k = 0; k < N; ++k) {
        std::string const name = kPrefix + names[k];
        planes.push_back({name + ".lo", ExrChannel::Type::Uint, base + 8 * k, sizeof(sums[0])});
        planes.push_back({name + ".hi", ExrChannel::Type::Uint, base + 8 * k + 4, sizeof(sums[0])});
    }
}

template <class Sums>
void add_words(Checksum& sum, std::vector<Sums> const& sums, std::size_t words) {
    for (Sums const& s : sums)
        for (std::size_t k = 0; k < words; ++k) sum.word(get_word(s, k));
}

FilmHeader header_of(ExrFile const& file, std::filesystem::path const& path) {
    if (std::string const version = attribute(file, "film", path); version != kVersion)
        refuse(path, "is a film of version " + version + ", and only version " + kVersion +
                         " is known: use the program that wrote it");
    FilmHeader h;
    h.identity = {attribute(file, "scene", path), attribute(file, "settings", path),
                  number(file, "seed", path)};
    h.resolution = {file.display_width, file.display_height};
    h.crop = {file.data_x0, file.data_x0 + file.width, file.data_y0, file.data_y0 + file.height};
    h.aovs = number(file, "aovs", path) != 0;
    h.passes = PassSet::parse(attribute(file, "passes", path));
    h.dropped = number(file, "dropped", path);
    h.rejected = number(file, "rejected", path);
    for (auto const& [name, value] : file.attributes)
        if (name.starts_with(kWords)) h.words[name.substr(kWords.size())] = value;
    return h;
}

/// Calls f(); whatever is wrong with the file is said with its name, as bad input.
template <class F>
auto reading_film(std::filesystem::path const& path, F&& f) {
    try {
        return f();
    } catch (Error const& e) {
        if (e.kind() == ErrorKind::Io) throw;
        // A damaged header may claim any size: to the user that is a bad file, not a limit.
        std::string const message = e.what();
        if (message.starts_with(path.string())) throw Error(ErrorKind::Input, message);
        refuse(path, "the film is damaged: " + message);
    }
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
        sum.word(film.rejected_);
        for (int const v : {film.resolution_.x, film.resolution_.y, film.crop_[0], film.crop_[1],
                            film.crop_[2], film.crop_[3], int{film.has_aovs()}})
            sum.word(static_cast<std::uint64_t>(v));
        add_words(sum, film.pixels_, kPixelWords.size());
        add_words(sum, film.aovs_, kAovWords.size());
        for (AovSums const& s : film.aovs_) sum.word(s.material);
        return hex(sum.value());
    }

    static void write(std::filesystem::path const& path, Film const& film, DevelopSettings const& settings) {
        ExrFile file = develop_beauty_exr(film, settings);
        file.attributes["nephroid.film"] = kVersion;
        file.attributes["nephroid.aovs"] = film.has_aovs() ? "1" : "0";
        file.attributes["nephroid.checksum"] = checksum(film);
        for (auto const& [option, value] : film.words_) file.attributes[kWords + option] = value;
        std::vector<ExrSourcePlane> planes;
        add_film(planes, film);
        write_exr(path, file, planes, ExrCompression::Fast);
    }

    static Film read(std::filesystem::path const& path) {
        Film film;
        ExrFile const file = read_exr(path, [&](ExrFile const& header) {
            FilmHeader h = header_of(header, path);
            film = Film(h.resolution, h.crop, h.aovs, h.identity);
            film.passes_ = std::move(h.passes);
            film.dropped_ = h.dropped;
            film.rejected_ = h.rejected;
            film.words_ = std::move(h.words);
            std::vector<ExrTargetPlane> planes;
            add_film(planes, film);
            for (ExrTargetPlane const& plane : planes) {
                ExrChannel const* channel = header.find(plane.name);
                if (!channel || channel->type != ExrChannel::Type::Uint)
                    refuse(path,
                           "the film is damaged: channel " + plane.name + " is missing; use another copy");
            }
            return planes;
        });
        if (checksum(film) != attribute(file, "checksum", path))
            refuse(path, "the film is damaged: its checksum does not fit; use another copy");
        return film;
    }

  private:
    template <class Plane, class F>
    static void add_film(std::vector<Plane>& planes, F& film) {
        using Byte = std::remove_reference_t<decltype(*Plane::base)>;
        add_planes(planes, kPixelWords, film.pixels_);
        if (!film.has_aovs()) return;
        add_planes(planes, kAovWords, film.aovs_);
        planes.push_back({kPrefix + "material.id", ExrChannel::Type::Uint,
                          reinterpret_cast<Byte*>(&film.aovs_.front().material), sizeof(AovSums)});
    }
};

void write_film(std::filesystem::path const& path, Film const& film, DevelopSettings const& settings) {
    FilmFile::write(path, film, settings);
}

Film read_film(std::filesystem::path const& path) {
    return reading_film(path, [&] { return FilmFile::read(path); });
}

FilmHeader read_film_header(std::filesystem::path const& path) {
    return reading_film(path, [&] { return header_of(read_exr_header(path), path); });
}

bool is_film(std::filesystem::path const& path) {
    try {
        return read_exr_header(path).attributes.contains("nephroid.film");
    } catch (Error const&) {
        return false;
    }
}

}  // namespace nephroid
