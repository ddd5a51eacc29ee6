// Imperfections that fade, step by step.
#include "equipoise/fates/machine_fade.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "equipoise/base/angles.hpp"
#include "equipoise/fates/machine_balance.hpp"
#include "equipoise/fates/machine_scale.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/hanging.hpp"

namespace equipoise {

namespace {
using Machine = HWY_NAMESPACE::MachineTrajectory<model::any_count>;

// So much of every imperfection.
model::Parameters with_imperfections(model::Parameters p, double share) {
  const auto equalise = [share](std::array<double, 2>& v) {
    const double mean = 0.5 * (v[0] + v[1]), half = 0.5 * share * (v[0] - v[1]);
    v = {mean + half, mean - half};
    if (share == 0.0) v[1] = v[0];
  };
  equalise(p.damping);
  equalise(p.stiffness);
  p.gravity *= share;
  for (double& e : p.race_offset) e *= share;
  for (int i = 0; i < p.balls; ++i) {
    p.rolling[i] *= share;
    p.stiction[i] *= share;
  }
  return p;
}

class Fade {
 public:
  Fade(const model::Parameters& p, double speed, const double* z, double tolerance, const StopFlag* stop)
      : p_(p),
        speed_(speed),
        tolerance_(tolerance),
        stop_(stop),
        z_(z, z + model::machine_dimension(p.balls)),
        begin_(z_) {}

  bool comes_to_balance(double patience) {
    // Each step takes a fortieth away; ten turns let go what it has stirred up.
    constexpr int steps = 40;
    const double time = std::clamp(10.0 * two_pi / std::fabs(speed_), 16.0, 64.0);
    model::Parameters now = p_;
    for (int k = 1; k < steps; ++k) {
      weaken(now, 1.0 - static_cast<double>(k) / steps);
      if (!go_on(now, time, [](auto&&...) { return false; })) return false;
    }
    weaken(now, 0.0);
    const MachineBalance balance(now, {.end = std::numeric_limits<double>::infinity(), .speed = speed_});
    BalanceApproach approach(balance);
    bool balanced = false;
    double next = 0.0;
    go_on(now, patience, [&](double t, const double* z) {
      if (t < next) return false;
      next = t + time;
      balanced = approach.look(t, z) != BalanceApproach::Verdict::none;
      return balanced || approach.unstable_here();
    });
    return balanced && near();
  }

 private:
  void weaken(model::Parameters& now, double share) {
    const model::Parameters before = std::exchange(now, with_imperfections(p_, share));
    model::hang_anew(before, now, z_[model::machine_index::psi(p_.balls)], z_.data());
  }

  bool near() const {
    for (int i = 0; i < p_.balls; ++i)
      if (std::fabs(z_[model::index::phi(i)] - begin_[model::index::phi(i)]) > 0.5 * pi) return false;
    return true;
  }

  template <class Until>
  bool go_on(const model::Parameters& p, double time, Until&& until) {
    using model::machine_index::psi;
    model::Drive drive;
    drive.psi = z_[psi(p.balls)];
    drive.speed = speed_;
    drive.pieces = {{.end = std::numeric_limits<double>::infinity(), .psi = drive.psi, .speed = speed_}};
    Machine machine(p, drive, ensemble_scale<model::any_count>(p, tolerance_), z_.data());
    const auto status = machine.advance(
        time,
        [&](double, double to, auto&& state_at) {
          double at[Machine::dimension];
          state_at.roughly(to, at);
          return until(to, at);
        },
        stop_);
    std::copy(machine.state(), machine.state() + z_.size(), z_.begin());
    return status == IntegrationStatus::done && near();
  }

  const model::Parameters& p_;
  double speed_, tolerance_;
  const StopFlag* stop_;
  std::vector<double> z_, begin_;
};

}  // namespace

bool fades_to_balance(const model::Parameters& p, double speed, const double* z, double tolerance, double patience,
                      const StopFlag* stop) {
  return Fade(p, speed, z, tolerance, stop).comes_to_balance(patience);
}

}  // namespace equipoise
