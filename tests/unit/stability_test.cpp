// Where balance is stable: rates against independent ones, boundaries against bisection, papers and trajectories.
#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "../support/refusals.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace stability_test {

Study paper_rotor(double speed, double drag) {
  Study study = parse_study(constant_speed, "rotor");
  study.speed.speed = speed;
  study.parameters.drag = {drag, drag};
  return study;
}

// A plane around the study's own values of the final speed and the drag.
StabilitySettings around(double low, double high, double drag, int width = 3, int height = 3) {
  StabilitySettings settings;
  settings.x = {"speed.final", low, high, width};
  settings.y = {"balancer.drag", 0.5 * drag, 1.5 * drag, height};
  return settings;
}

const BalanceBoundary* boundary(const StabilityPlane& plane, bool along_x, bool upwards) {
  for (const BalanceBoundary& b : plane.own->boundaries)
    if (b.along_x == along_x && b.upwards == upwards) return &b;
  return nullptr;
}

// The state next to `z` that comes back after `time`, by Newton's method, and the largest rate by which differences
// from it grow: both from trajectories alone, by central differences. `freedom`: neutral directions of a continuum.
double followed_growth(const model::System& system, Eigen::VectorXd z, double time, int freedom = 0) {
  const auto after = [&](const Eigen::VectorXd& y) { return advance_state(system, y, time).value(); };
  Eigen::MatrixXd flow(z.size(), z.size());
  const bool moves = !system.autonomous();
  for (int round = 0; round < (moves ? 5 : 1); ++round) {
    for (Eigen::Index k = 0; k < z.size(); ++k) {
      Eigen::VectorXd up = z, down = z;
      const double step = 1e-5 * system.scale()[k];
      up[k] += step;
      down[k] -= step;
      flow.col(k) = (after(up) - after(down)) / (2.0 * step);
    }
    if (moves && round < 4)
      z -= dense::LinearSolver(flow - Eigen::MatrixXd::Identity(z.size(), z.size()))
               .solve(Eigen::VectorXd(after(z) - z));
  }
  const Eigen::VectorXcd all = dense::eigenvalues(flow);
  std::vector<std::complex<double>> multipliers(all.begin(), all.end());
  std::sort(multipliers.begin(), multipliers.end(),
            [](auto a, auto b) { return std::abs(a - 1.0) < std::abs(b - 1.0); });
  double largest = 0.0;
  for (std::size_t k = static_cast<std::size_t>(freedom); k < multipliers.size(); ++k)
    largest = std::max(largest, std::abs(multipliers[k]));
  return std::log(largest) / time;
}

double followed_growth(const Study& study, int freedom = 0) {
  const model::System system = study.system();
  const double speed = *speed_in_balance(study, system);
  const model::CentredTwin twin = model::centred_twin(study.parameters, speed);
  BallAngles phi = *balanced_angles(model::balanced_states(twin.parameters), twin.parameters);
  for (double& angle : phi) angle += twin.turn;
  const double time = system.autonomous() ? 3.0 : system.section_period();
  return followed_growth(system, model::balanced_state(system, speed, phi.data()), time, freedom);
}

TEST(Stability, RatesAreThoseOfTheRefinedEquilibrium) {
  std::mt19937 random(40);
  const auto drawn = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  int unstable = 0, none = 0;
  for (int k = 0; k < 40; ++k) {
    Study study = paper_rotor(drawn(0.3, 6.0), std::pow(10.0, drawn(-3.0, 0.0)));
    study.parameters.eccentricity = drawn(0.001, 0.12);
    study.parameters.mass = {drawn(0.01, 0.06), drawn(0.01, 0.06)};
    const BalancePoint found = balance_at(study);
    const auto states = model::balanced_states(study.parameters);
    EXPECT_EQ(found.kind == BalanceKind::none, states.angles.empty());
    EXPECT_EQ(found.margin < 0.0, states.angles.empty());
    none += states.angles.empty();
    if (states.angles.empty()) continue;
    for (const auto& phi : states.angles) {  // both have the same
      Eigen::VectorXd guess = model::centred_state(study.parameters, phi.data());
      guess[0] += 1e-5;
      const auto equilibrium = refine_equilibrium(study.system(), guess);
      ASSERT_TRUE(equilibrium);
      const std::complex<double> slowest = equilibrium->eigenvalues[0];
      EXPECT_NEAR(found.growth, slowest.real(), 1e-9);
      EXPECT_NEAR(found.frequency, std::fabs(slowest.imag()), 1e-7);
      const auto count = std::count_if(equilibrium->eigenvalues.begin(), equilibrium->eigenvalues.end(),
                                       [](const auto& v) { return v.real() > 0.0; });
      EXPECT_EQ(found.unstable, count);
      EXPECT_EQ(found.kind == BalanceKind::unstable, count > 0);
    }
    unstable += found.kind == BalanceKind::unstable;
  }
  EXPECT_GT(unstable, 5);
  EXPECT_LT(unstable, 35);
  EXPECT_GT(none, 2);
}

TEST(Stability, TheHopfBoundaryOfThePapersRotorIsWhereAPairCrosses) {
  for (const double drag : {0.01, 0.05}) {
    const StabilityPlane plane = stability(paper_rotor(4.0, drag), around(0.5, 6.0, drag));
    ASSERT_TRUE(plane.own);
    EXPECT_EQ(plane.own->point.kind, BalanceKind::stable);
    const BalanceBoundary* hopf = boundary(plane, true, false);
    ASSERT_TRUE(hopf);
    EXPECT_EQ(hopf->change, BalanceBoundary::Change::hopf);
    const auto pair_at = [&](double speed) {
      const Study study = paper_rotor(speed, drag);
      const auto phi = model::balanced_states(study.parameters).angles.front();
      const Eigen::VectorXd z = model::centred_state(study.parameters, phi.data());
      const Eigen::VectorXcd all = dense::eigenvalues(model::jacobian(study.parameters, speed, z.data()));
      return *std::max_element(all.begin(), all.end(), [](auto a, auto b) { return a.real() < b.real(); });
    };
    EXPECT_NEAR(pair_at(hopf->value).real(), 0.0, 2e-9);
    EXPECT_NEAR(std::fabs(pair_at(hopf->value).imag()), hopf->frequency, 1e-6);
    EXPECT_LT(pair_at(1.02 * hopf->value).real(), 0.0);
    EXPECT_GT(pair_at(0.98 * hopf->value).real(), 0.0);
    EXPECT_EQ(boundary(plane, true, true)->change, BalanceBoundary::Change::none);
  }
}

TEST(Stability, NearTheBoundaryTrajectoriesDieOutAndGrowAtTheRateThatItSays) {
  for (int k = 0; k < 10; ++k) {
    const double drag = 0.01 * std::pow(5.0, k / 9.0);
    const StabilityPlane plane = stability(paper_rotor(5.9, drag), around(0.3, 6.0, drag));
    const BalanceBoundary* edge = boundary(plane, true, plane.own->point.kind != BalanceKind::stable);
    edge = edge ? edge : boundary(plane, true, false);
    ASSERT_TRUE(edge && edge->change == BalanceBoundary::Change::hopf) << drag;
    for (const double factor : {0.98, 1.02}) {
      const Study study = paper_rotor(factor * edge->value, drag);
      const BalancePoint point = balance_at(study);
      EXPECT_EQ(point.kind, factor < 1.0 ? BalanceKind::unstable : BalanceKind::stable) << drag;
      // A small deviation along the slowest motion, followed by the full equations over whole swings.
      const auto phi = model::balanced_states(study.parameters).angles.front();
      const Eigen::VectorXd rest = model::centred_state(study.parameters, phi.data());
      const auto pairs = dense::eigenpairs(model::jacobian(study.system(), rest));
      Eigen::Index slowest = 0;
      pairs.values.real().maxCoeff(&slowest);
      const double time = 10.0 * 2.0 * M_PI / point.frequency;
      Eigen::VectorXd deviation = pairs.vectors.col(slowest).real();
      deviation *= 1e-6 / deviation.norm();
      const auto end = advance_state(study.system(), rest + deviation, time);
      ASSERT_TRUE(end);
      EXPECT_NEAR(std::log((*end - rest).norm() / deviation.norm()) / time, point.growth,
                  0.01 * std::fabs(point.growth))
          << drag << " " << factor;
    }
  }
}

TEST(Stability, OtherRotorsHaveTheRatesOfTheirTrajectories) {
  struct Case {
    const char* name;
    std::string text;
    int freedom;
  };
  const std::string motor = R"([speed]
profile = "torque"
initial = 2.0
torque = { stall = 0.2, no_load_speed = 3.2 }
)";
  const std::vector<Case> cases{
      {"unequal supports", with(constant_speed, "damping = 0.5", "damping = [0.5, 0.4]\nstiffness = [1.0, 1.2]"), 0},
      {"gravity", with(constant_speed, "damping = 0.5", "damping = 0.5\ngravity = 0.01"), 0},
      {"off-centre race", with(constant_speed, "balls = 2", "balls = 2\nrace_offset = [0.002, 0.001]"), 0},
      {"motor", with(rotor_and_balancer, "damping = 0.5", "damping = 0.5\ninertia = 0.5") + motor, 0},
      {"four balls", with(constant_speed, "balls = 2\nmass = 0.05", "balls = 4\nmass = 0.02"), 2},
      {"contact", with(constant_speed, "balls = 2", "balls = 2\ncontact_angle = 0.1"), 0},
  };
  for (const Case& c : cases) {
    const Study study = parse_study(c.text, c.name);
    const BalancePoint found = balance_at(study);
    EXPECT_TRUE(found.kind == BalanceKind::stable || found.kind == BalanceKind::unstable) << c.name;
    EXPECT_EQ(found.left_out, 0) << c.name;
    EXPECT_NEAR(found.growth, followed_growth(study, c.freedom), 0.01 * std::fabs(found.growth)) << c.name;
  }
}

TEST(Stability, SaysWhatIsLeftOut) {
  const auto left_out = [](const std::string& from, const std::string& to) {
    return balance_at(parse_study(with(constant_speed, from, to), "rotor")).left_out;
  };
  EXPECT_EQ(left_out("balls = 2", "balls = 2"), 0);
  EXPECT_EQ(left_out("balls = 2", "balls = 2\nstiction = 0.001"), dry_friction_left_out);
  EXPECT_EQ(left_out("damping = 0.5", "damping = 0.5\ngravity = 30.0"), gravity_left_out);
  const Study study = parse_study(with(constant_speed, "balls = 2", "balls = 2\nstiction = 0.001"), "rotor");
  EXPECT_TRUE(holds(result_text(stability(study, around(1.0, 4.0, 0.05))), "At all points dry friction is left out."));
  EXPECT_FALSE(holds(result_text(stability(paper_rotor(2.4, 0.05), around(1.0, 4.0, 0.05))), "left out"));
}

// The machine of the code that was published with Mirkov and others (2026). Speeds are in rad/s.
TEST(Stability, TheMachineOfMirkovAndOthersLosesItAboveItsCriticalSpeed) {
  constexpr double critical = 3.15440;
  struct Row {
    const char* drag;
    double above, below;
  };
  for (const Row& row : {Row{"0.005", 3.14, 3.16},
                         {"1e-4", 3.45, 3.50},
                         {"2.4e-5", 3.85, 3.90},
                         {"5e-6", 4.00, 4.05},
                         {"2e-6", 4.25, 4.30}}) {
    const Study study = parse_study(std::string(R"([rotor]
mass = "10.05 kg"
unbalance = "0.001 kg m"
stiffness = "100 N/m"
damping = "2 N s/m"
[balancer]
balls = 2
race_radius = "50 mm"
mass = "30 g"
drag = ")") + row.drag + R"( N m s"
[speed]
profile = "constant"
speed = "12 rad/s"
)",
                                    "machine");
    const StabilityPlane plane = stability(study, around(2.5 / critical, 13.0 / critical, study.parameters.drag[0]));
    ASSERT_TRUE(plane.own);
    EXPECT_EQ(plane.own->point.kind, BalanceKind::stable) << row.drag;
    const BalanceBoundary* lost = boundary(plane, true, false);
    ASSERT_TRUE(lost);
    EXPECT_EQ(lost->change, BalanceBoundary::Change::hopf) << row.drag;
    EXPECT_GT(critical * lost->value, row.above) << row.drag;
    EXPECT_LT(critical * lost->value, row.below) << row.drag;
  }
}

// Two balls of mass 0.05 cancel an unbalance of 0.1 at most. There a real eigenvalue is 0 as well, but the state ends.
TEST(Stability, BalanceEndsWhereTheBallsJustReach) {
  StabilitySettings settings;
  settings.x = {"rotor.eccentricity", 0.0, 0.2, 3};
  settings.y = {"balancer.drag", 0.1, 0.5, 2};
  const StabilityPlane plane = stability(paper_rotor(5.0, 0.3), settings);
  const BalanceBoundary* end = boundary(plane, true, true);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->change, BalanceBoundary::Change::existence);
  EXPECT_NEAR(end->value, 0.1, 1e-9);
}

// A load above the hump of its torque: the motor falls back to another speed, and rates jump without crossing 0.
TEST(Stability, AMotorThatFallsBackIsNoEigenvalueThatCrosses) {
  const Study study = parse_study(R"([rotor]
eccentricity = 0.01
damping = 0.3
inertia = 0.6
[balancer]
balls = 2
mass = 0.02
drag = 0.05
[speed]
profile = "torque"
torque = { speeds = [0.0, 1.0, 2.0, 3.0], values = [0.004, 0.001, 0.006, 0.0] }
load = { constant = 0.002 }
)",
                                  "motor");
  StabilitySettings settings;
  settings.x = {"rotor.damping", 0.1, 0.5, 3};
  settings.y = {"speed.load.constant", 0.0005, 0.007, 3};
  const StabilityPlane plane = stability(study, settings);
  const BalanceBoundary* back = boundary(plane, false, true);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->change, BalanceBoundary::Change::jump);
  EXPECT_NEAR(back->value, 0.006, 1e-6);
  EXPECT_LT(balance_at(study_with(study, "speed.load.constant", 0.00599)).growth, -1e-3);
}

// Unbalance stated in planes makes a couple that does not depend on inertias; the model has it as an angle.
TEST(Stability, InertiasOfARotorWithACoupleAreRefused) {
  const Study washer = read_study(EQUIPOISE_SOURCE_DIR "/studies/tilting-washer.toml");
  ASSERT_NE(washer.parameters.tilt.misalignment, 0.0);
  for (const char* key : {"rotor.tilt.polar_inertia", "rotor.tilt.transverse_inertia", "rotor.damping"})
    EXPECT_THROW(study_with(washer, key, 0.5), InputError) << key;
  EXPECT_NO_THROW(study_with(washer, "balancer.drag", 2.0 * washer.parameters.drag[0]));
  for (const char* key : {"rotor.tilt.unbalance.1.size", "rotor.tilt.bearings.2.stiffness", "rotor.mass"}) {
    const InputError e = refused([&] { study_with(washer, key, 0.5); });
    EXPECT_EQ(e.key(), key);
    EXPECT_NE(e.problem().find("is a key of data sheets; this command varies what they become"), std::string::npos)
        << e.what();
  }
}

TEST(Stability, PointsAreTheStudiesOfTheirValues) {
  const Study study = parse_study(ramp_speed, "rotor");
  for (const auto& [x, y] :
       {std::pair{SliceAxis{"speed.final", 1.0, 5.0, 7}, SliceAxis{"balancer.drag", 0.01, 0.1, 5}},
        {SliceAxis{"rotor.damping", 0.1, 1.0, 7}, SliceAxis{"balancer.mass", 0.01, 0.1, 5}},
        {SliceAxis{"rotor.stiffness", 0.5, 2.0, 7}, SliceAxis{"rotor.eccentricity", 0.0, 0.1, 5}}}) {
    const PlaneStudies studies(study, x, y);
    const double at_y = y.centre(3);
    for (const double at_x : {x.centre(2), x.centre(5)})
      EXPECT_EQ(to_toml(studies.at(at_x, at_y)),
                to_toml(parse_study(ramp_speed, "rotor",
                                    {fmt::format("{}={}", x.key, at_x), fmt::format("{}={}", y.key, at_y)})));
  }
  const Study machine = parse_study(constant_machine, "machine");
  const PlaneStudies read(machine, {"speed.final", 1.0, 5.0, 3}, {"balancer.drag", 0.01, 0.1, 3});
  EXPECT_EQ(to_toml(read.at(2.0, 0.05)),
            to_toml(study_with(study_with(machine, "speed.final", 2.0), "balancer.drag", 0.05)));
}

TEST(Stability, AllThreadsGiveTheSameBits) {
  StabilitySettings settings = around(0.3, 6.0, 0.05, 40, 30);
  settings.threads = 1;
  const Study study = paper_rotor(2.4, 0.05);
  const StabilityPlane one = stability(study, settings);
  settings.threads = 4;
  const StabilityPlane four = stability(study, settings);
  EXPECT_EQ(stability_csv(one), stability_csv(four));
  EXPECT_EQ(stability_answer(one), stability_answer(four));
}

TEST(Stability, AStoppedPlaneIsPartial) {
  const StopFlag stop{true};
  StabilitySettings settings = around(0.3, 6.0, 0.05);
  settings.stop = &stop;
  const StabilityPlane plane = stability(paper_rotor(2.4, 0.05), settings);
  EXPECT_FALSE(plane.complete);
  EXPECT_EQ(plane.count(BalanceKind::not_computed), plane.points.size());
  EXPECT_TRUE(holds(result_text(plane), "PARTIAL: 0 of 9 points"));
  EXPECT_TRUE(holds(stability_answer(plane), "nothing was computed (PARTIAL)"));
  EXPECT_TRUE(holds(stability_csv(plane).substr(0, stability_csv(plane).find('\n')), "PARTIAL: stopped early"));
  EXPECT_TRUE(holds(result_svg(plane, "rotor"), "PARTIAL: stopped early"));
}

TEST(Stability, IsStoppedInItsSearchForTheNextChangeToo) {
  Study study = paper_rotor(2.4, 0.05);
  study.parameters.gravity = 0.02;
  StopFlag stop{false};
  StabilitySettings settings = around(0.3, 6.0, 0.05);
  settings.threads = 2;
  settings.stop = &stop;
  settings.progress = [&](const Progress& p) {
    if (p.what == "steps to the next change") stop = true;
  };
  const StabilityPlane plane = stability(study, settings);
  EXPECT_FALSE(plane.complete);
  EXPECT_EQ(plane.count(BalanceKind::not_computed), 0u);
  ASSERT_TRUE(plane.own);
  EXPECT_TRUE(plane.own->boundaries.empty());
  EXPECT_TRUE(
      holds(result_text(plane), "PARTIAL: stopped before all changes next to the study's own values were found.\n"))
      << result_text(plane);
  EXPECT_FALSE(holds(result_text(plane), "points were computed"));
}

TEST(Stability, APlaneStoppedHalfwayTellsPartsOfTheWholeAndWhatIsMissing) {
  StabilityPlane plane = stability(paper_rotor(2.4, 0.05), around(0.3, 6.0, 0.05));
  plane.own.reset();
  for (std::size_t k = 3; k < plane.points.size(); ++k) plane.points[k] = BalancePoint();
  plane.complete = false;
  EXPECT_TRUE(holds(stability_answer(plane), "; 66.7 % of the plane was not computed (PARTIAL)."))
      << stability_answer(plane);
  EXPECT_TRUE(holds(result_text(plane), "not computed")) << result_text(plane);
  EXPECT_TRUE(holds(result_svg(plane, "rotor"), "not computed, 66.7 %"));
}

TEST(Stability, AnswersForThePlaneAndForTheStudy) {
  StabilitySettings settings = around(0.3, 6.0, 0.05, 40, 30);
  settings.y = {"rotor.eccentricity", 0.0, 0.2, 30};  // two balls of 0.05 cancel up to 0.1
  const StabilityPlane plane = stability(paper_rotor(2.4, 0.05), settings);
  const std::string answer = stability_answer(plane);
  EXPECT_TRUE(holds(answer, "impossible in 50.0 %")) << answer;
  EXPECT_TRUE(holds(answer, "it is stable")) << answer;
  const BalanceBoundary* end = boundary(plane, false, true);
  ASSERT_TRUE(end);
  if (end->change == BalanceBoundary::Change::existence) {
    EXPECT_NEAR(end->value, 0.1, 1e-9);
    EXPECT_TRUE(holds(answer, "the balanced state ends")) << answer;
  }
  const std::string slow = stability_answer(stability(paper_rotor(0.8, 0.05), settings));
  EXPECT_TRUE(holds(slow, "it is unstable")) << slow;
  EXPECT_FALSE(holds(slow, "it is stable")) << slow;
  const std::string outside = stability_answer(stability(paper_rotor(8.0, 0.05), settings));
  EXPECT_TRUE(holds(outside, "outside the plane")) << outside;
  const std::string picture = result_svg(plane, "rotor");
  for (const char* words : {"a pair crosses (Hopf)", "balance ends", "the study"})
    EXPECT_TRUE(holds(picture, words)) << words;
}

TEST(Stability, RefusesKeysAndValuesBeforeAnyWork) {
  const Study study = paper_rotor(2.4, 0.05);
  const auto refused = [&](const SliceAxis& x, const SliceAxis& y) -> std::string {
    StabilitySettings settings;
    settings.x = x;
    settings.y = y;
    try {
      stability(study, settings);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const SliceAxis speed{"speed.final", 1.0, 5.0, 4}, drag{"balancer.drag", 0.01, 0.1, 4};
  EXPECT_EQ(refused(speed, drag), "");
  EXPECT_TRUE(holds(refused(speed, {"balancer.drag", -1.0, 0.1, 4}), "balancer.drag = -0.8625"));
  EXPECT_TRUE(holds(refused({"initial.phi_1", 0.0, 1.0, 4}, drag), "initial.phi_1"));
  EXPECT_TRUE(holds(refused({"rotor.nothing", 0.0, 1.0, 4}, drag), "rotor.nothing"));
  EXPECT_TRUE(holds(refused(speed, speed), "both axes vary the same key"));
  SliceAxis twin = speed;
  twin.key = "speed.speed";
  EXPECT_TRUE(holds(refused(twin, speed), "speed.speed: varies nothing: speed.final, the other axis, sets the same"));
  EXPECT_TRUE(holds(refused({"speed.final", 5.0, 1.0, 4}, drag), "the first below the second"));
}

TEST(Stability, AFileIsReplacedOnlyByTheSamePlane) {
  const std::string path = testing::TempDir() + "stability.nc";
  std::filesystem::remove(path);
  StabilitySettings settings = around(1.0, 5.0, 0.05);
  settings.output = path;
  const Study study = paper_rotor(2.4, 0.05);
  stability(study, settings);
  EXPECT_NO_THROW(stability(study, settings));
  settings.x.high = 6.0;
  EXPECT_THROW(stability(study, settings), InputError);
  std::filesystem::remove(path);
}

}  // namespace stability_test
}  // namespace equipoise
