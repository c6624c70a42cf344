#include "exr_stream.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace nephroid::codec {

ExrFileSource::ExrFileSource(std::filesystem::path const& path) : IStream(path.c_str()) {
    std::string const name = path.string();
    // O_NONBLOCK: opening a FIFO without a writer would wait for ever.
    do fd_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    while (fd_ < 0 && errno == EINTR);
    if (fd_ < 0) fail(name, "cannot open the file: " + std::generic_category().message(errno), ErrorKind::Io);
    struct stat info {};
    bool const regular = ::fstat(fd_, &info) == 0 && S_ISREG(info.st_mode);
    size_ = static_cast<std::uint64_t>(info.st_size);
    if (regular) return;
    ::close(fd_);
    fail(name, S_ISDIR(info.st_mode) ? "is a folder; name a file" : "is not a regular file; name one",
         ErrorKind::Io);
}

ExrFileSource::~ExrFileSource() { ::close(fd_); }

bool ExrFileSource::read(char out[], int n) {
    for (int done = 0; done < n;) {
        ssize_t const got =
            ::pread(fd_, out + done, static_cast<std::size_t>(n - done), static_cast<off_t>(at_));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            fail(fileName(), "cannot read the file: " + std::generic_category().message(errno),
                 ErrorKind::Io);
        if (got == 0) throw std::runtime_error("the file is truncated");
        done += static_cast<int>(got);
        at_ += static_cast<std::uint64_t>(got);
    }
    return at_ < size_;
}

std::vector<std::byte> ExrFileSource::head(std::size_t most) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min<std::uint64_t>(most, size_)));
    at_ = 0;
    if (!bytes.empty()) read(reinterpret_cast<char*>(bytes.data()), static_cast<int>(bytes.size()));
    at_ = 0;
    return bytes;
}

}  // namespace nephroid::codec
