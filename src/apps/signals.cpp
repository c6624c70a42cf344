#include "signals.h"

#include "commands.h"

#include <unistd.h>
#include <csignal>

namespace nephroid::cli {

namespace {
std::atomic<bool> stop{false}, rendering{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the handler may only touch lock-free atomics");

void on_signal(int) {
    if (!rendering) {
        constexpr char text[] = "nephroid: interrupted before rendering began; nothing was written\n";
        (void)!::write(STDERR_FILENO, text, sizeof text - 1);
        _exit(kInterrupted);
    }
    if (stop.exchange(true)) _exit(kInterrupted);
}
}  // namespace

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction old {};
    sigaction(SIGHUP, nullptr, &old);
    if (old.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

std::atomic<bool> const& stop_on_signals() {
    rendering = true;
    return stop;
}

}  // namespace nephroid::cli
