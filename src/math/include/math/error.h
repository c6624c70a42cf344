// The one exception type. Bad input throws it with "file:line: what, and what to do"; nothing throws during a pass.
#pragma once

#include <stdexcept>
#include <string>

namespace nephroid {

/// What went wrong, for the program's exit code (docs/conventions.md).
enum class ErrorKind {
    Input,  // malformed or contradictory input: exit 2
    Limit,  // a size limit that protects the machine: exit 3
    Io      // the operating system refused: exit 4
};

class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, std::string const& message) : std::runtime_error(message), kind_(kind) {}
    [[nodiscard]] ErrorKind kind() const { return kind_; }

  private:
    ErrorKind kind_;
};

}  // namespace nephroid
