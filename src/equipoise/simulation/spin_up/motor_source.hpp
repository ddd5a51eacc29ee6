// Takes a start of a driven rotor from its index to its state in the last piece of the drive.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

class MotorSource final : public SpinUp {
 public:
  /// The study must have its horizon; balls still clamped at the horizon are not followed further.
  MotorSource(const Study& study, const StopFlag* stop);

  bool make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
            TransientTable* transients = nullptr) const override;
  bool follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients = nullptr) const override;
  BatchTask last_task() const override;

  /// Does spin_up_own_rotors() for driven rotors.
  static bool follow_own_rotors(std::span<const OwnRotorStart> starts, const StopFlag* stop, SpunUp& spun,
                                TransientTable* transients);

 private:
  struct Machine {
    explicit Machine(const Study& given);

    Study study;
    model::Drive drive;
    std::vector<model::System> systems;  // over each piece
    ReleaseRule release_rule;
    bool clamped_at_first;
    double horizon;

    double settled() const { return drive.pieces.back().begin; }
    OwnRotor rotor(std::size_t k) const;
  };
  struct Fleet;

  MotorSource(std::vector<Machine> machines, const StopFlag* stop);
  // All starts share one machine, or each has its own.
  const Machine& of(std::size_t i) const { return machines_[machines_.size() == 1 ? 0 : i]; }
  bool are_own() const { return machines_.size() > 1; }
  double until(std::size_t i, std::size_t k) const;
  void add(const Machine& machine, const InitialState& start, SpunUp& starts) const;
  bool advance(SpunUp& starts, TransientTable* transients) const;
  ReleaseRule rule_over(std::size_t k, const std::vector<std::size_t>& places) const;
  template <class Run>
  bool side_by_side(std::size_t k, bool held, const std::vector<std::size_t>& places, std::vector<double>& states,
                    const Fleet& fleet, Run&& run) const;
  bool follow_clamped(std::size_t k, Fleet& fleet) const;
  bool run_free(std::size_t k, Fleet& fleet) const;
  void end_clamped(std::size_t k, std::size_t i, const ClampedEnd& end, double* state, Fleet& fleet) const;
  BatchTask task(std::size_t k) const;

  std::vector<Machine> machines_;
  Sampler sampler_;
  const StopFlag* stop_;
  double tolerance_;
};

}  // namespace equipoise
