// What decides the starts of basin().
#pragma once

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The study with its horizon, and with random starts if it names no way of sampling.
Study as_sampled(Study study);

/// Checks options.initial, and makes the study's starts those. Throws InputError.
void take_given_starts(const BasinOptions& options, Study& study);

/// What the options of basin() ask of the attractor search. `searches` may be null.
AttractorSearchSettings search_settings(const BasinOptions& options, AttractorSearchCache* searches);

/// A session that keeps deciding after the stop flag and callbacks of its search are gone. It searches with `options`
/// first and finds the result again in `found`. The study must have its horizon and method. Throws RunError if stopped.
Session lasting_session(const Study& study, const RunOptions& options, bool transients, AttractorSearchCache& found,
                        SearchMode mode = SearchMode::full);

}  // namespace equipoise
