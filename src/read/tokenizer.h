// Splits the text of a pbrt file into words, quoted strings and brackets.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace nephroid {

inline constexpr std::size_t kMaxTokenBytes = 1 << 20;

struct Token {
    enum class Kind : std::uint8_t { Word, String, Open, Close };
    Kind kind = Kind::Word;
    bool escaped = false;  // a String with backslashes, still to be decoded
    std::uint32_t line = 0;
    std::string_view text;  // as in the file; a String's without its quotes
};

/// Views into `text`, which must outlive it and its tokens. Comments and white space are skipped.
class Tokenizer {
  public:
    /// Refuses UTF-16 and NUL bytes; skips a UTF-8 byte order mark.
    Tokenizer(Scene const& scene, std::uint32_t file, std::string_view text);

    std::optional<Token> next();
    void unget(Token const& token) { ungot_ = token; }
    [[nodiscard]] SourceLocation here() const { return {file_, line_}; }
    [[nodiscard]] SourceLocation at(Token const& token) const { return {file_, token.line}; }
    /// The value of a String token.
    [[nodiscard]] std::string decode(Token const& token) const;

  private:
    Token quoted();
    Token word();
    void skip_blanks();

    Scene const& scene_;
    std::uint32_t file_;
    std::uint32_t line_ = 1;
    char const* p_ = nullptr;
    char const* end_ = nullptr;
    std::optional<Token> ungot_;
};

}  // namespace nephroid
