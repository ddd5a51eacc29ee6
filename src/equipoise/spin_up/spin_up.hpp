// Starts brought to the last piece of their drive, their balls free.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/batch/batch_task.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/fate.hpp"
#include "equipoise/types/transient_table.hpp"

namespace equipoise {

/// Row-major, one row a start.
struct SpunUp {
  std::vector<double> phi;       ///< ball angles with which they began
  std::vector<double> states;    ///< of the system (model/system.hpp), at `begins`
  std::vector<double> begins;    ///< when balls are free and the last piece has begun; empty: all at SpinUp::settled()
  std::vector<double> released;  ///< when balls were let go, where each start has its own time; else empty
  std::vector<Fate> fates;       ///< of those that are over
  std::vector<char> over;        ///< whether the fate is known already: never let go; empty: of none but the lost
  std::vector<double> nearest;   ///< of such: the speed nearest to the one of release that they came to
  std::vector<OwnRotor> rotors;  ///< each start's own, over the last piece of its drive; empty: all have the same

  bool is_over(std::size_t i) const {
    const bool lost = fates[i].outcome == Outcome::diverged || fates[i].outcome == Outcome::failed;
    return lost || (!over.empty() && over[i]);
  }
  std::size_t size() const { return fates.size(); }
  double begin(std::size_t i, double settled) const { return begins.empty() ? settled : begins[i]; }
};

/// Thread-safe once made.
class SpinUp {
 public:
  virtual ~SpinUp() = default;

  /// Prepares make() for tables with these settings.
  virtual void watch(const TransientSettings& settings) = 0;
  /// Starts first .. first + count - 1 of `seed`. False if stopped early. `transients`, with the settings of watch(),
  /// receives a row for each start up to the time of its state.
  virtual bool make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
                    TransientTable* transients = nullptr) const = 0;
  /// The same for given starts (given_starts.hpp). Where the speed is prescribed and the balls are held at first, only
  /// their angles count.
  virtual bool follow(std::span<const InitialState> given, SpunUp& starts,
                      TransientTable* transients = nullptr) const = 0;
  /// The task over the last piece of the drive, without trajectories, end and what is gathered.
  virtual BatchTask last_task() const = 0;
  /// When the last piece begins and, of a rotor that turns as prescribed, the balls are free.
  virtual double settled() const = 0;
  virtual double tolerance() const = 0;
};

/// Of any system. The study's horizon is filled in.
std::unique_ptr<SpinUp> make_spin_up(const Study& study, const StopFlag* stop);

}  // namespace equipoise
