// The starts of a system, many at a time on SIMD lanes, decided by attractors found beforehand.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/attractor_search/attractor_search.hpp"
#include "equipoise/attractor_search/family_mesh.hpp"
#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/attractors/motion.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/results/transient_figures.hpp"
#include "equipoise/rotor_family/study_family.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/spin_up/own_starts.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/start_runs/undecided.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/fate.hpp"

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

/// What became of starts, one after the other.
struct Decided {
  std::vector<double> phi;  ///< initial ball angles, `balls` a start; none of starts that were given
  std::vector<Fate> fates;
  std::vector<UnlistedStart> unlisted;   ///< their fates have the attractor 0 and wait for StartRunner::list()
  std::vector<TransientRow> transients;  ///< of every start, if the runner gathers them
};

/// A start and the fractions that its uncertain values are quantiles of.
struct DrawnStart {
  std::uint64_t number = 0;
  std::vector<double> fractions;
};
/// What starts of one rotor of a family came to.
struct MetMotions {
  std::vector<KnownFeatures> known;  ///< as OwnRotor::met: motions that the mesh does not list
  std::vector<Motion> motions;
  bool follows_open = true;  ///< as FamilyCell::follows_open, of this rotor
};
/// A start whose study is its own, and where that lies in the family (rotor_family/study_family.hpp).
struct FamilyStart {
  OwnStart own;
  std::vector<double> fractions;
  const MetMotions* met = nullptr;  ///< by other starts of its rotor, if that is known
};

/// Everything about a study that all its starts share; of one with uncertain values, about all rotors that they draw.
class StartRunner {
 public:
  /// Spins up and discovers the attractors. The study has passed check_runnable(). Ask stopped() afterwards.
  /// `transients`: gathers those of every start.
  StartRunner(const Study& study, const AttractorSearchSettings& settings, bool transients = false);
  /// Of these starts of a family, by run_family(); `study` is one of it, in whose units fates are.
  StartRunner(const Study& study, StudyFamily family, const FamilyStarts& starts,
              const AttractorSearchSettings& settings);

  /// Decides starts first .. first + count - 1. Thread-safe, as is all that is const. False if stopped early.
  bool run(std::uint64_t first, std::size_t count, Decided& decided) const;
  /// The same for starts given (spin_up/given_starts.hpp), where they do not draw their rotors too.
  bool run_from(std::span<const InitialState> given, Decided& decided) const;
  /// The identifier of what an unlisted start settles on, which is listed if need be; 0 if that is nothing stable.
  /// Not thread-safe: called in the order of starts, so that identifiers do not depend on threads.
  int list(const UnlistedStart& start);
  /// What it turned out to have come to, written into its fate: one of nothing steady is undecided. As list().
  int settle(const UnlistedStart& start, Fate& fate);
  /// The same of all, in their order.
  void settle(Decided& decided);
  /// An unlisted start from its state when it was found stationary, as an earlier run kept it. Empty if
  /// stopped early.
  std::optional<UnlistedStart> follow(const std::vector<double>& state) const;
  /// What some starts that are undecided do at the horizon: one for each, or none where only the horizon can be blamed.
  std::vector<UndecidedEnd> look_at(const std::vector<InitialState>& undecided) const;

  /// Of a study with uncertain values: what start `number` draws, and the fates of draws.
  std::vector<double> fractions_of(std::uint64_t number) const;
  bool run_drawn(std::span<const DrawnStart> drawn, Decided& decided) const {
    return run_drawn(drawn, decided, gathers_);
  }

  /// Fates of starts of rotors that the study's family holds.
  bool run_family(std::vector<FamilyStart> given, Decided& decided) const {
    return run_family(std::move(given), decided, gathers_);
  }
  /// What such starts come to that the mesh does not list; `rotor`: of each start the place of its rotor's motions in
  /// `met`. Starts with one rotor only; no rotors that coast. False if stopped.
  bool meet(std::vector<FamilyStart> given, std::span<const std::size_t> rotor, std::span<MetMotions> met) const;

  const Catalogue& catalogue() const { return catalogue_; }
  BalanceNote balance() const;
  /// What the search for attractors found that a neighbour's may begin with.
  WarmStartLevels warm_start_levels() const {
    return family_ ? mesh_.warm_start_levels() : discovery_.warm_start_levels;
  }
  /// Study time from which decision times are counted.
  double settled() const { return source_->settled(); }
  /// Stopped before it could begin.
  bool stopped() const { return discovery_.stopped || mesh_.stopped; }

  const StudyFamily* family() const { return family_ ? &*family_ : nullptr; }
  const FamilyMesh& mesh() const { return mesh_; }
  const BalancedAnalysis& balanced() const { return discovery_.balanced; }
  const ClassificationRule& rule() const { return discovery_.rule; }

 private:
  bool run_drawn(std::span<const DrawnStart> drawn, Decided& decided, bool watched) const;
  bool run_family(std::vector<FamilyStart> given, Decided& decided, bool watched) const;
  bool run_coasting(std::span<const FamilyStart> given, Decided& decided, bool watched) const;
  static FamilyMesh mesh_of(const Study& study, const StudyFamily& family, const AttractorSearchSettings& settings);
  struct Batch;
  Batch new_batch(bool watched) const;
  bool follows_open(const Batch& batch, std::size_t i) const;
  bool meet(const Batch& batch, std::size_t i, MetMotions& met) const;
  bool begin_family(std::vector<FamilyStart> given, Batch& batch) const;
  bool decide(Batch& batch) const;
  bool classify_some(Batch& batch, const std::vector<std::size_t>& places, const ClassificationRule& rule) const;
  bool finish(Batch& batch, Decided& decided) const;
  std::optional<UnlistedStart> unlisted_start(const Batch& batch, std::size_t i, double now, double patience) const;
  UnlistedStart met_again(const Batch& batch, std::size_t i, const Fate& fate) const;
  double mean_speed(const Batch& batch, std::size_t i, const Fate& fate) const;
  bool note_last_speeds(Batch& batch) const;
  void note_unbalance(const Batch& batch, std::size_t i, Fate& fate) const;
  Restlessness restlessness(double before, const Fate& fate, double begin) const;
  TransientSettings settings_of(const Batch& batch, std::size_t i) const;
  std::vector<double> when_recognised(const Batch& batch, std::size_t i, double now) const;
  KnownEnd end_of(int attractor) const;

  Study study_;
  bool gathers_ = false;  // transients
  const StopFlag* stop_;
  const model::System system_;
  TransientSettings transients_;
  std::unique_ptr<SpinUp> source_;  // of an uncertain study that of its medians
  Sampler sampler_;
  AttractorSearch discovery_;  // of one rotor
  std::optional<StudyFamily> family_;
  FamilyMesh mesh_;             // of many
  Catalogue catalogue_;         // grows by list(), while run() reads the one that was discovered
  std::vector<KnownEnd> ends_;  // by identifier, of the attractors known beforehand; for transients only
};

}  // namespace equipoise
