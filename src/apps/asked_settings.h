// What the command line says about how a scene is rendered, on top of what the scene says.
#pragma once

#include "commands.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <vector>

namespace nephroid::cli {

/// Throws Error(Input).
[[noreturn]] void refuse_option(std::string const& message);

/// Numbers between separators, all of the text or nothing.
template <class T>
std::vector<T> numbers(std::string const& option, std::string const& text, char separator,
                       std::size_t count) {
    std::vector<T> out;
    char const* p = text.data();
    char const* const end = p + text.size();
    while (p < end) {
        T v{};
        auto const r = std::from_chars(p, end, v);
        if (r.ec != std::errc{}) break;
        out.push_back(v);
        p = r.ptr;
        if (p < end && *p == separator && p + 1 < end)
            ++p;
        else
            break;
    }
    if (p != end || out.size() != count)
        refuse_option(
            fmt::format("{} {}: expected {} numbers with '{}' between them", option, text, count, separator));
    return out;
}

/// The scene's settings, overridden. Throws Error(Input) that names the option.
Settings settings_of(SettingOptions const& o, Scene const& scene);

}  // namespace nephroid::cli
