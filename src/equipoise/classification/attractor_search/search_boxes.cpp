// Boxes: ranges brought back to the middle's rotor; undecided starts named by their last long window.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/simulation/rule/pilot.hpp"
#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {

namespace {

// Boxes around a motion's windows, widened by these multiples of their range. A wide one is entered sooner, but its
// audit asks for more hits. The first one satisfied decides.
constexpr std::array box_widths{1.0, 2.0, 4.0};

// The range of all members, as the middle's motion would show it.
FeatureBox range_of(const Search& s, const Candidate& c) {
  if (c.members.empty() || c.trend < 0) return c.range;
  FeatureBox range;
  for (std::size_t m = 0; m < c.members.size(); ++m) {
    const FeatureBox& shown = s.pilot.records()[c.members[m]].range;
    const OwnRotor* own = s.pilot.rotor(c.members[m]);
    const Features low = of_middle(s, c, shown.low, own), high = of_middle(s, c, shown.high, own);
    for (int k = 0; k < feature_count(s.balls()); ++k) {
      range.low[k] = m ? std::min(range.low[k], low[k]) : low[k];
      range.high[k] = m ? std::max(range.high[k], high[k]) : high[k];
    }
  }
  return range;
}

// A torus or chaos may not repeat within the pilot's time, but its last long window identifies it.
void name_undecided(Search& s, const std::vector<Candidate>& found) {
  for (const Candidate& c : found)
    for (const std::size_t i : c.members)
      if (s.drawn && s.pilot.outcomes()[i].attractor == 0) s.pilot.name(i, c.attractor);
  for (std::size_t i = 0; i < s.pilot.followed(); ++i) {
    if (s.pilot.outcomes()[i].kind != OutcomeKind::undecided || !s.pilot.records()[i].finished_window) continue;
    const Features& features = s.pilot.records()[i].features;
    const OwnRotor* own = s.pilot.rotor(i);
    if (s.shows_balance(i))
      s.pilot.name(i, balanced_id);
    else if (const KnownFeatures* known = s.known_as(features, own))
      s.pilot.name(i, known->attractor);
    else if (!s.system.autonomous()) {  // modulated by the rotor, a torus has one frequency more
      const KnownFeatures* torus = s.looks_like(features, own, torus_grouping);
      s.pilot.name(i, torus ? torus->attractor : 0);
    }
  }
}

// How long balance must last: e^10 of the fastest growth anywhere on the continuum; or, if all of it attracts, e^5 of
// the slowest decay. At most a quarter of the horizon.
double lasting(const ContinuumSample& sample, double horizon) {
  constexpr double growing = 10.0, dying = 5.0, least = 200.0, long_enough = 1000.0;
  double asked = long_enough;
  if (sample.most_growth > 0.0)
    asked = std::max(growing / sample.most_growth, long_enough);
  else if (sample.drawn > 0 && sample.stable == sample.drawn)
    asked = std::clamp(-dying / sample.slowest_rate, least, long_enough);
  return std::min(asked, 0.25 * horizon);
}

}  // namespace

// For a continuum of balanced states of which nothing is at rest. Bounds follow from the rotor alone, the time from
// how fast deviations grow.
std::optional<FeatureBox> balance_box(const model::System& system, const BalancedAnalysis& balanced, double window,
                                      double horizon) {
  const auto speed = model::balanced_speed(system);
  if (system.autonomous() || system.events().stick || !speed || *speed == 0.0) return std::nullopt;
  if (balanced.states.kind != model::BalancedStates::Kind::continuum) return std::nullopt;
  constexpr double of_speed = 0.05;  // share by which the speed may waver; balls may swing as fast, beyond what their
                                     // weight does
  const model::Parameters& p = system.parameters();
  const double time = lasting(balanced.sample, horizon), turning = std::fabs(*speed);
  const double shaking = 0.5 * bare_response(p, *speed), swing = of_speed * turning + 2.0 * p.gravity / turning;
  const double drift = pi / time;  // half a turn in that time
  FeatureBox box;
  for (int k = 0; k < 3; ++k) box.high[k] = shaking;
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < 3; ++k) {
      box.high[3 + 3 * i + k] = k == 0 ? drift : swing;
      box.low[3 + 3 * i + k] = -box.high[3 + 3 * i + k];
    }
  for (int k = speed_feature(p.balls); k < feature_count(p.balls); ++k) {
    box.low[k] = system.prescribed() ? 0.0 : *speed - of_speed * turning;
    box.high[k] = system.prescribed() ? 0.0 : *speed + of_speed * turning;
  }
  box.attractor = balanced_id;
  box.hits_needed = static_cast<int>(std::ceil(2.0 * time / window));
  return box;
}

void make_boxes(Search& s, const std::vector<Candidate>& found) {
  constexpr std::size_t members_needed = 3;
  ClassificationRule& rule = s.result.rule;
  for (const double widths : box_widths)
    for (const Candidate& c : found) {
      const Attractor* a = s.result.catalogue.find(c.attractor);
      if (!a || !c.shows_motion || c.attractor == balanced_id) continue;
      // A refined orbit vouches for a single member, and a given motion for itself.
      if (!c.members.empty() && c.members.size() < (a->motion.kind == MotionKind::periodic ? 1 : members_needed))
        continue;
      FeatureBox box = box_around(range_of(s, c), rule.balls, c.attractor, widths);
      box.trend = c.trend;
      if (box.attractor && rule.boxes.size() + 1 < most_boxes) rule.boxes.push_back(box);
    }
}

void audit_boxes(Search& s, const std::vector<Candidate>& found) {
  name_undecided(s, found);
  std::vector<FeatureBox> kept;
  for (std::size_t b = 0; b < s.result.rule.boxes.size(); ++b) {
    FeatureBox box = s.result.rule.boxes[b];
    const bool restless = s.result.catalogue.find(box.attractor)->motion.kind == MotionKind::chaotic;
    box.hits_needed = hits_from_audit(s.pilot.outcomes(), s.pilot.records(), b, box.attractor, restless);
    if (box.hits_needed) kept.push_back(box);
  }
  s.result.rule.boxes = kept;
}

bool scouts_suffice(const Search& s) {
  const std::vector<Outcome>& outcomes = s.pilot.outcomes();
  return !(s.system.simple() && s.system.autonomous()) && s.result.rule.boxes.empty() &&
         std::all_of(
             outcomes.begin(), outcomes.begin() + static_cast<std::ptrdiff_t>(s.pilot.random_ones()),
             [](const Outcome& outcome) { return outcome.kind == OutcomeKind::attracted && outcome.attractor != 0; });
}

}  // namespace equipoise
