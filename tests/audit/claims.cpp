// Compares names and listed figures with figures measured late.
#include "claims.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/core/base/angles.hpp"

namespace equipoise::audit {

namespace {

// Size of what balls and unbalance together can do to the rotor: the unit for displacements.
double natural_size(const model::Parameters& p) { return p.eccentricity + p.total_mass(); }

// At the ensemble's tolerance of 1e-6 per step, errors of trajectories add up to some ten times that.
constexpr double noise = 1e-4;

// A captured ball stays within a turn of where it was.
bool winds(const LateMotion& late, int ball) { return std::fabs(late.turned[ball]) > 1.25 * two_pi; }

// Drift rates over a span are uncertain by the ball's swing about them: at most a turn.
double rate_error(const LookTimes& times) { return two_pi / times.span(); }

std::string not_balanced(const Study& study, const LateMotion& late, const LookTimes& times) {
  const model::Parameters& p = study.parameters;
  const double size = natural_size(p);
  for (int i = 0; i < p.balls; ++i) {
    // Balls at rest swing at most about their place, under gravity. On the slow approach to balance they turn less and
    // less.
    const bool slower = std::fabs(late.rate_late[i]) < 0.5 * std::fabs(late.rate_early[i]);
    if (std::fabs(late.turned[i]) > 1.0 && !slower)
      return fmt::format("ball {} turned by {:.3g} within {:.0f}", i + 1, late.turned[i], times.span());
    if (late.swing[i] > 1.5 && !slower) return fmt::format("ball {} swings by {:.3g}", i + 1, late.swing[i]);
  }
  const bool exact = p.gravity == 0.0 && p.race_is_centred() && !p.balls_stick() && !p.balls_collide();
  const bool shrinks = late.after.high < 0.8 * late.before.high;
  if (exact && late.after.high > noise * size && !shrinks)
    return fmt::format("r reaches {:.3g}, {:.3g} before, where exact balance exists", late.after.high,
                       late.before.high);
  // Less than half of what the rotor does without balls: the meaning of "balanced" where nothing is exact.
  if (late.after.high > 0.5 * bare_response(p, late.speed) + noise * size && !shrinks)
    return fmt::format("r reaches {:.3g}; without balls it is {:.3g}", late.after.high, bare_response(p, late.speed));
  if (late.after.high > 1.5 * late.before.high && late.after.high > noise * size)
    return fmt::format("r grows from {:.3g} to {:.3g}", late.before.high, late.after.high);
  return {};
}

// Number of captured balls by name; -1 if the name does not say.
int captured_in(const std::string& kind, int balls) {
  if (kind == "one captured" || (kind == "captured" && balls == 1)) return 1;
  if (kind == "both captured") return 2;
  if (kind == "all captured") return balls;
  if (kind == "locked") return balls;
  if (kind == "co-drifting" || kind == "drifting apart" || kind == "drifting" || kind == "pair drift" ||
      kind == "drifting at different rates" || kind == "hanging")
    return 0;
  const auto at = kind.find(" captured");
  return at != std::string::npos && at < 3 ? std::atoi(kind.c_str()) : -1;
}

// What the name alone says of the balls.
std::string not_as_named(const Study& study, const std::string& kind, const LateMotion& late, const LookTimes& times) {
  const int balls = study.parameters.balls, said = captured_in(kind, balls);
  int winding = 0;
  double slowest = 1e300, fastest = -1e300;
  for (int i = 0; i < balls; ++i) {
    winding += winds(late, i);
    slowest = std::min(slowest, late.rate[i]);
    fastest = std::max(fastest, late.rate[i]);
  }
  if (said >= 0 && balls - winding != said)
    return fmt::format("{} of {} balls wind within {:.0f}", winding, balls, times.span());
  const bool one_rate = kind == "co-drifting" || kind == "drifting apart" || kind == "pair drift";
  if (one_rate && fastest - slowest > 0.05 * std::max(std::fabs(slowest), std::fabs(fastest)) + rate_error(times))
    return fmt::format("balls drift at {:.4g} to {:.4g}", slowest, fastest);
  if (kind == "drifting at different rates" && fastest - slowest < 0.5 * rate_error(times))
    return fmt::format("all balls drift at {:.4g}", slowest);
  return {};
}

std::string range_differs(const RadiusRange& seen, const Motion& said, double size) {
  // A periodic orbit is listed to rounding and sampled at 500 points; a torus or chaos fills its extremes slowly.
  const double part = said.kind == MotionKind::chaotic ? 0.4 : said.kind == MotionKind::quasi_periodic ? 0.15 : 0.03;
  const double room = part * said.r_max + noise * size;
  if (std::fabs(seen.high - said.r_max) <= room && seen.low >= said.r_min - room) return {};
  return fmt::format("r from {:.4g} to {:.4g}, listed {:.4g} to {:.4g}", seen.low, seen.high, said.r_min, said.r_max);
}

// A motion listed with its figures.
std::string not_as_listed(const Study& study, const Motion& said, const LateMotion& late, const LookTimes& times) {
  const model::Parameters& p = study.parameters;
  std::vector<double> seen(late.rate.begin(), late.rate.begin() + p.balls);
  std::vector<double> listed(said.drift.begin(), said.drift.begin() + p.balls);
  if (p.equal_balls()) {
    std::sort(seen.begin(), seen.end());
    std::sort(listed.begin(), listed.end());
  }
  const double part = said.kind == MotionKind::chaotic ? 0.1 : 0.02;
  for (int i = 0; i < p.balls; ++i)
    if (std::fabs(seen[i] - listed[i]) > part * std::fabs(listed[i]) + 2.0 * rate_error(times))
      return fmt::format("a ball drifts at {:.4g}, listed {:.4g}", seen[i], listed[i]);
  return range_differs(late.after, said, natural_size(p));
}

}  // namespace

std::string contradiction(const Study& study, const Ensemble& ensemble, std::size_t i, const LateMotion& late,
                          const LookTimes& times) {
  const Outcome& outcome = ensemble.outcomes[i];
  if (!late.followed) return {};
  if (late.lost) return "it diverged or failed later";
  const bool driven = study.speed.driven();
  const double stall = driven ? std::fabs(study.stall_speed()) : 0.0;
  // Mean speeds of a steady rotor vary by less than half a per cent.
  if (outcome.kind == OutcomeKind::stalled)
    return std::fabs(late.speed) < 1.01 * stall
               ? std::string()
               : fmt::format("it turns at {:.4g}, not below {:.4g}", late.speed, stall);
  if (driven && std::fabs(late.speed) < 0.99 * stall)
    return fmt::format("it turns at {:.4g}, below {:.4g}: stalled", late.speed, stall);
  const Attractor* a = ensemble.catalogue.find(outcome.attractor);
  if (!a) return "its attractor is not in the list";
  const std::string kind = kind_of_name(a->name);
  if (a->motion.set_valued) {  // held for good, each start's balls where they stopped
    for (int ball = 0; ball < study.parameters.balls; ++ball)
      if (late.turned[ball] != 0.0)
        return fmt::format("ball {} turned by {:.3g}, though stuck", ball + 1, late.turned[ball]);
    return kind.starts_with("balanced") ? not_balanced(study, late, times) : std::string();
  }
  if (kind == "balanced") return not_balanced(study, late, times);
  if (std::string named = not_as_named(study, kind, late, times); !named.empty()) return named;
  // For rotors that differ, the listed figures belong to another rotor.
  if (a->motion.kind == MotionKind::measured || ensemble.own_rotors) return {};
  return not_as_listed(study, a->motion, late, times);
}

}  // namespace equipoise::audit
