#include "context.h"

#include "bytes.h"
#include "scene/file_path.h"
#include "shown.h"

#include <system_error>

namespace nephroid {

namespace {
constexpr std::size_t kMaxPath = 1000;  // in messages: the end of a path matters more than that of a name
}

std::uint32_t Context::add_file(std::string const& shown, std::filesystem::path folder) {
    scene.files.push_back(nephroid::shown(shown, kMaxPath));
    folders_.push_back(std::move(folder));
    return static_cast<std::uint32_t>(scene.files.size() - 1);
}

std::filesystem::path Context::resolve(SourceLocation where, std::string const& name) const {
    std::filesystem::path path = name;
    if (path.is_absolute() || where.file >= folders_.size()) return path;
    auto below_first = without_detours(folders_[0] / path);
    if (where.file == 0) return below_first;
    std::error_code ignored;
    if (std::filesystem::exists(below_first, ignored)) return below_first;
    auto const beside = without_detours(folders_[where.file] / path);
    return std::filesystem::exists(beside, ignored) ? beside : below_first;
}

std::string Context::read_named(SourceLocation where, std::string_view what,
                                std::filesystem::path const& path) const {
    auto file = read_bytes(path);
    if (file.problem.empty()) return std::move(file.bytes);
    auto const message = scene.locate(where) + ": " + std::string(what) + " \"" +
                         shown(path.string(), kMaxPath) + "\" " + file.problem;
    throw Error(file.too_long ? ErrorKind::Limit : ErrorKind::Input, message);
}

void Context::note(SourceLocation where, std::string const& text) {
    constexpr int kSayAtMost = 5;
    auto& r = repeats_[text];
    if (r.said < kSayAtMost) {
        ++r.said;
        scene.note(where, text);
    } else {
        ++r.dropped;
        r.last = where;
    }
}

void Context::finish_notes() {
    for (auto const& [text, r] : repeats_)
        if (r.dropped > 0)
            scene.note(r.last, text + " (the last of " + std::to_string(r.dropped) + " more such notes)");
    repeats_.clear();
}

}  // namespace nephroid
