// Runs pilot starts on lanes.
#include "equipoise/classification/attractor_search/pilot_run.hpp"

#include <algorithm>
#include <array>
#include <atomic>

#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/rule/pilot.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

namespace {

// A seed apart from the study's, on which the rule then does not depend.
constexpr std::uint64_t pilot_seed = 0x9e3779b97f4a7c15;
// Lanes seldom wait for the last start of a large chunk; several threads need several chunks.
std::size_t chunk_for(int threads) { return threads == 1 ? PilotRun::Size().random_starts : 256; }

}  // namespace

// Adds starts that are not over. Time no longer matters to them: all go on from where the last piece begins.
void PilotRun::append(const SpunUp& starts) {
  const std::size_t size = system_.dimension();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (starts.is_over(i)) continue;
    begin_.insert(begin_.end(), &starts.states[i * size], &starts.states[i * size] + size);
    if (!starts.rotors.empty()) rotors_.push_back(starts.rotors[i]);
  }
}

SpunUp PilotRun::free_at_speeds(std::size_t first, std::size_t count) const {
  constexpr std::size_t speeds = 8;
  constexpr double beyond_resonance = 3.0;  // range searched if the motor has no speed of its own
  SpunUp starts;
  for (std::size_t i = 0; drawn_ && i < count; ++i) starts.rotors.push_back(drawn_->rotor(first + i));
  starts.outcomes.assign(count, Outcome{});
  const std::size_t size = system_.dimension();
  starts.states.assign(count * size, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    double* state = &starts.states[i * size];
    const model::System& system = starts.rotors.empty() ? system_ : starts.rotors[i].system;
    const double fastest = system.no_load_speed().value_or(beyond_resonance);
    start_angles(pilot_seed, first + i, system_.balls(), state + model::index::phi(0));
    if (system.events().contact) make_room(system.parameters(), state + model::index::phi(0));
    const double speed = fastest * (static_cast<double>(i % speeds) + 0.5) / speeds;
    state[system_.layout().speed] = speed;
    // At rest under its weight.
    const std::array<double, 2> rest = model::rest_position(system.parameters(), 0.0);
    std::copy(rest.begin(), rest.end(), state);
  }
  return starts;
}

// Adds `count` random starts, from number `first` on.
bool PilotRun::add(std::size_t first, std::size_t count) {
  const std::size_t own = system_.prescribed() ? count : count / 2;
  SpunUp starts;
  if (!source_.make(pilot_seed, first, own, starts)) return false;
  append(starts);
  if (own < count) append(free_at_speeds(first + own, count - own));
  return true;
}

bool PilotRun::make() {
  const int balls = system_.balls();
  const auto [scouting, coincident, all] = wanted_;
  if (!add(0, scouting)) return false;
  random_ones_ = begin_.size() / system_.dimension();
  std::vector<InitialState> in_one_place(coincident, initial_);
  for (std::size_t k = 0; k < coincident; ++k)
    for (int i = 0; i < balls; ++i)
      in_one_place[k].phi[i] = two_pi * static_cast<double>(k) / static_cast<double>(coincident) +
                               model::side_by_side * system_.parameters().contact_angle * i;
  SpunUp together;
  if (!source_.follow(in_one_place, together)) return false;
  append(together);
  scouts_ = begin_.size() / system_.dimension();
  if (!add(scouting, all - scouting)) return false;
  outcomes_.resize(begin_.size() / system_.dimension());
  records_.resize(outcomes_.size());
  return true;
}

namespace {

// Outcomes of the first starts, one after the other; states only of those without a name.
struct Followed {
  bool complete = false;
  std::vector<Outcome> outcomes;
  std::vector<PilotRecord> records;
  std::vector<double> states;
};

template <class Bytes, Like<Followed> T>
void members(Bytes& b, T& f) {
  b(f.complete, f.outcomes, f.records, f.states);
}

}  // namespace

bool PilotRun::follow(std::size_t count, const ClassificationRule& rule, double horizon, int threads,
                      const StopFlag* stop, StageProgress& stages, NotePage& notes) {
  const auto size = static_cast<std::size_t>(system_.dimension());
  const auto each_unnamed = [&](const std::vector<Outcome>& outcomes, auto&& visit) {
    for (std::size_t i = 0; i < count; ++i)
      if (outcomes[i].attractor == 0) visit(&states_[i * size]);
  };
  stages.begin("pilot trajectories", count);  // also if an earlier run has followed them: what comes next has no stage
  const Followed followed = notes.answer(
      "pilot", stop,
      [&] {
        Followed now{decide(count, rule, horizon, threads, stop, stages), {}, {}, {}};
        now.outcomes.assign(outcomes_.begin(), outcomes_.begin() + static_cast<std::ptrdiff_t>(count));
        now.records.assign(records_.begin(), records_.begin() + static_cast<std::ptrdiff_t>(count));
        each_unnamed(now.outcomes,
                     [&](const double* state) { now.states.insert(now.states.end(), state, state + size); });
        return now;
      },
      [&](const Followed& known) {
        std::size_t unnamed = 0;
        for (const Outcome& outcome : known.outcomes) unnamed += outcome.attractor == 0;
        return known.outcomes.size() == count && known.records.size() == count && known.states.size() == unnamed * size;
      });
  followed_ = count;
  states_ = begin_;
  std::copy(followed.outcomes.begin(), followed.outcomes.end(), outcomes_.begin());
  std::copy(followed.records.begin(), followed.records.end(), records_.begin());
  auto next = followed.states.begin();
  each_unnamed(followed.outcomes, [&](double* state) {
    std::copy(next, next + static_cast<std::ptrdiff_t>(size), state);
    next += static_cast<std::ptrdiff_t>(size);
  });
  return followed.complete;
}

bool PilotRun::decide(std::size_t count, const ClassificationRule& rule, double horizon, int threads,
                      const StopFlag* stop, StageProgress& stages) {
  const std::size_t size = system_.dimension(), chunk = chunk_for(threads);
  states_ = begin_;
  std::atomic<bool> complete{true};
  in_parallel(threads, (count + chunk - 1) / chunk, [&](std::size_t k) {
    const std::size_t first = k * chunk, length = std::min(chunk, count - first);
    BatchTask task = task_;
    task.end = task.segment.begin + horizon;
    std::vector<OwnRotor> rotors;
    for (std::size_t i = 0; i < length && !rotors_.empty(); ++i) {
      OwnRotor& rotor = rotors.emplace_back(rotors_[first + i]);
      rotor.end = rotor.segment.begin + horizon;
    }
    const std::vector<const OwnRotor*> own = pointers_to(rotors);
    task.take({&states_[first * size], length * size}, own, {});
    task.stop = stop;
    std::vector<Outcome> outcomes(length);
    std::vector<PilotRecord> records(length);
    if (classify_batch(task, rule, outcomes, &records))
      stages.add(length);
    else
      complete = false;
    std::copy(outcomes.begin(), outcomes.end(), outcomes_.begin() + static_cast<std::ptrdiff_t>(first));
    std::copy(records.begin(), records.end(), records_.begin() + static_cast<std::ptrdiff_t>(first));
  });
  return complete;
}

Eigen::Map<const Eigen::VectorXd> PilotRun::state(std::size_t i) const {
  const int size = system_.dimension();
  return {&states_[i * size], size};
}

Eigen::VectorXd PilotRun::state_on_section(std::size_t i) const {
  const model::Segment& segment = rotors_.empty() ? task_.segment : rotors_[i].segment;
  return at_next_section(system(i), state(i), segment.psi_at(outcomes_[i].time)).value_or(state(i));
}

}  // namespace equipoise
