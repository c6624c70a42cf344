// Blocks, instances and other files: the directives that give a scene its structure.
#include "pbrt_reader.h"

#include "scene/affine_rows.h"

#include <algorithm>
#include <utility>

namespace nephroid {

namespace {

constexpr std::size_t kMaxBlocks = 4'000'000;  // 400 bytes each
constexpr std::size_t kMaxIncludes = 32;
// 32 files that each include the next one ten times would be read for longer than anybody waits.
constexpr std::size_t kMaxIncludedFiles = 10'000;
constexpr std::size_t kMaxIncludedBytes = std::size_t{4} << 30;
constexpr std::size_t kMaxAttributes = 1000;  // look-ups are linear

}  // namespace

void PbrtReader::world_begin(Tokenizer& /*tokens*/, SourceLocation /*where*/) {
    in_world_ = true;
    state_.start = state_.end = {};
    state_.start_active = state_.end_active = true;
    coordinate_systems_["world"] = {};
}

void PbrtReader::world_end(Tokenizer& /*tokens*/, SourceLocation where) {
    context_.note(where, "WorldEnd is of pbrt-v3: in pbrt-v4 the world ends with the file");
}

void PbrtReader::push(char kind, SourceLocation where) {
    if (saved_.size() == kMaxBlocks)
        throw Error(ErrorKind::Limit, context_.scene.locate(where) + ": more than four million open blocks");
    saved_.push_back({state_, kind, where});
}

bool PbrtReader::pop(char kind, SourceLocation where) {
    char const* const end = kind == 'o' ? "ObjectEnd" : "AttributeEnd";
    if (saved_.size() <= saved_floor_) {
        context_.note(where, std::string(end) + " without its Begin is ignored");
        return false;
    }
    auto& top = saved_.back();
    if (top.kind != kind)
        context_.fail(where, std::string(end) + " closes what " +
                                 (kind == 'o' ? "AttributeBegin" : "ObjectBegin") + " opened at " +
                                 context_.scene.locate(top.where));
    state_ = std::move(top.state);
    saved_.pop_back();
    return true;
}

void PbrtReader::attribute_begin(Tokenizer& /*tokens*/, SourceLocation where) { push('a', where); }
void PbrtReader::attribute_end(Tokenizer& /*tokens*/, SourceLocation where) { pop('a', where); }
void PbrtReader::transform_begin(Tokenizer& /*tokens*/, SourceLocation where) {
    context_.note(where, "TransformBegin is deprecated; as in pbrt-v4 it saves all that AttributeBegin does");
    push('a', where);
}

void PbrtReader::attribute(Tokenizer& tokens, SourceLocation where) {
    auto const target = type_of(tokens, "Attribute");
    constexpr std::array<std::string_view, 5> kTargets{"shape", "light", "material", "medium", "texture"};
    auto const it = std::find(kTargets.begin(), kTargets.end(), target);
    if (it == kTargets.end())
        context_.fail(where, "Attribute \"" + shown(target) +
                                 "\": must be \"shape\", \"light\", \"material\", \"medium\" or \"texture\"");
    auto& shared = state_.attributes[static_cast<std::size_t>(it - kTargets.begin())];
    shared = with_attributes(shared, parse_params(tokens, context_, state_.color_space));
    if (shared->count > kMaxAttributes)
        throw Error(ErrorKind::Limit, context_.scene.locate(where) +
                                          ": more than 1000 parameters are set by " + "Attribute \"" +
                                          shown(target) + "\" at once; close blocks, or set fewer");
}

void PbrtReader::object_begin(Tokenizer& tokens, SourceLocation where) {
    auto const name = type_of(tokens, "ObjectBegin");
    if (group_ != GroupId{0}) context_.fail(where, "ObjectBegin inside another object; end that first");
    push('o', where);
    auto& object = objects_[name];
    if (object.defined)
        context_.fail(where, "object \"" + shown(name) + "\" is already defined at " +
                                 context_.scene.locate(context_.scene[object.group].where));
    if (!object.group.valid()) object.group = context_.scene.add(Group{name, {}, {}, where});
    context_.scene.groups[object.group.value].where = where;
    object.defined = true;
    group_ = object.group;
}

void PbrtReader::object_end(Tokenizer& /*tokens*/, SourceLocation where) {
    if (group_ == GroupId{0}) context_.fail(where, "ObjectEnd without its Begin");
    if (pop('o', where)) group_ = GroupId{0};
}

void PbrtReader::object_instance(Tokenizer& tokens, SourceLocation where) {
    auto const name = type_of(tokens, "ObjectInstance");
    auto& object = objects_[name];
    if (!object.group.valid()) {
        // It may be defined later; finish_objects() looks.
        object.group = context_.scene.add(Group{name, {}, {}, where});
        object.first_use = where;
    }
    if (object.group == group_) context_.fail(where, "object \"" + shown(name) + "\" contains itself");
    if (!is_affine(state_.start))
        context_.fail(where, "the transform of an instance must not be a projection");
    note_motion(where);
    context_.scene.groups[group_.value].instances.push_back({object.group, rows_of(state_.start), where});
}

void PbrtReader::run_file(Tokenizer& tokens, SourceLocation where, char const* what) {
    auto const name = type_of(tokens, what);
    auto const path = context_.resolve(where, name);
    std::error_code ignored;
    auto canonical = std::filesystem::weakly_canonical(path, ignored);
    if (std::find(open_files_.begin(), open_files_.end(), canonical) != open_files_.end())
        context_.fail(where, std::string(what) + " \"" + shown(name) + "\": the file includes itself");
    if (open_files_.size() >= kMaxIncludes)
        context_.fail(where,
                      std::string(what) + " \"" + shown(name) + "\": files are nested more than 32 deep");
    auto const limit = [&](char const* message) {
        throw Error(ErrorKind::Limit,
                    context_.scene.locate(where) + ": " + what + " \"" + shown(name) + "\": " + message);
    };
    if (++included_files_ > kMaxIncludedFiles)
        limit("more than 10000 files in all; include each part once and instance it with ObjectInstance");
    auto const text = context_.read_named(where, what, path);
    included_bytes_ += text.size();
    if (included_bytes_ > kMaxIncludedBytes)
        limit(
            "more than 4 GiB of included files in all; keep meshes in PLY files, and repeat with "
            "ObjectInstance");
    auto const file = context_.add_file(path.string(), path.parent_path());
    open_files_.push_back(std::move(canonical));
    Tokenizer inner(context_.scene, file, text);
    run(inner);
    open_files_.pop_back();
}

void PbrtReader::include(Tokenizer& tokens, SourceLocation where) { run_file(tokens, where, "Include"); }

/// As Include, but nothing of the graphics state comes back.
void PbrtReader::import(Tokenizer& tokens, SourceLocation where) {
    auto const state = state_;
    auto const depth = saved_.size();
    auto const group = group_;
    auto const floor = std::exchange(saved_floor_, depth);
    run_file(tokens, where, "Import");
    if (saved_.size() != depth)
        context_.fail(saved_.back().where, "this block is not closed in the imported file");
    saved_floor_ = floor;
    state_ = state;
    group_ = group;
}

}  // namespace nephroid
