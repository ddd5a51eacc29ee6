// Lanes are taken from time to time with the ensemble's kernels; machines one by one, as the ensemble does.
#include "late_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/integrate/machine_trajectory-inl.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/spin_up/initial_state.hpp"
#include "equipoise/spin_up/start_source.hpp"

namespace equipoise::audit {

namespace {
namespace kernels = HWY_NAMESPACE;

constexpr int samples_a_window = 500;

// Turns samples of one trajectory into a LateMotion. Angles are unwrapped.
class Looker {
 public:
  Looker(const model::Parameters& p, LateMotion& motion) : p_(p), motion_(motion) {}

  // `second`: of the second window.
  void sample(bool second, double t, double psi, const double* z) {
    const double sag = model::static_sag(p_);
    const double r = std::hypot(z[0] - sag * std::sin(psi), z[1] - sag * std::cos(psi));
    RadiusRange& range = second ? motion_.after : motion_.before;
    int& count = count_[second];
    if (count == 0) range = {r, 0.0, r};
    if (count == 0 && !second) {
      begin_ = {t, psi};
      std::copy(z + 4, z + 4 + p_.balls, phi_.begin());
    }
    if (count == 0 && second) {
      middle_ = {t, psi};
      std::copy(z + 4, z + 4 + p_.balls, middle_phi_.begin());
      low_ = high_ = middle_phi_;
    }
    ++count;
    range.low = std::min(range.low, r);
    range.high = std::max(range.high, r);
    range.mean += (r - range.mean) / count;
    if (!std::isfinite(r)) motion_.lost = true;
    last_ = {t, psi};
    std::copy(z + 4, z + 4 + p_.balls, last_phi_.begin());
    for (int i = 0; i < p_.balls && second; ++i) {
      low_[i] = std::min(low_[i], z[4 + i]);
      high_[i] = std::max(high_[i], z[4 + i]);
    }
  }

  void finish() {
    if (count_[1] == 0) motion_.lost = true;
    if (motion_.lost) return;
    motion_.speed = (last_.psi - begin_.psi) / (last_.t - begin_.t);
    for (int i = 0; i < p_.balls; ++i) {
      motion_.turned[i] = last_phi_[i] - phi_[i];
      motion_.rate[i] = motion_.turned[i] / (last_.t - begin_.t);
      motion_.rate_early[i] = (middle_phi_[i] - phi_[i]) / (middle_.t - begin_.t);
      motion_.rate_late[i] = (last_phi_[i] - middle_phi_[i]) / (last_.t - middle_.t);
      motion_.swing[i] = high_[i] - low_[i];
    }
  }

 private:
  struct At {
    double t = 0.0, psi = 0.0;
  };
  const model::Parameters& p_;
  LateMotion& motion_;
  int count_[2] = {0, 0};
  At begin_, middle_, last_;
  std::array<double, model::max_balls> phi_{}, middle_phi_{}, last_phi_{}, low_{}, high_{};
};

// When samples are taken, relative to settled(): first window, then second.
std::vector<std::pair<double, bool>> sample_times(const LookTimes& times) {
  std::vector<std::pair<double, bool>> list;
  for (const auto& [begin, second] : {std::pair{times.first, false}, std::pair{times.second, true}})
    for (int k = 0; k <= samples_a_window; ++k) list.emplace_back(begin + times.length * k / samples_a_window, second);
  return list;
}

// Of the ensemble's kernels: others round otherwise, and where the way to an attractor is chaotic that is soon another
// way, to another attractor as well. Up to the first look the steps are the ensemble's own too, so that what was decided
// is followed on from the very state it was decided in.
DecisionRule rule_that_never_decides(int balls) {
  DecisionRule rule;
  rule.balls = balls;
  rule.window = rule.first_long_window = 1e9;
  return rule;
}

void follow_lanes(const Study& study, const StartSource& source, std::size_t first, const LookTimes& times,
                  std::vector<LateMotion>& motions, std::size_t count) {
  std::vector<double> phi, states;
  std::vector<Fate> fates;
  source.make(study.sampling.seed, first, count, phi, states, fates);
  std::vector<Looker> lookers;
  for (std::size_t i = 0; i < count; ++i) lookers.emplace_back(study.parameters, motions[first + i]);
  const std::size_t size = model::dimension(study.parameters.balls);
  const model::Segment& last = source.last_segment();
  const DecisionRule rule = rule_that_never_decides(study.parameters.balls);
  double t = last.begin;
  for (const auto& [at, second] : sample_times(times)) {
    LaneTask task = source.task(source.segments().size() - 1, states);
    task.segment.begin = t;
    task.segment.psi = last.psi_at(t);
    task.end = last.begin + at;
    if (task.end > t) decide_lanes(task, rule, fates, nullptr);
    t = std::max(t, task.end);
    for (std::size_t i = 0; i < count; ++i)
      if (fates[i].outcome == Outcome::diverged || fates[i].outcome == Outcome::failed)
        motions[first + i].lost = true;
      else
        lookers[i].sample(second, t, last.psi_at(t), &states[i * size]);
  }
  for (Looker& looker : lookers) looker.finish();
}

// The ensemble's own error scale, so that this is its trajectory (fates/machine_runner.cpp).
void follow_machine(const Study& study, const model::Drive& drive, const InitialState& start, const LookTimes& times,
                    double settled, LateMotion& motion) {
  using Machine = kernels::MachineTrajectory<model::any_count>;
  const int n = study.parameters.balls;
  using model::machine_index::psi;
  Machine::Scale scale;
  scale.tolerance = study.numerics.tolerance.value_or(default_basin_tolerance);
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = study.parameters.eccentricity + study.parameters.total_mass();
  scale.absolute.fill(true);
  double z[Machine::dimension];
  initial_state(start, n, drive.speed, z);
  Machine machine(study.parameters, drive, scale, z);
  Looker looker(study.parameters, motion);
  const auto list = sample_times(times);
  std::size_t next = 0;
  const auto status = machine.advance(settled + list.back().first, [&](double, double to, auto&& state_at) {
    for (; next < list.size() && settled + list[next].first <= to; ++next) {
      double at[Machine::dimension];
      state_at(settled + list[next].first, at);
      looker.sample(list[next].second, settled + list[next].first, at[psi(n)], at);
    }
    return false;
  });
  motion.lost = status != IntegrationStatus::done;
  looker.finish();
}

double machine_settled(const Study& study, const model::Drive& drive) {
  const double begin = drive.pieces.back().begin;
  return study.speed.driven() ? begin : std::max(begin, drive.release_time);
}

}  // namespace

std::vector<LateMotion> follow_late(const Study& study, std::size_t count, const LookTimes& times, int threads) {
  std::vector<LateMotion> motions(count);
  tbb::task_arena arena(threads);
  if (!study.system().simple()) {
    const model::Drive drive = study.drive();
    const double settled = machine_settled(study, drive);
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const InitialState start = start_of(study, study.sampling.seed, i);
        follow_machine(study, drive, start, times, settled, motions[i]);
      });
    });
    return motions;
  }
  constexpr std::size_t chunk = 32;  // fills the widest lanes four times
  const StartSource source(study, nullptr);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, (count + chunk - 1) / chunk, [&](std::size_t k) {
      follow_lanes(study, source, k * chunk, times, motions, std::min(chunk, count - k * chunk));
    });
  });
  return motions;
}

double window_length(const Study& study) {
  const double speed = std::fabs(study.speed_profile().final_speed());
  return std::clamp(40.0 * two_pi / std::max(speed, 1e-3), 150.0, 4000.0);
}

}  // namespace equipoise::audit
