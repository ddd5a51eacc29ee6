// What decides the starts of basin().
#pragma once

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The study with its horizon, and with random starts if it names no way of sampling.
Study as_sampled(Study study);

/// Checks options.initial, and makes the study's starts those. Throws InputError.
void take_given_starts(const BasinOptions& options, Study& study);

/// What the options of basin() ask of the attractor search. `searches` may be null.
AttractorSearchSettings search_settings(const BasinOptions& options, AttractorSearchCache* searches);

}  // namespace equipoise
