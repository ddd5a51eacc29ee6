// One study's starts, from index to fate. Shared by basin(), attractors() and replay_start().
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "equipoise/attractors/fate.hpp"
#include "equipoise/attractors/motion.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/ensemble/transient_table.hpp"
#include "equipoise/run/discovery.hpp"
#include "equipoise/run/start_source.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for invalid studies and those whose starts cannot be decided: anisotropic supports or gravity on a
/// rotor that comes to rest, or with decisions by proof.
void check_decidable(const Study& study);
/// The same, and for anisotropic supports and gravity altogether: what `asked` ("maps") answers for equations that do
/// not depend on the rotor's angle only.
void check_autonomous(const Study& study, const char* asked);

/// A start that came to a stationary motion which the catalogue does not list.
struct UnlistedStart {
  std::size_t place = 0;         ///< among the starts of the call
  std::vector<double> state;     ///< when it was found stationary (at the next strobe, with anisotropy or gravity)
  std::optional<Motion> motion;  ///< what it settles on; none if it is not steady after all
};

/// Everything about a study that all its starts share.
class StartRunner {
 public:
  /// Spins up and discovers the attractors. The study has passed check_decidable(). Ask stopped() afterwards.
  /// `transients`: run() can be asked for rows.
  StartRunner(const Study& study, const DiscoverySettings& settings, bool transients = false);

  /// Decides starts first .. first + count - 1. Thread-safe. False if stopped early. Starts in `unlisted` have the
  /// attractor 0 and wait for list(). `rows`, if given, receives the transients of every start.
  bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
           std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const;
  /// The identifier of what an unlisted start settles on, which is listed if need be; 0 if that is nothing stable.
  /// Not thread-safe: called in the order of starts, so that identifiers do not depend on threads.
  int list(const UnlistedStart& start);
  /// An unlisted start from its state when it was found stationary, as an earlier run kept it.
  UnlistedStart follow(const std::vector<double>& state) const;

  const BalancedAnalysis& balanced() const { return discovery_.balanced; }
  const Catalogue& catalogue() const { return discovery_.catalogue; }
  const DecisionRule& rule() const { return discovery_.rule; }
  double settled() const { return source_.settled(); }
  bool stopped() const { return discovery_.stopped; }

 private:
  std::vector<double> when_recognised(const std::vector<double>& state, const Fate& fate) const;

  Study study_;
  const StopFlag* stop_;
  TransientSettings transients_;
  StartSource source_;
  Discovery discovery_;
};

}  // namespace equipoise
