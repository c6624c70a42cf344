#include "image/file.h"

#include "math/error.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include <fcntl.h>
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

/// A temporary file that removes itself unless it was renamed to its target.
class Temporary {
  public:
    Temporary(std::filesystem::path const& target, mode_t mode) {
        static std::atomic<unsigned> counter{0};
        for (int attempt = 0; attempt < 100; ++attempt) {
            // A leading dot hides it from patterns such as *.exr; a short name fits where a long target just fits.
            std::string const name =
                ".nephroid-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
            path_ = target.parent_path() / name;
            fd_ = open_retrying(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL, mode);
            if (fd_ >= 0 || errno != EEXIST) break;
        }
        if (fd_ < 0) fail(target, "cannot create a file in that folder", errno);
    }
    ~Temporary() {
        if (fd_ >= 0) ::close(fd_);
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    Temporary(Temporary const&) = delete;
    Temporary& operator=(Temporary const&) = delete;

    void write(std::filesystem::path const& target, std::span<std::byte const> data) {
        while (!data.empty()) {
            ssize_t const n = ::write(fd_, data.data(), data.size());
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) fail(target, "cannot write the file", errno);
            data = data.subspan(static_cast<std::size_t>(n));
        }
    }
    void keep_mode(mode_t mode) { (void)::fchmod(fd_, mode); }
    void sync_and_close(std::filesystem::path const& target) {
        int result = 0;
        do result = ::fsync(fd_);
        while (result != 0 && errno == EINTR);
        if (result != 0 && errno != EINVAL && errno != ENOTSUP)
            fail(target, "cannot write the file to disk", errno);
        int const fd = fd_;
        fd_ = -1;
        if (::close(fd) != 0 && errno != EINTR) fail(target, "cannot write the file to disk", errno);
    }
    void rename_to(std::filesystem::path const& target) {
        if (::rename(path_.c_str(), target.c_str()) != 0) fail(target, "cannot replace the file", errno);
        path_.clear();
    }

  private:
    std::filesystem::path path_;
    int fd_ = -1;
};

}  // namespace

std::vector<std::byte> read_file(std::filesystem::path const& path, std::size_t limit) {
    return read_whole<std::vector<std::byte>>(path, limit);
}

std::string read_text_file(std::filesystem::path const& path, std::size_t limit) {
    return read_whole<std::string>(path, limit);
}

void write_file_atomically(std::filesystem::path const& path, std::span<std::byte const> data) {
    if (!path.has_filename()) throw Error(ErrorKind::Io, path.string() + ": names no file to write to");
    std::filesystem::path target = path;
    std::error_code ignored;
    if (std::filesystem::is_symlink(path, ignored)) {
        auto const resolved = std::filesystem::weakly_canonical(path, ignored);
        if (!ignored) target = resolved;
    }
    struct stat old {};
    bool const exists = ::stat(target.c_str(), &old) == 0;
    if (exists && !S_ISREG(old.st_mode))
        throw Error(ErrorKind::Io,
                    path.string() + (S_ISDIR(old.st_mode) ? ": is a folder; name a file to write to"
                                                          : ": is not a regular file; name one to write to"));
    Temporary temporary(target, 0666);
    if (exists) temporary.keep_mode(old.st_mode & 07777);
    temporary.write(path, data);
    temporary.sync_and_close(path);
    temporary.rename_to(target);
    // Until the folder is synced the new name may be lost in a power cut. Not every file system can; the data is safe.
    auto const folder_path = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
    Descriptor folder(open_retrying(folder_path.c_str(), O_RDONLY | O_DIRECTORY));
    if (folder.get() >= 0) (void)::fsync(folder.get());
}

}  // namespace nephroid
