// Per-start results as NetCDF, kept as they come and resumable.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/model/scales.hpp"
#include "equipoise/result_files/start_columns.hpp"
#include "equipoise/results/outcome_share.hpp"
#include "equipoise/results/transient_figures.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

class SearchLog;

/// What a basin file says of the run that made it.
struct BasinFileHeader {
  std::string study;  ///< resolved study as TOML, without its number of starts
  int balls = 2;
  std::string cpu_target;  ///< of this run; a file may hold results of several
  std::string arithmetic;  ///< what they must share for their results to be the same to the bit
  bool angles = true;      ///< false: leave phi out; it follows from seed and index
  bool driven = false;     ///< a motor turns the rotor: each start has a mean speed of its own
  bool touches = false;    ///< balls collide: whether they did is said of each start
  bool sticks = false;     ///< dry friction may hold balls anywhere: each start has an unbalance left of its own
  std::vector<std::string> variables;  ///< of the states of discoveries, by name
  /// Uncertain values that each start draws, by key, and their units. Of a motion the number of the start that met it
  /// is then kept, for starts have rotors of their own.
  std::vector<std::string> drawn, drawn_units;
  bool full_starts = false;  ///< starts differ in more than their ball angles
  std::string own_starts;    ///< of starts that are the caller's: how many, and their checksum; empty: drawn
  SamplingMethod method = SamplingMethod::random;
  std::optional<TransientSettings> transients;  ///< if the file holds transients
  std::optional<model::Scales> scales;          ///< of a study in physical units; stated in files with transients
};

/// Time that all runs into a file took together.
struct RunTime {
  double seconds = 0.0, cpu_seconds = 0.0;
};

/// Two files. The results, `path`, are NetCDF (classic, 64-bit offsets), always written whole beside and renamed:
/// dimension start with its index and variables phi(start, ball), outcome(start), decision_time(start),
/// decided_by(start), of driven rotors mean_speed(start), with balls that stick left_unbalance(start), with balls that
/// touch balls_met(start), and with full_starts rotor_state(start, rotor_component) and phi_dot(start, ball), with
/// own_starts psi(start), on a grid weight(start), with uncertain values drawn(start, uncertain_value); dimension
/// outcome_kind: code, name, alias, count, share and its interval, and but for random starts where the interval is from
/// and how many random starts would have done, with balls that stick quantiles of what they leave; with transients the
/// columns of TransientRow by start; dimension discovery: states of motions met during the run. Every variable has
/// units and long_name. Readable by xarray, ncdump, ncview. Behind it all stands a checksum; a file without it, or with
/// another, is not read.
///
/// While a run goes on, `path`.part holds what is new (io/journal.hpp), so that a run that is killed loses a
/// second's work, and what its search has found out; it is gone once all results are in place, and of some only the
/// search is left. One run at a time has a file.
class BasinFile {
 public:
  /// Opens what `path` and `path`.part hold of the same study, seed, version and arithmetic, or begins anew.
  /// Throws InputError if it cannot be written, is in use, damaged, or holds something else: which, it says.
  BasinFile(const std::string& path, const BasinFileHeader& header);
  ~BasinFile();
  BasinFile(const BasinFile&) = delete;
  BasinFile& operator=(const BasinFile&) = delete;

  /// Starts already there (0 .. stored() - 1).
  std::uint64_t stored() const;
  /// Of them, those that `path` does not hold yet.
  std::uint64_t unfinished() const;
  /// The CPU targets that they were computed on.
  const std::vector<std::string>& cpu_targets() const;
  /// Fates of starts first .. first + count - 1.
  std::vector<Fate> read(std::uint64_t first, std::size_t count) const;
  /// Their transients, of a file that holds them.
  std::vector<TransientRow> read_transients(std::uint64_t first, std::size_t count) const;
  /// Appends starts; they are on disk within about a second of work. `so_far`: of this run. Throws RunError, with all
  /// before them kept, if the disk cannot take them.
  void append(const StartBatch& batch, const RunTime& so_far);
  /// States on motions that were first met during earlier runs, in the order of starts: enough to name them again.
  std::vector<std::vector<double>> discoveries() const;
  /// Of the search for attractors, as far as runs came that did not finish.
  SearchLog& notes();
  /// Leaves no notes behind: all that was asked for is in `path`.
  void forget_notes();
  void append_attractor_search(const std::vector<double>& state);
  /// Writes the results: all that is stored, the summary of all of it, the resolved study; `complete` marks whether all
  /// requested starts are there. `time`: of this run; it is added to what earlier ones took. Nothing is written where
  /// nothing is stored. To be called last. Throws RunError, with everything kept as it was, if the disk cannot take it.
  void finish(const std::string& resolved_study, const std::vector<OutcomeShare>& summary, bool complete,
              const RunTime& time);
  /// What the last run's finish() said; complete() is false if there was none.
  bool complete() const;
  std::vector<OutcomeShare> summary() const;
  RunTime time() const;

 private:
  void read_share(std::size_t kind, Share& share) const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace equipoise
