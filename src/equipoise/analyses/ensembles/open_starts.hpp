// The note that says why starts of an ensemble stay open.
#pragma once

#include <functional>
#include <vector>

#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/core/statistics/escape_rate.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// Looks at how some starts go on at the end; returns none once stopped.
using LookAt = std::function<std::vector<UndecidedEnd>()>;

/// How fast starts leave long-lived chaos.
void note_chaos(BasinResult& result, const EscapeRate& chaos);

/// Many undecided starts make an ensemble worthless, so the note then gives the reason. Balls that are never released
/// are noted even if only one start has them.
void note_open_starts(BasinResult& result, const Horizon& horizon, const LookAt& undecided, const LookAt& stalled);

}  // namespace equipoise
