// A mapper's attractor search, for an ensemble of the same rotor.
#pragma once

#include <string>

#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"

namespace equipoise {

/// What basin() of `study` on CPU target `target` can use instead of its own search (BasinOptions::searches), with
/// the same bits. The mapper's study must have the same search (attractor_search_subject()) and the same target;
/// otherwise throws InputError that names the difference. Also throws for studies that are decided without a search.
AttractorSearchCache mapped_search(const Mapper& mapper, const Study& study, const std::string& target);

}  // namespace equipoise
