// Compiled once for all tests, and optimised: most of their time is spent here.
#include "machine_follow.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "machine_scale.hpp"

namespace machine_follow {

Seen follow(const equipoise::Study& study, std::uint64_t index, double until) {
  using namespace equipoise;
  using Machine = HWY_NAMESPACE::EventTrajectory<model::any_count>;
  const model::Parameters& p = study.parameters;
  const int n = p.balls;
  const model::Drive drive = study.drive();
  const double begin = drive.pieces.back().begin;
  double z[Machine::dimension];
  initial_state(start_of(study, study.sampling.seed, index), n, drive.speed, z);
  Machine machine(p, drive, ensemble_scale<model::any_count>(p, default_basin_tolerance), z);
  Seen seen;
  seen.lost = machine.advance(begin + 0.5 * until, [](auto&&...) { return false; }) != IntegrationStatus::done;
  const double from = machine.time();
  double before[Machine::dimension];
  std::copy(machine.state(), machine.state() + Machine::dimension, before);
  double previous[Machine::dimension];
  std::copy(before, before + Machine::dimension, previous);
  double square = 0.0, last_square = 0.0;
  const auto watch = [&](double t, double to, auto&& state_at) {
    double at[Machine::dimension];
    state_at.roughly(to, at);
    const double sag = model::static_sag(p), psi = at[model::machine_layout(n).psi];
    const double x = at[0] - sag * std::sin(psi), y = at[1] - sag * std::cos(psi), r2 = x * x + y * y;
    square += (to - t) * r2;
    if (t > begin + 0.95 * until) last_square += (to - t) * r2;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < i; ++k) {
        const double ahead = at[4 + i] - at[4 + k], last = previous[4 + i] - previous[4 + k];
        seen.oppositions += std::floor((ahead + pi) / two_pi) != std::floor((last + pi) / two_pi);
      }
    std::copy(at, at + Machine::dimension, previous);
    for (int i = 0; i < n; ++i) seen.rate[i] = std::max(seen.rate[i], std::fabs(at[model::index::q(i, n)]));
    return false;
  };
  seen.lost = seen.lost || machine.advance(begin + until, watch) != IntegrationStatus::done;
  const double time = machine.time() - from;
  seen.speed = (machine.state()[model::machine_layout(n).psi] - before[model::machine_layout(n).psi]) / time;
  seen.r = std::sqrt(square / time);
  seen.last_r = std::sqrt(last_square / (0.05 * until));
  for (int i = 0; i < n; ++i) seen.turned[i] = machine.state()[4 + i] - before[4 + i];
  seen.one_side = true;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < i; ++k)
      seen.one_side = seen.one_side &&
                      std::fabs(wrapped(previous[4 + i] - previous[4]) - wrapped(previous[4 + k] - previous[4])) < pi;
  return seen;
}

std::string kind_of(const equipoise::Study& study, const Seen& seen) {
  using equipoise::two_pi;
  if (study.speed.driven() && std::fabs(seen.speed) < study.stall_speed()) return "stalled";
  const int balls = study.parameters.balls;
  int captured = 0;
  for (int i = 0; i < balls; ++i) captured += std::fabs(seen.turned[i]) < 3.2;
  if (captured == balls) return "rest";
  if (captured > 0) return captured == 1 ? "one captured" : std::to_string(captured) + " captured";
  if (balls == 1) return "drifting";
  for (int i = 1; i < balls; ++i)
    if (std::fabs(seen.turned[i] - seen.turned[0]) > 0.02 * std::fabs(seen.turned[0]) + 7.0)
      return "drifting at different rates";
  if (seen.oppositions == 0) return seen.one_side ? "co-drifting" : "drifting apart";
  // docs/explanation/motions.md: nothing was found between 1.54 and 1.99.
  const double turns = std::fabs(seen.turned[0]) / two_pi;
  return balls == 2 && seen.oppositions > 1.75 * turns ? "pair drift" : "drifting apart";
}

}  // namespace machine_follow
