// Why starts of an ensemble stay open, in its note.
#pragma once

#include <functional>
#include <vector>

#include "equipoise/results/basin_result.hpp"
#include "equipoise/start_runs/undecided.hpp"

namespace equipoise {

/// What some starts do in the end; none once stopped.
using LookAt = std::function<std::vector<UndecidedEnd>()>;

/// Many undecided starts are no answer: the note then says why there are so many. That balls are never let go is said
/// of any.
void note_open_starts(BasinResult& result, const Horizon& horizon, const LookAt& undecided, const LookAt& stalled);

}  // namespace equipoise
