// The starts of a system, many at a time on SIMD lanes, decided by attractors found beforehand.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/discovery/discovery.hpp"
#include "equipoise/fates/runner.hpp"
#include "equipoise/model/capability.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/transients/transient_table.hpp"

namespace equipoise {

/// Throws InputError for invalid studies and those whose starts cannot be decided.
void check_decidable(const Study& study);
/// Throws InputError for a study that asks for decisions by proof where there are none.
void check_proof(const Study& study);

/// Throws InputError for a spin-up with the balls held that is too long to look for peaks in.
void check_watchable(const Study& study);
/// Throws InputError for invalid studies, and those whose system lacks what the answer needs (model/capability.hpp).
void check_offers(const Study& study, model::Answer answer);

/// Everything about a study that all its starts share.
class StartRunner : public Runner {
 public:
  /// Spins up and discovers the attractors. The study has passed check_decidable(). Ask stopped() afterwards.
  /// `transients`: run() can be asked for rows.
  StartRunner(const Study& study, const DiscoverySettings& settings, bool transients = false);

  bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
           std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const override;
  bool run_from(std::span<const InitialState> given, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
                std::vector<TransientRow>* rows = nullptr) const override;
  int list(const UnlistedStart& start) override;
  std::optional<UnlistedStart> follow(const std::vector<double>& state) const override;
  std::vector<UndecidedEnd> look_at(const std::vector<InitialState>& undecided) const override;

  bool one_by_one() const override { return false; }
  const Catalogue& catalogue() const override { return catalogue_; }
  BalanceNote balance() const override { return {discovery_.balanced.stable, discovery_.balanced.note}; }
  TrapHints hints() const override { return discovery_.hints; }
  double settled() const override { return source_->settled(); }
  bool stopped() const override { return discovery_.stopped; }

  const BalancedAnalysis& balanced() const { return discovery_.balanced; }
  const DecisionRule& rule() const { return discovery_.rule; }

 private:
  bool decide(SpunUp& starts, TransientTable* table, std::vector<Fate>& fates) const;
  bool finish(SpunUp& starts, TransientTable* table, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
              std::vector<TransientRow>* rows) const;
  std::optional<UnlistedStart> unlisted_start(const SpunUp& starts, std::size_t i, double now) const;
  double mean_speed(const Fate& fate) const;
  bool note_last_speeds(const SpunUp& starts, std::vector<Fate>& fates) const;
  void note_unbalance(const double* state, Fate& fate) const;
  float unbalance_at(const double* state) const;
  bool stalls(const Fate& fate) const;
  Restlessness restlessness(double before, const Fate& fate, double begin) const;
  TransientSettings settings_of(const SpunUp& starts, std::size_t i) const;
  std::vector<double> when_recognised(const double* state, double now) const;

  Study study_;
  const StopFlag* stop_;
  const model::System system_;
  TransientSettings transients_;
  std::unique_ptr<SpinUp> source_;
  Discovery discovery_;
  Catalogue catalogue_;         // grows by list(), while run() reads the one that was discovered
  std::vector<KnownEnd> ends_;  // by identifier, of the attractors known beforehand; for transients only
};

}  // namespace equipoise
