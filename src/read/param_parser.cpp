#include "param_parser.h"

#include "number.h"
#include "shown.h"

#include <algorithm>
#include <limits>

namespace nephroid {

namespace {

constexpr std::string_view kSpaceOrTab = " \t";
constexpr std::size_t kMaxParams = 1000;

/// Messages quote what was found.
std::string excerpt(std::string_view s) { return shown(s, 40); }

/// What the values of a type must look like.
enum class Form { Number, Integer, Bool, String, NumberOrString };
Form form(ParamType type) {
    switch (type) {
        case ParamType::Bool:
            return Form::Bool;
        case ParamType::Integer:
            return Form::Integer;
        case ParamType::String:
        case ParamType::Texture:
            return Form::String;
        case ParamType::Spectrum:
            return Form::NumberOrString;
        default:
            return Form::Number;
    }
}

/// Values come in multiples of this.
std::size_t per_item(Param const& p) {
    switch (p.type) {
        case ParamType::Point2:
        case ParamType::Vector2:
            return 2;
        case ParamType::Point3:
        case ParamType::Vector3:
        case ParamType::Normal3:
        case ParamType::Rgb:
            return 3;
        case ParamType::Spectrum:
            return p.strings.empty() ? 2 : 1;
        default:
            return 1;
    }
}

class ListParser {
  public:
    ListParser(Tokenizer& tokens, Context& context, FileColorSpace color_space)
        : tokens_(tokens), context_(context), color_space_(color_space) {}

    ParamList parse() {
        ParamList list;
        while (auto const token = tokens_.next()) {
            if (token->kind != Token::Kind::String) {
                tokens_.unget(*token);
                break;
            }
            // Look-ups are linear: an honest list has a dozen entries.
            if (list.size() == kMaxParams)
                context_.fail(tokens_.at(*token), "more than 1000 parameters in one list");
            list.push_back(parameter(*token));
        }
        return list;
    }

  private:
    Param parameter(Token const& declaration) {
        Param p = declared(declaration);
        auto const first = required(p);
        if (first.kind == Token::Kind::Open) {
            for (auto token = required(p); token.kind != Token::Kind::Close; token = required(p))
                value(p, token);
        } else {
            value(p, first);
        }
        check_count(p);
        return p;
    }

    Param declared(Token const& token) {
        std::string const text = tokens_.decode(token);
        std::string_view rest = text;
        auto const word = [&rest] {
            rest.remove_prefix(std::min(rest.find_first_not_of(kSpaceOrTab), rest.size()));
            auto const w = rest.substr(0, rest.find_first_of(kSpaceOrTab));
            rest.remove_prefix(w.size());
            return w;
        };
        auto const type_word = word();
        auto const name = word();
        auto const where = tokens_.at(token);
        if (name.empty())
            context_.fail(where, "\"" + excerpt(text) +
                                     "\": a parameter is declared as \"type name\", e.g. \"float fov\"");
        if (type_word == "color" || type_word == "xyz")
            context_.fail(
                where, "parameter type \"" + shown(type_word) + "\" is of pbrt-v3; in pbrt-v4 it is \"rgb\"");
        auto const type = param_type(type_word);
        if (!type)
            context_.fail(
                where, "\"" + excerpt(type_word) +
                           "\" is not a parameter type; use bool, float, integer, point2, vector2, point3, "
                           "vector3, normal, string, texture, rgb, spectrum or blackbody");
        Param p;
        p.type = *type, p.name = name, p.color_space = color_space_, p.where = where;
        return p;
    }

    Token required(Param const& p) {
        auto const token = tokens_.next();
        if (!token)
            context_.fail(p.where, "parameter \"" + shown(p.name) + "\": the file ends before its values do");
        return *token;
    }

    void value(Param& p, Token const& token) {
        using Kind = Token::Kind;
        if (token.kind == Kind::Open || token.kind == Kind::Close) wrong(p, token);
        switch (form(p.type)) {
            case Form::Number:
                return number(p, token);
            case Form::NumberOrString:
                // One list, one kind.
                if (token.kind == Kind::Word && p.strings.empty()) return number(p, token);
                if (token.kind == Kind::String && p.floats.empty())
                    return p.strings.push_back(tokens_.decode(token));
                wrong(p, token);
            case Form::Integer: {
                auto const v = token.kind == Kind::Word ? parse_int(token.text) : std::nullopt;
                using Limits = std::numeric_limits<int>;
                if (!v || *v < Limits::min() || *v > Limits::max()) wrong(p, token);
                return p.ints.push_back(static_cast<int>(*v));
            }
            case Form::Bool:
                // Quoted as in pbrt-v3, bare as in pbrt-v4.
                if (token.text != "true" && token.text != "false") wrong(p, token);
                return p.bools.push_back(token.text == "true");
            case Form::String:
                if (token.kind != Kind::String) wrong(p, token);
                return p.strings.push_back(tokens_.decode(token));
        }
    }

    void number(Param& p, Token const& token) {
        auto const v = token.kind == Token::Kind::Word ? parse_float(token.text) : std::nullopt;
        if (!v) wrong(p, token);
        p.floats.push_back(*v);
    }

    [[noreturn]] void wrong(Param const& p, Token const& token) {
        char const* wanted = "";
        switch (form(p.type)) {
            case Form::Number:
                wanted = "a finite number";
                break;
            case Form::Integer:
                wanted = "a 32-bit integer";
                break;
            case Form::Bool:
                wanted = "true or false";
                break;
            case Form::String:
                wanted = "a quoted string";
                break;
            case Form::NumberOrString:
                wanted = "either finite numbers or a quoted name";
                break;
        }
        std::string const quote = token.kind == Token::Kind::String ? "\"" : "";
        context_.fail(tokens_.at(token), "parameter \"" + std::string(type_name(p.type)) + " " +
                                             shown(p.name) + "\": " + quote + excerpt(token.text) + quote +
                                             " is not " + wanted);
    }

    void check_count(Param const& p) {
        auto const count = std::max({p.floats.size(), p.ints.size(), p.bools.size(), p.strings.size()});
        auto const declared_as = "parameter \"" + std::string(type_name(p.type)) + " " + shown(p.name) + "\"";
        if (count == 0) context_.fail(p.where, declared_as + " has no value");
        if (p.type == ParamType::Blackbody && count == 2)
            context_.fail(p.where,
                          declared_as +
                              " has two values as in pbrt-v3; in pbrt-v4 it is the temperature alone, "
                              "and the light has a \"float scale\"");
        if (count % per_item(p) != 0)
            context_.fail(p.where, declared_as + " has " + std::to_string(count) +
                                       " values, which is not a multiple of " + std::to_string(per_item(p)));
    }

    Tokenizer& tokens_;
    Context& context_;
    FileColorSpace color_space_;
};

}  // namespace

ParamList parse_params(Tokenizer& tokens, Context& context, FileColorSpace color_space) {
    return ListParser(tokens, context, color_space).parse();
}

double required_number(Tokenizer& tokens, Context& context, std::string_view what) {
    auto const token = tokens.next();
    if (!token) context.fail(tokens.here(), std::string(what) + ": the file ends before its numbers do");
    auto const v = token->kind == Token::Kind::Word ? parse_double(token->text) : std::nullopt;
    if (!v)
        context.fail(tokens.at(*token),
                     std::string(what) + ": \"" + excerpt(token->text) + "\" is not a finite number");
    return *v;
}

std::string required_string(Tokenizer& tokens, Context& context, std::string_view what) {
    auto const token = tokens.next();
    if (!token)
        context.fail(tokens.here(), std::string(what) + ": the file ends where a quoted name should be");
    if (token->kind != Token::Kind::String)
        context.fail(tokens.at(*token),
                     std::string(what) + ": \"" + excerpt(token->text) + "\" must be a quoted string");
    return tokens.decode(*token);
}

}  // namespace nephroid
