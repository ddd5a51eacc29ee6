// Starts that draw their rotor too: each has a system of its own, is followed by itself, and its motion is told by
// name.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "equipoise/fates/machine_runner.hpp"
#include "equipoise/fates/runner.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for a study with uncertain values whose starts cannot be decided, at its medians or where all
/// values are at one of their ends.
void check_drawable(const Study& study, bool transients);

/// A start of a study with uncertain values, and what it came to.
struct DrawnStart {
  InitialState start;
  Fate fate;  ///< attracted: its attractor has the name below; of one followed by kinds it has the kind's identifier
  MotionName name;
  std::optional<Motion> motion;  ///< a stable one
};

class DrawnRunner : public Runner {
 public:
  /// `study` has passed check_drawable().
  DrawnRunner(const Study& study, const StopFlag* stop);

  /// All that comes to a motion is unlisted: motions of the same name have one identifier.
  bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
           std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows = nullptr) const override;
  int list(const UnlistedStart& start) override;
  /// `state`: the number of a start.
  std::optional<UnlistedStart> follow(const std::vector<double>& state) const override;

  /// Start `index` of the study with `values` drawn (drawn_values(), or any others); in the units of the study's
  /// medians. One whose values make no study has failed. Empty if stopped early.
  std::optional<DrawnStart> decide(std::uint64_t index, const std::vector<double>& values, TransientRow* row) const;
  std::vector<double> values_of(std::uint64_t index) const;

  bool one_by_one() const override { return true; }
  const Catalogue& catalogue() const override { return by_kinds_ ? by_kinds_->catalogue() : catalogue_; }
  BalanceNote balance() const override;
  double settled() const override { return settled_; }
  bool stopped() const override { return false; }

 private:
  bool follow_alone(const Study& draw, std::uint64_t index, DrawnStart& result, TransientRow* row) const;
  bool follow_by_kinds(const Study& draw, std::uint64_t index, DrawnStart& result, TransientRow* row) const;

  Study study_;
  const StopFlag* stop_;
  Sampler sampler_;
  std::unique_ptr<MachineRunner> by_kinds_;  // of the medians, where starts are followed_one_by_one()
  double settled_;
  Catalogue catalogue_;
};

}  // namespace equipoise
