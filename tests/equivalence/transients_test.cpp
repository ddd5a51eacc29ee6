// Transients gathered in the time loop: against densely sampled single trajectories, with and without lanes, for any
// threads, interrupted or not.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/decided_watch.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/simulation/transients/transient_watch.hpp"
#include "equipoise/study/sampling/starts.hpp"
#include "transient_lanes.hpp"

namespace equipoise {
namespace transients_test {

constexpr double no_window_ends = 1e6;  // longer than any trajectory here: the final speed has only this window

TransientSample sample_at(const Study& study, const Trajectory& one, std::size_t k) {
  const double x = one.x[k], y = one.y[k], w = one.psi_dot[k];
  const double u = one.x_dot[k] - w * y, v = one.y_dot[k] + w * x;
  double ux = study.parameters.eccentricity, uy = 0.0;
  for (std::size_t i = 0; i < one.phi.size(); ++i) {
    ux += study.parameters.mass[i] * std::cos(one.phi[i][k]);
    uy += study.parameters.mass[i] * std::sin(one.phi[i][k]);
  }
  const double fx = one.bearing_x[k], fy = one.bearing_y[k];
  // From the rotor's rest position: a point in fixed axes, so that u, v are the rates of both.
  const double sag = -(1.0 + study.parameters.total_mass()) * study.parameters.gravity / study.parameters.stiffness[1];
  const double rx = x - sag * std::sin(one.psi[k]), ry = y - sag * std::cos(one.psi[k]);
  TransientSample s{one.t[k], {ux, uy}, {}};
  const double dynamic = fy + (1.0 + study.parameters.total_mass()) * study.parameters.gravity;
  const double upright = u * std::sin(one.psi[k]) + v * std::cos(one.psi[k]);
  s.places[0] = {rx * rx + ry * ry,
                 2.0 * (rx * u + ry * v),
                 fx * fx + fy * fy,
                 u * u + v * v,
                 fx * fx + dynamic * dynamic,
                 upright * upright,
                 0.0,
                 0.0,
                 one.psi_dot[k]};
  return s;
}

// Figures from dense samples (200 per unit of time): what lies between them is below 1e-4 of a peak.
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
    const auto &now = s.places[0], &last = before.places[0];
    const double h = s.t - before.t;
    RadialPeak& peak = s.t < asked.release ? sums.clamped_peak : sums.free_peak;
    peak = larger(peak, {now.r2, s.t, now.speed});
    sums.force_peak = std::max(sums.force_peak, now.force2);
    sums.dynamic_peak = std::max(sums.dynamic_peak, now.dynamic2);
    if (now.r2 > asked.displacement * asked.displacement) sums.time_above += h;
    if (s.t >= asked.release && now.r2 > asked.settled * asked.settled) sums.last_above = s.t;
    if (s.t >= window_begin) {
      TransientWindow& w = sums.window;
      w.peak = std::max(w.peak, now.r2);
      if (before.t >= window_begin) {
        w.length += h;
        w.force += 0.5 * h * (last.force2 + now.force2);
        w.velocity += 0.5 * h * (last.velocity2 + now.velocity2);
        w.dynamic += 0.5 * h * (last.dynamic2 + now.dynamic2);
        const double upright = 0.5 * h * (last.upright2 + now.upright2);
        w.directions[0] += 0.5 * h * (last.velocity2 + now.velocity2) - upright;
        w.directions[1] += upright;
        for (std::size_t c = 0; c < 2; ++c) w.unbalance[c] += 0.5 * h * (before.unbalance[c] + s.unbalance[c]);
      }
    }
    before = s;
  }
  return transient_row(asked, sums, false);
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
    const std::string what = std::string(c.name) + ", start " + std::to_string(i);
    const TransientRow expected = sampled(study, asked, last_begin, last_begin + horizon);
    expect_same_figures(rows[i], expected, what, study.parameters.all_unbalances(), asked.by_direction);
    EXPECT_EQ(std::isnan(rows[i].peak_time), std::isnan(expected.peak_time)) << what;
    if (std::isnan(expected.peak_time)) continue;
    EXPECT_NEAR(rows[i].peak_time, expected.peak_time, 0.05f) << what;
    EXPECT_NEAR(rows[i].peak_speed, expected.peak_speed, 0.002f) << what;
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
const std::string early_ramp = R"([release]
speed = 2.0
[speed]
profile = "ramp"
final = 2.4
duration = 60.0
)";
// psi' jumps after release; the rotor starts away from its rest position.
const std::string published_ramp = early_ramp + "law = \"published\"\n[initial]\nx = 0.02\n";

INSTANTIATE_TEST_SUITE_P(All, Transients,
                         testing::Values(Case{"constant speed", constant_speed, 0.08, 0.03},
                                         Case{"early release", rotor_and_balancer + early_ramp, 0.05, 0.03},
                                         Case{"published law", rotor_and_balancer + published_ramp, 0.05, 0.03},
                                         Case{"gravity and anisotropy, early release", skew + early_ramp, 0.06, 0.05}),
                         [](const auto& param) { return std::to_string(param.index); });

// The watch without lanes sees what the lanes see, although its steps differ.
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
  expect_same_figures(transient_row(asked, watch.sums(), false), sampled(study, asked, 0.0, until), "watch");
}

// r = own + exp(-rate t): the rules of leaving, with times in closed form. Decided at 10.
struct Fading {
  double own, rate;

  TransientSample at(double t) const {
    const double fading = std::exp(-rate * t), r = own + fading;
    TransientSample s{t, r, {}};
    s.places[0] = {r * r, -2.0 * rate * fading * r, r * r, r * r, r * r, r * r, 0.0, 0.0, 0.0};
    return s;
  }
  TransientRow left(const TransientSettings& asked, const KnownEnd& end) const {
    DecidedWatch watch(asked);
    watch.begin(at(0.0));
    for (double t = 0.0; !watch.may_leave() && t < 5000.0; t += 0.5) {
      watch.step_to(t + 0.5, [&](double now) { return at(now); });
      if (t == 9.5) watch.decided(end);
    }
    return transient_row(asked, watch.sums(), false, end.figures);
  }
};

TEST(TransientWatch, FollowsAStartUntilItIsBelowItsLimitsForGood) {
  TransientSettings asked;
  asked.displacement = 0.2;
  asked.settled = 0.1;
  const MotionFigures balance{}, shaking{0.15, 0.15, 0.15, 0.15, 0.15};
  const TransientRow balanced = Fading{0.0, 0.05}.left(asked, {balance, 0.0});
  // exp(-t/20) = 0.05, half the lower limit, at 59.9: the window from 74 on is the first that is below throughout.
  EXPECT_EQ(balanced.followed_until, 90.0f);
  EXPECT_NEAR(balanced.settling_time, 20.0 * std::log(10.0), 0.01);
  EXPECT_NEAR(balanced.time_above, 20.0 * std::log(5.0), 0.02);
  // Its figures at the end are those of balance, not of the way there.
  EXPECT_EQ(balanced.peak_radial_at_end, 0.0f);
  EXPECT_EQ(balanced.rms_force, 0.0f);
  EXPECT_EQ(balanced.rms_velocity, 0.0f);
  EXPECT_EQ(balanced.residual_unbalance, 0.0f);
  EXPECT_FLOAT_EQ(balanced.peak_radial, 1.0f);

  // Ends between the limits: the time above the limit ends, settling does not come.
  const TransientRow shaken = Fading{0.15, 0.05}.left(asked, {shaking, 0.0});
  EXPECT_NEAR(shaken.time_above, 20.0 * std::log(20.0), 0.02);  // 0.15 + 0.05
  EXPECT_TRUE(std::isinf(shaken.settling_time));
  EXPECT_EQ(shaken.rms_velocity, 0.15f);
  // Ends above both limits: nothing to wait for except the peak, which is over.
  asked.displacement = 0.12;
  const TransientRow lasting = Fading{0.15, 0.05}.left(asked, {shaking, 0.0});
  EXPECT_TRUE(std::isinf(lasting.time_above));
  EXPECT_EQ(lasting.followed_until, 26.0f);
}

TEST(TransientWatch, MeasuresAnUnknownEndOnceItHasStoppedCreeping) {
  const TransientSettings asked;
  const KnownEnd unknown, slow{std::nullopt, 200.0};
  // Nothing changes: four windows.
  EXPECT_EQ((Fading{1.0, 1.0}.left(asked, unknown).followed_until), 74.0f);
  EXPECT_EQ((Fading{1.0, 1.0}.left(asked, slow).followed_until), 266.0f);  // the first doubled time above 200
  // By exp(-t/500) two neighbouring windows differ by less than 2 % from the start, and half is still to come.
  const TransientRow creeping = Fading{1.0, 0.002}.left(asked, unknown);
  EXPECT_GT(creeping.followed_until, 500.0f);
  const TransientRow fast = Fading{1.0, 0.02}.left(asked, unknown);
  EXPECT_NEAR(fast.peak_radial_at_end, 1.0, 0.05);
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
  static AttractorSearchCache searches;  // all studies here end at one speed
  BasinOptions o;
  o.searches = &searches;
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

TEST(BasinTransients, TellsAttractorsApart) {
  const BasinResult result = basin(ensemble(600), options(2));
  const TransientGroup* balanced = nullptr;
  const TransientGroup* other = nullptr;
  for (const TransientGroup& g : result.transients->groups) {
    if (g.id == balanced_id) balanced = &g;
    if (g.id > balanced_id && (!other || g.starts > other->starts)) other = &g;
  }
  ASSERT_TRUE(balanced && other);
  const auto figure = [](const TransientGroup& g, const char* name) {
    for (std::size_t k = 0; k < transient_figures.size(); ++k)
      if (std::string(transient_figures[k].name) == name) return g.figures[k];
    return SampleSummary{};
  };
  // Balance is no vibration at all, and every start settles.
  EXPECT_EQ(figure(*balanced, "settling_time").open, 0u);
  for (const char* name : {"peak_radial_at_end", "rms_velocity", "rms_force", "residual_unbalance"})
    EXPECT_EQ(figure(*balanced, name).largest, 0.0) << name;
  EXPECT_EQ(balanced->exceeded[2]->count, 0u);
  EXPECT_EQ(balanced->never, 0u);
  // The others never settle and vibrate for good.
  EXPECT_EQ(figure(*other, "settling_time").open, other->starts);
  EXPECT_EQ(other->never, other->starts);
  EXPECT_EQ(other->exceeded[2]->count, other->starts);
  // A single start replayed is the same start.
  const StartReplay alone = replay_start(ensemble(600), 5, options(1));
  ASSERT_TRUE(alone.transients);
  EXPECT_GT(alone.transients->followed_until, alone.outcome.time);
}

const SampleSummary& figure_of(const TransientGroup& group, const char* name) {
  std::size_t k = 0;
  while (std::string(transient_figures[k].name) != name) ++k;
  return group.figures[k];
}

// Limits that balance meets and every way there exceeds, without a settling limit.
TEST(BasinTransients, FiguresAtTheEndAreThoseOfTheMotionWhateverDecides) {
  Study study = parse_study(constant_speed, "constant speed");
  study.sampling.starts = 120;
  study.limits.velocity = 0.01;
  study.limits.displacement = 0.01;
  std::vector<BasinResult> results;
  for (const ClassificationMode mode :
       {ClassificationMode::validated, ClassificationMode::proof, ClassificationMode::horizon}) {
    study.numerics.decide = mode;
    results.push_back(basin(study, options(2)));
    const TransientGroup& balanced = results.back().transients->groups[1];
    ASSERT_EQ(balanced.id, balanced_id);
    EXPECT_EQ(balanced.exceeded[2]->count, 0u);
    EXPECT_EQ(balanced.lasting, 0u);
    EXPECT_EQ(figure_of(balanced, "time_above").open, 0u);
  }
  const std::vector<TransientGroup>& first = results.front().transients->groups;
  for (const BasinResult& other : results) {
    const std::vector<TransientGroup>& groups = other.transients->groups;
    ASSERT_EQ(groups.size(), first.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      EXPECT_EQ(groups[g].lasting, first[g].lasting);
      for (const TransientFigure& column : transient_figures) {
        if (column.value == &TransientRow::followed_until || column.value == &TransientRow::energy) continue;
        const SampleSummary &one = figure_of(first[g], column.name), &two = figure_of(groups[g], column.name);
        // The same trajectories: single precision, and the 2 % to which a torus's largest r is known.
        EXPECT_EQ(one.open, two.open) << column.name;
        EXPECT_NEAR(one.mean, two.mean, 1e-6 + 0.02 * one.mean) << groups[g].name << ", " << column.name;
      }
    }
  }
}

// The rotor sags under its weight by more than the limit; nothing else happens to it.
const std::string heavy = R"([rotor]
eccentricity = 0.01
damping = 0.5
gravity = 0.02
[balancer]
balls = 2
mass = 0.05
drag = 0.1
[speed]
profile = "ramp"
final = 4.0
duration = 100.0
[limits]
displacement = 0.2
)";

TEST(BasinTransients, DisplacementsCountFromWhereTheRotorRests) {
  const std::vector<std::string> heavier{"rotor.gravity=0.3", "rotor.damping=0.8"};  // a sag of 0.33
  Study study = parse_study(heavy, "heavy", heavier);
  const Trajectory one = simulate(study, {0.0, 0.5, 1.0});
  EXPECT_NEAR(one.y[0], -0.33, 1e-12);  // its rest position, where it stays while it hardly turns
  // Only the unbalance, at most 0.11 times psi'' = 0.04, moves it.
  for (const double r : one.radial) EXPECT_LT(r, 0.5 * 0.0044);
  study = parse_study(heavy, "heavy", {"rotor.gravity=0.3", "rotor.damping=0.8", "initial.x=0.0"});
  EXPECT_NEAR(simulate(study, {0.0}).radial[0], 0.33, 1e-12);  // dropped from unloaded springs

  for (const char* more : {"balancer.contact_angle=0.0", "balancer.contact_angle=0.2"}) {  // lanes, and a machine
    study = parse_study(heavy, "heavy", {"rotor.gravity=0.3", "rotor.damping=0.8", more});
    study.sampling.starts = 12;
    study.numerics.horizon = 400.0;
    BasinOptions o;
    o.threads = 2;
    o.transients = true;
    const BasinResult result = basin(study, o);
    const TransientGroup& all = result.transients->groups.front();
    EXPECT_EQ(all.exceeded[0]->count, 0u) << more;
    EXPECT_EQ(figure_of(all, "time_above").largest, 0.0) << more;
    EXPECT_LT(figure_of(all, "peak_radial").largest, 0.2) << more;
    EXPECT_NEAR(figure_of(all, "rms_force").mean, 0.33, 0.02) << more;  // the weight, and little else
  }
}

}  // namespace transients_test
}  // namespace equipoise
