// One study's starts, from index to fate.
#include "equipoise/fates/start_runner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "equipoise/discovery/cost.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/fates/transient_tally.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/speed.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/motion_figures.hpp"
#include "equipoise/orbits/stroboscopic.hpp"
#include "equipoise/transients/clamped_transients.hpp"

namespace equipoise {

namespace {

const char* final_speed_key(const Study& study) {
  const Profile profile = study.speed.profile;
  return profile == Profile::constant ? "speed.speed" : profile == Profile::points ? "speed.speeds" : "speed.final";
}

// What sets the time of release.
const char* release_key(const Study& study) {
  if (study.release.speed) return "release.speed";
  if (study.release.time) return "release.time";
  const Profile profile = study.speed.profile;
  return profile == Profile::trapezoid ? "speed.rise_until"
         : profile == Profile::points  ? "speed.times"
                                       : "speed.duration";
}

}  // namespace

void check_watchable(const Study& study) {
  const double release = study.release_time();
  const double points = clamped_grid_points(study.parameters, model::segments(study.speed_profile(), release));
  if (points <= most_clamped_grid_points) return;
  throw InputError(study.name, release_key(study), fmt::format("{:.6g}", study.release.speed.value_or(release)),
                   fmt::format("holds the balls until t = {:.6g}, too long to watch for transients; must be release by "
                               "about t = {:.3g}, or a study without [limits] and --transients",
                               release, release * (most_clamped_grid_points / points)));
}

void check_decidable(const Study& study) {
  check(study);
  check_cost(study);
  const double speed = study.speed_profile().final_speed();
  if (std::fabs(speed) > fastest_speed)
    throw InputError(
        study.name, final_speed_key(study), fmt::format("{:.6g}", speed),
        fmt::format("basin and attractors take final speeds from -{0:g} to {0:g} critical speeds", fastest_speed));
  if (!model::is_strobed(study.parameters)) return;
  if (speed == 0.0)
    throw InputError(study.name, final_speed_key(study), "0",
                     "basins and attractors need a rotor that turns in the end (other than 0) where supports are "
                     "anisotropic or gravity acts");
  if (study.numerics.decide == DecideMode::proof)
    throw InputError(study.name, "numerics.decide", "proof",
                     "with anisotropic supports or gravity there are no proofs: use \"validated\" or \"horizon\"");
}

void check_offers(const Study& study, model::Answer answer) {
  using model::Need;
  check(study);
  const model::Parameters& p = study.parameters;
  const auto lack = model::lacking(study.system(), answer);
  if (!lack) return;
  const auto reject = [&](const char* key, const std::string& value) {
    throw InputError(study.name, key, value, lack->reason);
  };
  const auto pair = [](const std::array<double, 2>& v) { return fmt::format("[{}, {}]", v[0], v[1]); };
  const bool stiffness = p.stiffness[0] != p.stiffness[1];
  switch (lack->need) {
    case Need::prescribed_speed:
      return reject("speed.profile", "torque");
    case Need::passing_balls:
      return reject("balancer.contact_angle", fmt::format("{}", p.contact_angle));
    case Need::sliding_balls:
      return reject("balancer.rolling", fmt::format("{}", p.rolling[0]));
    case Need::centred_race:
      return reject("balancer.race_offset", pair(p.race_offset));
    case Need::equal_supports:
      return reject(stiffness ? "rotor.stiffness" : "rotor.damping", pair(stiffness ? p.stiffness : p.damping));
    case Need::no_gravity:
      return reject("rotor.gravity", fmt::format("{}", p.gravity));
  }
}

StartRunner::StartRunner(const Study& study, const DiscoverySettings& settings, bool transients)
    : study_(with_horizon(study)),
      stop_(settings.stop),
      transients_(transient_settings(study)),
      source_(study, settings.stop),
      discovery_(discover(study_, settings)) {
  if (!transients) return;
  source_.watch(transients_);
  for (const Attractor& a : discovery_.catalogue.attractors()) {
    ends_.resize(std::max(ends_.size(), static_cast<std::size_t>(a.id) + 1));
    ends_[static_cast<std::size_t>(a.id)] = known_end(study_.parameters, a);
  }
}

bool StartRunner::run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
                      std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  std::vector<double> states;
  TransientTable table{transients_, {}, ends_};
  TransientTable* transients = rows ? &table : nullptr;
  if (!source_.make(study_.sampling.seed, first, count, phi, states, fates, transients)) return false;
  LaneTask task = task_from(states, count);
  task.transients = transients;
  std::vector<Fate> decided(count);
  if (!decide_lanes(task, discovery_.rule, decided, nullptr)) return false;
  const std::size_t size = model::dimension(study_.parameters.balls);
  unlisted.clear();
  if (rows) rows->assign(count, TransientRow{});
  for (std::size_t i = 0; i < count; ++i) {
    if (fates[i].outcome == Outcome::undecided)
      fates[i] = decided[i];  // else lost on an earlier branch, and stays lost
    const Fate& fate = fates[i];
    const bool attracted = fate.outcome == Outcome::attracted;
    std::optional<MotionFigures> end;
    if (attracted && fate.attractor == 0) {
      // A watched trajectory has gone on since it was decided.
      const double now = rows ? table.rows[i].end : fate.time;
      unlisted.push_back(follow(when_recognised({states.data() + i * size, states.data() + (i + 1) * size}, now)));
      unlisted.back().place = i;
      fates[i].by = DecidedBy::followed;
      if (const auto& motion = unlisted.back().motion; rows && motion && motion->stable)
        end = motion_figures(study_.parameters, *motion);
    } else if (attracted) {
      end = table.end_of(fate.attractor).figures;
    }
    if (!rows) continue;
    const bool lost = fate.outcome == Outcome::diverged || fate.outcome == Outcome::failed;
    (*rows)[i] = transient_row(transients_, table.rows[i], lost, end);
  }
  return true;
}

// States at the beginning of the final speed, followed to the horizon.
LaneTask StartRunner::task_from(std::vector<double>& states, std::size_t count) const {
  LaneTask task;
  task.parameters = &study_.parameters;
  task.segment = source_.last_segment();
  task.end = task.segment.begin + *study_.numerics.horizon;
  task.tolerance = source_.tolerance();
  task.count = count;
  task.states = states.data();
  task.stop = stop_;
  return task;
}

std::vector<UndecidedEnd> StartRunner::look_at(const std::vector<std::uint64_t>& undecided) const {
  const std::size_t size = model::dimension(study_.parameters.balls);
  std::vector<double> all, phi, states;
  std::vector<Fate> fates;
  for (const std::uint64_t number : undecided)
    if (source_.make(study_.sampling.seed, number, 1, phi, states, fates))
      all.insert(all.end(), states.begin(), states.end());
  const std::size_t count = all.size() / size;
  std::vector<Fate> decided(count);
  if (!decide_lanes(task_from(all, count), discovery_.rule, decided, nullptr)) return {};
  std::vector<UndecidedEnd> ends;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> z =
        when_recognised({all.data() + i * size, all.data() + (i + 1) * size}, decided[i].time);
    ends.push_back(look_at_undecided(study_.parameters, source_.last_segment().speed,
                                     Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(size))));
  }
  return ends;
}

// The state at time `now` as a start is followed further from it: with anisotropy or gravity one at a strobe, so that
// it needs no angle beside it.
std::vector<double> StartRunner::when_recognised(const std::vector<double>& state, double now) const {
  const model::Segment& segment = source_.last_segment();
  const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
  const auto at_strobe = at_next_strobe({study_.parameters, segment.speed}, z, segment.psi_at(now));
  return at_strobe ? std::vector<double>(at_strobe->begin(), at_strobe->end()) : state;
}

UnlistedStart StartRunner::follow(const std::vector<double>& state) const {
  const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
  return {0, state, motion_from({study_.parameters, study_.speed_profile().final_speed()}, z)};
}

int StartRunner::list(const UnlistedStart& start) {
  const bool stable = start.motion && start.motion->stable;
  return stable ? discovery_.catalogue.add(study_.parameters, *start.motion) : 0;
}

}  // namespace equipoise
