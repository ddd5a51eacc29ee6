// A study as a machine's trajectory: drive, error scale and state at t = 0.
#pragma once

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/integrate/event_trajectory-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/simulation/rule/words.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

inline void check_overlap(const Study& study) {
  const model::Parameters& p = study.parameters;
  if (!p.balls_collide()) return;
  for (int i = 0; i < p.balls; ++i)
    for (int j = 0; j < i; ++j) {
      const double apart = std::fabs(wrapped(study.initial.phi[i] - study.initial.phi[j]));
      if (apart < p.contact_angle)
        throw InputError(
            study.name, "initial.phi", fmt::format("{}", study.initial.phi[i]),
            fmt::format("balls {} and {} overlap: {} rad apart; must be at least {} apart, as balls are that touch",
                        j + 1, i + 1, apart, p.contact_angle));
    }
}

template <bool tilt>
class MachineRunOf {
 public:
  using Machine = EventTrajectory<model::any_count, tilt>;

  // The study outlives it.
  explicit MachineRunOf(const Study& study)
      : drive_(study.drive()), machine_(study.parameters, drive_, scale_of(study), first_state(study, drive_).data()) {}
  MachineRunOf(const MachineRunOf&) = delete;
  MachineRunOf& operator=(const MachineRunOf&) = delete;

  Machine& machine() { return machine_; }
  const Machine& machine() const { return machine_; }

 private:
  static typename Machine::Scale scale_of(const Study& study) {
    return machine_scale<Machine::dimension>(study.parameters,
                                             study.numerics.tolerance.value_or(default_simulate_tolerance));
  }
  static std::array<double, Machine::dimension> first_state(const Study& study, const model::Drive& drive) {
    std::array<double, Machine::dimension> z{};
    const InitialState start = parted(study.parameters, study.initial);
    const int balls = study.parameters.balls;
    initial_state(start, balls, drive.speed, z.data(), tilt ? model::dimension(balls) : -1);
    return z;
  }

  const model::Drive drive_;
  Machine machine_;
};

using MachineRun = MachineRunOf<false>;

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();
