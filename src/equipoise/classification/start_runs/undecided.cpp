// Diagnoses undecided starts and words the result.
#include "equipoise/classification/start_runs/undecided.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/spin_up/run_up.hpp"

namespace equipoise {

namespace {

// In natural sizes: r and the unbalance of rotor and balls over the largest unbalance; rates over the rotor's speed.
constexpr double near = 0.2;
// Chaos may be transient, so the time is not much longer than such chaos lasts.
constexpr double exponent_time = 1500.0, longer_time = 8.0 * exponent_time;
// Deviations grow by the exponent up to a bounded factor, e^8 as in motion.cpp. Slow balls may also pass from quiet to
// a burst, in which deviations grow by e^15, and back.
constexpr double bounded_growth = 8.0 + 15.0;
// Far below what "near" allows.
constexpr double near_tolerance = 1e-6;
// In natural sizes. Nothing swings more slowly: swings have rates of the order of the speed or of the drag.
constexpr double creep = 1e-3;

double fastest_ball(const model::Parameters& p, const Eigen::VectorXd& state) {
  return state.segment(model::index::q(0, p.balls), p.balls).lpNorm<Eigen::Infinity>();
}

// A motion of large swings passes balance now and then, so the trajectory must stay there.
bool stays_near_balance(const model::System& system, double speed, const Eigen::VectorXd& state) {
  const model::Parameters& p = system.parameters();
  const double near_axis = near * p.all_unbalances(), slow = near * std::max(1.0, std::fabs(speed));
  const auto is_near = [&](const Eigen::VectorXd& z) {
    return z.head(2).norm() < near_axis && std::abs(model::unbalance(p, z.data() + model::index::phi(0))) < near_axis &&
           fastest_ball(p, z) < slow;
  };
  std::vector<Eigen::VectorXd> later;
  Eigen::VectorXd end = state;
  return is_near(state) &&
         follow(system, end, exponent_time, near_tolerance, nullptr, &later) == IntegrationStatus::done &&
         std::all_of(later.begin(), later.end(), is_near);
}

// Positive if it certainly is, otherwise 0.
double largest_exponent(const model::System& system, const Eigen::VectorXd& state) {
  for (const double time : {exponent_time, longer_time}) {
    const std::vector<double> exponents = lyapunov_exponents(system, state, time, 1);
    const double growth = exponents.empty() ? 0.0 : exponents.front() * time;
    if (growth > bounded_growth) return exponents.front();
    if (growth < 1.0) return 0.0;  // regular
  }
  return 0.0;
}

std::string speed_words(const Study& study, double speed) {
  constexpr double rpm = pi / 30.0;
  return study.scales ? plain_number(speed * study.scales->frequency / rpm, 3) + " rpm" : plain_number(speed, 3);
}

std::string horizon_text(const Study& study, const Horizon& h) {
  const std::string followed = fmt::format("they were followed for {} ({})", time_words(study, h.time, 6),
                                           h.given ? "numerics.horizon" : "chosen");
  return h.long_enough() ? followed : slowness_text(h) + "; " + followed;
}

// The run-up as `explain` has it. Empty if the motor holds no speed, or the rotor has it from the beginning.
std::string run_up_text(const Study& study, const Horizon& horizon) {
  const auto aim = model::sustained_speed(study.system());
  const auto run = aim ? run_up(study, *aim) : std::nullopt;
  if (!run || !run->alone) return "";
  if (!run->shaken)
    return fmt::format("; even without balls the rotor stalls at {}, where its own unbalance takes the motor's power",
                       speed_words(study, std::fabs(run->stalls_at)));
  return fmt::format("; a run-up to {} takes about {} with the power that the rotor's own unbalance takes{}",
                     speed_words(study, std::fabs(run->speed)), time_words(study, *run->shaken, 3),
                     *run->shaken - run->last_piece > horizon.time ? ", longer than they were followed" : "");
}

// How far the rotors that speed up have come, and how long a run-up takes.
std::string speeding_text(const Study& study, const Horizon& horizon, const std::vector<UndecidedEnd>& ends) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const UndecidedEnd& e : ends) {
    if (e.what != Restlessness::speeding_up) continue;
    least = std::min(least, e.reached);
    most = std::max(most, e.reached);
  }
  const std::string from = speed_words(study, least), to = speed_words(study, most);
  std::string text = "at " + (from == to ? to : from + " to " + to);
  if (const auto aim = study.motor().final_speed())
    text += fmt::format(" when last seen; the motor's target is {}", speed_words(study, std::fabs(*aim)));
  text += run_up_text(study, horizon);
  return text;
}

}  // namespace

std::string time_words(const Study& study, double time, int digits) {
  return study.scales ? plain_number(time * study.scales->time(), digits) + " s" : plain_number(time, digits);
}

std::string slowness_text(const Horizon& h) {
  const double slowest = h.rates.slowest();
  if (slowest == 0.0) return "balls without drag never settle";
  const char* what = slowest == h.rates.drag     ? "drag damps the balls"
                     : slowest == h.rates.growth ? "balance is left"
                                                 : "balance is approached";
  return fmt::format("{} at a rate of {:.2g}, so the horizon must be about {:.2g}", what, slowest, h.asked);
}

UndecidedEnd look_at_undecided(const model::System& system, const Eigen::VectorXd& state) {
  const model::Parameters& p = system.parameters();
  const double speed = system.speed(state);
  const double scale = std::max(1.0, std::fabs(speed));
  if (system.runs_away(speed)) return {Restlessness::running_away, 0.0};
  const Eigen::VectorXd rate = model::rate(system, state);
  const bool still =
      fastest_ball(p, state) < creep * std::fabs(speed) && fastest_ball(p, rate) < creep * std::fabs(speed) * scale;
  // Chaos may stay near balanced states that are all unstable.
  if (const double exponent = still ? 0.0 : largest_exponent(system, state); exponent > 0.0)
    return {Restlessness::chaotic, exponent};
  if (stays_near_balance(system, speed, state)) return {Restlessness::near_balance, 0.0};
  return {still ? Restlessness::creeping : Restlessness::regular, 0.0};
}

std::string clamped_text(const std::vector<UndecidedEnd>& ends) {
  const UndecidedEnd* best = nullptr;
  for (const UndecidedEnd& e : ends)
    if (e.what == Restlessness::clamped &&
        (!best || std::fabs(e.reached - e.asked) < std::fabs(best->reached - best->asked)))
      best = &e;
  if (!best) return "";
  return best->asked == 0.0
             ? fmt::format("the rotor keeps turning, at {:.2g} at least, and never comes to release.speed = 0",
                           best->reached)
             : fmt::format("the rotor comes to {:.2g} of release.speed at most", best->reached / best->asked);
}

std::string why_undecided(const Study& study, const Horizon& horizon, const std::vector<UndecidedEnd>& ends) {
  constexpr std::array<const char*, restlessness_kinds> kinds{"{} near balance",
                                                              "{} creeping, all balls nearly at rest",
                                                              "{} wandering chaotically",
                                                              "{} in motions that do not repeat yet",
                                                              "{} whose balls are never released",
                                                              "{} whose motor speeds the rotor up without end",
                                                              "{} whose rotor still speeds up",
                                                              "{} whose rotor still changes its mean speed",
                                                              "{} watched for too short a time to compare its parts",
                                                              "{} in steady motions that could not be identified"};
  std::vector<std::string> parts;
  std::size_t hopeless = 0;  // ends that more time would not change
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const auto what = static_cast<Restlessness>(k);
    const auto count = static_cast<std::size_t>(
        std::count_if(ends.begin(), ends.end(), [&](const UndecidedEnd& e) { return e.what == what; }));
    if (count == 0) continue;
    parts.push_back(fmt::format(fmt::runtime(kinds[k]), count));
    if (what == Restlessness::speeding_up) parts.back() += " (" + speeding_text(study, horizon, ends) + ")";
    if (what == Restlessness::clamped) parts.back() += " (" + clamped_text(ends) + ")";
    if (what == Restlessness::clamped || what == Restlessness::running_away || what == Restlessness::unidentified)
      hopeless += count;
    if (what != Restlessness::chaotic) continue;
    double sum = 0.0;
    for (const UndecidedEnd& e : ends) sum += e.exponent;
    parts.back() += fmt::format(" (largest Lyapunov exponent {:.2g})", sum / static_cast<double>(count));
  }
  if (parts.empty()) return horizon_text(study, horizon);
  const std::string seen = fmt::format("of {} examined: {}", ends.size(), fmt::join(parts, ", "));
  return hopeless == ends.size() ? seen : seen + "; " + horizon_text(study, horizon);
}

}  // namespace equipoise
