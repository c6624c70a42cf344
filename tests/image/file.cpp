#include "support.h"

#include <doctest/doctest.h>

#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace nephroid;
using test::bytes;
using test::error_of;
namespace fs = std::filesystem;

TEST_CASE("files are written whole and read back") {
    test::Folder const folder;
    write_file_atomically(folder / "a", bytes("first"));
    CHECK(read_text_file(folder / "a") == "first");
    write_file_atomically(folder / "a", bytes("second version"));
    CHECK(read_text_file(folder / "a") == "second version");
    write_file_atomically(folder / "empty", {});
    CHECK(read_file(folder / "empty").empty());
    CHECK(folder.entries() == 2);
    std::string message;
    CHECK(error_of([&] { read_file(folder / "a", 4); }, &message) == ErrorKind::Limit);
    CHECK(message.find((folder / "a").string()) == 0);
}

TEST_CASE("only regular files are read: no folders, devices or pipes, and without waiting for one") {
    test::Folder const folder;
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    for (fs::path const& path :
         {folder / "pipe", folder.path(), fs::path("/dev/zero"), folder / "missing", fs::path("")})
        CHECK(error_of([&] { read_file(path); }) == ErrorKind::Io);
}

TEST_CASE("writing to impossible places fails and leaves everything as it was") {
    test::Folder const folder;
    fs::create_directory(folder / "directory");
    write_file_atomically(folder / "directory/inside", bytes("kept"));
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    for (fs::path const& path : {folder / "missing/a", folder / "directory", folder / "pipe",
                                 folder / "directory/", fs::path(""), folder / std::string(300, 'x')}) {
        std::string message;
        CHECK(error_of([&] { write_file_atomically(path, bytes("new")); }, &message) == ErrorKind::Io);
        CHECK(message.find(path.string() + ": ") == 0);
    }
    CHECK(read_text_file(folder / "directory/inside") == "kept");
    CHECK(folder.entries() == 2);
}

TEST_CASE("a disk that fills up leaves the old file and no litter") {
    test::Folder const folder;
    write_file_atomically(folder / "a", bytes("old"));
    rlimit old{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &old) == 0);
    rlimit small = old;
    small.rlim_cur = 4096;
    auto const handler = std::signal(SIGXFSZ, SIG_IGN);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    auto const error = error_of([&] { write_file_atomically(folder / "a", bytes(std::string(10000, 'n'))); });
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, handler);
    CHECK(error == ErrorKind::Io);
    CHECK(read_text_file(folder / "a") == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("permissions and symbolic links survive replacement") {
    test::Folder const folder;
    write_file_atomically(folder / "real", bytes("old"));
    fs::permissions(folder / "real", fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    fs::create_symlink("real", folder / "link");
    write_file_atomically(folder / "link", bytes("new"));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(read_text_file(folder / "real") == "new");
    CHECK(fs::status(folder / "real").permissions() ==
          (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read));
}

TEST_CASE("a symbolic link whose target is not there yet gets its target") {
    test::Folder const folder;
    fs::create_directory(folder / "deep");
    fs::create_symlink("deep/real", folder / "link");
    write_file_atomically(folder / "link", bytes("new"));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(read_text_file(folder / "deep/real") == "new");
    CHECK(write_target(folder / "link") == folder / "deep/real");
}

TEST_CASE("what a killed writer leaves is used up by the next one that writes the same file") {
    test::Folder const folder;
    write_file_atomically(folder / "a", bytes("old"));
    for (int i = 0; i < 3; ++i) {
        pid_t const child = ::fork();
        if (child == 0) {
            NewFile file(folder / "a");
            file.write(bytes("half of somethi"));
            ::kill(::getpid(), SIGKILL);
        }
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        CHECK(folder.entries() == 2);  // one leftover, however often
    }
    write_file_atomically(folder / "a", bytes("new"));
    CHECK(read_text_file(folder / "a") == "new");
    CHECK(folder.entries() == 1);
}

TEST_CASE("two writers of one file do not meet") {
    test::Folder const folder;
    {
        NewFile one(folder / "a"), two(folder / "a");
        one.write(bytes("one"));
        two.write(bytes("two, longer"));
        one.commit();
        CHECK(read_text_file(folder / "a") == "one");
        two.commit();
    }
    CHECK(read_text_file(folder / "a") == "two, longer");
    CHECK(folder.entries() == 1);
    { NewFile const given_up(folder / "a"); }
    CHECK(folder.entries() == 1);
}
