// The new film goes to <path>.next, whole and synced, and then changes places with <path> in one step; what is now .next
// becomes <path>.previous. Killed at any moment, <path> is whole. Where the file system cannot exchange two names, two
// renames do it, and killed between them .next and .previous are whole.
#include "film/checkpoint.h"

#include "film/develop.h"
#include "math/error.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <stdio.h>  // renameat2
#include <unistd.h>

namespace nephroid {

namespace {

std::filesystem::path with_suffix(std::filesystem::path path, char const* suffix) { return path += suffix; }

void rename_or_fail(std::filesystem::path const& from, std::filesystem::path const& to) {
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (error)
        throw Error(ErrorKind::Io, to.string() + ": cannot put the checkpoint in place: " + error.message());
}

/// Puts next where path is, and what was there to previous.
void rotate(std::filesystem::path const& next, std::filesystem::path const& path) {
    auto const previous = with_suffix(path, ".previous");
    if (::renameat2(AT_FDCWD, next.c_str(), AT_FDCWD, path.c_str(), RENAME_EXCHANGE) == 0)
        return rename_or_fail(next, previous);
    std::error_code error;
    if (std::filesystem::exists(path, error))
        rename_or_fail(path, previous);  // someone may have taken it away
    rename_or_fail(next, path);
}

bool is_whole(std::filesystem::path const& path) {
    try {
        (void)read_film(path);
        return true;
    } catch (Error const&) {
        return false;
    }
}

/// Makes renames last through a power cut, where the file system can.
void sync_folder(std::filesystem::path const& file) {
    auto const folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    int const fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return;
    (void)::fsync(fd);
    ::close(fd);
}

}  // namespace

void write_checkpoint(std::filesystem::path const& path, Film const& film, bool newest_is_whole) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw Error(ErrorKind::Io, path.string() + ": is a folder; name a file for the checkpoint");
    auto const next = with_suffix(path, ".next");
    write_film(next, film, DevelopSettings{});
    if (newest_is_whole || is_whole(path)) {
        rotate(next, path);
    } else {
        rename_or_fail(next, path);
    }
    sync_folder(path);
}

std::filesystem::path other_generation(std::filesystem::path const& path, FilmHeader const* like) {
    std::filesystem::path best;
    std::uint64_t passes = 0;
    for (char const* suffix : {".next", ".previous"}) {
        auto const file = with_suffix(path, suffix);
        try {
            FilmHeader const header = read_film(file).header();
            if (like && !difference(header, *like).empty()) continue;
            if (best.empty() || header.passes.count() > passes) best = file, passes = header.passes.count();
        } catch (Error const&) {
            // Neither is an error by itself.
        }
    }
    return best;
}

Film read_checkpoint(std::filesystem::path const& path) {
    try {
        return read_film(path);
    } catch (Error const& e) {
        auto const other = other_generation(path);
        if (other.empty()) throw;
        throw Error(e.kind(),
                    std::string(e.what()) + "; another generation is whole: --resume " + other.string());
    }
}

}  // namespace nephroid
