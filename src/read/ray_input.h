// What a .ray file is made of above its tokens: values, and blocks of attributes.
#pragma once

#include "context.h"
#include "ray_tokens.h"

#include <array>
#include <functional>
#include <initializer_list>

namespace nephroid {

/// An attribute that a block may have. `run` is called after its name; it reads "= value".
struct RayAttribute {
    std::string_view name, other_spelling;
    std::function<void()> run;
    bool once = false;  // given again is an error; else the last one counts (note)
};

class RayInput {
  public:
    RayInput(Context& context, std::uint32_t file, std::string_view text)
        : context_(context), tokens_(context.scene, file, text) {}

    [[nodiscard]] Context& context() const { return context_; }
    [[nodiscard]] RayToken const& peek() const { return tokens_.peek(); }
    RayToken take() { return tokens_.take(); }
    [[nodiscard]] SourceLocation here() const { return tokens_.at(peek()); }
    /// Fails at the next token, or where the file ends.
    [[noreturn]] void fail(std::string const& message) const { context_.fail(here(), message); }
    /// Fails with "`what` should be here, not …".
    [[noreturn]] void expected(std::string_view what) const;

    bool take_if(char mark);
    void need(char mark);

    double number();
    float real();  // within the range of floats
    bool boolean();
    std::string text();  // "…", or a bare name
    template <std::size_t N>
    std::array<double, N> numbers() {
        std::array<double, N> out{};
        need('(');
        for (std::size_t i = 0; i < N; ++i) {
            if (i > 0) need(',');
            out[i] = number();
        }
        need(')');
        return out;
    }
    Vec3 triple();
    /// Without negative components: those are 0, with a note.
    Vec3 colour(std::string_view what);
    /// "( item, item, … )", which may be empty; a comma may follow the last one.
    template <class F>
    void list(F const& item) {
        auto const open = here();
        need('(');
        while (!take_if(')')) {
            item();
            if (peek().kind == RayToken::Kind::End) not_closed(open, '(');
            if (!peek().is(')')) need(',');
        }
    }
    /// "{ attribute = value; … }" of `what`.
    void block(std::string_view what, std::initializer_list<RayAttribute> attributes);
    /// A value after "=".
    template <class F>
    auto value(F const& read) {
        need('=');
        return read();
    }
    /// Passes over "{ … }" or "( … )" whatever is in it.
    void skip_nest();
    [[noreturn]] void not_closed(SourceLocation open, char bracket) const;

  private:
    Context& context_;
    RayTokens tokens_;
};

}  // namespace nephroid
