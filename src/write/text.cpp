#include "text.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace nephroid {

namespace {

constexpr std::size_t kWidth = 100;  // of lines, about

template <class T>
std::string shortest(T x) {
    std::array<char, 32> text{};
    auto const r = std::to_chars(text.data(), text.data() + text.size(), x);
    return {text.data(), r.ptr};
}

}  // namespace

std::string text_of(float x) { return shortest(x); }
std::string text_of(double x) { return shortest(x); }

std::string in_quotes(std::string_view text) {
    std::string out = "\"";
    for (char const c : text) {
        static constexpr std::string_view kNames = "bfnrt\\\"", kValues = "\b\f\n\r\t\\\"";
        auto const k = kValues.find(c);
        if (k != std::string_view::npos) out += {'\\', kNames[k]};
        if (k == std::string_view::npos) out += c;
    }
    return out + '"';
}

float degrees_of(float angle, bool& exact) {
    float const near = degrees(angle);
    exact = true;
    for (float const candidate :
         {near, std::nextafter(near, -kInfinity), std::nextafter(near, kInfinity), std::round(near)})
        if (radians(candidate) == angle) return candidate;
    exact = false;
    return near;
}

std::string matrix_text(Mat4 const& m) {
    std::string out = " [";
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            out += (row == 0 && column > 0 ? "  " : " ") + text_of(m.m[row][column]);
    return out + " ]";
}

void ParamText::declare(std::string_view type, std::string_view name) {
    if (text_.size() - line_ > kWidth - 20) {
        text_ += "\n   ";
        line_ = text_.size();
    }
    text_ += " \"" + std::string(type) + ' ' + std::string(name) + '"';
}

void ParamText::value(std::string const& x) {
    if (text_.size() - line_ + x.size() > kWidth) {
        text_ += "\n       ";
        line_ = text_.size();
    }
    text_ += ' ' + x;
}

void ParamText::number(std::string_view name, float x) {
    declare("float", name);
    text_ += ' ' + text_of(x);
}
void ParamText::angle(std::string_view name, float radians, bool ours) {
    bool exact = false;
    float const degrees = degrees_of(radians, exact);
    if (exact || !ours)
        number(name, degrees);
    else
        number(std::string(name) + ".radians", radians);
}
void ParamText::integer(std::string_view name, int x) {
    declare("integer", name);
    text_ += ' ' + std::to_string(x);
}
void ParamText::boolean(std::string_view name, bool x) {
    declare("bool", name);
    text_ += x ? " true" : " false";
}
void ParamText::string(std::string_view name, std::string_view x) {
    declare("string", name);
    text_ += ' ' + in_quotes(x);
}
void ParamText::texture(std::string_view name, std::string_view x) {
    declare("texture", name);
    text_ += ' ' + in_quotes(x);
}
void ParamText::strings(std::string_view name, std::vector<std::string> const& x) {
    declare("string", name);
    text_ += " [";
    for (std::string const& s : x) text_ += ' ' + in_quotes(s);
    text_ += " ]";
}
void ParamText::spectrum(std::string_view name, TabulatedSpd const& table) {
    declare("spectrum", name);
    text_ += " [";
    for (std::size_t i = 0; i < table.lambda.size(); ++i)
        value(text_of(table.lambda[i]) + ' ' + text_of(table.value[i]));
    text_ += " ]";
}
void ParamText::spectrum(std::string_view name, std::string_view of_name) {
    declare("spectrum", name);
    text_ += ' ' + in_quotes(of_name);
}

void ParamText::number(std::string_view name, float x, float otherwise) {
    if (x != otherwise) number(name, x);
}
void ParamText::integer(std::string_view name, int x, int otherwise) {
    if (x != otherwise) integer(name, x);
}
void ParamText::boolean(std::string_view name, bool x, bool otherwise) {
    if (x != otherwise) boolean(name, x);
}
void ParamText::choice(std::string_view name, std::string_view x, std::string_view otherwise) {
    if (x != otherwise) string(name, x);
}

void ParamText::floats(std::string_view type, std::string_view name, float const* x, std::size_t count) {
    if (count == 0) return;
    declare(type, name);
    text_ += " [";
    for (std::size_t i = 0; i < count; ++i) value(text_of(x[i]));
    text_ += " ]";
}
void ParamText::integers(std::string_view name, int const* x, std::size_t count) {
    if (count == 0) return;
    declare("integer", name);
    text_ += " [";
    for (std::size_t i = 0; i < count; ++i) value(std::to_string(x[i]));
    text_ += " ]";
}
void ParamText::points(std::string_view type, std::string_view name, std::vector<Vec3> const& x) {
    if (!x.empty()) floats(type, name, &x[0].x, 3 * x.size());
}
void ParamText::points(std::string_view type, std::string_view name, std::vector<Vec2> const& x) {
    if (!x.empty()) floats(type, name, &x[0].x, 2 * x.size());
}

}  // namespace nephroid
