#include "ray_input.h"

#include "number.h"
#include "params.h"
#include "shown.h"

#include <algorithm>

namespace nephroid {

void RayInput::expected(std::string_view what) const {
    auto const& token = peek();
    std::string found = "the end of the file";
    if (token.kind != RayToken::Kind::End) found = "\"" + shown(token.text, 40) + "\"";
    fail(std::string(what) + " should be here, not " + found);
}

bool RayInput::take_if(char mark) {
    if (!peek().is(mark)) return false;
    take();
    return true;
}

void RayInput::need(char mark) {
    if (!take_if(mark)) expected(std::string{'"', mark, '"'});
}

double RayInput::number() {
    if (peek().kind != RayToken::Kind::Number) expected("a number");
    auto const x = parse_double(peek().text);
    if (!x) fail("\"" + shown(peek().text, 40) + "\" is no finite number; write one such as -0.5 or 1e-3");
    take();
    return *x;
}

float RayInput::real() {
    if (peek().kind != RayToken::Kind::Number) expected("a number");
    auto const x = parse_float(peek().text);
    if (!x)
        fail("\"" + shown(peek().text, 40) +
             "\" is no number of single precision; write one such as -0.5 or 1e-3");
    take();
    return *x;
}

bool RayInput::boolean() {
    bool const yes = peek().is("true");
    if (!yes && !peek().is("false")) expected("true or false");
    take();
    return yes;
}

std::string RayInput::text() {
    if (peek().kind != RayToken::Kind::String && peek().kind != RayToken::Kind::Name)
        expected("a name, or a string in quotes,");
    return std::string(take().text);
}

Vec3 RayInput::triple() {
    Vec3 v{};
    need('(');
    for (int i = 0; i < 3; ++i) {
        if (i > 0) need(',');
        v[i] = real();
    }
    need(')');
    return v;
}

Vec3 RayInput::colour(std::string_view what) {
    auto const where = here();
    Vec3 const c = triple();
    if (c.x < 0 || c.y < 0 || c.z < 0)
        context_.note(where, std::string(what) + ": what is negative in a colour counts as 0");
    return max(c, Vec3{0});
}

void RayInput::block(std::string_view what, std::initializer_list<RayAttribute> attributes) {
    auto const open = here();
    std::vector<bool> given(attributes.size(), false);
    need('{');
    while (!take_if('}')) {
        if (take_if(';')) continue;
        if (peek().kind == RayToken::Kind::End) not_closed(open, '{');
        if (peek().kind != RayToken::Kind::Name)
            expected("an attribute of " + std::string(what) + ", or \"}\",");
        auto const name = peek().text;
        auto const found = std::find_if(attributes.begin(), attributes.end(), [&](RayAttribute const& a) {
            return name == a.name || (!a.other_spelling.empty() && name == a.other_spelling);
        });
        if (found == attributes.end()) {
            std::vector<std::string> names;
            for (auto const& a : attributes) names.emplace_back(a.name);
            fail("unknown attribute \"" + shown(name, 40) + "\" of " + std::string(what) +
                 which_to_use(name, names));
        }
        auto const index = static_cast<std::size_t>(found - attributes.begin());
        auto const twice = std::string(what) + ": \"" + std::string(found->name) + "\" is given twice";
        if (given[index] && found->once) fail(twice + "; keep one");
        if (given[index]) context_.note(here(), twice + ": the last one counts");
        given[index] = true;
        take();
        found->run();
    }
}

void RayInput::skip_nest() {
    auto const open = here();
    char const bracket = peek().is('(') ? '(' : '{';
    need(bracket);
    for (std::size_t depth = 1; depth > 0;) {
        auto const token = take();
        if (token.kind == RayToken::Kind::End) not_closed(open, bracket);
        if (token.is('(') || token.is('{')) ++depth;
        if (token.is(')') || token.is('}')) --depth;
    }
}

void RayInput::not_closed(SourceLocation open, char bracket) const {
    context_.fail(open,
                  std::string("this ") + bracket + " is not closed: add a " + (bracket == '(' ? ')' : '}'));
}

}  // namespace nephroid
