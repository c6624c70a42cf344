#include "targets.h"

#include "console.h"
#include "image/file.h"
#include "image/image.h"
#include "math/error.h"
#include "scene/file_path.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <unordered_map>

namespace nephroid::cli {

namespace {

namespace fs = std::filesystem;

/// One spelling for each file, whether it is there yet or not.
fs::path canonical(std::string const& path) {
    std::error_code ec;
    fs::path const full = fs::absolute(write_target(path), ec);
    fs::path const canonical = fs::weakly_canonical(full, ec);
    return ec ? full.lexically_normal() : canonical;
}

bool is_output(FileRole r) { return r == FileRole::Output || r == FileRole::FilmOutput; }

bool clash(NamedFile const& a, NamedFile const& b) {
    if (!is_output(a.role) && !is_output(b.role)) return false;
    bool const films = (a.role == FileRole::FilmInput && b.role == FileRole::FilmOutput) ||
                       (a.role == FileRole::FilmOutput && b.role == FileRole::FilmInput);
    return !films;
}

}  // namespace

bool is_film_name(std::string const& path) { return path.size() > 9 && path.ends_with(".film.exr"); }

std::string extension_of(std::string const& path) {
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void check_target(std::string const& option, std::string const& file, bool checkpoint) {
    fs::path const target = write_target(file);
    fs::path const folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code ec;
    if (!fs::is_directory(folder, ec))
        throw Error(ErrorKind::Io,
                    fmt::format("{} {}: there is no folder {}", option, file, folder.string()));
    for (char const* suffix : {"", ".previous"}) {
        if (*suffix != '\0' && !checkpoint) break;
        struct stat ignored {};
        if (::lstat((target.string() + suffix).c_str(), &ignored) != 0 && errno == ENAMETOOLONG)
            throw Error(ErrorKind::Io,
                        fmt::format("{} {}{}: the name is too long for the file system; choose a "
                                    "shorter one",
                                    option, file, suffix));
    }
    try {
        NewFile const probe{fs::path(file)};
    } catch (Error const& e) {
        throw Error(e.kind(), fmt::format("{} {}", option, e.what()));
    }
}

void check_outputs(std::vector<std::string> const& outputs, bool replay) {
    static constexpr char const* known[] = {".exr", ".png", ".jpg", ".jpeg", ".pfm", ".hdr"};
    for (std::string const& out : outputs) {
        std::string const extension = extension_of(out);
        if (std::none_of(std::begin(known), std::end(known), [&](char const* k) { return extension == k; }))
            throw Error(ErrorKind::Input,
                        fmt::format("-o {}: cannot write \"{}\" files; use .exr, .png, .jpg, .pfm, .hdr{}",
                                    out, extension, replay ? ", .film.exr, .svg or .json" : " or .film.exr"));
        check_target("-o", out);
    }
}

void check_output_size(std::vector<std::string> const& outputs, std::array<int, 4> crop) {
    int const width = crop[1] - crop[0], height = crop[3] - crop[2];
    std::int64_t const pixels = std::int64_t{width} * height;
    for (std::string const& out : outputs) {
        std::string const extension = extension_of(out);
        bool const jpeg = extension == ".jpg" || extension == ".jpeg";
        int const longest = jpeg ? 65500 : kMaxImageSide;
        if (width > longest || height > longest)
            throw Error(
                ErrorKind::Limit,
                fmt::format("-o {}: {} x {} pixels; such a file has at most {} a side: --crop the picture",
                            out, width, height, longest));
        if (extension != ".exr" && pixels > kMaxImageBytes / 12)
            throw Error(
                ErrorKind::Limit,
                fmt::format("-o {}: {} x {} pixels are more than 2 GiB of floats; write an EXR, or --crop "
                            "the picture",
                            out, width, height));
    }
}

void check_conflicts(std::vector<NamedFile> const& files) {
    // The first of each role for each file, which stands for the others: scenes name thousands of files.
    std::unordered_map<std::string, std::vector<NamedFile const*>> known;
    for (NamedFile const& file : files) {
        auto& same = known[canonical(file.path).string()];
        for (NamedFile const* const before : same) {
            if (!clash(file, *before)) continue;
            bool const both = is_output(file.role) && is_output(before->role);
            NamedFile const& written = is_output(file.role) ? file : *before;
            NamedFile const& other = is_output(file.role) ? *before : file;
            throw Error(ErrorKind::Input, fmt::format("{} {}: is {} {} as well{}; choose another name",
                                                      written.option, written.path, other.option, other.path,
                                                      both ? "" : ", which would be overwritten"));
        }
        if (std::none_of(same.begin(), same.end(),
                         [&](NamedFile const* before) { return before->role == file.role; }))
            same.push_back(&file);
    }
}

void print_written(std::string const& file) { print("{}\n", without_detours(fs::absolute(file)).string()); }

void add_outputs(std::vector<NamedFile>& files, std::vector<std::string> const& outputs) {
    for (std::string const& out : outputs)
        files.push_back({"-o", out, is_film_name(out) ? FileRole::FilmOutput : FileRole::Output});
}

}  // namespace nephroid::cli
