// Planes and curves of balance that is one state of a continuum: the polygon that stands for it, its curves up to where
// balance ends, what the answer says of the whole continuum; against closed forms and differences of trajectories.
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/cancelling.hpp"
#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "../support/charted_plane.hpp"

namespace equipoise {
namespace continuum_plane_test {

using Complex = std::complex<double>;

model::Parameters rotor_of(double eccentricity, const std::vector<double>& masses) {
  model::Parameters p;
  p.eccentricity = eccentricity;
  p.balls = static_cast<int>(masses.size());
  std::copy(masses.begin(), masses.end(), p.mass.begin());
  return p;
}

double margin_of(const model::Parameters& p) {
  const double largest = std::max(p.eccentricity, *std::max_element(p.mass.begin(), p.mass.begin() + p.balls));
  return p.eccentricity + p.total_mass() - 2.0 * largest;
}

// Unbalance and balls laid end to end.
std::vector<Complex> corners(const model::Parameters& p, const std::array<double, model::max_balls>& phi) {
  std::vector<Complex> found{0.0, p.eccentricity};
  for (int i = 0; i < p.balls; ++i)
    found.push_back(found.back() + std::polar(p.mass[static_cast<std::size_t>(i)], phi[static_cast<std::size_t>(i)]));
  return found;
}

TEST(InscribedPolygon, ClosesAndHasItsCornersOnACircle) {
  std::mt19937 random(3);
  const auto drawn = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  int compared = 0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<double> masses;
    for (int n = 3 + k % 4; n > 0; --n) masses.push_back(drawn(0.01, 0.1));
    const model::Parameters p = rotor_of(k % 5 ? drawn(0.0, 0.3) : 0.0, masses);
    const double size = p.eccentricity + p.total_mass(), margin = margin_of(p);
    if (margin < 1e-3 * size) continue;
    const auto phi = model::inscribed_polygon(p);
    const std::vector<Complex> at = corners(p, phi);
    // Rounding of the circle, magnified where the polygon is nearly a line.
    const double rounding = 1e-14 * size * size / margin;
    EXPECT_LT(std::abs(at.back()), rounding);
    // The circle through three corners that are not in line holds the others.
    const Complex a = at[0], b = at[2] - a, c = at[3] - a;
    const double twice = 2.0 * (b.real() * c.imag() - b.imag() * c.real());
    const Complex centre = a + Complex(0.0, 1.0) * (c * std::norm(b) - b * std::norm(c)) / -twice;
    const double radius = std::abs(at[0] - centre);
    for (const Complex corner : at) EXPECT_NEAR(std::abs(corner - centre), radius, 1e3 * rounding * radius / size);
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

TEST(InscribedPolygon, OfAlikeBallsIsEvenAndOnTheLightSide) {
  const auto phi = model::inscribed_polygon(rotor_of(0.02, {0.05, 0.05, 0.05, 0.05}));
  for (int i = 1; i < 4; ++i)
    EXPECT_NEAR(phi[static_cast<std::size_t>(i)] - phi[static_cast<std::size_t>(i - 1)], phi[1] - phi[0], 1e-12);
  EXPECT_NEAR(0.5 * (phi[0] + phi[3]), pi, 1e-12);
}

TEST(InscribedPolygon, ComesToTheBallsInLineWhereBalanceEnds) {
  // As the square root of what is left, from either end: the largest is the unbalance, or a ball.
  for (const double left : {1e-4, 1e-6, 1e-8}) {
    const auto light = model::inscribed_polygon(rotor_of(0.12 * (1.0 - left), {0.03, 0.04, 0.05}));
    for (int i = 0; i < 3; ++i) EXPECT_LT(std::fabs(light[static_cast<std::size_t>(i)] - pi), 4.0 * std::sqrt(left));
    const auto heavy = model::inscribed_polygon(rotor_of(0.02 * (1.0 + left), {0.03, 0.04, 0.09}));
    for (int i = 0; i < 2; ++i)
      EXPECT_LT(std::fabs(wrapped(heavy[static_cast<std::size_t>(i)])), 4.0 * std::sqrt(left));
    EXPECT_LT(std::fabs(wrapped(heavy[2] - pi)), 4.0 * std::sqrt(left));
  }
}

Study unlike_balls(const std::string& masses, double drag, double speed = 2.4) {
  Study study = parse_study(with(constant_speed, "balls = 2\nmass = 0.05", "balls = 3\nmass = " + masses), "rotor");
  study.speed.speed = speed;
  std::fill_n(study.parameters.drag.begin(), 3, drag);
  return study;
}

BifurcationChart over_unbalance(const Study& study) {
  ChartSettings settings;
  settings.x = {"speed.final", 0.5, 6.0, 24};
  settings.y = {"rotor.eccentricity", 0.0, 0.12, 24};
  settings.boxes = 0;
  return bifurcation_chart(study, settings);
}

TEST(ContinuumChart, FollowsCurvesOfUnlikeBallsToWhereBalanceEnds) {
  // Balls of 0.02, 0.03 and 0.05 just cancel each other without unbalance, and 0.1 at most; the others 0.005 at least.
  struct Case {
    const char* masses;
    double drag, least, most;
  };
  int ended = 0, crossed = 0;
  for (const Case& c : {Case{"[0.02, 0.03, 0.05]", 0.01, 0.0, 0.1}, Case{"[0.02, 0.03, 0.05]", 0.2, 0.0, 0.1},
                        Case{"[0.04, 0.05, 0.095]", 0.01, 0.005, 1.0}}) {
    const Study study = unlike_balls(c.masses, c.drag);
    for (const ChartCurve& curve : over_unbalance(study).curves) {
      if (curve.of != of_balance || curve.kind != CurveKind::hopf) continue;
      for (const bool first : {true, false}) {
        const CurvePoint& end = first ? curve.points.front() : curve.points.back();
        const CurveEnd why = curve.ends[first ? 0 : 1];
        EXPECT_TRUE(why == CurveEnd::plane || why == CurveEnd::no_balance) << c.masses << " " << end.x << " " << end.y;
        // The plane's own edge, or what the balls can cancel: within a millionth.
        const double edge = std::min({std::fabs(end.y - c.least), std::fabs(end.y - c.most), std::fabs(end.y - 0.12),
                                      std::fabs(end.x - 6.0), std::fabs(end.x - 0.5)});
        EXPECT_LT(edge, 1e-6) << c.masses << " " << end.x << " " << end.y;
        ++ended;
      }
      // Every place has balls at rest in balance, and a pair on the unit circle of the map over its own period.
      for (std::size_t k = 5; k + 5 < curve.points.size(); k += 20) {
        const CurvePoint& p = curve.points[k];
        if (p.frequency < 0.05) continue;
        Study there = study;
        there.speed.speed = p.x;
        there.parameters.eccentricity = p.y;
        const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(p.state.data(), 10);
        const double quarter = 0.5 * pi / p.frequency;
        EXPECT_LT((*advance_state(there.system(), z, quarter, 0.0, 1e-13) - z).norm(), 1e-10);
        const Eigen::VectorXcd all = multipliers_by_differences(there.system(), z, quarter);
        EXPECT_LT((all.array() - Complex(0.0, 1.0)).abs().minCoeff(), 1e-6) << c.masses << " " << p.x << " " << p.y;
        ++crossed;
      }
    }
  }
  EXPECT_GE(ended, 12);
  EXPECT_GE(crossed, 10);
}

StabilityPlane small_plane(const Study& study, const SliceAxis& x, const SliceAxis& y) {
  StabilitySettings settings;
  settings.x = x;
  settings.y = y;
  return stability(study, settings);
}

// Growth of deviations by differences of trajectories; the multiplier nearest to 1 is the continuum's own.
double growth_of(const model::System& system, const std::array<double, model::max_balls>& phi) {
  constexpr double time = 8.0;
  Eigen::VectorXcd all =
      multipliers_by_differences(system, model::balanced_state(system, system.speed(), phi.data()), time);
  Eigen::Index own = 0;
  (all.array() - 1.0).abs().minCoeff(&own);
  all[own] = 0.0;
  return std::log(all.cwiseAbs().maxCoeff()) / time;
}

TEST(ContinuumPlane, TellsHowMuchOfTheContinuumIsStableAndHowFast) {
  // At this speed some members are stable and some are not. All of them: the third ball at every angle, with either
  // triangle of the other two.
  const Study study = unlike_balls("[0.04, 0.05, 0.06]", 0.2, 1.72);
  const model::System system = study.system();
  double slowest = -INFINITY, fastest = INFINITY, most = 0.0;
  for (int k = 0; k < 120; ++k)
    for (const double side : {1.0, -1.0}) {
      const double phi = two_pi * (k + 0.5) / 120;
      const Complex rest = -(study.parameters.eccentricity + std::polar(0.06, phi));
      const double length = std::abs(rest), one = (0.0016 + length * length - 0.0025) / (2.0 * 0.04 * length);
      if (std::fabs(one) >= 1.0) continue;
      std::array<double, model::max_balls> angles{};
      angles[0] = std::arg(rest) + side * std::acos(one);
      angles[1] = std::arg(rest - std::polar(0.04, angles[0]));
      angles[2] = phi;
      const double growth = growth_of(system, angles);
      (growth < 0.0 ? slowest : most) = std::max(growth < 0.0 ? slowest : most, growth);
      fastest = std::min(fastest, growth);
    }
  ASSERT_LT(fastest, -1e-4);
  ASSERT_GT(most, 1e-4);
  const StabilityPlane plane = small_plane(study, {"speed.final", 1.0, 2.5, 4}, {"rotor.eccentricity", 0.005, 0.05, 4});
  ASSERT_TRUE(plane.own && plane.own->continuum);
  const ContinuumPart& part = *plane.own->continuum;
  EXPECT_GT(part.stable, 0);
  EXPECT_LT(part.stable, part.drawn);
  // Those drawn reach the extremes of a smooth function to the square of their distances.
  EXPECT_NEAR(part.fastest_rate, fastest, 0.01 * (most - fastest));
  EXPECT_NEAR(part.most_growth, most, 0.01 * (most - fastest));
  // The state that is drawn is one of them.
  EXPECT_GE(plane.own->point.growth, fastest - 0.01 * (most - fastest));
  EXPECT_LE(plane.own->point.growth, most + 0.01 * (most - fastest));
  const std::string answer = stability_answer(plane);
  EXPECT_TRUE(holds(answer, "balance with the balls spread evenly, one state of a continuum, is")) << answer;
  EXPECT_TRUE(holds(answer, "Of 1024 balanced states drawn evenly from the continuum " + std::to_string(part.stable) +
                                " are stable: their slowest deviations fall to 1/e in "))
      << answer;
  EXPECT_TRUE(holds(answer, "; deviations of unstable ones grow by a factor e in ")) << answer;
  const auto json = nlohmann::json::parse(json_text(plane));
  EXPECT_EQ(json["one_of_many"], true);
  EXPECT_EQ(json["own"]["continuum"]["stable"], part.stable);
  EXPECT_TRUE(holds(result_svg(plane, "rotor"), "balls spread evenly"));
}

TEST(ContinuumPlane, OfTwoBallsSaysNothingOfAContinuum) {
  const StabilityPlane plane =
      small_plane(charted_rotor(), {"speed.final", 1.0, 2.5, 4}, {"rotor.eccentricity", 0.005, 0.05, 4});
  EXPECT_FALSE(plane.own->continuum);
  EXPECT_FALSE(holds(result_text(plane), "continuum")) << result_text(plane);
  EXPECT_TRUE(nlohmann::json::parse(json_text(plane))["own"]["continuum"].is_null());
}

TEST(ContinuumPlane, AChartSaysIt) {
  const BifurcationChart chart = over_unbalance(unlike_balls("[0.04, 0.05, 0.06]", 0.2));
  EXPECT_TRUE(holds(chart_answer(chart), "balance with the balls spread evenly, one state of a continuum, is"));
  EXPECT_TRUE(holds(result_text(chart), "inscribed"));
  EXPECT_EQ(nlohmann::json::parse(json_text(chart))["one_of_many"], true);
  EXPECT_TRUE(holds(result_svg(chart, "rotor"), "balls spread evenly"));
}

// Two unlike balls in each of two planes: each plane closes its triangle in two ways, and between drags and speeds at
// which the first and the last of the four states lose their stability only the most stable one counts.
TEST(SeveralStates, AreToldByTheMostStableOne) {
  const std::string text = R"([rotor]
eccentricity = 0.006
eccentricity_angle = 2.4
damping = 0.08
[rotor.tilt]
transverse_inertia = 1.9
polar_inertia = 0.7
misalignment = 0.006
stiffness = [0.4, 2.2]
damping = [0.02, 0.19]
[balancer]
balls = 4
plane = [1.5, 1.5, -0.8, -0.8]
mass = [0.006, 0.0075, 0.008, 0.007]
drag = 0.2
[speed]
profile = "constant"
speed = 2.369
)";
  const Study study = parse_study(text, "rotor");
  const model::System system = study.system();
  int stable = 0;
  const model::BalancedStates states = model::balanced_states(study.parameters);
  ASSERT_EQ(states.angles.size(), 4u);
  for (const auto& phi : states.angles) stable += balanced_rates(system, phi, false)->rates.front().real() < 0.0;
  EXPECT_TRUE(0 < stable && stable < 4) << stable;
  EXPECT_EQ(balance_at(study).kind, BalanceKind::stable);
  const SliceAxis speed{"speed.final", 2.0, 3.0, 3}, drag{"balancer.drag", 0.1, 0.3, 3};
  const StabilityPlane plane = small_plane(study, speed, drag);
  EXPECT_TRUE(holds(result_text(plane), "the most stable state at each point"));
  EXPECT_EQ(nlohmann::json::parse(json_text(plane))["of_several"], true);
  const Study alike = parse_study(text, "rotor", {"balancer.mass=0.007"});
  EXPECT_FALSE(holds(result_text(small_plane(alike, speed, drag)), "most stable"));
}

TEST(PlaneNotes, TellWhatAnAxisBrings) {
  const SliceAxis speed{"speed.final", 1.5, 2.5, 3};
  const auto text = [&](const SliceAxis& other) { return result_text(small_plane(charted_rotor(), speed, other)); };
  EXPECT_TRUE(holds(text({"balancer.contact_angle", 0.1, 0.4, 3}), "do not touch"));
  EXPECT_TRUE(holds(text({"rotor.gravity", 0.001, 0.01, 3}), "rates are those of multipliers"));
  for (const char* words : {"do not touch", "multipliers"})
    EXPECT_FALSE(holds(text({"balancer.drag", 0.01, 0.1, 3}), words)) << words;
  ChartSettings settings;
  settings.x = speed;
  settings.y = {"balancer.contact_angle", 0.1, 0.4, 3};
  settings.boxes = 0;
  EXPECT_TRUE(holds(result_text(bifurcation_chart(charted_rotor(), settings)), "because the balls lack room"));
}

TEST(PlaneNames, AreThoseOfTheCaller) {
  const SliceAxis speed{"speed.final", 1.5, 2.5, 3}, drag{"balancer.drag", -0.1, 0.4, 3},
      same{"speed.final", 1.0, 2.0, 3};
  const PlaneNames names{"x", "y", "size", "chart"};
  const auto refusal = [&](const SliceAxis& x, const SliceAxis& y) -> std::string {
    try {
      PlaneStudies(charted_rotor(), x, y);
    } catch (const InputError& e) {
      return under_names(e, x, y, names).what();
    }
    return "";
  };
  EXPECT_TRUE(refusal(speed, drag).starts_with("y: balancer.drag = ")) << refusal(speed, drag);
  EXPECT_TRUE(refusal(speed, same).starts_with("x: speed.final")) << refusal(speed, same);
  const SliceAxis wide{"speed.final", 1.0, 2.0, 20000}, high{"balancer.drag", 0.1, 0.4, 20000};
  EXPECT_TRUE(refusal(wide, high).starts_with("size = 20000x20000: ")) << refusal(wide, high);
}

TEST(PlaneStudies, AskWhatTheCornersOfferAsTheyAreRead) {
  const SliceAxis speed{"speed.final", 1.5, 2.5, 3}, drag{"balancer.drag", 0.1, 0.4, 3};
  std::vector<double> drags;
  PlaneStudies(charted_rotor(), speed, drag, [&](const Study& there) { drags.push_back(there.parameters.drag[0]); });
  EXPECT_EQ(drags, (std::vector<double>{drag.centre(0), drag.centre(0), drag.centre(2), drag.centre(2)}));
}

}  // namespace continuum_plane_test
}  // namespace equipoise
