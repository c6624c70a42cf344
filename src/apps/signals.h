// SIGINT and SIGTERM ask a render to stop; a second one ends the program at once.
#pragma once

#include <atomic>

namespace nephroid::cli {

/// Installs the handlers and returns the flag that they set.
std::atomic<bool> const& stop_on_signals();

}  // namespace nephroid::cli
