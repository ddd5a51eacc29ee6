// The main question: with what probability do the balls end up balancing the rotor?
// This room: an ensemble's starts, shares and file.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

class Catalogue;
class OpenEnsembles;
class SearchLog;
struct AttractorSearchCache;

/// Progress counts stages of the attractor search (Progress::preparing), then decided starts, in order. The total is 0
/// while sampling until a half-width is reached.
struct BasinOptions : RunOptions {
  double half_width = 0.0;  ///< where above 0: sample until every outcome's interval is this narrow: up to
                            ///< study.sampling.starts if limit_given, else 10^9. A study without sampling.method gets
                            ///< the cheaper of random and Sobol starts
  bool limit_given = false;
  std::string output;  ///< NetCDF file for per-start results; empty: none. An unfinished file of the same study is
                       ///< resumed, a finished one extended or only read
  bool store_angles = true;  ///< in `output`
  /// Gather statistics of transients, also for `output` and `keep_starts`. Unset: if the study has [limits] or
  /// [standards].
  std::optional<bool> transients;
  bool without_balls = true;  ///< with transients: also what the rotor does without balls, and with balls held
  bool keep_starts = false;   ///< the result holds every start (BasinResult::every_start): 11 bytes a start, 8 more a
                              ///< ball, and 40 more with transients
  std::uint64_t keep_at_most = std::numeric_limits<std::uint64_t>::max();  ///< `keep_starts`: only the first ones
  /// The caller's own starts, followed in place of drawn ones. Start i begins at t = 0 at initial[i], a whole state in
  /// the form of [initial]. All of them are followed, whatever study.sampling says. All count alike: intervals are
  /// those of random starts, for whatever distribution the caller drew them from. At a prescribed speed psi must be the
  /// study's if the rotor's angle matters (gravity, anisotropic supports). If the balls are clamped at first,
  /// everything but their angles must be the study's. Not allowed with a half-width, sampling.method "sobol" or "grid",
  /// or uncertain values.
  std::vector<InitialState> initial;
  /// States near motions known from elsewhere (dimension(balls) numbers each): rare attractors that pilots miss.
  std::vector<std::vector<double>> warm_start_states;
  SearchMode search = SearchMode::full;                ///< warm: these states are all of a neighbouring study
  double search_serves = many_starts;                  ///< starts (AttractorSearchSettings)
  const WarmStartLevels* warm_start_levels = nullptr;  ///< levels of the neighbour's trapping regions, or null
  int search_threads = 0;                              ///< for the attractor search; 0: as `threads`
  OpenEnsembles* help = nullptr;  ///< threads that help to decide starts (analyses/ensembles/chunks.hpp), or null
  SearchLog* notes = nullptr;     ///< the search log, or null; a run with `output` keeps it in that file instead
  AttractorSearchCache* searches = nullptr;  ///< shared by consecutive runs with the same final speed; results do
                                             ///< not depend on it
  /// Called for every counted start in index order, stored ones included; from any thread, but one at a time.
  std::function<void(const Outcome&)> outcome;
};

bool gathers_transients(const Study& study, const BasinOptions& options);

/// The initial values of start `index` at t = 0. The index may exceed study.sampling.starts; on a grid it must be below
/// the grid's number of starts.
InitialState start_of(const Study& study, std::uint64_t index);

/// One start decided by itself.
struct StartReplay {
  std::uint64_t index = 0;
  InitialState start;         ///< state at t = 0
  std::vector<double> drawn;  ///< uncertain values, in the order and units of study.uncertain.values
  Outcome outcome;
  std::string name;                        ///< of the attractor, or empty
  std::optional<TransientRow> transients;  ///< if they are gathered
};

/// Runs the ensemble: study.sampling.starts starts, or as many as options.half_width needs. The outcome of start i
/// depends on the study and i alone (for one CPU target; see docs/explanation/numerics.md).
/// Throws InputError for studies that cannot be decided (see check_runnable()) and for unusable output files. Throws
/// RunError if the output file fails later.
/// `catalogue`, if given, receives the attractors found, refined and named; `warm_start_levels` the levels of their
/// trapping regions.
BasinResult basin(const Study& study, const BasinOptions& options = {}, Catalogue* catalogue = nullptr,
                  WarmStartLevels* warm_start_levels = nullptr);

/// The outcome of start `index`, bit for bit as basin() gives it. The index may exceed study.sampling.starts, but must
/// be below the number of options.initial, if any.
StartReplay replay_start(const Study& study, std::uint64_t index, const BasinOptions& options = {});

}  // namespace equipoise
