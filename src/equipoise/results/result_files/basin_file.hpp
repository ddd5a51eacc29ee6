// Per-start results as NetCDF, kept as they come and resumable.
// This room: files of single results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/machine/datasheet/scales.hpp"
#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/results/commands/transient_result.hpp"
#include "equipoise/results/io/row_store.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// What a basin file states about the run that made it.
struct BasinFileHeader {
  std::string study;  ///< resolved study as TOML, without its number of starts
  int balls = 2;
  std::string cpu_target;              ///< of this run; a file may hold results of several
  std::string arithmetic;              ///< runs with the same value give bit-identical results
  bool angles = true;                  ///< false: leave phi out; it follows from seed and index
  bool driven = false;                 ///< a motor turns the rotor: each start has its own mean speed
  bool touches = false;                ///< balls collide: each start records whether they did
  bool sticks = false;                 ///< dry friction may hold balls anywhere: each start has its own unbalance left
  std::vector<std::string> variables;  ///< of the states of discoveries, by name
  /// Uncertain values that each start draws, by key, and their units. A motion is then kept as the number of the start
  /// that met it, because each start has its own rotor.
  std::vector<std::string> drawn, drawn_units;
  bool full_starts = false;  ///< starts differ in more than their ball angles
  std::string own_starts;    ///< for the caller's own starts: their number and checksum; empty: drawn
  SamplingMethod method = SamplingMethod::random;
  std::optional<TransientSettings> transients;  ///< if the file holds transients
  std::optional<model::Scales> scales;          ///< of a study in physical units; stated in files with transients
};

/// What a run states of all starts in the file that it leaves.
struct BasinEnd {
  std::string study;  ///< resolved, as TOML
  std::vector<OutcomeShare> summary;
  bool complete = false;                        ///< all requested starts are there
  RunTime time;                                 ///< of this run
  std::optional<TransientGroup> all{};          ///< transients of all starts, if the file holds them
  std::optional<WithoutBalls> without_balls{};  ///< the same
};

/// The starts of an ensemble, as a store (results/io/store.hpp). In the finished results dimension start has its index
/// and the variables phi(start, ball), outcome(start), decision_time(start), decided_by(start); for driven rotors
/// mean_speed(start), with sticking balls left_unbalance(start), with touching balls balls_met(start), with
/// full_starts rotor_state(start, rotor_component) and phi_dot(start, ball), with own_starts psi(start), on a grid
/// weight(start), with uncertain values drawn(start, uncertain_value), with transients the columns of TransientRow.
/// Dimension outcome_kind has code, name, alias, count, share and its interval; except for random starts also the
/// origin of the interval and the equivalent number of random starts; with sticking balls quantiles of what they
/// leave. Dimension discovery has states of motions met during the run. Every variable has units and long_name.
/// Readable by xarray, ncdump, ncview.
class BasinFile : public io::RowStore {
 public:
  /// Opens results of the same study, seed, version and arithmetic, or begins new ones. Throws like Store.
  BasinFile(const std::string& path, const BasinFileHeader& header);

  /// Starts already stored (0 .. stored() - 1).
  std::uint64_t stored() const { return stored_; }
  /// The next start that is stored behind a gap, left by damage; the largest number if there is none. Once the gap is
  /// filled, stored() passes over it.
  std::uint64_t stored_next() const {
    return behind_.empty() ? std::numeric_limits<std::uint64_t>::max() : behind_.begin()->first;
  }
  /// What damage has taken from `path`.part, in words; empty if nothing.
  std::string loss() const;
  /// Of these, those that `path` does not hold yet.
  std::uint64_t unfinished() const { return stored_ - finished(); }
  /// The CPU targets that they were computed on.
  const std::vector<std::string>& cpu_targets() const { return cpu_targets_; }
  /// Starts first .. first + count - 1, each with an Outcome (outcome_of()).
  StartArrays read(std::uint64_t first, std::size_t count) const;
  /// Appends starts. `so_far`: time of this run. If the disk cannot take them, throws RunError and keeps all earlier
  /// ones.
  void append(const StartArrays& starts, const RunTime& so_far);
  /// Removes the search log: everything requested is in `path`.
  void forget_notes();
  /// Writes the results, with earlier runs' time added; nothing if nothing is stored. Call it last. Throws like Store.
  void finish(const BasinEnd& end);
  /// As stated by the last run's finish(); complete() is false if there was none.
  bool complete() const { return unfinished() == 0 && says_complete(); }
  std::vector<OutcomeShare> summary() const;
  /// Of all runs into the file.
  RunTime time() const { return time_; }

 private:
  void hold(std::uint64_t first, std::uint64_t count);
  bool ran_on(const std::string& target) const;

  const BasinFileHeader header_;
  const std::vector<io::StartColumn> columns_;
  std::uint64_t stored_ = 0;
  std::map<std::uint64_t, std::uint64_t> behind_;  // first start and end of those behind a gap
  std::vector<std::string> cpu_targets_;
  RunTime time_;
};

namespace io {

/// The content of such a file.
struct BasinContents : BasinEnd {
  const BasinFileHeader& header;
  std::uint64_t starts = 0;                               ///< 1 or more
  std::function<DataValues(std::size_t column)> columns;  ///< their values (start_columns.hpp)
  std::vector<std::vector<double>> discoveries;
  std::vector<std::string> cpu_targets;
};
/// Refers to the argument.
Dataset basin_dataset(const BasinContents& contents);

}  // namespace io
}  // namespace equipoise
