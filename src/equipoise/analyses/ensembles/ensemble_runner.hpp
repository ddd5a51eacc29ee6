// Parts of basin() that others share: the study and the search that its options define, and the note about open starts.
#pragma once

#include <functional>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/core/statistics/escape_rate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The study with its horizon, and with random starts if it names no way of sampling.
Study as_sampled(Study study);

/// Checks options.initial, and makes the study's starts those. Throws InputError.
void take_given_starts(const BasinOptions& options, Study& study);

/// What the options of basin() ask of the attractor search. `searches` may be null.
AttractorSearchSettings search_settings(const BasinOptions& options, AttractorSearchCache* searches);

/// Looks at how some starts go on at the end; returns none once stopped.
using LookAt = std::function<std::vector<UndecidedEnd>()>;

/// How fast starts leave long-lived chaos.
void note_chaos(BasinResult& result, const EscapeRate& chaos);

/// Many undecided starts make an ensemble worthless, so the note then gives the reason. Balls that are never released
/// are noted even if only one start has them.
void note_open_starts(BasinResult& result, const Horizon& horizon, const LookAt& undecided, const LookAt& stalled);

}  // namespace equipoise
