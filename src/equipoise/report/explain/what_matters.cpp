// Each quantity changed by a fifth, and the oil's temperature by 10 K: what that does to capacity, to the approach to
// balance, and to what must be overcome on the way.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/rules_of_thumb.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"

namespace equipoise {

namespace {

std::string time_of(const Study& s, double time) {
  if (!s.scales) return fmt::format("{:.3g}/omega_c", time);
  const double seconds = time * s.scales->time();
  return seconds < 1.0 ? fmt::format("{:.3g} ms", 1000.0 * seconds) : fmt::format("{:.3g} s", seconds);
}

// Quantities that are estimated rather than known, as factors on a study.
struct Estimate {
  std::string_view name;
  void (*scale)(model::Parameters&, double);
};
constexpr std::string_view drag_name = "ball drag";
constexpr std::array<Estimate, 5> estimates{{
    {"unbalance",
     [](model::Parameters& p, double f) {
       p.eccentricity *= f;
       p.tilt.misalignment *= f;
     }},
    {"support stiffness",
     [](model::Parameters& p, double f) {
       for (double& kappa : p.stiffness) kappa *= f;
       for (auto& direction : p.tilt.stiffness)
         for (double& kappa : direction) kappa *= f;
     }},
    {"support damping",
     [](model::Parameters& p, double f) {
       for (double& zeta : p.damping) zeta *= f;
       for (auto& direction : p.tilt.damping)
         for (double& zeta : direction) zeta *= f;
     }},
    {drag_name,
     [](model::Parameters& p, double f) {
       for (double& beta : p.drag) beta *= f;
     }},
    {"ball mass",  // whose drag stays
     [](model::Parameters& p, double f) {
       for (int i = 0; i < p.balls; ++i) {
         p.mass[static_cast<std::size_t>(i)] *= f;
         p.drag[static_cast<std::size_t>(i)] /= f;
       }
     }},
}};

// What a change is judged by, each a number that is better if larger.
struct Measures {
  bool can_balance = false, stable = false;
  bool unstable = false;          // known to be; for some studies neither is known
  std::optional<double> margin;   // what the balls can cancel over the unbalance; none if more of it does not help
  std::optional<double> settles;  // rate of the approach to balance
  bool hangs = false;             // drag may leave balls below the shaft
  std::optional<double> passes;   // drag over that below which balls may stay at the critical speed
};

// Of planes, that which has the least to spare.
std::optional<double> margin_of(const Explanation& e) {
  if (!e.tilt) return e.unbalance > 0.0 ? e.largest_unbalance / e.unbalance : 1.0;
  std::optional<double> least;
  for (const ExplainedPlane& plane : e.tilt->planes)
    if (plane.unbalance > 0.0)
      least = std::min(plane.most / plane.unbalance, least.value_or(plane.most / plane.unbalance));
  const bool impossible = e.balanced.kind == model::BalancedStates::Kind::none;
  if (impossible && least.value_or(1.0) >= 1.0) return std::nullopt;  // planes or angles are in the way, or one ball
  return least.value_or(1.0);
}

Measures measures_of(const Study& study, const StopFlag* stop) {
  const Explanation e = explain(study, stop);
  Measures m;
  m.can_balance = e.balanced.kind != model::BalancedStates::Kind::none;
  m.margin = margin_of(e);
  if (e.motion) {
    m.stable = e.motion->stable;
    m.unstable = m.can_balance && !m.stable;
    if (e.motion->stable) m.settles = -e.motion->slowest_rate;
  }
  m.hangs = e.carrying && e.carrying->may_hang();
  if (e.speed && !e.tilt) {
    const double needed = rules::drag_against_capture(study.parameters, std::abs(*e.speed));
    if (needed > 0.0) m.passes = rules::mean_drag(study.parameters) / needed;
  }
  return m;
}

// How much a change matters, and in words what it does.
struct Effect {
  double size = 0.0;
  std::string words;
};

constexpr double decides = 1e3, least_decision = 0.5 * decides;  // a change from yes to no outweighs any other

Effect effect_of(const Study& study, const Measures& before, const Measures& after) {
  Effect worst;
  const auto consider = [&](double size, std::string words) {
    if (size > worst.size) worst = {size, std::move(words)};
  };
  if (before.can_balance != after.can_balance)
    consider(2.0 * decides, after.can_balance ? "balance becomes possible" : "balance becomes impossible");
  if (before.hangs != after.hangs)
    consider(1.5 * decides, after.hangs ? "balls stay hanging below the shaft" : "drag carries hanging balls round");
  if ((before.stable && after.unstable) || (before.unstable && after.stable))
    consider(decides, after.stable ? "balance becomes stable" : "balance becomes unstable");
  if (before.passes && after.passes && (*before.passes < 1.0) != (*after.passes < 1.0))
    consider(least_decision, *after.passes < 1.0
                                 ? "drag becomes so low that the balls may stay at the critical speed"
                                 : "drag becomes high enough to take the balls past the critical speed");
  if (before.margin && after.margin)
    consider(std::abs(std::log(*after.margin / *before.margin)),
             fmt::format("the balls can cancel {:.3g} instead of {:.3g} times the unbalance", *after.margin,
                         *before.margin));
  if (before.settles && after.settles)
    consider(std::abs(std::log(*after.settles / *before.settles)),
             fmt::format("small disturbances decay with a time constant of {} instead of {}",
                         time_of(study, 1.0 / *after.settles), time_of(study, 1.0 / *before.settles)));
  return worst;
}

// One change of an estimate, and its words.
struct VariedStudy {
  std::string_view of;
  const char* amount;
  bool more;
  bool weighed;  // by its size; else only by what it makes possible or impossible
  Study study;
};

// What 10 K more or less make of the drag; nothing beyond the law of the oil.
std::optional<double> drag_factor(const Study& study, double kelvin) try {
  if (!study.sheet.oil_at || !study.in_si) return std::nullopt;
  Study warmer = *study.in_si;
  *warmer.sheet.oil_at += kelvin;
  const Study then = study::nondimensionalise(warmer, study::refuse_in(warmer));
  return *then.sheet.oil_viscosity / *study.sheet.oil_viscosity;
} catch (const InputError&) {
  return std::nullopt;
}

std::vector<VariedStudy> changes_of(const Study& study) {
  constexpr double part = 0.2, kelvin = 10.0;
  std::vector<VariedStudy> changes;
  const auto add = [&](const Estimate& estimate, double factor, VariedStudy change) {
    estimate.scale(change.study.parameters, factor);
    changes.push_back(std::move(change));
  };
  for (const Estimate& estimate : estimates)
    for (const double sign : {-1.0, 1.0})
      add(estimate, 1.0 + sign * part, {estimate.name, "20 %", sign > 0.0, true, study});
  for (const double sign : {-1.0, 1.0})
    if (const auto factor = drag_factor(study, sign * kelvin))
      add(*std::find_if(estimates.begin(), estimates.end(), [](const Estimate& e) { return e.name == drag_name; }),
          *factor, {"oil temperature", "10 K", sign > 0.0, false, study});
  return changes;
}

std::string how_judged(const Study& study) {
  return fmt::format(
      ". Unbalance, stiffness, damping, drag and ball mass were each varied by 20 %{}, by formulas and linear theory "
      "only",
      study.sheet.oil_at ? ", and the oil by 10 K" : "");
}

}  // namespace

std::string what_matters_most(const Study& study, const StopFlag* stop) {
  if (study.parameters.balls == 0) return "not judged: there are no balls";
  const Measures before = measures_of(study, stop);
  Effect worst;
  std::string which;
  for (const VariedStudy& change : changes_of(study)) {
    Effect effect = effect_of(study, before, measures_of(change.study, stop));
    if (effect.size <= worst.size || (!change.weighed && effect.size < least_decision)) continue;
    worst = std::move(effect);
    const bool stokes = study.sheet.oil_viscosity && change.of == drag_name;
    which = fmt::format("{}{}. With {} {}, {}", change.of, stokes ? ", here from a formula" : "", change.amount,
                        change.more ? "more" : "less", worst.words);
  }
  if (is_set(stop)) return "not known: it was stopped";
  if (before.unstable && worst.size < decides)
    return "none of these: with each of them varied by 20 %, balance stays unstable";
  if (which.empty())
    return before.can_balance || !study.parameters.tilts()
               ? "none of these, by these rules"
               : "none of these: with each of them varied by 20 %, balance stays impossible";
  return which + how_judged(study);
}

}  // namespace equipoise
