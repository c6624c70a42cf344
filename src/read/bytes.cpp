#include "bytes.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace nephroid {

namespace {

struct Inflater {
    z_stream stream{};
    bool open = false;

    Inflater() { open = inflateInit2(&stream, 15 + 16) == Z_OK; }  // 16: expect gzip's header and trailer
    ~Inflater() {
        if (open) inflateEnd(&stream);
    }
    Inflater(Inflater const&) = delete;
    Inflater& operator=(Inflater const&) = delete;
};

struct Descriptor {
    int fd = -1;

    explicit Descriptor(int f) : fd(f) {}
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
    Descriptor(Descriptor const&) = delete;
    Descriptor& operator=(Descriptor const&) = delete;
};

FileBytes too_long() {
    return {{}, "is longer than " + std::to_string(kMaxFileBytes >> 20) + " MiB: split it", true};
}

}  // namespace

FileBytes inflate_if_gzip(std::string bytes, std::size_t limit) {
    if (bytes.size() < 2 || bytes[0] != '\x1f' || bytes[1] != '\x8b') return {std::move(bytes), {}};
    Inflater z;
    if (!z.open) return {{}, "cannot start zlib"};
    std::string out;
    std::array<char, 1 << 16> block;
    // zlib counts in 32 bits: feed the input in pieces.
    std::size_t fed = 0;
    while (true) {
        if (z.stream.avail_in == 0 && fed < bytes.size()) {
            std::size_t const piece = std::min(bytes.size() - fed, std::size_t{1} << 30);
            z.stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + fed);
            z.stream.avail_in = static_cast<uInt>(piece);
            fed += piece;
        }
        z.stream.next_out = reinterpret_cast<Bytef*>(block.data());
        z.stream.avail_out = static_cast<uInt>(block.size());
        int const status = inflate(&z.stream, Z_NO_FLUSH);
        out.append(block.data(), block.size() - z.stream.avail_out);
        if (out.size() > limit) return too_long();
        if (status == Z_STREAM_END) {
            // gzip files may be concatenated; what follows and is no gzip is padding.
            bool const more =
                z.stream.avail_in >= 2 && z.stream.next_in[0] == 0x1f && z.stream.next_in[1] == 0x8b;
            if (!more) return {std::move(out), {}};
            if (inflateReset(&z.stream) != Z_OK) return {{}, "has a broken gzip stream"};
        } else if (status != Z_OK) {
            return {{}, "has a broken or truncated gzip stream"};
        }
    }
}

FileBytes read_bytes(std::filesystem::path const& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        return {
            {},
            errno == ENOENT ? "does not exist" : std::string("cannot be opened: ") + std::strerror(errno)};
    // To open a device can do things already. What was looked at may be another file by now, so it is asked again below,
    // and a FIFO is not waited for.
    if (!S_ISREG(status.st_mode)) return {{}, "is not a regular file"};
    Descriptor const file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
    if (file.fd < 0) return {{}, std::string("cannot be opened: ") + std::strerror(errno)};
    struct statfs system {};
    if (::fstat(file.fd, &status) != 0 || ::fstatfs(file.fd, &system) != 0) return {{}, "cannot be read"};
    if (!S_ISREG(status.st_mode)) return {{}, "is not a regular file"};
    if (system.f_type == PROC_SUPER_MAGIC || system.f_type == SYSFS_MAGIC)
        return {{}, "is not a regular file: it belongs to the system"};
    auto const size = static_cast<std::size_t>(status.st_size);
    if (size > kMaxFileBytes) return too_long();

    // One byte more than there should be: the last read, which finds the end, then needs no more room.
    std::string bytes(size + 1, '\0');
    std::size_t used = 0;
    while (true) {
        if (used == bytes.size()) bytes.resize(used + (1 << 16));  // the file grew
        auto const n = ::read(file.fd, bytes.data() + used, bytes.size() - used);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return {{}, std::string("cannot be read: ") + std::strerror(errno)};
        if (n == 0) break;
        if (size == 0) return {{}, "is not a regular file: it has no size, but holds data"};
        used += static_cast<std::size_t>(n);
        if (used > kMaxFileBytes) return too_long();
    }
    bytes.resize(used);
    return inflate_if_gzip(std::move(bytes));
}

}  // namespace nephroid
