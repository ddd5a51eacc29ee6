// A study in physical units again.
#pragma once

#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// The study with the release that it leaves to its default written down: without units that is another than with them.
/// Of a driven rotor it is the same.
Study stating_release(Study study);

/// The resolved study as TOML in physical units, from its scales; read_study() takes it back to the same machine, and,
/// if the mean of the stiffnesses is 1 (as in every study that came in physical units), to the same dimensionless
/// numbers but for rounding. Throws InputError if the study has no scales.
std::string to_physical_toml(const Study& study);

}  // namespace equipoise
