// A mapper's search, for an ensemble of the same rotor.
#pragma once

#include <string>

#include "equipoise/analyses/mapper.hpp"
#include "equipoise/attractor_search/attractor_search.hpp"

namespace equipoise {

/// What basin() of `study` on CPU target `target` takes in place of a search of its own (BasinOptions::discoveries), to
/// the same bits. Throws InputError, naming what differs, unless the mapper's study has the same search
/// (attractor_search_subject()) and its target is the same, and for studies whose starts are followed without a search.
AttractorSearchCache mapped_search(const Mapper& mapper, const Study& study, const std::string& target);

}  // namespace equipoise
