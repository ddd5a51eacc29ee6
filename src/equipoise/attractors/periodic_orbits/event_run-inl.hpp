// One trajectory of a system with events in the state of machine/model/system.hpp; EventTrajectory uses a state of its
// own.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/simulation/integrate/event_trajectory-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/hybrid_flow-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/ball_events.hpp"

namespace equipoise {
namespace HWY_NAMESPACE {

// The equations of a system while its balls keep their mode.
class ModeEquations {
 public:
  using Flow = HybridFlow<double, model::any_count>;
  static constexpr int dimension = Flow::dimension;

  // `psi`: the rotor's angle at time 0, if the state does not contain it.
  ModeEquations(const model::System& system, double psi, const model::BallMode& mode)
      : mode_(mode),
        table_(system.parameters()),
        flow_(system, model::Segment{0.0, std::numeric_limits<double>::infinity(), psi, system.speed(), 0.0, false},
              &table_) {
    table_.set(mode);
  }
  ModeEquations(const ModeEquations&) = delete;
  ModeEquations& operator=(const ModeEquations&) = delete;

  void set(const model::BallMode& mode) {
    if (mode == mode_) return;
    mode_ = mode;
    table_.set(mode);
  }
  void operator()(double t, const double* y, double* dy) const { flow_(t, y, dy); }
  // On each ball, over its mass.
  Flow::Forces forces(const double* y) const {
    double dy[dimension];
    Flow::Forces result;
    flow_.evaluate(0.0, y, dy, result);
    return result;
  }

 private:
  model::BallMode mode_;
  Flow::Modes table_;
  Flow flow_;
};

class EventRun {
 public:
  using Machine = EventTrajectory<model::any_count>;
  static constexpr int dimension = Machine::dimension;

  // From state `y` at time 0. `psi`: the rotor's angle there, if the state does not contain it. Touching balls to
  // within rounding are taken to touch.
  EventRun(const model::System& system, const double* y, double psi, const typename Machine::Scale& scale)
      : system_(system),
        machine_layout_(model::machine_layout(n())),
        begin_(beginning(y, psi)),
        machine_(system_.parameters(), drive(system), scale, begin_.data(), begin_[machine_layout_.error]),
        equations_(system_, psi, machine_.mode()) {}
  EventRun(const EventRun&) = delete;
  EventRun& operator=(const EventRun&) = delete;

  // EventTrajectory's, but `observe` gets states of the system.
  template <class Observe>
  IntegrationStatus advance(double end, Observe&& observe, const StopFlag* stop = nullptr) {
    return machine_.advance(
        end,
        [&](double from, double to, auto&& state_at) {
          const auto at = [&](double t, double* y) {
            double z[dimension];
            state_at(t, z);
            model::copy_state(machine_layout_, z, system_.layout(), y);
          };
          return observe(from, to, at);
        },
        stop);
  }

  void state(double* y) const { model::copy_state(machine_layout_, machine_.state(), system_.layout(), y); }
  double time() const { return machine_.time(); }
  double psi() const { return machine_.state()[machine_layout_.psi]; }
  long events() const { return machine_.events(); }
  const model::BallMode& mode() const { return machine_.mode(); }
  void operator()(double t, const double* y, double* dy) const {
    equations_.set(machine_.mode());
    equations_(t, y, dy);
  }
  // Senses in which the free balls move.
  std::array<int, model::max_balls> senses() const {
    std::array<int, model::max_balls> result{};
    for (int i = 0; i < n(); ++i) result[i] = mode().held[i] ? 0 : mode().sense[i];
    return result;
  }

 private:
  int n() const { return system_.balls(); }

  // The machine's state, in which balls touching up to integration errors touch exactly.
  std::array<double, dimension> beginning(const double* y, double psi) const {
    constexpr double touching = 1e-7, together = 1e-8;
    std::array<double, dimension> z{};
    z[machine_layout_.psi] = psi;
    z[machine_layout_.speed] = system_.speed();
    model::copy_state(system_.layout(), y, machine_layout_, z.data());
    const model::Parameters& p = system_.parameters();
    if (!p.balls_collide() || n() < 2) return z;
    std::array<int, model::max_balls> order{};
    for (int i = 0; i < n(); ++i) order[i] = i;
    const auto angle = [&](int i) { return wrapped_positive(z[model::index::phi(i)]); };
    std::sort(order.begin(), order.begin() + n(), [&](int a, int b) { return angle(a) < angle(b); });
    for (int k = 0; k < n(); ++k) {
      const int a = order[k], b = order[(k + 1) % n()];
      const double gap = wrapped(z[model::index::phi(b)] - z[model::index::phi(a)] - p.contact_angle);
      double& rate = z[model::index::q(b, n())];
      if (std::fabs(gap) > touching || std::fabs(rate - z[model::index::q(a, n())]) > together) continue;
      z[model::index::phi(b)] -= gap;
      rate = z[model::index::q(a, n())];
    }
    return z;
  }

  model::Drive drive(const model::System& system) const {
    model::Drive result;
    result.psi = begin_[machine_layout_.psi];
    result.speed = begin_[machine_layout_.speed];
    model::DrivePiece piece = system.drive();
    piece.begin = 0.0;
    piece.end = std::numeric_limits<double>::infinity();
    piece.psi = result.psi;
    result.pieces = {piece};
    return result;
  }

  const model::System system_;
  const model::StateLayout machine_layout_;
  const std::array<double, dimension> begin_;
  Machine machine_;
  mutable ModeEquations equations_;  // keeps to the machine's mode
};

// Relative errors as in error_scale() of a system, for a machine's state.
inline EventRun::Machine::Scale event_scale(const model::System& system, double tolerance) {
  auto scale = error_scale<EventRun::Machine::dimension>(system.parameters(), tolerance);
  const int n = system.balls(), psi = model::machine_layout(n).psi;
  for (int i = psi; i < model::machine_layout(n).size; ++i) scale.floor[i] = smallest_share;
  scale.floor[psi] = 1.0;
  scale.absolute[psi] = scale.angle[psi] = true;
  return scale;
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
