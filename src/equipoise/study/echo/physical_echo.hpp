// A dimensionless study written in physical units.
// This room: a study written again: as a tree, as TOML, in physical units.
#pragma once

#include <string>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The study with its default release stated: the default differs with units, except for a driven rotor.
Study stating_release(Study study);

/// The resolved study as TOML in physical units, from its scales. read_study() takes it back to the same machine. If
/// the mean stiffness is 1 (as in every study read in physical units), it takes it back to the same dimensionless
/// numbers, up to rounding. Throws InputError if the study has no scales.
std::string to_physical_toml(const Study& study);

}  // namespace equipoise
