// Takes a start from its index to its state at the final speed, for rotors at a prescribed speed.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/integrate/clamped.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/simulation/transients/clamped_transients.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Thread-safe after construction and watch().
class StartSource : public SpinUp {
 public:
  /// Integrates the clamped spin-up, which all starts share.
  StartSource(const Study& study, const StopFlag* stop);
  /// With `segments` in place of the study's [speed] and [release]: contiguous from 0, clamped ones first, the last one
  /// free and without end.
  StartSource(const Study& study, std::vector<model::Segment> segments, const StopFlag* stop);

  void watch(const TransientSettings& settings) override;
  bool follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients = nullptr) const override;

  /// The states, row-major, in which the balls of these starts are released.
  void release(std::span<const InitialState> given, std::vector<double>& states) const;
  /// An ensemble's task over the whole of free segment `k`.
  BatchTask task(std::size_t k, std::vector<double>& states) const;
  BatchTask last_task() const override;
  /// Takes states at the end of segment `k`, not the last, across the jump of psi' that follows.
  void cross(std::size_t k, std::vector<double>& states) const;

  const std::vector<model::Segment>& segments() const { return segments_; }
  std::size_t first_free() const { return first_free_; }

 private:
  model::StateLayout layout() const;
  std::size_t size() const { return static_cast<std::size_t>(layout().size); }
  void place(const InitialState& start, double* state, TransientSums* sums = nullptr) const;
  void place_tilting(const InitialState& start, double* state, TransientSums* sums) const;
  std::array<double, 4> origin() const;
  void end_piece(std::size_t k, TransientTable& transients) const;

  std::vector<model::Segment> segments_;
  std::vector<model::System> systems_;  // over each segment
  std::size_t first_free_ = 0;
  ClampedBasis basis_;
  ClampedTransients clamped_;
  TransientSettings watched_;  // of a tilting rotor, whose held starts are watched one by one
  double tolerance_;
};

}  // namespace equipoise
