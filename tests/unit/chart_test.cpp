// Curves on which balance changes: against bisection, independent derivatives, trajectories on either side; proofs
// against eigenvalues.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/core/math/curve_follower.hpp"
#include "equipoise/extras/curves/followed_curve.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/extras/proof/balance_boxes.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace chart_test {

Study chart_rotor(double speed, double drag) {
  Study study = parse_study(constant_speed, "rotor");
  study.speed.speed = speed;
  study.parameters.drag = {drag, drag};
  return study;
}

ChartSettings over_speed_and_drag(double low_speed, double high_speed, double low_drag, double high_drag,
                                  int points = 24, std::uint64_t boxes = 0) {
  ChartSettings settings;
  settings.x = {"speed.final", low_speed, high_speed, points};
  settings.y = {"balancer.drag", low_drag, high_drag, points};
  settings.boxes = boxes;
  return settings;
}

// Without curves of locked states (locked_chart_test.cpp).
BifurcationChart balance_chart(const Study& study, const ChartSettings& settings) {
  BifurcationChart chart = bifurcation_chart(study, settings);
  std::erase_if(chart.specials, [&](const SpecialPoint& p) { return chart.curves[p.curve].of != of_balance; });
  std::erase_if(chart.curves, [](const ChartCurve& c) { return c.of != of_balance; });
  return chart;
}

const BifurcationChart& wide_chart() {
  static const BifurcationChart chart =
      balance_chart(chart_rotor(2.4, 0.05), over_speed_and_drag(0.0, 6.0, 0.001, 1.0, 48, 200000));
  return chart;
}

Study at(double speed, double drag) { return chart_rotor(speed, drag); }

TEST(HigherDerivatives, AreThoseOfTheJacobian) {
  std::mt19937 random(7);
  const auto drawn = [&] { return std::uniform_real_distribution<>(-1.0, 1.0)(random); };
  for (const char* balls : {"balls = 2", "balls = 3", "balls = 2\nrolls = true"}) {
    const Study study = parse_study(with(constant_speed, "balls = 2", balls), "rotor");
    const model::System system = study.system();
    const Eigen::Index size = system.dimension();
    const auto vector = [&] {
      return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return drawn(); }));
    };
    const Eigen::VectorXd z = vector(), u = vector(), v = vector(), w = vector();
    constexpr double step = 1e-5;
    const auto slope = [&](const Eigen::VectorXd& place) {
      return Eigen::VectorXd(model::jacobian(system, place) * u);
    };
    const Eigen::VectorXd second = (slope(z + step * v) - slope(z - step * v)) / (2.0 * step);
    EXPECT_LT((model::second_derivative(system, z, u, v) - second).norm(), 1e-7 * (1.0 + second.norm())) << balls;
    const auto bend = [&](const Eigen::VectorXd& place) { return model::second_derivative(system, place, u, v); };
    const Eigen::VectorXd third = (bend(z + step * w) - bend(z - step * w)) / (2.0 * step);
    EXPECT_LT((model::third_derivative(system, z, u, v, w) - third).norm(), 1e-7 * (1.0 + third.norm())) << balls;
    // All orders of the directions give the same.
    EXPECT_LT((model::third_derivative(system, z, w, u, v) - model::third_derivative(system, z, u, v, w)).norm(),
              1e-12 * (1.0 + third.norm()));
  }
}

TEST(CurveFollower, GoesRoundACircleToItsPrecision) {
  // Of radius 1/4: the unknowns are those of the unit square.
  CurveFollower follower([](const Eigen::VectorXd& p) -> std::optional<Eigen::VectorXd> {
    return Eigen::VectorXd::Constant(1, (p - Eigen::Vector2d(0.5, 0.5)).squaredNorm() - 0.0625);
  });
  const auto begin = follower.nearby(Eigen::Vector2d(0.8, 0.5));
  ASSERT_TRUE(begin);
  CurveFollower::Step here{*begin, *follower.tangent(*begin, Eigen::Vector2d(0.1, 1.0)), 0.0, {}, {}};
  double step = 1e-3, length = 0.0;
  while (length < 2.0 * M_PI * 0.25) {
    const auto next = follower.next(here, step);
    ASSERT_TRUE(next);
    EXPECT_NEAR((next->point - Eigen::Vector2d(0.5, 0.5)).norm(), 0.25, 1e-13);
    length += (next->point - here.point).norm();
    here = *next;
  }
  EXPECT_NEAR((here.point - *begin).norm(), 0.0, CurveFollower::longest_step);
}

TEST(Chart, CurvesAreWhereTheStabilityOfThePlaneChanges) {
  const BifurcationChart& chart = wide_chart();
  ASSERT_EQ(chart.curves.size(), 2u);
  int compared = 0, crossed = 0;
  for (const ChartCurve& curve : chart.curves) {
    EXPECT_EQ(curve.kind, CurveKind::hopf);
    EXPECT_LT(curve.error, 1e-10);
    for (std::size_t k = 3; k + 3 < curve.points.size(); k += 25) {
      const CurvePoint& p = curve.points[k];
      const auto spectrum = balance_spectrum(at(p.x, p.y));
      const auto pair = nearest_pair(spectrum->rates, {0.0, p.frequency * p.frequency, {}});
      EXPECT_NEAR(pair->mean, 0.0, 1e-11);
      EXPECT_NEAR(std::sqrt(pair->product), p.frequency, 1e-9);
      // Across the curve the number of unstable eigenvalues changes by the pair.
      const CurvePoint& q = curve.points[k + 1];
      const double along_x = (q.x - p.x) / 6.0, along_y = (q.y - p.y) / 0.999, norm = std::hypot(along_x, along_y);
      const auto unstable = [&](double side) {
        return balance_at(at(p.x - side * 6.0 * along_y / norm, p.y + side * 0.999 * along_x / norm)).unstable;
      };
      EXPECT_EQ(std::abs(unstable(1e-5) - unstable(-1e-5)), 2) << p.x << " " << p.y;
      EXPECT_EQ(std::min(unstable(1e-5), unstable(-1e-5)), p.others) << p.x << " " << p.y;
      ++crossed;
      // Bisection along the speed from a study next to it ends at the same place.
      if (p.others > 0 || std::fabs(along_y) < 0.5 * norm) continue;
      StabilitySettings settings;
      settings.x = {"speed.final", p.x - 0.1, p.x + 0.1, 2};
      settings.y = {"balancer.drag", 0.5 * p.y, 1.5 * p.y, 2};
      const StabilityPlane plane = stability(at(p.x + 0.02, p.y), settings);
      for (const BalanceBoundary& b : plane.own->boundaries)
        if (b.along_x && !b.upwards && b.change == BalanceBoundary::Change::hopf) {
          const double slope = (balance_at(at(p.x + 1e-4, p.y)).growth - balance_at(at(p.x - 1e-4, p.y)).growth) / 2e-4;
          EXPECT_NEAR(b.value, p.x, 1.1e-9 / std::fabs(slope)) << p.y;  // bisection looks for a rate of 1e-9
          ++compared;
        }
    }
  }
  EXPECT_GT(crossed, 8);
  EXPECT_GT(compared, 1);
}

TEST(Chart, AFinerGridFindsTheSameCurvesAndPoints) {
  const BifurcationChart& chart = wide_chart();
  const BifurcationChart finer = balance_chart(chart_rotor(2.4, 0.05), over_speed_and_drag(0.0, 6.0, 0.001, 1.0, 96));
  ASSERT_EQ(finer.curves.size(), chart.curves.size());
  ASSERT_EQ(finer.specials.size(), chart.specials.size());
  for (const SpecialPoint& p : chart.specials)
    EXPECT_TRUE(std::any_of(
        finer.specials.begin(), finer.specials.end(),
        [&](const SpecialPoint& q) { return q.kind == p.kind && std::hypot((q.x - p.x) / 6.0, q.y - p.y) < 1e-9; }))
        << p.x << " " << p.y;
}

TEST(Chart, DoubleHopfPointsHaveTwoPairsOnTheAxisAndGeneralisedOnesNoCubicTerm) {
  int doubles = 0, generalised = 0;
  for (const SpecialPoint& p : wide_chart().specials) {
    const auto spectrum = balance_spectrum(at(p.x, p.y));
    if (p.kind == SpecialKind::double_hopf) {
      ++doubles;
      for (const double frequency : {p.frequency, p.second}) {
        const auto pair = nearest_pair(spectrum->rates, {0.0, frequency * frequency, {}});
        EXPECT_NEAR(pair->mean, 0.0, 2e-9);
        EXPECT_NEAR(std::sqrt(pair->product), frequency, 1e-8);
      }
    } else if (p.kind == SpecialKind::generalised_hopf) {
      ++generalised;
      EXPECT_NEAR(first_lyapunov(*spectrum, p.frequency).value(), 0.0, 1e-8);
    }
  }
  EXPECT_EQ(doubles, 2);
  EXPECT_EQ(generalised, 1);
}

// The amplitude of the ball that swings most, once the motion from `z` has come to its cycle.
double swing_after(const model::System& system, Eigen::VectorXd z, double time, double period) {
  if (time > 0.0) z = advance_state(system, z, time).value();
  std::vector<double> low(2, INFINITY), high(2, -INFINITY);
  for (int k = 0; k < 120; ++k) {
    z = advance_state(system, z, period / 100.0).value();
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], z[model::index::phi(i)]);
      high[i] = std::max(high[i], z[model::index::phi(i)]);
    }
  }
  return 0.5 * std::max(high[0] - low[0], high[1] - low[1]);
}

// From balance along the pair's motion, so that the ball that swings most has this amplitude.
Eigen::VectorXd swung(const BalanceSpectrum& spectrum, double frequency, double amplitude) {
  const auto pairs = dense::eigenpairs(spectrum.jacobian);
  Eigen::Index nearest = 0;
  (pairs.values.array() - std::complex<double>(0.0, frequency)).abs().minCoeff(&nearest);
  const Eigen::VectorXcd q = pairs.vectors.col(nearest);
  const double swing = std::max(std::abs(q[4]), std::abs(q[5]));
  return spectrum.state + amplitude / swing * q.real();
}

// Places on curves where a stable balance is lost, softly or abruptly, with a cubic term that counts.
std::vector<CurvePoint> places_of_loss(bool soft) {
  std::vector<CurvePoint> places;
  for (const ChartCurve& curve : wide_chart().curves)
    for (std::size_t k = 5; k + 5 < curve.points.size(); k += 4) {
      const CurvePoint& p = curve.points[k];
      if (p.others == 0 && (p.lyapunov < 0.0) == soft && std::fabs(p.lyapunov) > 0.02 && p.frequency > 0.03)
        places.push_back(p);
    }
  return places;
}

// With another speed or another drag, so that the pair's growth rate is `growth`.
Study with_growth(const CurvePoint& p, double growth) {
  const auto rate = [&](double speed, double drag) {
    const auto spectrum = balance_spectrum(at(speed, drag));
    return nearest_pair(spectrum->rates, {0.0, p.frequency * p.frequency, {}})->mean;
  };
  constexpr double step = 1e-6;
  const double by_speed = (rate(p.x + step, p.y) - rate(p.x - step, p.y)) / (2.0 * step);
  const double by_drag = (rate(p.x, p.y + step) - rate(p.x, p.y - step)) / (2.0 * step);
  double speed = p.x, drag = p.y;
  for (int k = 0; k < 40; ++k) {
    const double missing = (growth - rate(speed, drag)) / (by_speed * by_speed + by_drag * by_drag);
    speed += missing * by_speed;
    drag += missing * by_drag;
  }
  EXPECT_NEAR(rate(speed, drag), growth, 1e-9);
  return at(speed, drag);
}

TEST(Chart, BeyondASoftLossTheBallsSwingAsTheCoefficientSays) {
  const std::vector<CurvePoint> places = places_of_loss(true);
  ASSERT_GE(places.size(), 4u);
  for (std::size_t k = 1; k < places.size(); k += places.size() / 3) {
    const CurvePoint& p = places[k];
    double last = 0.0;
    const double slow = 0.1 * p.frequency * p.frequency;  // slow next to the swing, and next to what bends it
    for (const double growth : {slow, 0.25 * slow}) {
      const Study study = with_growth(p, growth);
      const double expected = std::sqrt(-growth / p.lyapunov);
      const auto spectrum = balance_spectrum(study);
      const double found = swing_after(study.system(), swung(*spectrum, p.frequency, 0.8 * expected), 5.0 / growth,
                                       2.0 * M_PI / p.frequency);
      const double off = std::fabs(found / expected - 1.0);
      EXPECT_LT(off, growth == slow ? 0.2 : 0.06) << p.x << " " << p.y << " swings " << found << ", not " << expected;
      // What the normal form leaves out is of the order of the square of the swing: a quarter.
      if (last > 0.02) {
        EXPECT_LT(off, 0.5 * last) << p.x << " " << p.y;
      }
      last = off;
    }
  }
}

// Whether, swung from balance by this amplitude, the balls come to swing twice as much before they swing half as much.
bool swings_more(const BalanceSpectrum& spectrum, double frequency, double amplitude) {
  Eigen::VectorXd z = swung(spectrum, frequency, amplitude);
  for (int turn = 0; turn < 3000; ++turn) {
    const double swing = swing_after(spectrum.system, z, 0.0, 2.0 * M_PI / frequency);
    if (swing > 2.0 * amplitude) return true;
    if (swing < 0.5 * amplitude) return false;
    z = advance_state(spectrum.system, z, 20.0 * M_PI / frequency).value();
  }
  ADD_FAILURE() << "neither";
  return false;
}

TEST(Chart, BesideAnAbruptLossAPushDecidesAndNoSmallSwingIsLeft) {
  const std::vector<CurvePoint> places = places_of_loss(false);
  ASSERT_GE(places.size(), 2u);
  for (const CurvePoint& p : {places.front(), places[places.size() / 2]}) {
    constexpr double growth = 5e-4;
    const double edge = std::sqrt(growth / p.lyapunov);
    const auto before = balance_spectrum(with_growth(p, -growth)), beyond = balance_spectrum(with_growth(p, growth));
    EXPECT_FALSE(swings_more(*before, p.frequency, 0.8 * edge)) << p.x << " " << p.y;
    EXPECT_TRUE(swings_more(*before, p.frequency, 1.25 * edge)) << p.x << " " << p.y;
    EXPECT_TRUE(swings_more(*beyond, p.frequency, 0.2 * edge)) << p.x << " " << p.y;
    EXPECT_TRUE(swings_more(*beyond, p.frequency, edge)) << p.x << " " << p.y;
  }
}

TEST(Chart, TheLineWhereBalanceEndsIsWhereTheBallsJustReach) {
  ChartSettings settings = over_speed_and_drag(0.5, 4.0, 0.0, 0.2, 64);
  settings.y.key = "rotor.eccentricity";
  const BifurcationChart chart = balance_chart(chart_rotor(2.4, 0.05), settings);
  int ends = 0;
  for (const ChartCurve& curve : chart.curves)
    if (curve.kind == CurveKind::existence) {
      ++ends;
      for (const CurvePoint& p : curve.points) EXPECT_NEAR(p.y, 0.1, 1e-11);  // two balls of 0.05
      EXPECT_EQ(curve.ends, (std::array{CurveEnd::plane, CurveEnd::plane}));
    }
  EXPECT_EQ(ends, 1);
  int met = 0;
  for (const SpecialPoint& p : chart.specials)
    if (p.kind == SpecialKind::zero_hopf) {
      ++met;
      EXPECT_NEAR(p.y, 0.1, 1e-11);
      EXPECT_GT(p.frequency, 0.1);
      // Close to it the pair hardly grows, and a real eigenvalue is small.
      Study study = chart_rotor(p.x, 0.05);
      study.parameters.eccentricity = 0.1 * (1.0 - 1e-8);
      const auto spectrum = balance_spectrum(study);
      EXPECT_NEAR(nearest_pair(spectrum->rates, {0.0, p.frequency * p.frequency, {}})->mean, 0.0, 1e-4);
    }
  EXPECT_GE(met, 1);
  // At the critical speed of the rotor with its balls, 1/sqrt(1.1), the frequency is 0 where balance ends.
  EXPECT_TRUE(std::any_of(chart.specials.begin(), chart.specials.end(), [](const SpecialPoint& p) {
    return p.kind == SpecialKind::bogdanov_takens && std::fabs(p.x - 1.0 / std::sqrt(1.1)) < 1e-6 &&
           std::fabs(p.y - 0.1) < 1e-9;
  }));
  EXPECT_TRUE(holds(chart_answer(chart), "all balls are in line"));
  EXPECT_FALSE(holds(chart_answer(wide_chart()), "all balls are in line"));
}

TEST(Chart, TheProvedBoxesCoverThePlaneAndAgreeWithEigenvalues) {
  const BifurcationChart& chart = wide_chart();
  ASSERT_TRUE(chart.not_proved.empty());
  double sum = 0.0;
  for (const BalanceKind kind : {BalanceKind::open, BalanceKind::none, BalanceKind::stable, BalanceKind::unstable})
    sum += chart.proved(kind);
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_LE(chart.proved(BalanceKind::open), 0.01);
  EXPECT_GT(chart.proved(BalanceKind::stable), 0.8);
  EXPECT_GT(chart.proved(BalanceKind::unstable), 0.1);
  std::mt19937 random(11);
  std::uniform_real_distribution<> part(0.0, 1.0);
  for (int k = 0; k < 4000; ++k) {
    const ProofBox& box =
        chart.boxes[std::min(static_cast<std::size_t>(part(random) * chart.boxes.size()), chart.boxes.size() - 1)];
    if (box.kind == BalanceKind::open) continue;
    const double x = box.x[0] + part(random) * (box.x[1] - box.x[0]),
                 y = box.y[0] + part(random) * (box.y[1] - box.y[0]);
    EXPECT_EQ(static_cast<int>(balance_at(at(x, y)).kind), static_cast<int>(box.kind)) << x << " " << y;
  }
  // No box that a curve of lost stability passes through is decided.
  for (const ChartCurve& curve : chart.curves)
    for (std::size_t k = 0; k < curve.points.size(); k += 7) {
      const CurvePoint& p = curve.points[k];
      if (p.others > 0) continue;
      for (const ProofBox& box : chart.boxes)
        if (box.x[0] < p.x && p.x < box.x[1] && box.y[0] < p.y && p.y < box.y[1]) {
          EXPECT_EQ(box.kind, BalanceKind::open) << p.x << " " << p.y;
        }
    }
}

TEST(Chart, BoxesWhereTheBallsCannotReachAreProvedToHaveNoBalance) {
  ChartSettings settings = over_speed_and_drag(1.0, 4.0, 0.02, 0.2, 8, 50000);
  settings.y.key = "rotor.eccentricity";
  const BifurcationChart chart = bifurcation_chart(chart_rotor(2.4, 0.05), settings);
  EXPECT_NEAR(chart.proved(BalanceKind::none), 5.0 / 9.0, 0.01);
  for (const ProofBox& box : chart.boxes)
    if (box.kind == BalanceKind::none) {
      EXPECT_GE(box.y[0], 0.1 - 1e-12);
    }
}

TEST(BalanceBoxes, ThePolynomialHasTheEigenvaluesAsZeros) {
  std::mt19937 random(5);
  const auto drawn = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  int tried = 0;
  for (int k = 0; k < 150; ++k) {
    Study study = chart_rotor(drawn(0.3, 6.0), drawn(0.001, 1.0));
    model::Parameters& p = study.parameters;
    p.eccentricity = drawn(0.001, 0.12);
    p.mass = {drawn(0.01, 0.06), drawn(0.01, 0.06)};
    p.damping.fill(drawn(0.01, 1.0));
    p.stiffness.fill(drawn(0.5, 2.0));
    const double speed = study.speed.speed;
    const BoxRotor rotor{speed, p.damping[0], p.stiffness[0], p.drag[0], p.eccentricity, {p.mass[0], p.mass[1]}};
    const auto spectrum = balance_spectrum(study);
    EXPECT_EQ(judge_box(rotor) == BalanceKind::none, !spectrum);
    if (!spectrum) continue;
    ++tried;
    const auto coefficient = balance_polynomial(rotor);
    for (const std::complex<double>& rate : spectrum->rates) {
      std::complex<double> value = 0.0;
      double size = 0.0;
      for (int power = 8; power >= 0; --power) {
        value = value * rate / speed + coefficient[power].centre;
        size = size * std::abs(rate) / speed + std::fabs(coefficient[power].centre);
      }
      EXPECT_LT(std::abs(value), 1e-9 * size);  // an eigenvalue's error times the slope
    }
    const BalanceKind judged = judge_box(rotor);
    if (judged != BalanceKind::open) {
      EXPECT_EQ(judged == BalanceKind::stable, spectrum->unstable() == 0);
    }
  }
  EXPECT_GT(tried, 30);
}

TEST(Chart, SaysHowBalanceIsLost) {
  const auto answer = [](double x0, double x1, double y0, double y1) {
    return chart_answer(bifurcation_chart(chart_rotor(2.4, 0.05), over_speed_and_drag(x0, x1, y0, y1)));
  };
  const std::string both = chart_answer(wide_chart());
  EXPECT_TRUE(holds(both, "softly along")) << both;
  EXPECT_TRUE(holds(both, "abruptly")) << both;
  EXPECT_TRUE(holds(both, "Proved by interval arithmetic: stable all over")) << both;
  const std::string soft = answer(0.5, 1.5, 0.3, 1.0);
  EXPECT_TRUE(holds(soft, "does so softly")) << soft;
  EXPECT_FALSE(holds(soft, "abruptly")) << soft;
  EXPECT_FALSE(holds(soft, "Proved")) << soft;
  const std::string none = answer(4.0, 6.0, 0.2, 1.0);
  EXPECT_TRUE(holds(none, "No line on which a stable balance loses its stability")) << none;
  EXPECT_FALSE(holds(both, "No line")) << both;
}

// Every point of a curve of balance has a pair on the imaginary axis; what it loses is told.
void has_a_line_of_loss(const BifurcationChart& chart, int fewest) {
  int compared = 0;
  for (const ChartCurve& curve : chart.curves)
    for (std::size_t k = 0; curve.kind == CurveKind::hopf && k < curve.points.size(); k += 5) {
      const CurvePoint& p = curve.points[k];
      const auto spectrum = balance_spectrum(at(p.x, p.y));
      EXPECT_NEAR(nearest_pair(spectrum->rates, {0.0, p.frequency * p.frequency, {}})->mean, 0.0, 1e-10);
      ++compared;
    }
  EXPECT_GE(compared, fewest);
  EXPECT_FALSE(holds(chart_answer(chart), "No line on which")) << chart_answer(chart);
}

TEST(Chart, FindsTheLineNextToTheStudyThatLiesBelowTheGrid) {
  // Drags of the grid are 1.25 and more; the study is stable and loses that with a smaller speed.
  const BifurcationChart chart = balance_chart(chart_rotor(2.4, 0.05), over_speed_and_drag(1.6, 3.0, 0.0, 10.0, 4));
  ASSERT_EQ(chart.plane.count(BalanceKind::stable), chart.plane.points.size());
  has_a_line_of_loss(chart, 10);
  bool next_to_own = false;
  for (const BalanceBoundary& b : chart.plane.own->boundaries)
    for (const ChartCurve& curve : chart.curves)
      for (const CurvePoint& p : curve.points)
        next_to_own = next_to_own || (b.along_x && std::fabs(p.x - b.value) < 0.01 && std::fabs(p.y - 0.05) < 0.1);
  EXPECT_TRUE(next_to_own);
}

TEST(Chart, FindsTheLineBetweenBoxesProvedStableAndUnstable) {
  // The study's own values lie outside the plane.
  const BifurcationChart chart =
      balance_chart(chart_rotor(8.0, 0.05), over_speed_and_drag(1.0, 3.0, 0.0, 10.0, 4, 20000));
  ASSERT_EQ(chart.plane.count(BalanceKind::stable), chart.plane.points.size());
  EXPECT_GT(chart.proved(BalanceKind::unstable), 0.0);
  has_a_line_of_loss(chart, 10);
  EXPECT_TRUE(holds(chart_answer(chart), "stable at every point of the grid")) << chart_answer(chart);
}

TEST(Chart, SaysWhyNothingIsProved) {
  const ChartSettings settings = over_speed_and_drag(1.0, 4.0, 0.02, 0.2, 6, 1000);
  const Study four = parse_study(with(constant_speed, "balls = 2\nmass = 0.05", "balls = 4\nmass = 0.02"), "rotor");
  const BifurcationChart chart = bifurcation_chart(four, settings);
  EXPECT_TRUE(chart.boxes.empty());
  EXPECT_TRUE(holds(result_text(chart), "Nothing is proved: proofs are of two balls"));
  const bool lost = balance_loss(chart).unknown > 0.0;
  EXPECT_EQ(lost, holds(chart_answer(chart), "states that form a continuum")) << chart_answer(chart);
  EXPECT_FALSE(holds(result_text(wide_chart()), "Nothing is proved"));
  const Study machine = parse_study(constant_machine, "machine");
  ChartSettings by_unbalance = over_speed_and_drag(1.0, 4.0, 0.001, 0.01, 6, 1000);
  by_unbalance.y.key = "rotor.eccentricity";
  EXPECT_TRUE(holds(result_text(bifurcation_chart(machine, by_unbalance)), "Nothing is proved") ||
              !bifurcation_chart(machine, by_unbalance).boxes.empty());
}

TEST(Chart, SaysWhichCurvesEndInsideThePlaneForNoReason) {
  BifurcationChart chart = wide_chart();
  EXPECT_FALSE(holds(result_text(chart), "end inside the plane"));
  chart.curves[1].ends[0] = CurveEnd::lost;
  EXPECT_TRUE(holds(result_text(chart), "because no next point was found, by number: 2."));
}

TEST(Chart, SaysWhetherMoreBoxesWouldDecideMore) {
  const auto text = [](std::uint64_t boxes) {
    return result_text(bifurcation_chart(chart_rotor(2.4, 0.05), over_speed_and_drag(1.0, 4.0, 0.02, 0.2, 6, boxes)));
  };
  EXPECT_TRUE(holds(text(50), "More boxes"));
  EXPECT_FALSE(holds(text(100000), "More boxes"));
  EXPECT_FALSE(holds(text(0), "More boxes"));
}

TEST(Chart, SaysWhatLinearTheoryLeavesOut) {
  const ChartSettings settings = over_speed_and_drag(1.0, 4.0, 0.02, 0.2, 6, 100);
  const Study sticky = parse_study(with(constant_speed, "balls = 2", "balls = 2\nstiction = 0.001"), "rotor");
  const BifurcationChart chart = bifurcation_chart(sticky, settings);
  EXPECT_TRUE(holds(result_text(chart), "At all points dry friction is left out."));
  EXPECT_TRUE(holds(result_text(chart), "Nothing is proved"));
  EXPECT_FALSE(holds(result_text(wide_chart()), "left out"));
}

TEST(Chart, RotorsWithoutCurvesAreRefused) {
  const ChartSettings settings = over_speed_and_drag(1.0, 4.0, 0.02, 0.2, 4);
  for (const auto& [from, to] : {std::pair{"damping = 0.5", "damping = 0.5\ngravity = 0.01"},
                                 {"damping = 0.5", "damping = [0.5, 0.4]"},
                                 {"balls = 2", "balls = 2\nrace_offset = [0.002, 0.001]"}})
    EXPECT_THROW(bifurcation_chart(parse_study(with(constant_speed, from, to), "rotor"), settings), InputError) << to;
}

TEST(Chart, AStoppedChartIsPartialAndThreadsMakeNoDifference) {
  const StopFlag stop{true};
  ChartSettings settings = over_speed_and_drag(1.0, 4.0, 0.02, 0.2, 12, 2000);
  settings.stop = &stop;
  const BifurcationChart stopped = bifurcation_chart(chart_rotor(2.4, 0.05), settings);
  EXPECT_TRUE(holds(result_text(stopped), "PARTIAL"));
  EXPECT_TRUE(chart_csv(stopped).starts_with("# equipoise ")) << chart_csv(stopped);
  EXPECT_TRUE(holds(chart_csv(stopped), ", PARTIAL: stopped early\ncurve,kind"));
  EXPECT_TRUE(holds(result_svg(stopped, "rotor"), "PARTIAL: stopped early"));
  settings.stop = nullptr;
  settings.threads = 1;
  const BifurcationChart one = bifurcation_chart(chart_rotor(2.4, 0.05), settings);
  settings.threads = 3;
  const BifurcationChart three = bifurcation_chart(chart_rotor(2.4, 0.05), settings);
  EXPECT_FALSE(holds(result_text(one) + chart_csv(one) + result_svg(one, "rotor"), "PARTIAL"));
  EXPECT_EQ(chart_csv(one), chart_csv(three));
  EXPECT_EQ(chart_answer(one), chart_answer(three));
}

TEST(Chart, ThePictureNamesWhatItShows) {
  const std::string picture = result_svg(wide_chart(), "rotor");
  for (const char* words : {"balance is lost softly", "balance is lost abruptly", "proved: stable", "proved: unstable",
                            "not decided", "where curves change their kind"})
    EXPECT_TRUE(holds(picture, words)) << words;
  EXPECT_FALSE(holds(picture, "balance ends"));
}

}  // namespace chart_test
}  // namespace equipoise
