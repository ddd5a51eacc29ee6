// A mapper's search, for an ensemble of the same rotor.
#pragma once

#include <string>

#include "equipoise/basins/mapper.hpp"
#include "equipoise/discovery/discovery.hpp"

namespace equipoise {

/// What basin() of `study` on CPU target `target` takes in place of a search of its own (BasinOptions::discoveries), to
/// the same bits. Throws InputError, naming what differs, unless the mapper's study has the same search
/// (discovery_subject()) and its target is the same, and for studies whose starts are followed without a search.
DiscoveryCache mapped_search(const Mapper& mapper, const Study& study, const std::string& target);

}  // namespace equipoise
