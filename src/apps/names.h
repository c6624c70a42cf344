// Settings in the words of the command line.
#pragma once

#include "film/film.h"
#include "scene/settings.h"
#include "world/world.h"

#include <string>
#include <vector>

namespace nephroid::cli {

std::string name_of(Integrator const& integrator);
std::string name_of(Sampler const& sampler);
std::string name_of(Filter const& filter);
std::string name_of(CameraKind const& camera);
std::string name_of(MaterialKind const& material);
std::string name_of(LightKind const& light);
/// Of an integrator that shoots photons, by the keys of --set; empty for others.
SettingWords photon_words(Integrator const& integrator);
/// What a film says about its render, so that another one can be told apart by option and value.
SettingWords words_of(Settings const& settings);
/// … and back: samples of a pixel in each of its passes.
std::uint64_t samples_of_a_pass(SettingWords const& words);

/// Of the lights that photons are counted by, in that order; shorter where names are not known.
std::vector<std::string> source_names(World const& world);
/// … and which of them a photon's light (LightRay::light) belongs to.
std::uint32_t source_index(World const& world, std::uint32_t light);

}  // namespace nephroid::cli
