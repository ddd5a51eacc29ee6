// Samples lanes from time to time, with the ensemble's kernels.
#include "late_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"

namespace equipoise::audit {

namespace {

constexpr int samples_a_window = 500;

// Turns samples of one trajectory into a LateMotion. Angles are unwrapped.
class Looker {
 public:
  Looker(const model::Parameters& p, LateMotion& motion) : p_(p), motion_(motion) {}

  // `second`: in the second window.
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

// Sample times relative to settled(): first window, then second.
std::vector<std::pair<double, bool>> sample_times(const LookTimes& times) {
  std::vector<std::pair<double, bool>> list;
  for (const auto& [begin, second] : {std::pair{times.first, false}, std::pair{times.second, true}})
    for (int k = 0; k <= samples_a_window; ++k) list.emplace_back(begin + times.length * k / samples_a_window, second);
  return list;
}

// A rule that never decides, for the ensemble's kernels. Others round differently, and where the way to an attractor is
// chaotic that soon leads to another attractor. Up to the first sample the steps are the ensemble's own too, so that
// starts are followed from the very state in which they were decided.
ClassificationRule rule_that_never_decides(int balls) {
  ClassificationRule rule;
  rule.balls = balls;
  rule.window = rule.first_long_window = 1e9;
  return rule;
}

// Starts first .. first + motions.size() - 1; `family`: for a study with uncertain values, else null.
class Followers {
 public:
  Followers(const Study& study, const StudyFamily* family, const SpinUp& source, std::size_t first,
            std::span<LateMotion> motions)
      : source_(source),
        motions_(motions),
        size_(study.system().dimension()),
        rule_(rule_that_never_decides(study.parameters.balls)) {
    std::vector<OwnRotorStart> own;
    for (std::size_t i = 0; family && i < motions.size(); ++i)
      own.push_back(own_rotor_start(*family, study, first + i));
    if (family ? !spin_up_own_rotors(own, nullptr, starts_)
               : !source.make(study.sampling.seed, first, motions.size(), starts_))
      return;
    task_ = source.last_task();
    psi_.assign(motions.size(), 0.0);
    parameters_.assign(motions.size(), study.parameters);
    for (std::size_t i = 0; i < own.size(); ++i) parameters_[i] = own[i].study.parameters;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      lookers_.emplace_back(parameters_[i], motions[i]);
      now_.push_back(starts_.begin(i, source.settled()));
      motions[i].followed = starts_.over.empty() || !starts_.over[i];
      motions[i].lost = motions[i].followed && starts_.is_over(i);
    }
  }

  void run(const LookTimes& times) {
    for (const auto& [at, second] : sample_times(times)) {
      const double time = source_.settled() + at;
      go_to(time);
      for (std::size_t i = 0; i < lookers_.size(); ++i)
        if (under_way(i) && now_[i] == time) sample(i, second, time);
    }
    for (std::size_t i = 0; i < lookers_.size(); ++i)
      if (motions_[i].followed) lookers_[i].finish();
  }

 private:
  bool under_way(std::size_t i) const { return motions_[i].followed && !motions_[i].lost; }
  double* state(std::size_t i) { return &starts_.states[i * size_]; }

  void go_to(double time) {
    std::vector<std::size_t> places;
    std::vector<double> states, begins;
    std::vector<const OwnRotor*> own;
    for (std::size_t i = 0; i < lookers_.size(); ++i) {
      if (!under_way(i) || !(now_[i] < time)) continue;
      if (!starts_.rotors.empty()) {
        starts_.rotors[i].end = time;
        own.push_back(&starts_.rotors[i]);
      }
      places.push_back(i);
      states.insert(states.end(), state(i), state(i) + size_);
      begins.push_back(now_[i]);
    }
    if (places.empty()) return;
    task_.end = time;
    task_.count = places.size();
    task_.states = states.data();
    task_.begins = begins.data();
    if (!own.empty()) task_.own = own.data();
    std::vector<Outcome> outcomes(places.size());
    classify_batch(task_, rule_, outcomes, nullptr);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const std::size_t i = places[k];
      std::copy_n(&states[k * size_], size_, state(i));
      motions_[i].lost = outcomes[k].kind == OutcomeKind::diverged || outcomes[k].kind == OutcomeKind::failed;
      turn(i, time);
    }
  }

  // The rotor's angle: as prescribed; part of the state; or from the mean of the speeds at both ends of a step between
  // samples, during which the speed hardly changes.
  void turn(std::size_t i, double time) {
    if (task_.layout().speed < 0)
      psi_[i] = (starts_.rotors.empty() ? task_.segment : starts_.rotors[i].segment).psi_at(time);
    else if (task_.layout().psi >= 0)
      psi_[i] = state(i)[task_.layout().psi];
    else
      psi_[i] += state(i)[task_.layout().speed] * (time - now_[i]);
    now_[i] = time;
  }

  void sample(std::size_t i, bool second, double time) { lookers_[i].sample(second, time, psi_[i], state(i)); }

  const SpinUp& source_;
  std::span<LateMotion> motions_;
  SpunUp starts_;
  std::vector<model::Parameters> parameters_;
  std::vector<Looker> lookers_;
  std::vector<double> now_, psi_;
  std::size_t size_;
  BatchTask task_;
  const ClassificationRule rule_;
};

}  // namespace

OwnRotorStart own_rotor_start(const StudyFamily& family, const Study& study, std::uint64_t number) {
  const Sampler sampler = sampler_of(study);
  const std::uint64_t seed = study.sampling.seed;
  Study own = family.at(family.values_at(drawn_fractions(study, sampler, seed, number)));
  const InitialState start = parted(own.parameters, start_of(own, sampler, seed, number));
  return {std::move(own), start};
}

std::vector<LateMotion> follow_late(const Study& study, std::uint64_t first, std::size_t count, const LookTimes& times,
                                    int threads) {
  std::vector<LateMotion> motions(count);
  const Study with_end = with_horizon(study);
  const auto source = make_spin_up(with_medians(with_end), nullptr);
  const std::optional<StudyFamily> family =
      study.uncertain.empty() ? std::nullopt : std::optional<StudyFamily>(with_end);
  tbb::task_arena arena(threads);
  constexpr std::size_t chunk = 32;  // fills the widest lanes four times
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, (count + chunk - 1) / chunk, [&](std::size_t k) {
      const std::size_t begin = k * chunk;
      const std::span<LateMotion> part(&motions[begin], std::min(chunk, count - begin));
      Followers(with_end, family ? &*family : nullptr, *source, first + begin, part).run(times);
    });
  });
  return motions;
}

double window_length(const Study& study) {
  const double speed = std::fabs(study.speed_profile().final_speed());
  return std::clamp(40.0 * two_pi / std::max(speed, 1e-3), 150.0, 4000.0);
}

}  // namespace equipoise::audit
