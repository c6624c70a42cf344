#include "ray_tokens.h"

#include "plain_text.h"
#include "shown.h"

#include <algorithm>

namespace nephroid {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool in_name(char c) { return is_letter(c) || is_digit(c) || c == '-'; }
/// Letters too: "1.5x" is one wrong number, not a number and a name.
bool in_number(char c) { return in_name(c) || c == '.' || c == '+'; }
bool begins_number(char c) { return is_digit(c) || c == '-' || c == '+' || c == '.'; }

template <class Belongs>
std::size_t length_of(std::string_view text, Belongs const& belongs) {
    auto const end = std::find_if_not(text.begin(), text.end(), belongs);
    return static_cast<std::size_t>(end - text.begin());
}

}  // namespace

RayTokens::RayTokens(Scene const& scene, std::uint32_t file, std::string_view text)
    : scene_(scene), file_(file), rest_(plain_text(scene, file, text)) {
    token_ = read();
}

RayToken RayTokens::take() {
    auto const token = token_;
    if (token.kind != RayToken::Kind::End) token_ = read();
    return token;
}

void RayTokens::skip_comment() {
    if (rest_[1] == '/') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
        return;
    }
    auto const end = rest_.find("*/", 2);
    if (end == std::string_view::npos)
        scene_.fail({file_, line_}, "this comment is not closed: end it with */");
    auto const comment = rest_.substr(0, end);
    line_ += static_cast<std::uint32_t>(std::count(comment.begin(), comment.end(), '\n'));
    rest_.remove_prefix(end + 2);
}

void RayTokens::skip_blanks() {
    while (!rest_.empty()) {
        char const c = rest_[0];
        if (rest_.starts_with("//") || rest_.starts_with("/*")) {
            skip_comment();
            continue;
        }
        if (c == '\n') {
            ++line_;
        } else if (c != ' ' && c != '\t' && c != '\r' && c != '\f' && c != '\v') {
            return;
        }
        rest_.remove_prefix(1);
    }
}

RayToken RayTokens::read() {
    skip_blanks();
    if (rest_.empty()) return {RayToken::Kind::End, line_, {}};
    auto const token = [&](RayToken::Kind kind, std::size_t begin, std::size_t size, std::size_t used) {
        RayToken const t{kind, line_, rest_.substr(begin, size)};
        rest_.remove_prefix(used);
        return t;
    };
    char const c = rest_[0];
    if (is_letter(c)) {
        auto const size = length_of(rest_, in_name);
        return token(RayToken::Kind::Name, 0, size, size);
    }
    if (begins_number(c)) {
        auto const size = length_of(rest_, in_number);
        return token(RayToken::Kind::Number, 0, size, size);
    }
    if (c == '"') {
        auto const end = rest_.find_first_of("\"\n", 1);
        if (end == std::string_view::npos || rest_[end] != '"')
            scene_.fail({file_, line_}, "unterminated string: close it with a \" on the same line");
        return token(RayToken::Kind::String, 1, end - 1, end + 1);
    }
    if (std::string_view("(){},=;").find(c) != std::string_view::npos)
        return token(RayToken::Kind::Mark, 0, 1, 1);
    // A whole character where it is one of UTF-8.
    auto const size = 1 + length_of(rest_.substr(1), [](char x) { return (x & '\xc0') == '\x80'; });
    scene_.fail({file_, line_}, "\"" + shown(rest_.substr(0, size)) +
                                    "\" has no meaning here: names, numbers, strings and ( ) { } , = ; have");
}

}  // namespace nephroid
