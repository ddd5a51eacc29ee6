// The starts of a machine (a motor, an off-centre race, contact, rolling resistance, stiction), each followed from
// event to event until it is steady, and told by what it then does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/fates/machine_judge.hpp"
#include "equipoise/fates/runner.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for a machine whose starts cannot be decided as the study asks.
void check_machine(const Study& study);

class MachineRunner : public Runner {
 public:
  /// `study` has passed check_machine().
  MachineRunner(const Study& study, const StopFlag* stop);

  /// Fates are kinds of steady motion (steady_kinds()), stalled, or lost; none is ever unlisted.
  bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
           std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const override;
  bool run_from(std::span<const InitialState> given, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
                std::vector<TransientRow>* rows = nullptr) const override;
  int list(const UnlistedStart&) override { return 0; }
  std::optional<UnlistedStart> follow(const std::vector<double>& state) const override {
    return UnlistedStart{0, state, {}, {}};
  }

  /// What any starts do where following them ends, decided or not.
  std::vector<UndecidedEnd> look_at(const std::vector<InitialState>& undecided) const override;

  /// Every kind that there is, met or not; their motions are not described.
  bool one_by_one() const override { return true; }
  const Catalogue& catalogue() const override { return catalogue_; }
  BalanceNote balance() const override { return facts_.note(); }
  /// When the drive's last piece has begun: from then on a trajectory whose balls are free may be called steady.
  double settled() const override { return settled_; }
  bool stopped() const override { return false; }

 private:
  Fate decide(const InitialState& start, TransientRow* row, UndecidedEnd* end) const;

  Study study_;
  const StopFlag* stop_;
  model::Drive drive_;
  Sampler sampler_;
  Catalogue catalogue_;
  MachineFacts facts_;
  double settled_;
};

}  // namespace equipoise
