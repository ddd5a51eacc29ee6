// From a start's index to its state in the last piece of a motor's law: pieces of the law, release at a time or a
// speed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "equipoise/deciding/held.hpp"
#include "equipoise/model/machine.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

class MotorSource final : public SpinUp {
 public:
  /// The study's horizon is filled in: balls that are not let go by then are not followed further.
  MotorSource(const Study& study, const StopFlag* stop);

  void watch(const TransientSettings&) override {}
  bool make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
            TransientTable* transients = nullptr) const override;
  bool follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients = nullptr) const override;
  LaneTask last_task() const override;
  double settled() const override { return drive_.pieces.back().begin; }
  double tolerance() const override { return tolerance_; }

 private:
  struct Fleet;
  void add(const InitialState& start, SpunUp& starts) const;
  bool advance(SpunUp& starts, TransientTable* transients) const;
  HoldRule rule_over(std::size_t k) const;
  bool hold(std::size_t k, Fleet& fleet) const;
  bool run_free(std::size_t k, Fleet& fleet) const;
  void end_hold(std::size_t k, std::size_t i, const HeldEnd& end, double until, double* state, Fleet& fleet) const;
  LaneTask task(std::size_t k) const;

  Study study_;
  Sampler sampler_;
  const StopFlag* stop_;
  model::Drive drive_;
  std::vector<model::System> systems_;  // over each piece
  HoldRule hold_;
  bool held_at_first_;
  double horizon_, tolerance_;
};

}  // namespace equipoise
