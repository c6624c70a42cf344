// Words of pbrt's language: numbers that read back as the same bits, quoted strings, and typed parameters.
#pragma once

#include "math/transform.h"
#include "math/vec.h"
#include "spectrum/spd.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

/// The shortest decimal number that is read as `x`.
std::string text_of(float x);
std::string text_of(double x);
/// In quotes, with escapes.
std::string in_quotes(std::string_view text);
/// The degrees that radians() makes `angle` of; where no float is, the nearest one, and `exact` is false.
float degrees_of(float angle, bool& exact);
/// ` [ 16 numbers ]`, column by column.
std::string matrix_text(Mat4 const& m);

/// A list of parameters, each `"type name" value`, broken into lines.
class ParamText {
  public:
    void number(std::string_view name, float x);
    /// In degrees, or, where these do not reach it and `ours` may be written, in radians.
    void angle(std::string_view name, float radians, bool ours);
    void integer(std::string_view name, int x);
    void boolean(std::string_view name, bool x);
    void string(std::string_view name, std::string_view x);
    void texture(std::string_view name, std::string_view x);
    void strings(std::string_view name, std::vector<std::string> const& x);
    void rgb(std::string_view name, Vec3 x) { floats("rgb", name, &x.x, 3); }
    void point(std::string_view name, Vec3 x) { floats("point3", name, &x.x, 3); }
    void vector(std::string_view name, Vec3 x) { floats("vector3", name, &x.x, 3); }
    void blackbody(std::string_view name, float kelvin) { floats("blackbody", name, &kelvin, 1); }
    void spectrum(std::string_view name, TabulatedSpd const& table);
    void spectrum(std::string_view name, std::string_view of_name);

    // Only where it is not what a reader takes without it.
    void number(std::string_view name, float x, float otherwise);
    void integer(std::string_view name, int x, int otherwise);
    void boolean(std::string_view name, bool x, bool otherwise);
    void choice(std::string_view name, std::string_view x, std::string_view otherwise);

    // Lists; nothing where they are empty.
    void floats(std::string_view type, std::string_view name, float const* x, std::size_t count);
    void integers(std::string_view name, int const* x, std::size_t count);
    void points(std::string_view type, std::string_view name, std::vector<Vec3> const& x);
    void points(std::string_view type, std::string_view name, std::vector<Vec2> const& x);

    [[nodiscard]] std::string const& text() const { return text_; }

  private:
    void declare(std::string_view type, std::string_view name);
    /// One value of a list: a new line where this one is full.
    void value(std::string const& x);

    std::string text_;
    std::size_t line_ = 0;  // where the current one began
};

}  // namespace nephroid
