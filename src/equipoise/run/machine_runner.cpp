// One machine trajectory after the other.
#include "equipoise/run/machine_runner.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/attractors/steady_watch.hpp"
#include "equipoise/integrate/machine_trajectory-inl.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/run/initial_state.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

// Of a step, where it is looked at.
constexpr std::array<double, 3> nodes{1.0 / 3, 2.0 / 3, 1.0};

// Distance from where gravity alone would hold the rotor with its balls.
template <int n>
SteadySample sample(const model::Parameters& p, const double* z) {
  double x = z[model::index::x], y = z[model::index::y];
  if (p.gravity != 0.0) {
    const double sag = (1.0 + p.total_mass()) * p.gravity / p.stiffness[1], psi = z[model::machine_index::psi(n)];
    x += sag * std::sin(psi);
    y += sag * std::cos(psi);
  }
  SteadySample s;
  s.r2 = x * x + y * y;
  for (int i = 0; i < n; ++i) s.rate[i] = z[model::index::q(i, n)];
  return s;
}

// Errors as in ensembles on lanes (lane_error_scale()); angles and speeds of the rotor like those of balls.
template <int n>
typename kernels::MachineTrajectory<n>::Scale ensemble_scale(const Study& study) {
  typename kernels::MachineTrajectory<n>::Scale scale;
  scale.tolerance = study.numerics.tolerance.value_or(default_basin_tolerance);
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = study.parameters.eccentricity + study.parameters.total_mass();
  scale.absolute.fill(true);
  return scale;
}
}  // namespace

void check_machine(const Study& study) {
  check(study);
  if (study.numerics.decide == DecideMode::proof)
    throw InputError(study.name, "numerics.decide", "proof",
                     "a machine (motor, race offset, contact, rolling resistance) has no proved balance; must be "
                     "\"validated\" or \"horizon\"");
}

MachineRunner::MachineRunner(const Study& study, const StopFlag* stop)
    : study_(study),
      stop_(stop),
      drive_(study.drive()),
      sampler_(sampler_of(study)),
      settled_(drive_.pieces.back().begin) {
  if (!study.speed.driven()) settled_ = std::max(settled_, drive_.release_time);
  for (const SteadyKind& kind : steady_kinds(study.parameters.balls)) {
    Motion motion;
    motion.kind = MotionKind::measured;
    catalogue_.add({kind.id, kind.name, "", motion, false});
  }
}

bool MachineRunner::run(std::uint64_t first, std::size_t count, std::vector<double>& phi,
                        std::vector<Fate>& fates) const {
  const int balls = study_.parameters.balls;
  phi.clear();
  fates.assign(count, Fate{});
  for (std::size_t i = 0; i < count; ++i) {
    if (stop_ && stop_->load(std::memory_order_relaxed)) return false;
    const InitialState start = start_of(study_, sampler_, study_.sampling.seed, first + i);
    phi.insert(phi.end(), start.phi.begin(), start.phi.begin() + balls);
    fates[i] = model::with_ball_count(balls, [&](auto n) { return decide<n>(start); });
  }
  return true;
}

template <int n>
Fate MachineRunner::decide(const InitialState& start) const {
  using Machine = kernels::MachineTrajectory<n>;
  const model::Parameters& p = study_.parameters;
  double z[Machine::dimension];
  initial_state(start, n, drive_.speed, z);
  Machine machine(p, drive_, ensemble_scale<n>(study_), z);
  const double aim = study_.speed_profile().final_speed();
  const bool at_horizon = study_.numerics.decide == DecideMode::horizon;
  SteadyWatch watch(p, aim);
  bool watching = false, watched_clamped = false, steady = false;
  const auto begin = [&](double t, const double* at) {
    watch.begin(t, at[model::machine_index::psi(n)], at + 4);
    watching = true;
    watched_clamped = machine.clamped();
  };
  const auto observe = [&](double from, double to, auto&& state_at) {
    if (to <= settled_) return false;
    double at[Machine::dimension];
    // Windows begin anew where the balls are let go: a rotor that is steady with its balls held may never do so.
    if (!watching || (watched_clamped && !machine.clamped())) {
      state_at(from, at);
      begin(from, at);
    }
    std::array<SteadySample, 3> samples;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      state_at.roughly(k + 1 == nodes.size() ? to : from + nodes[k] * (to - from), at);
      samples[k] = sample<n>(p, at);
    }
    if (watch.step(to, at[model::machine_index::psi(n)], at + 4, samples)) steady = true;
    return steady && !at_horizon;
  };
  const auto status = machine.advance(settled_ + study_.numerics.horizon, observe, stop_);
  Fate fate;
  fate.time = machine.time();
  if (status != IntegrationStatus::done) {
    fate.outcome = status == IntegrationStatus::diverged ? Outcome::diverged : Outcome::failed;
    return fate;
  }
  if (!watch.has_features()) return fate;
  // Chaotic motion of a captured rotor repeats its mean speed and nothing else: that it has stalled is known all the
  // same.
  const bool slow = study_.speed.driven() && watch.mean_speed() < study_.stall_speed();
  if (slow && (steady || watch.speed_repeats())) {
    fate.outcome = Outcome::stalled;
    fate.by = at_horizon ? DecidedBy::horizon : DecidedBy::windows;
  } else if (steady && !machine.clamped()) {
    fate.outcome = Outcome::attracted;
    fate.attractor = static_cast<short>(steady_kind(p, watch.features(), watch.mean_speed()).id);
    fate.by = at_horizon ? DecidedBy::horizon : DecidedBy::windows;
  }
  return fate;
}

}  // namespace equipoise
