#include "image/file.h"

#include "math/error.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace nephroid {

namespace {

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail(std::filesystem::path const& path, std::string const& what, int error) {
    throw Error(ErrorKind::Io, path.string() + ": " + what + ": " + reason(error));
}

/// A file descriptor that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor const&) = delete;
    Descriptor& operator=(Descriptor const&) = delete;
    [[nodiscard]] int get() const { return fd_; }
    /// The error of close(2) counts: network file systems report a full disk there.
    int close() {
        int const result = fd_ >= 0 ? ::close(fd_) : 0;
        fd_ = -1;
        return result;
    }

  private:
    int fd_;
};

int open_retrying(char const* path, int flags, mode_t mode = 0) {
    int fd = -1;
    do fd = ::open(path, flags | O_CLOEXEC, mode);
    while (fd < 0 && errno == EINTR);
    return fd;
}

template <class Buffer>
Buffer read_whole(std::filesystem::path const& path, std::size_t limit) {
    // O_NONBLOCK: opening a FIFO without a writer would wait for ever.
    Descriptor const file(open_retrying(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY));
    if (file.get() < 0) fail(path, "cannot open the file", errno);
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) fail(path, "cannot examine the file", errno);
    if (!S_ISREG(info.st_mode))
        throw Error(ErrorKind::Io,
                    path.string() + (S_ISDIR(info.st_mode) ? ": is a folder; name a file"
                                                           : ": is not a regular file; name one"));
    auto const size = static_cast<std::size_t>(info.st_size);
    if (size > limit)
        throw Error(ErrorKind::Limit, path.string() + ": the file has " + std::to_string(size) +
                                          " bytes; at most " + std::to_string(limit) + " are read");
    Buffer data;
    data.resize(size);
    std::size_t done = 0;
    while (done < size) {
        ssize_t const n = ::read(file.get(), data.data() + done, size - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail(path, "cannot read the file", errno);
        if (n == 0) break;  // shrunk meanwhile
        done += static_cast<std::size_t>(n);
    }
    data.resize(done);
    return data;
}

/// FNV-1a of the target's name: short, so that it fits where a long target just fits.
std::string temporary_name(std::filesystem::path const& target) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (char const c : target.filename().string()) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    // A leading dot hides it from patterns such as *.exr.
    std::string name = ".nephroid-";
    for (int shift = 60; shift >= 0; shift -= 4) name += "0123456789abcdef"[(h >> shift) & 15u];
    return name + ".tmp";
}

/// Opens and locks `path`; -1 when another process is at it, or when that cannot be told.
int open_locked(std::filesystem::path const& path) {
    for (int attempt = 0; attempt < 10; ++attempt) {
        int const fd = open_retrying(path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK, 0666);
        if (fd < 0) return -1;
        struct stat mine {
        }, named{};
        bool const locked = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
        // Whoever had the lock before may have renamed the file since it was opened here.
        bool const still_there = locked && ::fstat(fd, &mine) == 0 && ::stat(path.c_str(), &named) == 0 &&
                                 mine.st_ino == named.st_ino && mine.st_dev == named.st_dev;
        // Left by a writer that was killed, or new: ours, and under no other name.
        bool const free_to_use =
            still_there && S_ISREG(mine.st_mode) && mine.st_nlink == 1 && mine.st_uid == ::geteuid();
        if (free_to_use && ::ftruncate(fd, 0) == 0) return fd;
        ::close(fd);
        if (!locked) return -1;
    }
    return -1;
}

}  // namespace

std::filesystem::path write_target(std::filesystem::path const& path) {
    std::filesystem::path target = path;
    std::error_code error;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(target, error); ++links) {
        auto const next = std::filesystem::read_symlink(target, error);
        if (error) break;
        target = target.parent_path() / next;  // an absolute one replaces
    }
    return target;
}

NewFile::NewFile(std::filesystem::path path) : path_(std::move(path)), target_(write_target(path_)) {
    if (!path_.has_filename()) throw Error(ErrorKind::Io, path_.string() + ": names no file to write to");
    struct stat old {};
    bool const exists = ::stat(target_.c_str(), &old) == 0;
    if (exists && !S_ISREG(old.st_mode))
        throw Error(ErrorKind::Io, path_.string() + (S_ISDIR(old.st_mode)
                                                         ? ": is a folder; name a file to write to"
                                                         : ": is not a regular file; name one to write to"));
    open_temporary();
    if (exists) (void)::fchmod(fd_, old.st_mode & 07777);
}

void NewFile::open_temporary() {
    temporary_ = target_.parent_path() / temporary_name(target_);
    fd_ = open_locked(temporary_);
    static std::atomic<unsigned> counter{0};
    for (int attempt = 0; fd_ < 0 && attempt < 100; ++attempt) {
        std::string const name =
            ".nephroid-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
        temporary_ = target_.parent_path() / name;
        fd_ = open_retrying(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (fd_ < 0 && errno != EEXIST) fail(path_, "cannot create a file in that folder", errno);
    }
    if (fd_ < 0) fail(path_, "cannot create a file in that folder", errno);
}

NewFile::~NewFile() {
    if (fd_ < 0) return;
    if (!temporary_.empty()) ::unlink(temporary_.c_str());  // before the lock goes
    ::close(fd_);
}

bool NewFile::write(std::span<std::byte const> data) {
    while (error_ == 0 && !data.empty()) {
        ssize_t const n = ::write(fd_, data.data(), data.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0)
            error_ = errno;
        else
            data = data.subspan(static_cast<std::size_t>(n));
    }
    return error_ == 0;
}

bool NewFile::seek(std::uint64_t position) {
    if (error_ == 0 && ::lseek(fd_, static_cast<off_t>(position), SEEK_SET) < 0) error_ = errno;
    return error_ == 0;
}

void NewFile::commit() {
    if (error_ != 0) fail(path_, "cannot write the file", error_);
    // Network file systems report a full disk here.
    int result = 0;
    do result = ::fsync(fd_);
    while (result != 0 && errno == EINTR);
    if (result != 0 && errno != EINVAL && errno != ENOTSUP)
        fail(path_, "cannot write the file to disk", errno);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, "cannot replace the file", errno);
    temporary_.clear();
    ::close(fd_);
    fd_ = -1;
    // Until the folder is synced the new name may be lost in a power cut. Not every file system can; the data is safe.
    auto const folder_path = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
    Descriptor const folder(open_retrying(folder_path.c_str(), O_RDONLY | O_DIRECTORY));
    if (folder.get() >= 0) (void)::fsync(folder.get());
}

std::vector<std::byte> read_file(std::filesystem::path const& path, std::size_t limit) {
    return read_whole<std::vector<std::byte>>(path, limit);
}

std::string read_text_file(std::filesystem::path const& path, std::size_t limit) {
    return read_whole<std::string>(path, limit);
}

void write_file_atomically(std::filesystem::path const& path, std::span<std::byte const> data) {
    NewFile file(path);
    file.write(data);
    file.commit();
}

}  // namespace nephroid
