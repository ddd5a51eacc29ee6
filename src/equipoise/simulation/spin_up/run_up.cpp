// Integrates the drive of a motor piece by piece.
#include "equipoise/simulation/spin_up/run_up.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

namespace {

namespace kernels = HWY_NAMESPACE;

constexpr double share_of_final = 0.95;

// State: psi', and the integral of a speed control's error.
struct TurningBody {
  const model::Parameters& p;
  double inertia, unbalance, shakes_below;
  model::DriveSegment motor;

  void operator()(double t, const double* y, double* dy) const {
    const double speed = std::fabs(y[0]);
    const double taken = speed < shakes_below ? model::shaking_torque(p, unbalance, speed) : 0.0;
    dy[0] = (motor.torque(t, y[0], y[1]) - (std::isfinite(taken) ? std::copysign(taken, y[0]) : 0.0)) / inertia;
    dy[1] = motor.error_rate(t, y[0], y[1]);
  }
};

}  // namespace

SpeedRun rotor_alone(const Study& study, double unbalance, std::optional<double> to) {
  // Beyond anybody's patience.
  constexpr double longest = 1e9;
  // A rotor below its speed is at rest once its acceleration falls to this fraction of the largest so far.
  constexpr double rests = 1e-6;
  const model::Parameters& p = study.parameters;
  const auto pieces = model::drive_segments(study.motor());
  const double inertia = model::turning_inertia(p);
  double y[2] = {study.speed.initial, 0.0}, largest = 0.0;
  SpeedRun run{0.0, y[0], to && std::fabs(y[0]) >= *to};
  for (const model::DriveSegment& piece : pieces) {
    const bool last = std::isinf(piece.end);
    if (run.arrived || (last && !to)) break;
    const TurningBody body{p, inertia, unbalance, model::quiet_speed(p), piece};
    kernels::ErrorScale<2> scale;
    scale.tolerance = 1e-8;  // a time to more digits than anybody reads
    // The error integral starts and stops at the motor's limit; only its effect on the speed counts.
    scale.floor = {1e-3, 1e6};
    kernels::AdaptiveIntegrator<TurningBody, 2> integrator(body, scale);
    const auto watch = [&](double t_old, double t_new, auto state_at) {
      double at[2], rate[2];
      state_at(t_new, at);
      body(t_new, at, rate);
      largest = std::max(largest, std::fabs(rate[0]));
      if (!to) return t_new;
      if (std::fabs(at[0]) < *to) {
        if (last && std::fabs(rate[0]) <= rests * largest) return t_old;
        return t_new;
      }
      double early = t_old, late = t_new;
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (early + late);
        state_at(middle, at);
        (std::fabs(at[0]) < *to ? early : late) = middle;
      }
      run.arrived = true;
      return std::min(late, std::nextafter(t_new, t_old));  // only a time before the step's end ends the run
    };
    const double end = last ? piece.begin + longest : piece.end;
    const auto status = integrator.advance(piece.begin, end, y, watch);
    run.time = integrator.reached();
    run.speed = y[0];
    if (status != IntegrationStatus::done) break;
  }
  return run;
}

std::optional<RunUp> run_up(const Study& study, double final_speed) {
  RunUp result;
  result.inertia = model::turning_inertia(study.parameters);
  result.speed = share_of_final * final_speed;
  result.last_piece = study.drive().pieces.back().begin;
  const double to = std::fabs(result.speed);
  if (std::fabs(study.speed.initial) >= to) return std::nullopt;
  const SpeedRun alone = rotor_alone(study, 0.0, to);
  const SpeedRun shaken = rotor_alone(study, study.parameters.eccentricity, to);
  if (alone.arrived) result.alone = alone.time;
  if (shaken.arrived)
    result.shaken = shaken.time;
  else
    result.stalls_at = shaken.speed;
  return result;
}

}  // namespace equipoise
