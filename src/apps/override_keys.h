// The table behind `--set key=value`: what a key does to the settings, and how values are read.
#pragma once

#include "scene/settings.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::cli {

/// One key. `set` throws Error(Input) that names it.
struct OverrideKey {
    char const* name;
    char const* help;
    std::function<void(Settings&, std::string const&)> set;
};

/// Those of the integrators that shoot photons (override_photons.cpp).
std::vector<OverrideKey> photon_keys();

[[noreturn]] void refuse_set(std::string const& key, std::string const& why);
int to_int(std::string const& key, std::string const& text, int least);
float to_number(std::string const& key, std::string const& text);
float to_positive(std::string const& key, std::string const& text);
/// Above 0, and at most 1.
float to_share(std::string const& key, std::string const& text);
bool to_bool(std::string const& key, std::string const& text);

template <class T>
T to_choice(std::string const& key, std::string const& text,
            std::vector<std::pair<char const*, T>> const& choices) {
    std::string known;
    for (auto const& [name, value] : choices) {
        if (text == name) return value;
        known += known.empty() ? name : std::string(", ") + name;
    }
    refuse_set(key, "unknown \"" + text + "\"; choose one of " + known);
}

/// The alternative T of a setting, or a refusal that says which one would have the key.
template <class T, class Variant>
T& alternative(Variant& v, std::string const& key, char const* what) {
    if (auto* t = std::get_if<T>(&v)) return *t;
    refuse_set(key, std::string("only ") + what + " has that");
}

}  // namespace nephroid::cli
