// The main question: with what probability do the balls end up balancing the rotor?
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/results/basin_result.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

class Catalogue;
class ChunkHelp;
class SearchLog;
struct AttractorSearchCache;
struct WarmStartLevels;

/// Progress is in stages of the search for attractors (Progress::preparing), then in starts decided, in order; the
/// total is 0 while sampling until a half-width is reached.
struct BasinOptions : RunOptions {
  double half_width = 0.0;  ///< > 0: sample until every outcome's interval is this narrow, at most
                            ///< study.sampling.starts if limit_given, else at most 10^9. A study that leaves
                            ///< sampling.method open gets the cheaper of random and Sobol starts
  bool limit_given = false;
  std::string output;  ///< NetCDF file for per-start results; empty: none. An unfinished file of the same study is
                       ///< resumed, a finished one extended or simply read
  bool store_angles = true;  ///< in `output`
  /// Gather the statistics of transients; `output` and `keep_starts` hold them too. Unset: if the study has [limits].
  std::optional<bool> transients;
  bool keep_starts = false;  ///< the result holds every start (BasinResult::every_start): 11 bytes a start and 8 a
                             ///< ball, with transients 40 more
  std::uint64_t keep_at_most = std::numeric_limits<std::uint64_t>::max();  ///< `keep_starts`: only so many, the first
  /// Starts of the caller's own, followed in place of drawn ones: start i begins at t = 0 as initial[i] says, each a
  /// whole state as [initial] has it. All of them are followed, whatever study.sampling says, and counted alike: an
  /// interval is that of random starts, and speaks of whatever distribution they were drawn from. Where the rotor turns
  /// as prescribed, psi is the study's if the rotor's angle matters (gravity, unequal supports), and while balls are
  /// held at first all but their angles is. Not with a half-width, sampling.method "sobol" or "grid", or uncertain
  /// values.
  std::vector<InitialState> initial;
  /// States near motions known from elsewhere, each dimension(balls) numbers: rare attractors that pilot starts miss.
  std::vector<std::vector<double>> warm_start_states;
  bool warm_start =
      false;  ///< the seeds are all of a neighbouring study's: a shorter search (AttractorSearchSettings::informed)
  const WarmStartLevels* warm_start_levels = nullptr;  ///< and its trapping regions, or null
  int search_threads = 0;                              ///< before the first start is decided; 0: as `threads`
  /// Who helps to decide starts that are sampled so (ensembles/chunks.hpp), or null; asked before each sample.
  std::function<ChunkHelp*(SamplingMethod)> help;
  SearchLog* notes = nullptr;  ///< of the search, or null: of a run with `output` those that are kept there
  AttractorSearchCache* discoveries = nullptr;  ///< shared by runs one after the other that end at the same speed;
                                                ///< results do not depend on it
  /// Every start counted, in order of index, those read from `output` included; from any thread, never from two at
  /// once.
  std::function<void(const Fate&)> fate;
};

/// Whether a run with these options gathers transients.
bool gathers_transients(const Study& study, const BasinOptions& options);

/// What start `index` (any, also beyond study.sampling.starts; on a grid below its number) begins with at t = 0.
InitialState start_of(const Study& study, std::uint64_t index);

/// One start replayed alone.
struct StartReplay {
  std::uint64_t index = 0;
  InitialState start;         ///< state at t = 0
  std::vector<double> drawn;  ///< uncertain values, in the order and the units of study.uncertain.values
  Fate fate;
  std::string name;                        ///< of the attractor, empty if there is none
  std::optional<TransientRow> transients;  ///< if they are gathered
};

/// Runs the ensemble: study.sampling.starts starts, or as many as options.half_width asks for. The outcome of start i
/// depends on the study and i alone (for one CPU target; see docs/numerics.md).
/// Throws InputError for studies that cannot be decided (see check_runnable()) and unusable output files,
/// RunError if the output file fails later.
/// `catalogue`, if given, receives the attractors found, refined and named, `hints` what is found about their trapping
/// regions.
BasinResult basin(const Study& study, const BasinOptions& options = {}, Catalogue* catalogue = nullptr,
                  WarmStartLevels* warm_start_levels = nullptr);

/// The fate of start `index` (any, also beyond study.sampling.starts; below the number of options.initial), with the
/// very bits basin() would give it.
StartReplay replay_start(const Study& study, std::uint64_t index, const BasinOptions& options = {});

}  // namespace equipoise
