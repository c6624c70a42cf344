// Splits the text of a .ray file (SBT-raytracer 1.1) into names, numbers, strings and marks.
#pragma once

#include "scene/scene.h"

#include <string_view>

namespace nephroid {

struct RayToken {
    enum class Kind : std::uint8_t { End, Name, Number, String, Mark };
    Kind kind = Kind::End;
    std::uint32_t line = 1;
    std::string_view text;  // as in the file; a String's without its quotes

    [[nodiscard]] bool is(char mark) const { return kind == Kind::Mark && text[0] == mark; }
    [[nodiscard]] bool is(std::string_view name) const { return kind == Kind::Name && text == name; }
};

/// Views into `text`, which must outlive the tokens. Comments (`//` and `/* */`) and blanks are skipped.
class RayTokens {
  public:
    /// Refuses UTF-16 and NUL bytes; skips a UTF-8 byte order mark.
    RayTokens(Scene const& scene, std::uint32_t file, std::string_view text);

    [[nodiscard]] RayToken const& peek() const { return token_; }
    /// The token that peek() showed; End for ever at the end of the file.
    RayToken take();
    [[nodiscard]] SourceLocation at(RayToken const& token) const { return {file_, token.line}; }

  private:
    void skip_blanks();
    void skip_comment();
    RayToken read();

    Scene const& scene_;
    std::uint32_t file_;
    std::uint32_t line_ = 1;
    std::string_view rest_;
    RayToken token_;
};

}  // namespace nephroid
