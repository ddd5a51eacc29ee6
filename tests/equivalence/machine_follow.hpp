// A machine's start followed for as long as one likes, with no rule that might end it early, and what it then does,
// told by means and extremes alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "equipoise/fates/machine_scale.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/spin_up/initial_state.hpp"

namespace machine_follow {

struct Seen {
  bool lost = false;
  double speed = 0.0, r = 0.0;                                       // mean psi', rms r of the later half
  double last_r = 0.0;                                               // rms r of the last tenth
  std::array<double, equipoise::model::max_balls> turned{}, rate{};  // of each ball; its largest |phi'|
};

template <int n>
Seen follow(const equipoise::Study& study, std::uint64_t index, double until) {
  using namespace equipoise;
  using Machine = HWY_NAMESPACE::MachineTrajectory<n>;
  const model::Parameters& p = study.parameters;
  const model::Drive drive = study.drive();
  const double begin = drive.pieces.back().begin;
  double z[Machine::dimension];
  initial_state(start_of(study, study.sampling.seed, index), n, drive.speed, z);
  Machine machine(p, drive, ensemble_scale<n>(p, default_basin_tolerance), z);
  Seen seen;
  seen.lost = machine.advance(begin + 0.5 * until, [](auto&&...) { return false; }) != IntegrationStatus::done;
  const double from = machine.time();
  double before[Machine::dimension];
  std::copy(machine.state(), machine.state() + Machine::dimension, before);
  double square = 0.0, last_square = 0.0;
  const auto watch = [&](double t, double to, auto&& state_at) {
    double at[Machine::dimension];
    state_at.roughly(to, at);
    const double sag = model::static_sag(p), psi = at[model::machine_index::psi(n)];
    const double x = at[0] - sag * std::sin(psi), y = at[1] - sag * std::cos(psi), r2 = x * x + y * y;
    square += (to - t) * r2;
    if (t > begin + 0.95 * until) last_square += (to - t) * r2;
    for (int i = 0; i < n; ++i) seen.rate[i] = std::max(seen.rate[i], std::fabs(at[model::index::q(i, n)]));
    return false;
  };
  seen.lost = seen.lost || machine.advance(begin + until, watch) != IntegrationStatus::done;
  const double time = machine.time() - from;
  seen.speed = (machine.state()[model::machine_index::psi(n)] - before[model::machine_index::psi(n)]) / time;
  seen.r = std::sqrt(square / time);
  seen.last_r = std::sqrt(last_square / (0.05 * until));
  for (int i = 0; i < n; ++i) seen.turned[i] = machine.state()[4 + i] - before[4 + i];
  return seen;
}

inline Seen follow(const equipoise::Study& study, std::uint64_t index, double until) {
  return equipoise::model::with_ball_count(study.parameters.balls,
                                           [&](auto n) { return follow<n>(study, index, until); });
}

/// The kinds of fates/steady_watch.hpp, but "rest" for all balls captured, r above rounding or not.
inline std::string kind_of(const equipoise::Study& study, const Seen& seen) {
  if (study.speed.driven() && std::fabs(seen.speed) < study.stall_speed()) return "stalled";
  const int balls = study.parameters.balls;
  int captured = 0;
  for (int i = 0; i < balls; ++i) captured += std::fabs(seen.turned[i]) < 3.2;
  if (captured == balls) return "rest";
  if (captured > 0) return captured == 1 ? "one captured" : std::to_string(captured) + " captured";
  if (balls == 1) return "drifting";
  for (int i = 1; i < balls; ++i)
    if (std::fabs(seen.turned[i] - seen.turned[0]) > 0.02 * std::fabs(seen.turned[0]) + 7.0) return "drifting apart";
  return "co-drifting";
}

}  // namespace machine_follow
