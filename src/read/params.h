// Typed parameter lists: "float radius" 2, "point3 P" [...], and the questions that directives ask of them.
#pragma once

#include "color_space.h"
#include "context.h"
#include "math/vec.h"

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

enum class ParamType : std::uint8_t {
    Bool,
    Float,
    Integer,
    Point2,
    Vector2,
    Point3,
    Vector3,
    Normal3,
    String,
    Texture,
    Rgb,
    Spectrum,
    Blackbody
};
/// As a scene file writes it. "point", "vector" and "normal3" are taken too.
std::string_view type_name(ParamType type);
std::optional<ParamType> param_type(std::string_view name);

/// Values are in the one list that fits the type (Spectrum: floats or strings), already counted and finite.
struct Param {
    ParamType type = ParamType::Float;
    std::string name;
    std::vector<float> floats;
    std::vector<int> ints;
    std::vector<bool> bools;
    std::vector<std::string> strings;
    FileColorSpace color_space = FileColorSpace::Srgb;  // of rgb triples
    SourceLocation where;
};
using ParamList = std::vector<Param>;
/// What `Attribute` has set: a chain of lists, newest first. Links never change, so saved graphics states share them.
struct AttributeParams {
    std::vector<std::shared_ptr<Param const>> params;
    std::shared_ptr<AttributeParams const> older;
    std::size_t count = 0;  // in all of the chain
};
using SharedParams = std::shared_ptr<AttributeParams const>;
/// The chain with `added` on top, which hide those of the same name and type below.
SharedParams with_attributes(SharedParams const& before, ParamList added);

/// The parameters of one directive. A question for a name that is there with another type fails. Own parameters win over
/// those that `Attribute` set, of which those of another type are skipped with a note; the last of equals wins.
class Params {
  public:
    /// `what` is what messages call the directive, e.g. `Shape "sphere"`. Keeps a reference to the context.
    Params(Context& context, std::string what, SourceLocation where, ParamList own,
           SharedParams inherited = {}, FileColorSpace color_space = FileColorSpace::Srgb);

    [[nodiscard]] Context& context() const { return *context_; }
    [[nodiscard]] SourceLocation where() const { return where_; }
    [[nodiscard]] std::string const& what() const { return what_; }
    /// The colour space in force at the directive, whose white is what a light is by default.
    [[nodiscard]] FileColorSpace color_space() const { return color_space_; }
    void note(std::string const& text) const { context_->note(where_, what_ + ": " + text); }
    [[noreturn]] void fail(std::string const& text) const { context_->fail(where_, what_ + ": " + text); }

    /// The parameter, whatever its type; null when it is not there.
    Param const* find(std::string_view name);
    /// The parameter, which must have one of the types.
    Param const* find(std::string_view name, std::initializer_list<ParamType> types);

    float number(std::string_view name, float otherwise);
    /// Given in degrees; ours also in radians, as "float NAME.radians": degrees in a float do not reach every angle.
    float angle(std::string_view name, float otherwise_degrees);
    int integer(std::string_view name, int otherwise);
    bool boolean(std::string_view name, bool otherwise);
    std::string string(std::string_view name, std::string_view otherwise);
    /// A string that must be one of `choices`: its index there.
    std::size_t choice(std::string_view name, std::initializer_list<std::string_view> choices,
                       std::size_t otherwise);
    Vec3 point3(std::string_view name, Vec3 otherwise);
    Vec3 vector3(std::string_view name, Vec3 otherwise);

    // Lists; empty when not there.
    std::vector<float> numbers(std::string_view name);
    std::vector<int> integers(std::string_view name);
    std::vector<std::string> strings(std::string_view name);
    std::vector<Vec2> points2(std::string_view name);
    std::vector<Vec3> points3(std::string_view name);
    std::vector<Vec3> normals(std::string_view name);

    /// A note for each parameter of its own that nobody asked for, with the nearest name that was asked for.
    void note_unused();
    /// For what is skipped as a whole.
    void ignore_all() { ignore_all_ = true; }

  private:
    Param const* one(std::string_view name, ParamType type, std::size_t per_item);
    Param const* find_own(std::string_view name);
    Param const* find_inherited(std::string_view name, std::initializer_list<ParamType> types);
    void note_duplicates() const;

    Context* context_;
    std::string what_;
    SourceLocation where_;
    ParamList own_;
    std::vector<bool> used_;  // parallel to own_
    SharedParams inherited_;
    FileColorSpace color_space_;
    std::vector<Param const*> skipped_;  // inherited ones of the wrong type that a note has been given for
    std::vector<std::string> asked_;
    bool ignore_all_ = false;
};

/// The candidate nearest to `word` in edit distance, if near enough to be a slip; else "".
std::string nearest_name(std::string_view word, std::vector<std::string> const& candidates);
/// ` (did you mean "X"?)`, or nothing.
std::string did_you_mean(std::string_view word, std::vector<std::string> const& candidates);
/// The same, or where none is near `; use one of "a", "b"`.
std::string which_to_use(std::string_view word, std::vector<std::string> const& candidates);
/// `"a", "b"`
std::string quoted(std::vector<std::string> const& names);

}  // namespace nephroid
