// SIGINT, SIGTERM and SIGHUP ask a render to stop; a second one ends the program at once. Before rendering there is nothing
// to save: the program says so and ends.
#pragma once

#include <atomic>

namespace nephroid::cli {

/// Installs the handlers. SIGHUP stays ignored where it was (nohup).
void catch_signals();
/// From now on the first signal only sets the flag.
std::atomic<bool> const& stop_on_signals();

}  // namespace nephroid::cli
