// Balanced states under anisotropy and gravity: existence by continuation, stability by Floquet multipliers.
#include "equipoise/traps/strobed_balance.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/motions/motion_description.hpp"
#include "equipoise/orbits/stroboscopic.hpp"

namespace equipoise {

StrobedBalance analyse_strobed_balance(const model::Parameters& p, double speed, const StopFlag* stop) {
  using Kind = model::BalancedStates::Kind;
  StrobedBalance result;
  BalancedAnalysis& analysis = result.analysis;
  model::Parameters horizontal = p;
  horizontal.gravity = 0.0;
  analysis.states = model::balanced_states(horizontal);
  if (analysis.states.kind == Kind::none) {
    analysis.note = "no balanced state exists: " + analysis.states.reason;
    return result;
  }
  std::vector<std::array<double, model::max_balls>> angles = analysis.states.angles;
  if (analysis.states.kind == Kind::family) {
    analysis.continuum = std::make_shared<BalancedContinuum>(p, speed);
    analysis.survey = analysis.continuum->survey(stop);
    judge_continuum(speed, analysis);
    if (p.gravity != 0.0) {  // whatever is balanced then, starts have to find
      analysis.stable = true;
      analysis.note.clear();
      return result;
    }
    angles = {analysis.survey.typical};
  } else if (p.balls == 2 && p.equal_balls() && angles.size() == 2) {
    angles.pop_back();  // mirror images are one motion
  }
  double slowest = -std::numeric_limits<double>::infinity(), fastest_growth = 0.0;
  bool lost = false;
  for (const auto& phi : angles) {
    if (is_set(stop)) return result;
    const auto orbit = balanced_orbit({p, speed}, phi.data());
    if (!orbit) {
      lost = true;
      continue;
    }
    result.motions.push_back(describe_orbit({p, speed}, *orbit));
    Motion& motion = result.motions.back();
    motion.balanced = true;  // it was followed from there
    if (analysis.states.kind == Kind::family) continue;
    const double rate = slowest_strobed_rate(motion);
    if (motion.stable)
      slowest = std::max(slowest, rate);
    else
      fastest_growth = std::max(fastest_growth, rate);
  }
  if (analysis.states.kind == Kind::family) return result;
  std::stable_partition(result.motions.begin(), result.motions.end(), [](const Motion& m) { return m.stable; });
  analysis.stable = std::isfinite(slowest);
  if (analysis.stable)
    analysis.slowest_rate = slowest;
  else if (lost && result.motions.empty())
    analysis.note = "no balanced motion exists: it vanishes as gravity and anisotropy are switched on";
  else
    analysis.note = fmt::format("the balanced state exists but is unstable at speed {} (growth rate {:.3g})", speed,
                                fastest_growth);
  analysis.growth_rate = fastest_growth;
  return result;
}

}  // namespace equipoise
