// One study's starts, from index to fate: what an ensemble needs of whoever follows them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "equipoise/deciding/fate.hpp"
#include "equipoise/discovery/discovery.hpp"
#include "equipoise/discovery/undecided.hpp"
#include "equipoise/model/capability.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/motions/motion.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/transients/transient_table.hpp"

namespace equipoise {

/// A start that came to a stationary motion which the catalogue does not list.
struct UnlistedStart {
  std::size_t place = 0;         ///< among the starts of the call
  std::vector<double> state;     ///< when it was found stationary (at the next strobe, with anisotropy or gravity)
  std::optional<Motion> motion;  ///< what it settles on; none if it is not steady after all
  MotionName name = {};          ///< of that, where starts have rotors of their own; `state` is then the start's number
};

/// What is known of the balanced state before any start is followed.
struct BalanceNote {
  bool stable = false;  ///< a linearly stable balanced state exists at the final speed
  std::string note;     ///< why no start can end balanced, if so
};

class Runner {
 public:
  virtual ~Runner() = default;

  /// Decides starts first .. first + count - 1. Thread-safe. False if stopped early. Starts in `unlisted` have the
  /// attractor 0 and wait for list(). `rows`, if given, receives the transients of every start.
  virtual bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
                   std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const = 0;
  /// The same for starts given (spin_up/given_starts.hpp), where they do not draw their rotors too.
  virtual bool run_from(std::span<const InitialState> given, std::vector<Fate>& fates,
                        std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const;
  /// The identifier of what an unlisted start settles on, which is listed if need be; 0 if that is nothing stable.
  /// Not thread-safe: called in the order of starts, so that identifiers do not depend on threads.
  virtual int list(const UnlistedStart& start) = 0;
  /// An unlisted start from its state when it was found stationary, as an earlier run kept it. Empty if
  /// stopped early.
  virtual std::optional<UnlistedStart> follow(const std::vector<double>& state) const = 0;

  /// What some starts that are undecided do at the horizon: one for each, or none where only the horizon can be blamed.
  virtual std::vector<UndecidedEnd> look_at(const std::vector<InitialState>& /*undecided*/) const { return {}; }

  virtual const Catalogue& catalogue() const = 0;
  virtual BalanceNote balance() const = 0;
  /// What the search for attractors found that a neighbour's may begin with.
  virtual TrapHints hints() const { return {}; }
  /// Study time from which decision times are counted.
  virtual double settled() const = 0;
  /// Stopped before it could begin.
  virtual bool stopped() const = 0;
};

/// What an unlisted start turned out to have come to, written into its fate: one of nothing steady is undecided.
/// Returns its identifier, or 0. Not thread-safe, as list().
int settle(Runner& runner, const UnlistedStart& start, Fate& fate);

/// Throws InputError for invalid studies and those whose starts cannot be decided; if `transients` are gathered, also
/// for those that cannot be watched.
void check_runnable(const Study& study, bool transients);

/// StartRunner. The study has passed
/// check_runnable().
std::unique_ptr<Runner> make_runner(const Study& study, const DiscoverySettings& settings, bool transients);

}  // namespace equipoise
