// Names motions from topology alone: which balls drift, which move as one, and when the motion comes back. The table is
// in docs/explanation/motions.md ("Names").
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"

namespace equipoise {

namespace {

constexpr char one_captured_text[] = "one captured";
constexpr char different_rates[] = "drifting at different rates";
constexpr char co_drifting_text[] = "co-drifting";
constexpr char pair_drift_text[] = "pair drift";
constexpr char drifting_apart_text[] = "drifting apart";

// For off_balance() of a refined equilibrium: where balls cancel exactly, only rounding is left.
constexpr double centred = 1e-9;

// Two, less what counting may miss over the hundred turns or more of a measured motion. Exact values are rational.
constexpr double twice_a_turn = 1.95;

enum Identifier { other = 0, balanced, co_drifting, drifting_apart, one_captured, period_four, pair_drift, locked };

// What the name is made of.
struct Topology {
  int balls = 0, captured = 0, drifting = 0;
  int rates = 0;     // different mean rates of drifting balls
  int clusters = 0;  // groups that move as one, of all balls
  int turns = 0;     // of the fastest ball before the motion comes back; 0 if it does not, or no ball drifts
  std::vector<int> captured_groups, drifting_groups;  // sizes of groups of two or more that move as one, falling

  Topology(const model::Parameters& p, const Motion& motion) : balls(p.balls) {
    std::array<int, model::max_balls> size{};
    std::array<bool, model::max_balls> winds{};
    for (int i = 0; i < balls; ++i) {
      const int group = motion.drift_group[i];
      ++(group == 0 ? captured : drifting);
      rates = std::max(rates, group);
      clusters = std::max(clusters, motion.cluster[i] + 1);
      ++size[motion.cluster[i]];
      winds[motion.cluster[i]] = group != 0;
      turns = std::max(turns, std::abs(motion.winding[i]));
    }
    for (int c = 0; c < clusters; ++c)
      if (size[c] > 1) (winds[c] ? drifting_groups : captured_groups).push_back(size[c]);
    for (auto* groups : {&captured_groups, &drifting_groups}) std::sort(groups->rbegin(), groups->rend());
  }
};

// "", ", period m", ", quasi-periodic" or ", chaotic": the difference from the plain motion that closes after one turn.
// On a stroboscopic section, the number of sections until the motion comes back.
std::string suffix(const Motion& motion, int turns) {
  if (never_repeats(motion.kind)) return fmt::format(", {}", name_of(motion.kind));
  if (motion.depends_on_angle)
    return fmt::format(", back after {} strobe{}", motion.sections, motion.sections > 1 ? "s" : "");
  return turns > 1 ? fmt::format(", period {}", turns) : "";
}

// "", " together" (all `count` of them), " (2 together)", " (3 and 2 together)".
std::string grouping(const std::vector<int>& groups, int count) {
  if (groups.empty()) return "";
  if (groups.front() == count) return " together";
  std::string text;
  for (const int size : groups) text += fmt::format("{}{}", text.empty() ? "" : " and ", size);
  return fmt::format(" ({} together)", text);
}

// Of a tilting rotor, three balls or more may rest together in one race, and apart in another, which is centred.
MotionName name_of_locked(const model::Parameters& p, const Motion& motion) {
  MotionName name{"locked", "", locked};
  if (p.tilts() && p.balls > 2) name.name += grouping(Topology(p, motion).captured_groups, p.balls);
  return name;
}

MotionName name_at_rest(const model::Parameters& p, const Motion& motion) {
  return model::off_balance(p, motion.state) < centred ? MotionName{"balanced", "", balanced}
                                                       : name_of_locked(p, motion);
}

// Motions in step with the rotor: all balls captured; or all left behind by a turn every turn, at rest in space except
// for vibration.
bool keeps_step(const model::Parameters& p, const Motion& motion) {
  if (!motion.depends_on_angle || motion.kind != MotionKind::periodic || motion.sections != 1) return false;
  return std::all_of(motion.winding.begin(), motion.winding.begin() + p.balls, [](int turns) { return turns == 0; });
}

bool hangs(const model::Parameters& p, const Motion& motion) {
  if (!motion.depends_on_angle || motion.kind != MotionKind::periodic) return false;
  const double turns = -motion.speed * motion.period / two_pi;
  return std::all_of(motion.winding.begin(), motion.winding.begin() + p.balls,
                     [turns](int winding) { return std::fabs(winding - turns) < 0.5; });
}

MotionName name_of_one(const Motion& motion, const Topology& topology) {
  return {(topology.captured ? "captured" : "drifting") + suffix(motion, topology.turns), "", other};
}

MotionName name_of_two(const Motion& motion, const Topology& topology) {
  const std::string ending = suffix(motion, topology.turns);
  if (topology.captured == 2) return {"both captured" + ending, "", other};
  if (topology.captured == 1) {
    if (motion.depends_on_angle)
      return {one_captured_text + ending, "", other};  // V3 and V4 are motions of isotropic rotors
    if (motion.kind == MotionKind::periodic && topology.turns == 1) return {one_captured_text, "V3", one_captured};
    if (motion.kind == MotionKind::periodic && topology.turns == 4)
      return {one_captured_text + ending, "V4", period_four};
    return {one_captured_text + ending, "", other};
  }
  if (topology.rates > 1) return {different_rates, "", other};
  if (topology.clusters == 1 || motion.together)
    return ending.empty() ? MotionName{co_drifting_text, "V1", co_drifting}
                          : MotionName{co_drifting_text + ending, "", other};
  // A pair that swings once a turn or more often follows the unbalance.
  if (motion.oppositions_per_turn > twice_a_turn)
    return motion.kind == MotionKind::chaotic ? MotionName{pair_drift_text + ending, "", other}
                                              : MotionName{pair_drift_text, "", pair_drift};
  return motion.depends_on_angle ? MotionName{drifting_apart_text + ending, "", other}
                                 : MotionName{drifting_apart_text, "V2", drifting_apart};
}

MotionName name_of_many(const Motion& motion, const Topology& topology) {
  const std::string ending = suffix(motion, topology.turns);
  const std::string together = grouping(topology.drifting_groups, topology.drifting);
  if (topology.drifting == 0) return {"all captured" + ending, "", other};
  if (topology.captured > 0) {
    return {fmt::format("{} captured{}, {} drifting{}{}", topology.captured,
                        grouping(topology.captured_groups, topology.captured), topology.drifting, together, ending),
            "", other};
  }
  if (topology.rates > 1) return {different_rates + together + ending, "", other};
  if (topology.clusters == 1 || motion.together) return {co_drifting_text + ending, "", other};
  return {drifting_apart_text + together + ending, "", other};
}

}  // namespace

namespace {

// The rotor does not turn, or only to and fro.
bool stalls(const Motion& motion) {
  constexpr double standing = 1e-6;  // means of refined and of regular motions are more accurate
  return motion.motor && std::fabs(motion.speed) < standing;
}

// Sommerfeld effect: the rotor hangs at the resonance of its supports, closer to it (in ratio) than to the motor's
// no-load speed. Most of the motor's power goes into vibration of the supports.
bool captured_at_resonance(const model::System& system, const Motion& motion) {
  const model::Parameters& p = system.parameters();
  const double meant = std::fabs(system.pace()), speed = std::fabs(motion.speed);
  double resonance = std::sqrt(0.5 * (p.stiffness[0] + p.stiffness[1]) / (1.0 + p.total_mass()));
  if (p.tilts()) {
    const model::WhirlSpeeds whirl = model::whirl_speeds(p, true);
    for (const double critical : whirl.excited())  // the highest that it was meant to leave behind
      if (critical < meant) resonance = critical;
  }
  return meant > resonance && speed * speed < resonance * meant &&
         motion.motor->support_power > 0.5 * motion.motor->power;
}

// How a driven rotor turns, if not as its motor is meant to turn it.
std::string of_the_rotor(const model::Parameters& p, const Motion& motion) {
  if (!motion.motor) return "";
  const model::System system = system_of(p, motion);
  std::string text = captured_at_resonance(system, motion) ? ", captured at resonance" : "";
  if (system.pace() * motion.speed < 0.0) text += ", backwards";
  return text;
}

MotionName name_by_balls(const model::Parameters& p, const Motion& motion) {
  if (motion.stuck)
    return motion.balanced ? MotionName{"balanced, stuck", "", balanced} : MotionName{"locked, stuck", "", locked};
  if (motion.depends_on_angle && motion.balanced) return {"balanced", "", balanced};
  if (motion.kind == MotionKind::equilibrium) return name_at_rest(p, motion);
  if (keeps_step(p, motion)) return name_of_locked(p, motion);
  if (hangs(p, motion)) return {"hanging" + (motion.sections > 1 ? suffix(motion, 0) : ""), "", other};
  const Topology topology(p, motion);
  return p.balls == 1   ? name_of_one(motion, topology)
         : p.balls == 2 ? name_of_two(motion, topology)
                        : name_of_many(motion, topology);
}

}  // namespace

MotionName motion_name(const model::Parameters& p, const Motion& motion) {
  if (stalls(motion)) return {"stalled" + (motion.kind == MotionKind::periodic ? "" : suffix(motion, 0)), "", other};
  MotionName name = name_by_balls(p, motion);
  if (p.balls != 2 && name.id != balanced) name.id = other;
  if (const std::string rotor = of_the_rotor(p, motion); name.id != balanced && !rotor.empty())
    name = {name.name + rotor, "", other};
  return name;
}

}  // namespace equipoise
