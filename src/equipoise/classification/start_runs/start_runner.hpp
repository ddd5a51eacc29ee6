// Decides the starts of a system, many at a time on SIMD lanes, by attractors found beforehand.
// This room: one start from index to fate, in a batch, for every kind of rotor.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/rotor_family/family_mesh.hpp"
#include "equipoise/classification/rotor_family/study_family.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/fate.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// A start that came to a stationary motion that the catalogue does not list.
struct UnlistedStart {
  std::size_t place = 0;         ///< among the starts of the call
  std::vector<double> state;     ///< when found stationary (on the next stroboscopic section, if there is one)
  std::optional<Motion> motion;  ///< the motion it came to; none if it is not steady after all
  MotionName name = {};          ///< of that motion; set if starts have rotors of their own: `state` is then the index
};

/// What is known of the balanced state before starts are followed.
struct BalanceNote {
  bool stable = false;  ///< a linearly stable balanced state exists at the final speed
  std::string note;     ///< if not, why no start can end balanced
};

/// The fates of starts, in order.
struct Decided {
  std::vector<double> phi;  ///< initial ball angles, `balls` a start; empty for given starts
  std::vector<Fate> fates;
  std::vector<UnlistedStart> unlisted;   ///< their fates have attractor 0 until StartRunner::settle()
  std::vector<TransientRow> transients;  ///< of every start, if the runner gathers them
};

/// A start, and the fractions whose quantiles are its uncertain values.
struct DrawnStart {
  std::uint64_t number = 0;
  std::vector<double> fractions;
};
/// The motions that starts of one rotor of a family came to.
struct MetMotions {
  std::vector<KnownFeatures> known;  ///< as OwnRotor::met: motions that the mesh does not list
  std::vector<Motion> motions;
  bool follows_open = true;  ///< FamilyCell::follows_open, of this rotor
};
/// A start with a study of its own, and the place of that study in the family
/// (classification/rotor_family/study_family.hpp).
struct FamilyStart {
  OwnRotorStart own;
  std::vector<double> fractions;
  const MetMotions* met = nullptr;  ///< by other starts of its rotor, or null if unknown
};

/// Everything that all starts of a study share or, with uncertain values, all rotors that they draw.
class StartRunner {
 public:
  /// Spins up and searches for attractors. The study must have passed check_runnable(). Check stopped() afterwards.
  /// `transients`: gathers those of every start.
  StartRunner(const Study& study, const AttractorSearchSettings& settings, bool transients = false);
  /// For these starts of a family, by run_family(), which also measures Fate::radius. `study` belongs to the family;
  /// fates are in its units.
  StartRunner(const Study& study, StudyFamily family, const FamilyStarts& starts,
              const AttractorSearchSettings& settings);

  /// Decides starts first .. first + count - 1. Thread-safe, like every const member. False if stopped early.
  bool run(std::uint64_t first, std::size_t count, Decided& decided) const;
  /// The same for given starts (check_given_starts()), unless the study has uncertain values.
  bool run_from(std::span<const InitialState> given, Decided& decided) const;
  /// The identifier of the motion that an unlisted start came to, listed if need be; 0 if it is not stable. Not
  /// thread-safe: call it in the order of starts, so that identifiers do not depend on threads.
  int list(const UnlistedStart& start);
  /// Writes the motion that it came to into its fate; without a steady one the start is undecided. Call it as list().
  int settle(const UnlistedStart& start, Fate& fate);
  /// The same for all, in order.
  void settle(Decided& decided);
  /// An unlisted start from its stored state when found stationary. Empty if stopped early.
  std::optional<UnlistedStart> follow(const std::vector<double>& state) const;
  /// How undecided starts go on at the horizon: an entry each, or none if only the horizon can be the cause.
  std::vector<UndecidedEnd> look_at(const std::vector<InitialState>& undecided) const;

  /// With uncertain values: the fractions that start `number` draws, and the fates of draws.
  std::vector<double> fractions_of(std::uint64_t number) const;
  bool run_drawn(std::span<const DrawnStart> drawn, Decided& decided) const {
    return run_drawn(drawn, decided, gathers_);
  }

  /// Decides starts whose rotors belong to the study's family.
  bool run_family(std::vector<FamilyStart> given, Decided& decided) const {
    return run_family(std::move(given), decided, gathers_);
  }
  /// The motions that these starts come to and the mesh does not list. `rotor`: for each start the place of its rotor
  /// in `met`. Not for coasting rotors. False if stopped.
  bool meet(std::vector<FamilyStart> given, std::span<const std::size_t> rotor, std::span<MetMotions> met) const;

  const Catalogue& catalogue() const { return catalogue_; }
  BalanceNote balance() const;
  /// What the search found that a neighbour's search may start from.
  WarmStartLevels warm_start_levels() const { return family_ ? mesh_.warm_start_levels() : search_.warm_start_levels; }
  /// Study time from which decision times count.
  double settled() const { return source_->settled(); }
  /// Whether it was stopped before it could begin.
  bool stopped() const { return search_.stopped || mesh_.stopped; }

  const StudyFamily* family() const { return family_ ? &*family_ : nullptr; }
  const ClassificationRule& rule() const { return search_.rule; }

 private:
  bool run_drawn(std::span<const DrawnStart> drawn, Decided& decided, bool watched) const;
  bool run_family(std::vector<FamilyStart> given, Decided& decided, bool watched) const;
  bool run_coasting(std::span<const FamilyStart> given, Decided& decided, bool watched) const;
  static FamilyMesh mesh_of(const Study& study, const StudyFamily& family, const AttractorSearchSettings& settings);
  // Starts being decided, and what is known of each.
  struct Batch {
    Batch(const StartRunner& of, bool watching) : runner(of), watched(watching), table{of.transients_, {}, of.ends_} {}

    const StartRunner& runner;
    SpunUp starts;
    std::vector<FamilyStart> own;   // each start's study if they differ, else empty
    std::vector<std::size_t> cell;  // their cells of the mesh
    bool watched;                   // transients are gathered, in `table`
    TransientTable table;
    std::vector<Fate> fates;
    std::optional<std::vector<PilotRecord>> records;  // of all starts, if requested
    // Of few starts: what those that were followed look like (`attractor`: their place here), and what they came to.
    std::vector<KnownFeatures> looks;
    std::vector<std::optional<Motion>> came_to;

    const Study& study(std::size_t i) const { return own.empty() ? runner.study_ : own[i].own.study; }
    const model::System& system(std::size_t i) const { return own.empty() ? runner.system_ : starts.rotors[i].system; }
    double end(std::size_t i) const {
      return own.empty() ? runner.source_->settled() + *runner.study_.numerics.horizon : starts.rotors[i].end;
    }
    TransientTable* watched_table() { return watched ? &table : nullptr; }
    const double* state(std::size_t i) const {
      return &starts.states[i * static_cast<std::size_t>(runner.system_.dimension())];
    }
  };

  bool follows_open(const Batch& batch, std::size_t i) const;
  bool meet(const Batch& batch, std::size_t i, MetMotions& met) const;
  bool begin_family(std::vector<FamilyStart> given, Batch& batch) const;
  bool decide(Batch& batch) const;
  bool classify_some(Batch& batch, const std::vector<std::size_t>& places, const ClassificationRule& rule) const;
  bool finish(Batch& batch, Decided& decided) const;
  bool is_in_chaos(const model::System& system, const std::vector<double>& state, double followed) const;
  UnlistedStart in_chaos(const Batch& batch, std::size_t i, double now) const;
  std::optional<UnlistedStart> unlisted_start(const Batch& batch, std::size_t i, double now, double patience) const;
  std::optional<UnlistedStart> unlisted_of_few(Batch& batch, std::size_t i, double now) const;
  UnlistedStart met_again(const Batch& batch, std::size_t i, const Fate& fate) const;
  double mean_speed(const Batch& batch, std::size_t i, const Fate& fate) const;
  bool note_last_speeds(Batch& batch) const;
  bool note_radii(Batch& batch) const;
  Restlessness restlessness(double before, const Fate& fate, double begin) const;
  std::vector<double> when_recognised(const Batch& batch, std::size_t i, double now) const;
  KnownEnd end_of(int attractor) const;

  Study study_;
  bool gathers_ = false, few_starts_ = false, measures_radii_ = false;
  const StopFlag* stop_;
  const model::System system_;
  TransientSettings transients_;
  std::unique_ptr<SpinUp> source_;  // with uncertain values that of the medians
  Sampler sampler_;
  AttractorSearch search_;  // for one rotor
  std::optional<StudyFamily> family_;
  FamilyMesh mesh_;             // for many
  Catalogue catalogue_;         // grows by list(), while run() reads that of the search
  std::vector<KnownEnd> ends_;  // by identifier: attractors known beforehand; for transients only
};

}  // namespace equipoise
