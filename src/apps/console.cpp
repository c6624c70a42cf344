#include "console.h"

#include "math/error.h"

#include <cerrno>
#include <csignal>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace nephroid::cli {

namespace {

std::string pending;  // results that are not written yet
int lost = 0;         // errno of the first write of results that failed

/// 0, or the errno.
int write_all(int fd, std::string_view text) {
    while (!text.empty()) {
        ssize_t const n = ::write(fd, text.data(), text.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        text.remove_prefix(static_cast<std::size_t>(n));
    }
    return 0;
}

}  // namespace

void prepare_streams() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // `ulimit -f`: then write() says that the file is too large
    for (int fd = 0; fd <= 2; ++fd)
        // Lowest free number first, so that open() fills the gap; what is written to stdout then fails and is noticed.
        if (::fcntl(fd, F_GETFD) < 0 && errno == EBADF)
            (void)::open("/dev/null", fd == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void say_text(std::string_view text) { (void)write_all(STDERR_FILENO, text); }

void print_text(std::string_view text) {
    pending += text;
    if (!text.ends_with('\n')) return;
    int const error = write_all(STDOUT_FILENO, pending);
    if (lost == 0) lost = error;
    pending.clear();
}

void flush_results() {
    int const error = write_all(STDOUT_FILENO, pending);
    if (lost == 0) lost = error;
    pending.clear();
    if (lost != 0)
        throw Error(ErrorKind::Io, "standard output: the results could not be written: " +
                                       std::generic_category().message(lost));
}

}  // namespace nephroid::cli
