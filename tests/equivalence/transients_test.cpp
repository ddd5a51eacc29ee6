// Transients gathered in the time loop: against single trajectories sampled densely, with and without lanes, whatever
// the threads, interrupted or not.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../base_study.hpp"
#include "equipoise/ensemble/starts.hpp"
#include "equipoise/ensemble/transient_watch.hpp"
#include "equipoise/run/basin.hpp"
#include "equipoise/run/lane_kernels.hpp"
#include "equipoise/run/simulate.hpp"
#include "equipoise/run/start_source.hpp"
#include "equipoise/run/transient_tally.hpp"

namespace equipoise {
namespace {

constexpr double no_window_ends = 1e6;  // longer than any trajectory here: the window is all that is at the final speed

TransientSample sample_at(const Study& study, const Trajectory& one, std::size_t k) {
  const double x = one.x[k], y = one.y[k], w = one.psi_dot[k];
  const double u = one.x_dot[k] - w * y, v = one.y_dot[k] + w * x;
  double ux = study.parameters.eccentricity, uy = 0.0;
  for (std::size_t i = 0; i < one.phi.size(); ++i) {
    ux += study.parameters.mass[i] * std::cos(one.phi[i][k]);
    uy += study.parameters.mass[i] * std::sin(one.phi[i][k]);
  }
  const double fx = one.bearing_x[k], fy = one.bearing_y[k];
  return {one.t[k], x * x + y * y, 2.0 * (x * u + y * v), fx * fx + fy * fy, u * u + v * v, std::hypot(ux, uy)};
}

// The figures from samples so dense (200 a unit of time) that what lies between them is below 1e-4 of a peak.
TransientRow sampled(const Study& study, const TransientSettings& asked, double window_begin, double until) {
  std::vector<double> times;
  const int count = static_cast<int>(std::ceil(until * 200.0));
  for (int k = 0; k <= count; ++k) times.push_back(until * k / count);
  const Trajectory one = simulate(study, times);
  TransientSums sums;
  sums.end = until;
  TransientSample before = sample_at(study, one, 0);
  for (std::size_t k = 0; k < one.t.size(); ++k) {
    const TransientSample s = sample_at(study, one, k);
    const double h = s.t - before.t;
    double& peak = s.t < asked.release ? sums.clamped_peak : sums.free_peak;
    peak = std::max(peak, s.r2);
    sums.force_peak = std::max(sums.force_peak, s.force2);
    sums.force_integral += 0.5 * h * (before.force2 + s.force2);
    if (s.r2 > asked.displacement * asked.displacement) sums.time_above += h;
    if (s.t >= asked.release && s.r2 > asked.settled * asked.settled) sums.last_above = s.t;
    if (s.t >= window_begin) {
      sums.window_peak = std::max(sums.window_peak, s.r2);
      if (before.t >= window_begin) {
        sums.window_length += h;
        sums.window_velocity += 0.5 * h * (before.velocity2 + s.velocity2);
        sums.window_unbalance += 0.5 * h * (before.unbalance + s.unbalance);
      }
    }
    before = s;
  }
  return transient_row(asked, sums, false);
}

// What the lanes gather of starts 0 to count - 1, followed for `horizon` after the last branch begins.
std::vector<TransientRow> gathered(const Study& study, const TransientSettings& asked, std::size_t count,
                                   double horizon) {
  StartSource source(study, nullptr);
  source.watch(asked);
  TransientTable table{asked, {}};
  std::vector<double> phi, states;
  std::vector<Fate> fates;
  EXPECT_TRUE(source.make(study.sampling.seed, 0, count, phi, states, fates, &table));
  LaneTask task = source.task(source.segments().size() - 1, states);
  task.end = task.segment.begin + horizon;
  task.transients = &table;
  DecisionRule rule;
  rule.balls = study.parameters.balls;
  rule.at_horizon = true;
  EXPECT_TRUE(decide_lanes(task, rule, fates, nullptr));
  std::vector<TransientRow> rows;
  for (const TransientSums& sums : table.rows) rows.push_back(transient_row(asked, sums, false));
  return rows;
}

// Peaks: a cubic between four places of a step misses a peak by less than 1 % (docs/numerics.md). Means: integrals of
// such cubics are ten times better. Times: a crossing is known to a tenth of a time unit at a slope of usual size.
void expect_same_figures(const TransientRow& seen, const TransientRow& expected, const std::string& what) {
  for (const auto peak : {&TransientRow::peak_radial, &TransientRow::peak_radial_after_release,
                          &TransientRow::peak_radial_at_end, &TransientRow::peak_force})
    EXPECT_NEAR(seen.*peak, expected.*peak, 0.01f * expected.*peak) << what;
  for (const auto mean : {&TransientRow::rms_force, &TransientRow::rms_velocity, &TransientRow::residual_unbalance})
    EXPECT_NEAR(seen.*mean, expected.*mean, 0.002f * expected.*mean) << what;
  EXPECT_NEAR(seen.time_above, expected.time_above, 0.5f) << what;
  if (std::isinf(expected.settling_time))
    EXPECT_EQ(seen.settling_time, expected.settling_time) << what;
  else
    EXPECT_NEAR(seen.settling_time, expected.settling_time, 0.3f) << what;
  EXPECT_FLOAT_EQ(seen.followed_until, expected.followed_until) << what;
}

struct Case {
  const char* name;
  std::string rest;  // of the study
  double displacement, settled;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Transients : public testing::TestWithParam<Case> {};

TEST_P(Transients, AgreeWithSingleTrajectories) {
  const Case& c = GetParam();
  Study study = parse_study(c.rest, c.name);
  study.limits.displacement = c.displacement;
  study.limits.settled = c.settled;
  TransientSettings asked = transient_settings(study);
  asked.window = no_window_ends;
  const double horizon = 60.0, settled = study.speed_profile().settled_time();
  const double last_begin = std::max(settled, study.release_time());
  const std::vector<TransientRow> rows = gathered(study, asked, 6, horizon);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    start_angles(study.sampling.seed, i, study.parameters.balls, study.initial.phi.data());
    expect_same_figures(rows[i], sampled(study, asked, last_begin, last_begin + horizon),
                        std::string(c.name) + ", start " + std::to_string(i));
  }
}

const std::string skew = R"([rotor]
eccentricity = 0.01
damping = [0.4, 0.6]
stiffness = [1.0, 1.3]
gravity = 0.02
[balancer]
balls = 3
mass = 0.04
drag = 0.05
)";
const std::string early_ramp = R"([speed]
profile = "ramp"
final = 2.4
duration = 60.0
[release]
speed = 2.0
)";

INSTANTIATE_TEST_SUITE_P(
    All, Transients,
    testing::Values(Case{"constant speed", constant_speed, 0.08, 0.03},
                    Case{"early release", rotor_and_balancer + early_ramp, 0.05, 0.03},
                    Case{"published law", rotor_and_balancer + early_ramp + "[initial]\nx = 0.02\n", 0.05, 0.03},
                    Case{"gravity and anisotropy, early release", skew + early_ramp, 0.06, 0.05}),
    [](const auto& param) { return std::to_string(param.index); });

// The watch without lanes sees what the lanes see, though it takes other steps.
TEST(TransientWatch, GathersWhatDenseSamplesShow) {
  Study study = parse_study(constant_speed, "constant speed");
  start_angles(1, 3, 2, study.initial.phi.data());
  TransientSettings asked;
  asked.displacement = 0.08;
  asked.settled = 0.03;
  asked.window = no_window_ends;
  const double h = 0.5, until = 50.0;
  std::vector<double> times{0.0};
  for (double t = 0.0; t < until; t += h)
    for (const double node : TransientWatch::nodes) times.push_back(t + node * h);
  const Trajectory one = simulate(study, times);
  TransientWatch watch(asked);
  watch.begin(sample_at(study, one, 0));
  for (std::size_t k = 1; k + 2 < one.t.size(); k += 3)
    watch.step({sample_at(study, one, k), sample_at(study, one, k + 1), sample_at(study, one, k + 2)});
  watch.finish();
  expect_same_figures(transient_row(asked, watch.sums(), false), sampled(study, asked, 0.0, until), "watch");
}

// r = exp(-t/20): the rules of leaving, with times known in closed form.
TEST(TransientWatch, FollowsADecidedTrajectoryUntilItHasSettled) {
  TransientSettings asked;
  asked.settled = 0.1;  // from 20 ln 10 = 46.05 on
  const auto at = [](double t) {
    const double r2 = std::exp(-t / 10.0);
    return TransientSample{t, r2, -0.1 * r2, r2, r2, 0.0};
  };
  const auto left_at = [&](bool until_settled) {
    TransientWatch watch(asked);
    watch.begin(at(0.0));
    for (double t = 0.0; !watch.may_leave() && t < 1000.0; t += 0.5) {
      watch.step({at(t + 0.5 / 3), at(t + 0.3), at(t + 0.5)});
      if (t == 9.5) watch.decided(until_settled);
    }
    watch.finish();
    return transient_row(asked, watch.sums(), false);
  };
  const TransientRow soon = left_at(false), late = left_at(true);
  EXPECT_EQ(soon.followed_until, 26.0f);  // one window after the decision at 10
  EXPECT_TRUE(std::isinf(soon.settling_time));
  EXPECT_EQ(late.followed_until, 74.0f);  // windows 10 to 26, 42, 58; the next is the first that lies below throughout
  EXPECT_NEAR(late.settling_time, 46.05, 0.01);
  EXPECT_NEAR(late.peak_radial_at_end, std::exp(-58.0 / 20), 1e-4);
  // Mean of exp(-t/10) over 58 to 74.
  EXPECT_NEAR(late.rms_velocity, std::sqrt(10.0 / 16.0 * (std::exp(-5.8) - std::exp(-7.4))), 1e-5);
}

Study ensemble(std::uint64_t starts) {
  Study study = parse_study(rotor_and_balancer + early_ramp, "ensemble");
  study.sampling.starts = starts;
  study.limits.displacement = 0.05;
  study.limits.force = 0.1;
  study.limits.velocity = 0.01;
  study.limits.settled = 0.002;
  return study;
}

BasinOptions options(int threads, const std::string& output = {}) {
  BasinOptions o;
  o.threads = threads;
  o.transients = true;
  o.output = output;
  return o;
}

void expect_same_result(const TransientResult& a, const TransientResult& b) {
  ASSERT_EQ(a.groups.size(), b.groups.size());
  for (std::size_t g = 0; g < a.groups.size(); ++g) {
    EXPECT_EQ(a.groups[g].name, b.groups[g].name);
    EXPECT_EQ(a.groups[g].starts, b.groups[g].starts);
    for (std::size_t k = 0; k < a.groups[g].figures.size(); ++k) {
      const SampleSummary &one = a.groups[g].figures[k], &two = b.groups[g].figures[k];
      EXPECT_EQ(one.open, two.open);
      EXPECT_EQ(one.mean, two.mean);
      EXPECT_EQ(one.largest, two.largest);
      for (std::size_t q = 0; q < one.quantiles.size(); ++q) {
        EXPECT_EQ(one.quantiles[q].value, two.quantiles[q].value);
        EXPECT_EQ(one.quantiles[q].low, two.quantiles[q].low);
        EXPECT_EQ(one.quantiles[q].high, two.quantiles[q].high);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(a.groups[g].exceeded[k]->count, b.groups[g].exceeded[k]->count);
  }
}

TEST(BasinTransients, DoNotDependOnThreadsOrInterruption) {
  const BasinResult one = basin(ensemble(900), options(1)), two = basin(ensemble(900), options(2));
  ASSERT_TRUE(one.transients && two.transients);
  expect_same_result(*one.transients, *two.transients);
  EXPECT_EQ(one.transients->groups.front().starts, 900u);

  const std::string path = testing::TempDir() + "transients_test.nc";
  std::filesystem::remove(path);
  basin(ensemble(300), options(2, path));
  const BasinResult resumed = basin(ensemble(900), options(2, path));
  EXPECT_EQ(resumed.resumed_from, 300u);
  expect_same_result(*one.transients, *resumed.transients);
  BasinOptions without = options(2, path);
  without.transients = false;
  EXPECT_THROW(basin(ensemble(900), without), InputError);  // a file with transients and a run without
  std::filesystem::remove(path);
}

TEST(BasinTransients, TellAttractorsApart) {
  const BasinResult result = basin(ensemble(600), options(2));
  const TransientGroup* balanced = nullptr;
  const TransientGroup* other = nullptr;
  for (const TransientGroup& g : result.transients->groups) {
    if (g.id == balanced_id) balanced = &g;
    if (g.id > balanced_id && (!other || g.starts > other->starts)) other = &g;
  }
  ASSERT_TRUE(balanced && other);
  const auto figure = [](const TransientGroup& g, const char* name) {
    for (std::size_t k = 0; k < transient_columns.size(); ++k)
      if (std::string(transient_columns[k].name) == name) return g.figures[k];
    return SampleSummary{};
  };
  // Balanced starts are followed until they have settled, so that none vibrates more than settled ones may: velocity at
  // most Omega' r with the fastest turn around, psi' + |phi'| < 2.4 + 1.
  EXPECT_EQ(figure(*balanced, "settling_time").open, 0u);
  EXPECT_LE(figure(*balanced, "peak_radial_at_end").largest, 0.002);
  EXPECT_LT(figure(*balanced, "rms_velocity").largest, 3.4 * 0.002);
  EXPECT_EQ(balanced->exceeded[2]->count, 0u);
  // The others never settle and shake for good.
  EXPECT_EQ(figure(*other, "settling_time").open, other->starts);
  EXPECT_EQ(other->exceeded[2]->count, other->starts);
  // One start replayed alone is the same start.
  const StartReplay alone = replay_start(ensemble(600), 5, options(1));
  ASSERT_TRUE(alone.transients);
  EXPECT_GT(alone.transients->followed_until, alone.fate.time);
}

}  // namespace
}  // namespace equipoise
