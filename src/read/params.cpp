#include "params.h"
#include "shown.h"

#include <algorithm>
#include <array>
#include <utility>

namespace nephroid {

namespace {

struct TypeName {
    std::string_view name;
    ParamType type;
};
// The first name of a type is the one that messages use.
constexpr std::array<TypeName, 16> kTypes{{{"bool", ParamType::Bool},
                                           {"float", ParamType::Float},
                                           {"integer", ParamType::Integer},
                                           {"point2", ParamType::Point2},
                                           {"vector2", ParamType::Vector2},
                                           {"point3", ParamType::Point3},
                                           {"point", ParamType::Point3},
                                           {"vector3", ParamType::Vector3},
                                           {"vector", ParamType::Vector3},
                                           {"normal", ParamType::Normal3},
                                           {"normal3", ParamType::Normal3},
                                           {"string", ParamType::String},
                                           {"texture", ParamType::Texture},
                                           {"rgb", ParamType::Rgb},
                                           {"spectrum", ParamType::Spectrum},
                                           {"blackbody", ParamType::Blackbody}}};

/// `"float" or "texture"`
std::string names_of(std::initializer_list<ParamType> types) {
    std::string names;
    for (auto const t : types) names += (names.empty() ? "\"" : " or \"") + std::string(type_name(t)) + "\"";
    return names;
}

std::vector<Vec3> triples(Param const* p) {
    std::vector<Vec3> out;
    if (!p) return out;
    out.reserve(p->floats.size() / 3);
    for (std::size_t i = 0; i + 2 < p->floats.size(); i += 3)
        out.emplace_back(p->floats[i], p->floats[i + 1], p->floats[i + 2]);
    return out;
}

}  // namespace

std::string_view type_name(ParamType type) {
    return std::find_if(kTypes.begin(), kTypes.end(), [&](TypeName const& t) { return t.type == type; })
        ->name;
}

std::optional<ParamType> param_type(std::string_view name) {
    for (auto const& t : kTypes)
        if (t.name == name) return t.type;
    return std::nullopt;
}

Params::Params(Context& context, std::string what, SourceLocation where, ParamList own,
               SharedParams inherited, FileColorSpace color_space)
    : context_(&context),
      what_(std::move(what)),
      where_(where),
      own_(std::move(own)),
      used_(own_.size(), false),
      inherited_(std::move(inherited)),
      color_space_(color_space) {
    note_duplicates();
}

void Params::note_duplicates() const {
    for (std::size_t i = 0; i < own_.size(); ++i) {
        auto const later = std::find_if(own_.begin() + static_cast<std::ptrdiff_t>(i) + 1, own_.end(),
                                        [&](Param const& p) { return p.name == own_[i].name; });
        if (later != own_.end())
            context_->note(later->where, what_ + ": parameter \"" + shown(own_[i].name) +
                                             "\" is given twice; the last one counts");
    }
}

Param const* Params::find_own(std::string_view name) {
    if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) asked_.emplace_back(name);
    Param const* found = nullptr;
    for (std::size_t i = 0; i < own_.size(); ++i)
        if (own_[i].name == name) found = &own_[i], used_[i] = true;
    return found;
}

/// pbrt looks up by name and type, so an `Attribute` that means one entity does not disturb another with its name.
Param const* Params::find_inherited(std::string_view name, std::initializer_list<ParamType> types) {
    Param const* other = nullptr;
    for (auto const* link = inherited_.get(); link; link = link->older.get())
        for (auto const& p : link->params) {
            if (p->name != name) continue;
            if (std::find(types.begin(), types.end(), p->type) != types.end()) return p.get();
            if (!other) other = p.get();
        }
    if (other && std::find(skipped_.begin(), skipped_.end(), other) == skipped_.end()) {
        skipped_.push_back(other);
        context_->note(other->where, what_ + ": parameter \"" + shown(other->name) +
                                         "\" of Attribute is a \"" + std::string(type_name(other->type)) +
                                         "\", not a " + names_of(types) + ": skipped");
    }
    return nullptr;
}

Param const* Params::find(std::string_view name) {
    if (auto const* p = find_own(name)) return p;
    for (auto const* link = inherited_.get(); link; link = link->older.get())
        for (auto const& p : link->params)
            if (p->name == name) return p.get();
    return nullptr;
}

Param const* Params::find(std::string_view name, std::initializer_list<ParamType> types) {
    auto const* p = find_own(name);
    if (!p) return find_inherited(name, types);
    if (std::find(types.begin(), types.end(), p->type) != types.end()) return p;
    context_->fail(p->where, what_ + ": parameter \"" + shown(p->name) + "\" is a \"" +
                                 std::string(type_name(p->type)) + "\"; it must be a " + names_of(types));
}

Param const* Params::one(std::string_view name, ParamType type, std::size_t per_item) {
    auto const* p = find(name, {type});
    if (!p) return p;
    auto const count = std::max({p->floats.size(), p->ints.size(), p->bools.size(), p->strings.size()});
    if (count != per_item)
        context_->fail(p->where,
                       what_ + ": parameter \"" + shown(p->name) + "\" needs " + std::to_string(per_item) +
                           (per_item == 1 ? " value, not " : " values, not ") + std::to_string(count));
    return p;
}

float Params::number(std::string_view name, float otherwise) {
    auto const* p = one(name, ParamType::Float, 1);
    return p ? p->floats[0] : otherwise;
}
float Params::angle(std::string_view name, float otherwise_degrees) {
    auto const exact = std::string(name) + ".radians";
    if (!find(exact)) return radians(number(name, otherwise_degrees));
    if (find(name)) fail("give either \"" + shown(name) + "\" or \"" + shown(exact) + "\", not both");
    return number(exact, 0);
}
int Params::integer(std::string_view name, int otherwise) {
    auto const* p = one(name, ParamType::Integer, 1);
    return p ? p->ints[0] : otherwise;
}
bool Params::boolean(std::string_view name, bool otherwise) {
    auto const* p = one(name, ParamType::Bool, 1);
    return p ? p->bools[0] : otherwise;
}
std::string Params::string(std::string_view name, std::string_view otherwise) {
    auto const* p = one(name, ParamType::String, 1);
    return p ? p->strings[0] : std::string(otherwise);
}

std::size_t Params::choice(std::string_view name, std::initializer_list<std::string_view> choices,
                           std::size_t otherwise) {
    auto const* p = one(name, ParamType::String, 1);
    if (!p) return otherwise;
    auto const found = std::find(choices.begin(), choices.end(), p->strings[0]);
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
    context_->fail(p->where, what_ + ": \"" + shown(p->strings[0]) + "\" is not a known \"" + shown(p->name) +
                                 "\"; use one of " + quoted({choices.begin(), choices.end()}));
}

Vec3 Params::point3(std::string_view name, Vec3 otherwise) {
    auto const* p = one(name, ParamType::Point3, 3);
    return p ? Vec3{p->floats[0], p->floats[1], p->floats[2]} : otherwise;
}
Vec3 Params::vector3(std::string_view name, Vec3 otherwise) {
    auto const* p = one(name, ParamType::Vector3, 3);
    return p ? Vec3{p->floats[0], p->floats[1], p->floats[2]} : otherwise;
}

std::vector<float> Params::numbers(std::string_view name) {
    auto const* p = find(name, {ParamType::Float});
    return p ? p->floats : std::vector<float>{};
}
std::vector<int> Params::integers(std::string_view name) {
    auto const* p = find(name, {ParamType::Integer});
    return p ? p->ints : std::vector<int>{};
}
std::vector<std::string> Params::strings(std::string_view name) {
    auto const* p = find(name, {ParamType::String});
    return p ? p->strings : std::vector<std::string>{};
}
std::vector<Vec2> Params::points2(std::string_view name) {
    std::vector<Vec2> out;
    auto const* p = find(name, {ParamType::Point2});
    if (!p) return out;
    out.reserve(p->floats.size() / 2);
    for (std::size_t i = 0; i + 1 < p->floats.size(); i += 2)
        out.emplace_back(p->floats[i], p->floats[i + 1]);
    return out;
}
std::vector<Vec3> Params::points3(std::string_view name) { return triples(find(name, {ParamType::Point3})); }
std::vector<Vec3> Params::normals(std::string_view name) { return triples(find(name, {ParamType::Normal3})); }

void Params::note_unused() {
    if (ignore_all_) return;
    for (std::size_t i = 0; i < own_.size(); ++i)
        if (!used_[i])
            context_->note(own_[i].where, what_ + ": parameter \"" + shown(own_[i].name) +
                                              "\" is unknown and ignored" +
                                              did_you_mean(own_[i].name, asked_));
}

}  // namespace nephroid
