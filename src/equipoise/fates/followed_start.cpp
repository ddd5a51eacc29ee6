// From the end of a spin-up to a motion, and to the figures of the way there.
#include "equipoise/fates/followed_start.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/unbalance.hpp"
#include "equipoise/motions/motion_figures.hpp"
#include "equipoise/orbits/stroboscopic.hpp"

namespace equipoise {

namespace {

// What holds of the motion that a start came to.
void note_motion(const Study& study, const model::System& system, const Motion& motion, Fate& fate) {
  fate.outcome = Outcome::attracted;
  fate.by = DecidedBy::followed;
  if (!system.prescribed()) fate.mean_speed = static_cast<float>(motion.speed);
  if (motion.set_valued)
    fate.unbalance =
        static_cast<float>(std::abs(model::unbalance(study.parameters, motion.state.data() + model::index::phi(0))));
  if (!system.prescribed() && std::fabs(motion.speed) < study.stall_speed()) fate.outcome = Outcome::stalled;
}

// Whether a state may be one near the motion. Lanes step otherwise than what told the motion: of a start whose way is
// chaotic they go another way, and may take longer.
bool looks_like(const model::Parameters& p, const Motion& motion, const double* state) {
  if (p.gravity != 0.0) return true;  // where the rotor rests depends on its angle
  const double margin = 0.1 * p.all_unbalances(), r = std::hypot(state[0], state[1]);
  if (r < motion.r_min - margin || r > motion.r_max + margin) return false;
  return motion.r_max > 0.0 || std::abs(model::unbalance(p, state + model::index::phi(0))) < margin;
}

// Once it has taken this much longer than what told the motion, a way goes elsewhere.
constexpr double longest_detour = 4.0;

}  // namespace

FollowedStart follow_start(const Study& study, const model::System& system, const SpinUp& source, const SpunUp& start,
                           const std::vector<KnownOrbit>& known, const StopFlag* stop) {
  FollowedStart result;
  if (start.is_over(0)) {
    result.fate = start.fates.front();
    return result;
  }
  const double begin = start.begin(0, source.settled());
  Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(start.states.data(), system.dimension());
  if (system.section() == model::Section::strobe)
    state = at_next_strobe(system, state, source.last_task().segment.psi_at(begin)).value_or(state);
  result.settling = settle(system, state, *study.numerics.horizon, known, stop);
  result.fate.time = begin + result.settling.time;
  if (result.settling.status == IntegrationStatus::diverged) result.fate.outcome = Outcome::diverged;
  if (result.settling.status == IntegrationStatus::failed) result.fate.outcome = Outcome::failed;
  const std::optional<Motion>& motion = result.settling.motion;
  if (!motion && !system.prescribed()) result.fate.mean_speed = static_cast<float>(result.settling.speed);
  if (motion && motion->stable) note_motion(study, system, *motion, result.fate);
  return result;
}

TransientRow followed_transients(const Study& study, const SpinUp& source, SpunUp& start, const FollowedStart& followed,
                                 TransientTable& table, const StopFlag* stop) {
  const model::Parameters& p = study.parameters;
  const auto lost = [](const Fate& f) { return f.outcome == Outcome::diverged || f.outcome == Outcome::failed; };
  if (!start.released.empty()) table.settings.release = start.released.front();
  double begin = start.begin(0, source.settled());
  const double horizon = source.settled() + *study.numerics.horizon;
  if (lost(followed.fate) || start.is_over(0) || !(begin < horizon))
    return transient_row(table.settings, table.rows.front(), lost(followed.fate));
  const std::optional<Motion>& motion = followed.settling.motion;
  const bool known = motion && motion->stable;

  LaneTask task = source.last_task();
  task.count = 1;
  task.states = start.states.data();
  task.begins = &begin;
  task.stop = stop;
  task.transients = &table;
  task.end = known ? std::min(followed.fate.time, horizon) : horizon;
  std::vector<Fate> fates(1);
  if (begin < task.end && !advance_lanes(task, fates)) return {};
  KnownEnd end;
  if (known && !lost(fates.front()) && task.end < horizon) {
    // From here on where it goes is known: once it looks like that it is followed until its end is seen.
    const MotionName name = motion_name(p, *motion);
    end = known_end(p, {name.id, name.name, name.alias, *motion, {}});
    table.ends.assign(balanced_id + 1, end);
    DecisionRule rule;
    rule.balls = p.balls;
    rule.interchangeable = p.equal_balls();
    rule.tori = {[&](const double* state) {
      return TorusTraps::Answer{looks_like(p, *motion, state) ? balanced_id : 0, 0.0};
    }};
    const double longest = task.end + longest_detour * (task.end - start.begin(0, source.settled()));
    begin = std::exchange(task.end, std::min(longest, horizon));
    if (!decide_lanes(task, rule, fates, nullptr)) return {};
  }
  return transient_row(table.settings, table.rows.front(), lost(fates.front()), end.figures);
}

}  // namespace equipoise
