// The starts of a machine (a motor, an off-centre race, contact, rolling resistance, stiction), each followed from
// event to event until it is steady, and told by what it then does.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/attractors/fate.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/ensemble/sampling.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for a machine whose starts cannot be decided as the study asks.
void check_machine(const Study& study);

class MachineRunner {
 public:
  /// `study` has passed check_machine().
  MachineRunner(const Study& study, const StopFlag* stop);

  /// Decides starts first .. first + count - 1: attracted to a kind of steady motion (steady_kind()), stalled, or lost.
  /// Thread-safe. False if stopped early.
  bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates) const;

  /// Every kind that there is, met or not; their motions are not described.
  const Catalogue& catalogue() const { return catalogue_; }
  /// From when on a trajectory whose balls are free may be called steady: when the drive's last piece has begun.
  double settled() const { return settled_; }

 private:
  template <int n>
  Fate decide(const InitialState& start) const;

  Study study_;
  const StopFlag* stop_;
  model::Drive drive_;
  Sampler sampler_;
  Catalogue catalogue_;
  double settled_;
};

}  // namespace equipoise
