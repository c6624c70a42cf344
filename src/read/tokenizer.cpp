#include "tokenizer.h"

#include "plain_text.h"

#include <algorithm>
#include <array>

namespace nephroid {

namespace {

/// What ends a word: blanks, quotes and brackets. A # inside a word belongs to it, as in pbrt.
constexpr std::array<bool, 256> kEndsWord = [] {
    std::array<bool, 256> t{};
    for (char const c : {' ', '\n', '\t', '\r', '"', '[', ']'}) t[static_cast<unsigned char>(c)] = true;
    return t;
}();

}  // namespace

Tokenizer::Tokenizer(Scene const& scene, std::uint32_t file, std::string_view text)
    : scene_(scene), file_(file) {
    text = plain_text(scene, file, text);
    p_ = text.data();
    end_ = p_ + text.size();
}

void Tokenizer::skip_blanks() {
    for (; p_ != end_; ++p_) {
        if (*p_ == '\n') {
            ++line_;
        } else if (*p_ == '#') {
            p_ = std::find_if(p_, end_, [](char c) { return c == '\n' || c == '\r'; });
            if (p_ == end_) return;
            if (*p_ == '\n') ++line_;
        } else if (*p_ != ' ' && *p_ != '\t' && *p_ != '\r') {
            return;
        }
    }
}

std::optional<Token> Tokenizer::next() {
    if (ungot_) {
        auto const token = *ungot_;
        ungot_.reset();
        return token;
    }
    skip_blanks();
    if (p_ == end_) return std::nullopt;
    if (*p_ == '"') return quoted();
    if (*p_ == '[') return Token{Token::Kind::Open, false, line_, {p_++, 1}};
    if (*p_ == ']') return Token{Token::Kind::Close, false, line_, {p_++, 1}};
    return word();
}

Token Tokenizer::quoted() {
    char const* const begin = ++p_;
    bool escaped = false;
    for (; p_ != end_ && *p_ != '"'; ++p_) {
        if (*p_ == '\n') break;
        if (*p_ == '\\') {
            escaped = true;
            if (++p_ == end_ || *p_ == '\n') break;
        }
    }
    if (p_ == end_ || *p_ != '"')
        scene_.fail(here(), "unterminated string: close it with a \" on the same line");
    if (static_cast<std::size_t>(p_ - begin) > kMaxTokenBytes)
        scene_.fail(here(), "a string of more than 1 MB");
    Token const token{Token::Kind::String, escaped, line_, {begin, static_cast<std::size_t>(p_ - begin)}};
    ++p_;
    return token;
}

Token Tokenizer::word() {
    char const* const begin = p_;
    while (p_ != end_ && !kEndsWord[static_cast<unsigned char>(*p_)]) ++p_;
    auto const size = static_cast<std::size_t>(p_ - begin);
    if (size > kMaxTokenBytes) scene_.fail(here(), "a word of more than 1 MB");
    return Token{Token::Kind::Word, false, line_, {begin, size}};
}

std::string Tokenizer::decode(Token const& token) const {
    if (!token.escaped) return std::string(token.text);
    std::string out;
    for (std::size_t i = 0; i < token.text.size(); ++i) {
        char c = token.text[i];
        if (c == '\\') {
            // quoted() made sure that something follows every backslash.
            static constexpr std::string_view kNames = "bfnrt\\'\"", kValues = "\b\f\n\r\t\\'\"";
            auto const k = kNames.find(token.text[++i]);
            if (k == std::string_view::npos)
                scene_.fail(at(token), std::string("unknown escape \\") + token.text[i] +
                                           " in a string: write \\\\ for a backslash");
            c = kValues[k];
        }
        out.push_back(c);
    }
    return out;
}

}  // namespace nephroid
