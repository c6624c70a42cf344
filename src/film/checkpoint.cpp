// Three steps: the new film goes to <path>.next, whole and synced; <path> becomes <path>.previous; <path>.next becomes
// <path>. Killed before the second step, <path> is whole; between the two, .previous and .next are; after the third,
// <path> is. .next is read too, because .previous may by then be a <path> that was damaged already. The new film is on
// the disk before any rename, so a power cut that keeps only some of the renames leaves a whole film as well.
#include "film/checkpoint.h"

#include "film/develop.h"
#include "math/error.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
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

/// Makes renames last through a power cut, where the file system can.
void sync_folder(std::filesystem::path const& file) {
    auto const folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    int const fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return;
    (void)::fsync(fd);
    ::close(fd);
}

}  // namespace

void write_checkpoint(std::filesystem::path const& path, Film const& film) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw Error(ErrorKind::Io, path.string() + ": is a folder; name a file for the checkpoint");
    auto const next = with_suffix(path, ".next");
    write_film(next, film, DevelopSettings{});
    if (std::filesystem::exists(std::filesystem::symlink_status(path, error)))
        rename_or_fail(path, with_suffix(path, ".previous"));
    rename_or_fail(next, path);
    sync_folder(path);
}

Film read_checkpoint(std::filesystem::path const& path, CheckpointSource* source) {
    std::string problem;
    ErrorKind kind = ErrorKind::Io;
    for (auto const& file : {path, with_suffix(path, ".next"), with_suffix(path, ".previous")}) {
        try {
            Film film = read_film(file);
            if (source) *source = {file, problem};
            return film;
        } catch (Error const& e) {
            if (file == path) problem = e.what(), kind = e.kind();
        }
    }
    throw Error(kind, problem + " (and there is no whole earlier checkpoint)");
}

}  // namespace nephroid
