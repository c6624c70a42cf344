#include "film/develop.h"
#include "image/file.h"
#include "image/read.h"
#include "math/error.h"
#include "random_film.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstdlib>
#include <limits>
#include <optional>

using namespace nephroid;

namespace {

void refused(std::filesystem::path const& path, std::string const& why, ErrorKind kind = ErrorKind::Input) {
    try {
        (void)read_film(path);
        FAIL_CHECK("read: " << why);
    } catch (Error const& e) {
        std::string const what = e.what();
        CAPTURE(what);
        CHECK(e.kind() == kind);
        CHECK(what.starts_with(path.string()));
        CHECK(what.find(why) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("films come back from disk to the bit") {
    TestFolder const folder;
    for (bool const aovs : {false, true}) {
        Film film = film_of({3, 9}, false, aovs);
        film.finish_pass(100);
        // Bits that arithmetic would not keep.
        film.pixel(2, 1).rgb = {-0.0, std::numeric_limits<double>::denorm_min(), std::nextafter(1.0, 2.0)};
        film.pixel(3, 1).samples = ~0ull - 1;
        write_film(folder / "a.film.exr", film, {});
        CHECK(same_bits(read_film(folder / "a.film.exr"), film));
        // Any viewer shows the beauty.
        Image const picture = read_image(folder / "a.film.exr");
        CHECK(picture.get(4, 4, 1) == half_to_float(float_to_half(develop(film).get(4, 4, 1))));
    }
    Film const none = empty_film();
    write_film(folder / "none.film.exr", none, {.half_float = false});
    CHECK(same_bits(read_film(folder / "none.film.exr"), none));
}

TEST_CASE("a film's header is read without its sums, and says what the film says") {
    TestFolder const folder;
    Film film = film_of({3, 9});
    film.add_rejected(5);
    film.describe({{"--color", "rgb"}, {"--set maxdepth", "5"}});
    write_film(folder / "a", film, {});
    for (FilmHeader const& h : {read_film_header(folder / "a"), read_film(folder / "a").header()}) {
        CHECK(difference(h, film.header()).empty());
        CHECK(h.passes == film.passes());
        CHECK(h.dropped == film.dropped());
        CHECK(h.rejected == 5);
        CHECK(h.words == SettingWords{{"--color", "rgb"}, {"--set maxdepth", "5"}});
        CHECK(h.aovs);
    }
    CHECK(is_film(folder / "a"));
    write_picture(folder / "picture.exr", film, {});
    CHECK_FALSE(is_film(folder / "picture.exr"));
    CHECK_FALSE(is_film(folder / "nowhere"));
}

TEST_CASE("merging films from disk is merging them in memory") {
    TestFolder const folder;
    Film const a = film_of({0, 4}), b = film_of({4, 7});
    write_film(folder / "a", a, {});
    write_film(folder / "b", b, {});
    CHECK(same_bits(merge(read_film(folder / "a"), read_film(folder / "b")), merge(a, b)));
}

TEST_CASE("the same film makes the same file") {
    TestFolder const folder;
    write_film(folder / "a", film_of({0, 4}, true), {});
    write_film(folder / "b", merge(film_of({2, 4}, true), film_of({0, 2}, true)), {});
    CHECK(read_file(folder / "a") == read_file(folder / "b"));
}

TEST_CASE("a flipped bit is noticed or harmless, wherever it is") {
    TestFolder const folder;
    Film const film = film_of({0, 4});
    write_film(folder / "good", film, {});
    std::vector<std::byte> const good = read_file(folder / "good");
    std::mt19937 random(11);
    std::size_t const header = 4000;  // attributes and channel names: hit as often as all the rest
    int noticed = 0;
    for (int i = 0; i < 400; ++i) {
        std::vector<std::byte> bad = good;
        std::size_t const at = random() % (i % 2 == 0 ? bad.size() : std::min(header, bad.size()));
        bad[at] ^= std::byte{1} << (random() % 8);
        write_file_atomically(folder / "bad", bad);
        CAPTURE(at);
        std::optional<Film> read;
        try {
            read = read_film(folder / "bad");
        } catch (Error const& e) {
            ++noticed;
            CHECK(e.kind() == ErrorKind::Input);
            CHECK(std::string(e.what()).find((folder / "bad").string()) != std::string::npos);
        }
        if (read) CHECK(same_bits(*read, film));
    }
    CHECK(noticed > 200);
}

TEST_CASE("truncated and foreign files are refused by name") {
    TestFolder const folder;
    Film const film = film_of({0, 4});
    write_film(folder / "good", film, {});
    std::vector<std::byte> const good = read_file(folder / "good");
    for (int i = 0; i < 50; ++i) {
        std::size_t const size = good.size() * static_cast<std::size_t>(i) / 50;
        write_file_atomically(folder / "cut", std::span(good).first(size));
        refused(folder / "cut", "");
    }
    std::string const text = "not a film";
    write_file_atomically(folder / "text", std::as_bytes(std::span(text)));
    refused(folder / "text", "no EXR");
    write_picture(folder / "picture.exr", film, {});
    refused(folder / "picture.exr", "is no film");
    refused(folder / "nowhere", "", ErrorKind::Io);
    refused(folder.path, "", ErrorKind::Io);

    ExrFile forged = read_exr(folder / "good");
    for (std::string const old : {"1", "2"}) {
        forged.attributes["nephroid.film"] = old;
        write_exr(folder / "version", forged);
        refused(folder / "version", "version " + old);
    }
    std::pair<char const*, char const*> const lies[] = {
        {"passes", "0:5"}, {"dropped", "99"}, {"rejected", "1"}, {"seed", "8"},
        {"scene", "x"},    {"settings", "x"}, {"aovs", "0"},     {"checksum", "0"}};
    for (auto const& [name, value] : lies) {
        forged = read_exr(folder / "good");
        forged.attributes[std::string("nephroid.") + name] = value;
        write_exr(folder / "lie", forged);
        refused(folder / "lie", "checksum");
    }
    for (char const* moved : {"data", "display"}) {
        forged = read_exr(folder / "good");
        (moved == std::string("data") ? forged.data_x0 : forged.display_width) += 1;
        write_exr(folder / "moved", forged);
        refused(folder / "moved", "checksum");
    }
    forged = read_exr(folder / "good");
    forged.attributes["nephroid.passes"] = "nonsense";
    write_exr(folder / "nonsense", forged);
    refused(folder / "nonsense", "no set of passes");
    forged = read_exr(folder / "good");
    std::erase_if(forged.channels, [](ExrChannel const& c) { return c.name == "film.weight.lo"; });
    write_exr(folder / "channel", forged);
    refused(folder / "channel", "film.weight.lo");
    forged = read_exr(folder / "good");
    forged.display_width = 3;
    write_exr(folder / "window", forged);
    refused(folder / "window", "crop window");
}

TEST_CASE("a film of more than 2 GiB is written and read like any other (NEPHROID_FULL)") {
    if (!std::getenv("NEPHROID_FULL")) return;
    TestFolder const folder;
    Film film({5000, 4300}, {0, 5000, 0, 4300}, false, test_identity());
    REQUIRE(film_bytes(5000 * 4300, false) > std::uint64_t{1900} << 20);
    for (int y = 0; y < 4300; y += 7) film.add(y, y, {1, 2, static_cast<float>(y)}, 1);
    film.finish_pass(0);
    write_film(folder / "a", film, {});
    Film const back = read_film(folder / "a");
    CHECK(back.pixel(4200, 4200).rgb[2] == 4200);
    CHECK(back.passes() == film.passes());
}
