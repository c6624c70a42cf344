#include "signals.h"

#include "commands.h"

#include <unistd.h>
#include <csignal>

namespace nephroid::cli {

namespace {
std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the handler may only touch lock-free atomics");

void on_signal(int) {
    if (stop.exchange(true)) _exit(kInterrupted);
}
}  // namespace

std::atomic<bool> const& stop_on_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return stop;
}

}  // namespace nephroid::cli
