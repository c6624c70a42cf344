#include "film/checkpoint.h"

#include "film/develop.h"
#include "image/file.h"
#include "math/error.h"
#include "random_film.h"

#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>

using namespace nephroid;

namespace {

/// Runs f in a child, which ends without destructors and without doctest.
pid_t spawn(std::function<int()> const& f) {
    pid_t const child = ::fork();
    if (child == 0) ::_exit(f());
    return child;
}

void damage(std::filesystem::path const& path) {
    auto bytes = read_file(path);
    bytes[bytes.size() / 2] ^= std::byte{0x10};
    write_file_atomically(path, bytes);
}

void io_error(std::function<void()> const& f) {
    try {
        f();
        FAIL_CHECK("no error");
    } catch (Error const& e) {
        CHECK(e.kind() == ErrorKind::Io);
    }
}

}  // namespace

TEST_CASE("checkpoints keep two generations; a damaged one is refused and the other is offered by name") {
    TestFolder const folder;
    auto const path = folder / "c.film.exr";
    auto const previous = folder / "c.film.exr.previous";
    Film const one = film_of({0, 1}), two = film_of({0, 2}), three = film_of({0, 3});
    auto const refused = [&](ErrorKind kind, std::string const& offer) {
        try {
            (void)read_checkpoint(path);
            FAIL_CHECK("read");
        } catch (Error const& e) {
            std::string const what = e.what();
            CAPTURE(what);
            CHECK(e.kind() == kind);
            CHECK(what.starts_with(path.string()));
            CHECK((what.find("--resume") != std::string::npos) == !offer.empty());
            CHECK(what.find(offer) != std::string::npos);
        }
    };
    write_checkpoint(path, one);
    CHECK(same_bits(read_checkpoint(path), one));
    CHECK_FALSE(std::filesystem::exists(previous));
    write_checkpoint(path, two);
    write_checkpoint(path, three, true);
    CHECK(same_bits(read_checkpoint(path), three));
    CHECK(same_bits(read_film(previous), two));
    CHECK_FALSE(std::filesystem::exists(folder / "c.film.exr.next"));
    damage(path);
    refused(ErrorKind::Input, "--resume " + previous.string());
    std::filesystem::remove(path);
    refused(ErrorKind::Io, "--resume " + previous.string());
    damage(previous);
    refused(ErrorKind::Io, "");
    io_error([&] { (void)read_checkpoint(folder / "none"); });
}

TEST_CASE("a damaged checkpoint does not take the place of the whole one before it") {
    TestFolder const folder;
    auto const path = folder / "c.film.exr";
    auto const previous = folder / "c.film.exr.previous";
    Film const two = film_of({0, 2}), three = film_of({0, 3}), four = film_of({0, 4});
    write_checkpoint(path, two);
    write_checkpoint(path, three);
    damage(path);
    write_checkpoint(path, four);
    CHECK(same_bits(read_film(path), four));
    CHECK(same_bits(read_film(previous), two));
    // The same when the newest is missing.
    std::filesystem::remove(path);
    write_checkpoint(path, three);
    CHECK(same_bits(read_film(path), three));
    CHECK(same_bits(read_film(previous), two));
    // Taken away behind the back of the one who wrote it.
    std::filesystem::remove(path);
    write_checkpoint(path, four, true);
    CHECK(same_bits(read_film(path), four));
}

TEST_CASE("the other generation must be of the same render, if one asks") {
    TestFolder const folder;
    auto const path = folder / "c.film.exr";
    Film const two = film_of({0, 2});
    write_checkpoint(path, two);
    write_checkpoint(path, film_of({0, 3}));
    FilmHeader like = two.header();
    CHECK(other_generation(path, &like) == folder / "c.film.exr.previous");
    like.identity.seed += 1;
    CHECK(other_generation(path, &like).empty());
    CHECK(other_generation(path) == folder / "c.film.exr.previous");
}

TEST_CASE("kill -9 at any moment leaves a whole checkpoint") {
    int const kills = std::getenv("NEPHROID_KILLS") ? std::atoi(std::getenv("NEPHROID_KILLS")) : 120;
    TestFolder const folder;
    auto const path = folder / "c.film.exr";
    std::mt19937 random(2024);
    write_checkpoint(path, film_of({0, 1}));
    std::uint64_t done = 1;  // passes that the checkpoint holds
    for (int kill = 0; kill < kills; ++kill) {
        pid_t const child = spawn([&] {
            for (Film film = read_checkpoint(path);;) {
                render_test_pass(film, film.passes().count());
                write_checkpoint(path, film);
            }
            return 0;
        });
        REQUIRE(child > 0);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 20000));
        ::kill(child, SIGKILL);
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        REQUIRE(WIFSIGNALED(status));             // it did not end by an error of its own
        Film const film = read_checkpoint(path);  // whole at any moment: two names change places in one step
        // Nothing that was there before is lost.
        CHECK(film.passes().count() >= done);
        CHECK(film.passes() == PassSet(PassRange{0, film.passes().count()}));
        done = film.passes().count();
    }
    MESSAGE(kills << " kills, " << done << " passes");
    // What was resumed that often is the film that was never interrupted.
    CHECK(same_bits(read_checkpoint(path), film_of({0, done})));
}

TEST_CASE("a write that fails says so and leaves the checkpoint as it was") {
    TestFolder const folder;
    auto const path = folder / "c.film.exr";
    Film const one = film_of({0, 1}), two = film_of({0, 2});
    io_error([&] { write_checkpoint(folder / "missing" / "c.film.exr", one); });
    write_checkpoint(path, one);
    io_error([&] { write_checkpoint(path / "c.film.exr", two); });  // the folder is a file
    std::filesystem::create_directory(folder / "folder");
    io_error([&] { write_checkpoint(folder / "folder", two); });
    if (::geteuid() != 0) {  // nothing is read-only for root
        std::filesystem::permissions(folder.path,
                                     std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
        io_error([&] { write_checkpoint(path, two); });
        std::filesystem::permissions(folder.path, std::filesystem::perms::owner_all);
    }
    // A full disk, played by a limit on the size of files.
    pid_t const child = spawn([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        rlimit const limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_checkpoint(path, two);
        } catch (Error const& e) {
            return e.kind() == ErrorKind::Io ? 42 : 2;
        }
        return 1;
    });
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 42);
    CHECK(same_bits(read_checkpoint(path), one));
    std::size_t files = 0;
    for ([[maybe_unused]] auto const& entry : std::filesystem::directory_iterator(folder.path)) ++files;
    CHECK(files == 2);  // the checkpoint and the folder: no litter
}
