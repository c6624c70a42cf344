// Settings in the words of the command line.
#pragma once

#include "film/film.h"
#include "scene/settings.h"

#include <string>

namespace nephroid::cli {

std::string name_of(Integrator const& integrator);
std::string name_of(Sampler const& sampler);
std::string name_of(Filter const& filter);
/// What a film says about its render, so that another one can be told apart by option and value.
SettingWords words_of(Settings const& settings);

}  // namespace nephroid::cli
