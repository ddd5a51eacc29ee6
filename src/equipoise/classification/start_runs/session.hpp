// Decides the starts of a system, many at a time on SIMD lanes, by attractors found beforehand.
// This room: one start from index to outcome, in a batch, for every kind of rotor.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
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
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/results/types/note.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// A start that ended in a stationary motion that the session's catalogue does not list.
struct UnlistedStart {
  std::size_t place = 0;         ///< among the starts of the call
  std::vector<double> state;     ///< when found stationary (on the next stroboscopic section, if there is one)
  std::optional<Motion> motion;  ///< the motion it came to; none if it is not steady after all
  MotionName name = {};  ///< of that motion, if it is listed by name; for drawn rotors `state` is the start's index
};

/// What is known of the balanced state before starts are followed.
struct BalanceNote {
  bool stable = false;  ///< a linearly stable balanced state exists at the final speed
  Note note;            ///< if not, why no start can end balanced
};

/// The outcomes of starts, in order.
struct Decided {
  std::vector<double> phi;  ///< initial ball angles, `balls` a start; empty for given starts
  std::vector<Outcome> outcomes;
  std::vector<UnlistedStart> unlisted;   ///< Outcome::attractor is 0 until RunCatalogue::settle()
  std::vector<TransientRow> transients;  ///< of every start, if the session gathers them
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

/// One rotor, or a family of rotors, at one final speed: everything that all starts share. Nothing changes after
/// construction, so any thread may call any member.
class Session {
 public:
  /// Spins up and searches for attractors. With uncertain values, the rotors that starts draw are the family. The study
  /// must have passed check_runnable(). Check stopped() afterwards. `transients`: gathers those of every start.
  Session(const Study& study, const AttractorSearchSettings& settings, bool transients = false);
  /// For these starts of a family; also measures Outcome::radius. `study` belongs to the family; outcomes are in its
  /// units.
  Session(const Study& study, StudyFamily family, const FamilyStarts& starts, const AttractorSearchSettings& settings);

  /// The same attractors and rules for starts that are followed to another tolerance; FamilyStart has its own.
  Session(const Session& other, double tolerance);

  /// Decides starts first .. first + count - 1. False if stopped early, as for all starts below.
  bool decide(std::uint64_t first, std::size_t count, Decided& decided) const;
  /// Given starts (check_given_starts()), unless the study has uncertain values.
  bool decide(std::span<const InitialState> given, Decided& decided) const;
  /// Draws of a study with uncertain values.
  bool decide(std::span<const DrawnStart> drawn, Decided& decided) const;
  /// Starts whose rotors belong to the family.
  bool decide(std::vector<FamilyStart> given, Decided& decided) const;
  /// The fractions that start `number` draws for the uncertain values.
  std::vector<double> fractions_of(std::uint64_t number) const;

  /// An unlisted start from its stored state when found stationary. Empty if stopped early.
  std::optional<UnlistedStart> follow(const std::vector<double>& state) const;
  /// How undecided starts go on at the horizon: an entry each, or none if only the horizon can be the cause.
  std::vector<UndecidedEnd> look_at(const std::vector<InitialState>& undecided) const;
  /// The motions that these starts come to and the mesh does not list. `rotor`: for each start the place of its rotor
  /// in `met`. Not for coasting rotors. False if stopped.
  bool meet(std::vector<FamilyStart> given, std::span<const std::size_t> rotor, std::span<MetMotions> met) const;

  /// The attractors that the search found.
  const Catalogue& catalogue() const { return mesh_.catalogue; }
  BalanceNote balance() const;
  /// What the search found that a neighbour's search may start from.
  WarmStartLevels warm_start_levels() const { return mesh_.warm_start_levels(); }
  /// Study time from which decision times count.
  double settled() const { return source_->settled(); }
  /// Whether it was stopped before it could begin.
  bool stopped() const { return mesh_.stopped; }

  const Study& study() const { return study_; }
  const StudyFamily* family() const { return family_ ? &*family_ : nullptr; }
  /// For one rotor.
  const ClassificationRule& rule() const { return mesh_.cells.front().search.rule; }

 private:
  class Batch;
  bool decide_coasting(const FamilyStart& start, Decided& decided) const;

  Study study_;
  bool gathers_ = false, measures_radii_ = false;
  SearchMode mode_ = SearchMode::full;
  const StopFlag* stop_;
  const model::System system_;
  TransientSettings transients_;
  std::shared_ptr<SpinUp> source_;  // with uncertain values that of the medians
  Sampler sampler_;
  std::optional<StudyFamily> family_;
  FamilyMesh mesh_;             // one cell for one rotor, none for a family of coasting rotors
  std::vector<KnownEnd> ends_;  // by identifier: attractors known beforehand; for transients only
};

/// The attractors of a session, and the motions that a run's starts came to beyond those. Belongs to the run, which
/// fills it in the order of starts, so that identifiers do not depend on threads.
class RunCatalogue : public Catalogue {
 public:
  explicit RunCatalogue(const Session& session)
      : Catalogue(session.catalogue()), parameters_(session.study().parameters) {}

  /// The identifier of the motion that an unlisted start came to, listed if need be; 0 if it is not stable.
  int list(const UnlistedStart& start);
  /// Writes the motion that it reached into its Outcome; without a steady one, the start is undecided.
  int settle(const UnlistedStart& start, Outcome& outcome);
  /// The same for all, in order.
  void settle(Decided& decided);

 private:
  model::Parameters parameters_;
};

}  // namespace equipoise
