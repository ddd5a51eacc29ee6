// The attractor search: what it finds unaided, what given states add, and that the result depends on nothing else.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/parameters.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {
namespace attractors_test {

Study rotor(double drag, double speed, std::uint64_t starts) {
  Study study = study_of(base_rotor(2, drag), speed);
  study.sampling.starts = starts;
  return study;
}

struct Expected {
  int id;
  const char *name, *alias;
  MotionKind kind;
  double r_min, r_max;  // independent integration, four digits (tori and orbits sampled)
};

struct Case {
  const char* label;
  double drag, speed;
  std::vector<Expected> attractors;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.label; }

const Attractor* find(const AttractorsResult& result, int id) {
  const auto is_it = [&](const Attractor& a) { return a.id == id; };
  const auto at = std::find_if(result.attractors.begin(), result.attractors.end(), is_it);
  return at == result.attractors.end() ? nullptr : &*at;
}

AttractorsOptions searching(std::uint64_t starts) {
  AttractorsOptions options;
  options.starts = starts;
  return options;
}

class Attractors : public testing::TestWithParam<Case> {};

constexpr auto rest = MotionKind::equilibrium, orbit = MotionKind::periodic, torus = MotionKind::quasi_periodic;

TEST_P(Attractors, AreFoundUnaided) {
  const Case& c = GetParam();
  const AttractorsResult result = attractors(rotor(c.drag, c.speed, 3000), searching(3000));
  std::vector<const Attractor*> met;  // tiny ones may or may not be met as well
  for (const Attractor& a : result.attractors)
    for (const Expected& e : c.attractors)
      if (a.id == e.id) met.push_back(&a);
  ASSERT_EQ(met.size(), c.attractors.size());
  for (std::size_t k = 0; k < met.size(); ++k) {
    const Expected& e = c.attractors[k];
    const Attractor& a = *met[k];
    SCOPED_TRACE(e.name);
    EXPECT_EQ(a.name, e.name);
    EXPECT_EQ(a.alias, e.alias);
    EXPECT_EQ(a.motion.kind, e.kind);
    EXPECT_TRUE(a.motion.stable);
    // Half a unit of the last digit; a torus shows its extremes to 1 %.
    const double tolerance = e.kind == torus ? 1.5e-3 : 1e-4;
    EXPECT_NEAR(a.motion.r_min, e.r_min, tolerance);
    EXPECT_NEAR(a.motion.r_max, e.r_max, tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rows, Attractors,
    testing::Values(Case{"drag_5_percent_speed_22_tenths",
                         0.05,
                         2.2,
                         {{1, "balanced", "", rest, 0, 0},
                          {2, "co-drifting", "V1", orbit, .1196, .1435},
                          {3, "drifting apart", "V2", torus, .0118, .1292}}},
                    Case{"drag_5_percent_speed_24_tenths",
                         0.05,
                         2.4,
                         {{1, "balanced", "", rest, 0, 0},
                          {2, "co-drifting", "V1", orbit, .1282, .1493},
                          {3, "drifting apart", "V2", torus, .0139, .1342}}},
                    Case{"drag_5_percent_speed_44_tenths",
                         0.05,
                         4.4,
                         {{1, "balanced", "", rest, 0, 0}, {4, "one captured", "V3", orbit, .0142, .0902}}},
                    Case{"drag_5_percent_speed_50_tenths",
                         0.05,
                         5.0,
                         {{1, "balanced", "", rest, 0, 0}, {4, "one captured", "V3", orbit, .0118, .0859}}},
                    Case{"drag_1_percent_speed_40_tenths",
                         0.01,
                         4.0,
                         {{1, "balanced", "", rest, 0, 0},
                          {2, "co-drifting", "V1", orbit, .0849, .1051},
                          {3, "drifting apart", "V2", torus, 0, .0727},
                          {4, "one captured", "V3", orbit, .0219, .1053},
                          {6, "pair drift", "", orbit, .0008, .0097}}}),
    [](const auto& info) { return info.param.label; });

// States near V4 and near the motion of five times its period next to it, at Omega = 4.4.
const std::vector<double> near_v4{0.0528067, -0.0762854, 0.277856,   0.165906,
                                  1.9580073, 2.1527421,  -1.0849954, -0.6289745};
const std::vector<double> near_period_20{0.0305819, -0.0883728, 0.3280828,  0.1462239,
                                         1.8916947, 2.0718997,  -1.1643877, 0.0967979};

TEST(AttractorsGiven, StatesBringRareAttractorsIntoTheList) {
  AttractorsOptions options = searching(500);
  options.warm_start_states = {near_v4, near_period_20};
  const AttractorsResult result = attractors(rotor(0.05, 4.4, 500), options);
  const Attractor* v4 = find(result, 5);
  ASSERT_TRUE(v4);
  EXPECT_EQ(v4->name, "one captured, period 4");
  EXPECT_EQ(v4->alias, "V4");
  EXPECT_NEAR(v4->motion.period, 16.2484, 5e-5);
  EXPECT_EQ(v4->motion.copies, 2);
  // -.877 +- .459i
  EXPECT_NEAR(std::abs(v4->motion.spectrum[1]), 0.9901, 5e-5);
  EXPECT_NEAR(v4->motion.spectrum[1].real(), -0.877, 5e-4);
  EXPECT_NEAR(std::fabs(v4->motion.spectrum[1].imag()), 0.459, 5e-4);
  const Attractor* beside = find(result, first_free_id);
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->name, "one captured, period 20");
  EXPECT_NEAR(beside->motion.period, 81.2408, 5e-5);
  // Independent of shooting: integrated over a period, the state returns up to whole turns.
  Study once = rotor(0.05, 4.4, 1);
  const Eigen::VectorXd& z = beside->motion.state;
  once.initial.x = z[0];
  once.initial.y = z[1];
  once.initial.x_dot = z[2] + 4.4 * z[1];  // z holds the inertial velocity
  once.initial.y_dot = z[3] - 4.4 * z[0];
  for (int i = 0; i < 2; ++i) {
    once.initial.phi[i] = z[4 + i];
    once.initial.phi_dot[i] = z[6 + i];
  }
  const Trajectory turn = simulate(once, {0.0, beside->motion.period});
  EXPECT_NEAR(turn.x.back(), turn.x.front(), 1e-9);
  EXPECT_NEAR(turn.y_dot.back(), turn.y_dot.front(), 1e-9);
}

TEST(AttractorsGiven, ResultsDoNotDependOnThreads) {
  const Study study = rotor(0.05, 2.4, 2000);
  AttractorsOptions options = searching(2000);
  options.threads = 1;
  const AttractorsResult one = attractors(study, options);
  options.threads = 2;
  const AttractorsResult two = attractors(study, options);
  ASSERT_EQ(one.attractors.size(), two.attractors.size());
  for (std::size_t k = 0; k < one.attractors.size(); ++k) {
    const Attractor &a = one.attractors[k], &b = two.attractors[k];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.motion.state, b.motion.state);
    EXPECT_EQ(a.motion.exponents, b.motion.exponents);
  }
}

// V4 at Omega = 4.4, about one start in 30 000, is first met during the run. It is listed, and an interrupted and
// resumed run lists it in the same way.
TEST(AttractorsMetLate, AreListedAndSurviveResumption) {
  const Study study = rotor(0.05, 4.4, 60'000);
  const BasinResult whole = basin(study);
  EXPECT_GT(whole.attractors.size(), 2u) << "no rare attractor was met";

  BasinOptions options;
  options.output = testing::TempDir() + "equipoise_late_" + std::to_string(getpid()) + ".nc";
  std::filesystem::remove(options.output);
  StopFlag stop{false};
  options.stop = &stop;
  options.progress = [&](const Progress& p) { stop = !p.preparing && p.done > 30'000; };
  EXPECT_TRUE(basin(study, options).partial);
  stop = false;
  options.progress = {};
  const BasinResult resumed = basin(study, options);
  EXPECT_GT(resumed.resumed_from, 30'000u);
  ASSERT_EQ(resumed.attractors.size(), whole.attractors.size());
  for (std::size_t k = 0; k < whole.attractors.size(); ++k) {
    EXPECT_EQ(resumed.attractors[k].id, whole.attractors[k].id);
    EXPECT_EQ(resumed.attractors[k].name, whole.attractors[k].name);
    EXPECT_EQ(resumed.attractors[k].share.count, whole.attractors[k].share.count);
  }
  std::filesystem::remove(options.output);
}

}  // namespace attractors_test
}  // namespace equipoise
