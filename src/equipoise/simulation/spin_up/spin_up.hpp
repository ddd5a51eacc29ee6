// Brings starts to the last piece of their drive, with free balls.
// This room: starts brought to the last piece of their drive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/results/types/transient_table.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// Row-major, one row per start.
struct SpunUp {
  std::vector<double> phi;        ///< initial ball angles
  std::vector<double> states;     ///< of the system (machine/model/system.hpp), at `begins`
  std::vector<double> begins;     ///< when balls are free and the last piece has begun; empty: all at SpinUp::settled()
  std::vector<double> released;   ///< when balls were released, if starts differ in it; else empty
  std::vector<Outcome> outcomes;  ///< of starts that are over
  std::vector<char> over;         ///< whether the outcome is known: never released; empty: only lost starts are over
  std::vector<double> nearest;    ///< of starts never released: of all speeds reached, the nearest to the release speed
  std::vector<OwnRotor> rotors;   ///< each start's own, over the last piece of its drive; empty: all share one

  bool is_over(std::size_t i) const {
    const bool lost = outcomes[i].kind == OutcomeKind::diverged || outcomes[i].kind == OutcomeKind::failed;
    return lost || (!over.empty() && over[i]);
  }
  std::size_t size() const { return outcomes.size(); }
  double begin(std::size_t i, double settled) const { return begins.empty() ? settled : begins[i]; }
};

/// Thread-safe after construction and watch().
class SpinUp {
 public:
  virtual ~SpinUp() = default;

  /// Prepares make() for tables with these settings.
  virtual void watch(const TransientSettings& /*settings*/) {}
  /// Makes starts first .. first + count - 1 of `seed`. False if stopped early. `transients`, with the settings of
  /// watch(), receives a row for each start, up to the time of its state.
  virtual bool make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
                    TransientTable* transients = nullptr) const;
  /// The same for given starts (classification/start_runs/checks.hpp). At a prescribed speed with clamped balls, only
  /// their angles count.
  virtual bool follow(std::span<const InitialState> given, SpunUp& starts,
                      TransientTable* transients = nullptr) const = 0;
  /// The task over the last piece of the drive, without trajectories, end and observers.
  virtual BatchTask last_task() const = 0;
  /// When the last piece begins and, at a prescribed speed, the balls are free.
  double settled() const { return last_task().segment.begin; }
  double tolerance() const { return last_task().tolerance; }

 protected:
  SpinUp(const Study& study, const StopFlag* stop);

  const Study study_;
  const Sampler sampler_;
  const StopFlag* const stop_;
};

/// For any system. The study must have its horizon.
std::unique_ptr<SpinUp> make_spin_up(const Study& study, const StopFlag* stop);

/// A start and its study, without uncertain values and with its horizon.
struct OwnRotorStart {
  Study study;
  InitialState start;
};

/// As SpinUp::follow(), each start in the units of its own study; fills SpunUp::rotors. The last systems must fit
/// together (simulation/batch/own_rotor.hpp). `transients`, if given, holds the settings of each (TransientTable::own).
bool spin_up_own_rotors(std::span<const OwnRotorStart> given, const StopFlag* stop, SpunUp& starts,
                        TransientTable* transients = nullptr);

}  // namespace equipoise
