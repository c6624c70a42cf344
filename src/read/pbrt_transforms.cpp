// Transform directives: each multiplies the current transform, or transforms, from the right.
#include "pbrt_reader.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

void PbrtReader::concat(Mat4 const& m, SourceLocation where) {
    auto const apply = [&](Mat4& ctm) {
        ctm = ctm * m;
        for (auto const& row : ctm.m)
            for (double const x : row)
                if (!std::isfinite(x)) context_.fail(where, "the current transform overflows");
    };
    if (state_.start_active) apply(state_.start);
    if (state_.end_active) apply(state_.end);
}

void PbrtReader::identity(Tokenizer& /*tokens*/, SourceLocation /*where*/) {
    if (state_.start_active) state_.start = {};
    if (state_.end_active) state_.end = {};
}

void PbrtReader::translate_by(Tokenizer& tokens, SourceLocation where) {
    std::array<double, 3> v{};
    for (auto& x : v) x = required_number(tokens, context_, "Translate");
    concat(translate(v[0], v[1], v[2]), where);
}

void PbrtReader::scale_by(Tokenizer& tokens, SourceLocation where) {
    std::array<double, 3> v{};
    for (auto& x : v) x = required_number(tokens, context_, "Scale");
    concat(scale(v[0], v[1], v[2]), where);
}

void PbrtReader::rotate_by(Tokenizer& tokens, SourceLocation where) {
    std::array<double, 4> v{};
    for (auto& x : v) x = required_number(tokens, context_, "Rotate");
    auto const m = rotate(v[0], v[1], v[2], v[3]);
    if (!m) context_.fail(where, "Rotate: the axis is zero");
    concat(*m, where);
}

void PbrtReader::look(Tokenizer& tokens, SourceLocation where) {
    std::array<double, 9> v{};
    for (auto& x : v) x = required_number(tokens, context_, "LookAt");
    auto const m = look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
    if (!m) context_.fail(where, "LookAt: the eye is at the target, or up is along the view");
    concat(*m, where);
}

/// Sixteen numbers in brackets, column by column: the transpose of how the matrix is written on paper.
Mat4 PbrtReader::matrix(Tokenizer& tokens, char const* what) {
    auto const bracket = [&](Token::Kind kind, char const* name) {
        auto const token = tokens.next();
        if (!token || token->kind != kind)
            context_.fail(token ? tokens.at(*token) : tokens.here(),
                          std::string(what) + ": sixteen numbers in brackets, but there is no " + name);
    };
    bracket(Token::Kind::Open, "[");
    Mat4 m;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) m.m[row][column] = required_number(tokens, context_, what);
    bracket(Token::Kind::Close, "]");
    return m;
}

void PbrtReader::transform(Tokenizer& tokens, SourceLocation where) {
    auto const m = matrix(tokens, "Transform");
    identity(tokens, where);
    concat(m, where);
}

void PbrtReader::concat_transform(Tokenizer& tokens, SourceLocation where) {
    concat(matrix(tokens, "ConcatTransform"), where);
}

void PbrtReader::coordinate_system(Tokenizer& tokens, SourceLocation /*where*/) {
    coordinate_systems_.insert_or_assign(type_of(tokens, "CoordinateSystem"),
                                         std::pair{state_.start, state_.end});
}

void PbrtReader::coord_sys_transform(Tokenizer& tokens, SourceLocation where) {
    auto const name = type_of(tokens, "CoordSysTransform");
    auto const it = coordinate_systems_.find(name);
    if (it == coordinate_systems_.end()) {
        std::vector<std::string> names;
        for (auto const& [n, m] : coordinate_systems_) names.push_back(n);
        return context_.note(where, "no coordinate system \"" + shown(name) + "\" is defined" +
                                        did_you_mean(name, names) + ": the transform stays as it is");
    }
    state_.start = it->second.first, state_.end = it->second.second;
}

void PbrtReader::active_transform(Tokenizer& tokens, SourceLocation where) {
    auto const token = tokens.next();
    auto const word = token && token->kind == Token::Kind::Word ? token->text : std::string_view{};
    if (word != "All" && word != "StartTime" && word != "EndTime")
        context_.fail(where, "ActiveTransform must be followed by All, StartTime or EndTime");
    state_.start_active = word != "EndTime";
    state_.end_active = word != "StartTime";
}

void PbrtReader::transform_times(Tokenizer& tokens, SourceLocation /*where*/) {
    // Of motion only the start is rendered, so when it starts does not matter.
    for (int i = 0; i < 2; ++i) required_number(tokens, context_, "TransformTimes");
}

Mat4 PbrtReader::inverse_transform(Params& p) {
    auto const computed = inverse(state_.start);
    if (!computed) p.fail("the current transform cannot be inverted");
    auto const name = p.string("inverse", "");
    if (name.empty()) return *computed;
    auto const it = coordinate_systems_.find(name);
    if (it == coordinate_systems_.end())
        p.fail("\"inverse\": no coordinate system \"" + shown(name) + "\" is defined");
    Mat4 const& given = it->second.first;
    for (std::size_t i = 0; i < 4; ++i) {
        double size = 0;
        for (double const x : computed->m[i]) size = std::max(size, std::abs(x));
        for (std::size_t k = 0; k < 4; ++k)
            if (!(std::abs(given.m[i][k] - computed->m[i][k]) <= 1e-6 * size))
                p.fail("\"inverse\": \"" + shown(name) +
                       "\" is not the inverse of the current transform; leave it out");
    }
    return given;
}

void PbrtReader::note_motion(SourceLocation where) {
    if (state_.start != state_.end)
        context_.note(where, "motion is not rendered yet: what moves stands at its start transform");
}

}  // namespace nephroid
