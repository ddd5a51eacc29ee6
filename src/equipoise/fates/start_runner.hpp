// The starts of a system, many at a time on SIMD lanes, decided by attractors found beforehand.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/discovery/discovery.hpp"
#include "equipoise/discovery/family_mesh.hpp"
#include "equipoise/discovery/study_family.hpp"
#include "equipoise/fates/runner.hpp"
#include "equipoise/model/capability.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/spin_up/own_starts.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/transients/transient_table.hpp"

namespace equipoise {

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
/// A start whose study is its own, and where that lies in the family (discovery/study_family.hpp).
struct FamilyStart {
  OwnStart own;
  std::vector<double> fractions;
  const MetMotions* met = nullptr;  ///< by other starts of its rotor, if that is known
};

/// Everything about a study that all its starts share; of one with uncertain values, about all rotors that they draw.
class StartRunner : public Runner {
 public:
  /// Spins up and discovers the attractors. The study has passed check_runnable(). Ask stopped() afterwards.
  /// `transients`: run() can be asked for rows.
  StartRunner(const Study& study, const DiscoverySettings& settings, bool transients = false);
  /// Of these starts of a family, by run_family(); `study` is one of it, in whose units fates are.
  StartRunner(const Study& study, StudyFamily family, const FamilyStarts& starts, const DiscoverySettings& settings);

  bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
           std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const override;
  bool run_from(std::span<const InitialState> given, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
                std::vector<TransientRow>* rows = nullptr) const override;
  int list(const UnlistedStart& start) override;
  std::optional<UnlistedStart> follow(const std::vector<double>& state) const override;
  std::vector<UndecidedEnd> look_at(const std::vector<InitialState>& undecided) const override;

  /// Of a study with uncertain values: what start `number` draws, and the fates of draws.
  std::vector<double> fractions_of(std::uint64_t number) const;
  bool run_drawn(std::span<const DrawnStart> drawn, std::vector<double>& phi, std::vector<Fate>& fates,
                 std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const;

  /// Fates of starts of rotors that the study's family holds.
  bool run_family(std::vector<FamilyStart> given, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
                  std::vector<TransientRow>* rows = nullptr) const;
  /// What such starts come to that the mesh does not list; `rotor`: of each start the place of its rotor's motions in
  /// `met`. Starts with one rotor only; no rotors that coast. False if stopped.
  bool meet(std::vector<FamilyStart> given, std::span<const std::size_t> rotor, std::span<MetMotions> met) const;

  const Catalogue& catalogue() const override { return catalogue_; }
  BalanceNote balance() const override;
  TrapHints hints() const override { return family_ ? mesh_.hints() : discovery_.hints; }
  double settled() const override { return source_->settled(); }
  bool stopped() const override { return discovery_.stopped || mesh_.stopped; }

  const StudyFamily* family() const { return family_ ? &*family_ : nullptr; }
  const FamilyMesh& mesh() const { return mesh_; }
  const BalancedAnalysis& balanced() const { return discovery_.balanced; }
  const DecisionRule& rule() const { return discovery_.rule; }

 private:
  bool run_coasting(std::span<const FamilyStart> given, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
                    std::vector<TransientRow>* rows) const;
  static FamilyMesh mesh_of(const Study& study, const StudyFamily& family, const DiscoverySettings& settings);
  struct Batch;
  bool follows_open(const Batch& batch, std::size_t i) const;
  bool meet(const Batch& batch, std::size_t i, MetMotions& met) const;
  bool begin_family(std::vector<FamilyStart> given, bool watched, Batch& batch) const;
  bool decide(Batch& batch) const;
  bool decide_some(Batch& batch, const std::vector<std::size_t>& places, const DecisionRule& rule) const;
  bool finish(Batch& batch, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
              std::vector<TransientRow>* rows) const;
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
  const StopFlag* stop_;
  const model::System system_;
  TransientSettings transients_;
  std::unique_ptr<SpinUp> source_;  // of an uncertain study that of its medians
  Sampler sampler_;
  Discovery discovery_;  // of one rotor
  std::optional<StudyFamily> family_;
  FamilyMesh mesh_;             // of many
  Catalogue catalogue_;         // grows by list(), while run() reads the one that was discovered
  std::vector<KnownEnd> ends_;  // by identifier, of the attractors known beforehand; for transients only
};

}  // namespace equipoise
