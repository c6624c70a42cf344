// All that the program prints goes through here. Words for people go to stderr, and it does not matter whether they arrive:
// printing never ends a render. Results go to stdout, and there it does matter.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace nephroid::cli {

/// To be called first: a closed stream must not become the next file that is opened, and a pipe that nobody reads must
/// not end the program.
void prepare_streams();

/// On stderr.
void say_text(std::string_view text);
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    say_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// On stdout.
void print_text(std::string_view text);
template <class... Arguments>
void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    print_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}
/// Throws Error(Io) when something that was printed did not arrive.
void flush_results();

}  // namespace nephroid::cli
