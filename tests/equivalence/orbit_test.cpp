// Periodic orbits, equilibria and exponents against figures recorded with an earlier, independent code
// (two balls, mu = 0.05 each, lambda = 0.01, zeta = 0.5, beta = 0.05 unless said).
#include "equipoise/attractors/periodic_orbits/orbit.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "../support/parameters.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace orbit_test {

using Eigen::VectorXd;
using equipoise::advance_state;
using equipoise::Equilibrium;
using equipoise::PeriodicOrbit;
using equipoise::refine_equilibrium;
using equipoise::refine_orbit;
using equipoise::two_pi;
namespace model = equipoise::model;
using Found = std::optional<PeriodicOrbit>;

model::Parameters rotor(int balls = 2, double drag = 0.05, double total_mass = 0.1) {
  return equipoise::base_rotor(balls, drag, total_mass / balls);
}

// State after `time` of the trajectory from a centred rotor with resting balls.
VectorXd settled(const model::Parameters& p, double speed, std::array<double, model::max_balls> phi, double time) {
  return *advance_state({p, speed}, model::centred_state(p, phi.data()), time);
}

// Time in which `ball` makes a whole turn.
double turn_time(const model::Parameters& p, double speed, VectorXd z, int ball) {
  const double from = z[model::index::phi(ball)], step = 0.02;
  double t = 0.0;
  for (; t < 50.0 && std::fabs(z[model::index::phi(ball)] - from) < two_pi; t += step)
    z = *advance_state({p, speed}, z, step);
  return t;
}

// Both balls in one place: the diagonal of equal ball angles is invariant and ends on this orbit for W < 4.4.
Found coincident(double speed) {
  const model::Parameters p = rotor();
  const VectorXd z = settled(p, speed, {1.0, 1.0}, 400.0);
  return refine_orbit({p, speed}, {z}, turn_time(p, speed, z, 0));
}

// One ball captured, the other lagging, at W = 3.4: where this start ends.
constexpr double captured_speed = 3.4;
Found captured() {
  const model::Parameters p = rotor();
  const VectorXd z = settled(p, captured_speed, {2.049, 1.781}, 1500.0);
  return refine_orbit({p, captured_speed}, {z}, turn_time(p, captured_speed, z, 1));
}

// The same orbit at another speed, each from the one before. Empty once one is not found.
Found continued(Found orbit, double from, double to, double longest_step) {
  const int steps = static_cast<int>(std::ceil(std::fabs(to - from) / longest_step - 1e-9));
  for (int k = 1; k <= steps && orbit; ++k)
    orbit = refine_orbit({rotor(), from + (to - from) * k / steps}, orbit->nodes, orbit->period);
  return orbit;
}

struct Range {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
};

Range radii(double speed, const PeriodicOrbit& orbit) {
  Range range;
  for (const VectorXd& z : equipoise::sample_orbit({rotor(), speed}, orbit, 2000)) {
    range.smallest = std::min(range.smallest, std::hypot(z[0], z[1]));
    range.largest = std::max(range.largest, std::hypot(z[0], z[1]));
  }
  return range;
}

// Recorded figures are rounded: half a unit of the last place, and a little more for those with a digit cut off.
constexpr double last_place = 0.6;

void expect_shape(const Found& orbit, double speed, double period, double period_digit, double r_min, double r_max) {
  ASSERT_TRUE(orbit) << speed;
  EXPECT_NEAR(orbit->period, period, last_place * period_digit) << speed;
  const Range r = radii(speed, *orbit);
  EXPECT_NEAR(r.smallest, r_min, last_place * 1e-4) << speed;
  EXPECT_NEAR(r.largest, r_max, last_place * 1e-4) << speed;
  EXPECT_LT(orbit->residual, 1e-12) << speed;  // rounding of angles of some turns, a few arcs' worth
  EXPECT_NEAR(std::abs(orbit->multipliers[0] - 1.0), 0.0, 1e-11) << speed;  // steps of 1e-12
}

TEST(CoincidentOrbit, HasTheRecordedShapeAndObeysTheTransverseLaw) {
  struct Row {
    double speed, period, r_min, r_max, multiplier;
  };
  for (const Row& row : {Row{2.0, 5.1933, .1107, .1369, .8782}, Row{2.2, 4.5075, .1196, .1435, .8934},
                         Row{2.4, 3.9785, .1282, .1493, .9053}, Row{3.0, 2.9361, .1466, .1691, .9292},
                         Row{3.2, 2.6993, .1520, .1749, .9347}, Row{3.4, 2.4978, .1573, .1801, .9395},
                         Row{4.4, 1.8222, .1792, .2015, .9555}}) {
    const Found orbit = row.speed > 4.0 ? continued(coincident(3.4), 3.4, row.speed, 0.1) : coincident(row.speed);
    expect_shape(orbit, row.speed, row.period, 1e-4, row.r_min, row.r_max);
    if (!orbit) continue;
    EXPECT_EQ(orbit->winding[0], -1);
    EXPECT_EQ(orbit->winding[1], -1);
    EXPECT_TRUE(orbit->stable());
    EXPECT_NEAR(std::abs(orbit->multipliers[1]), row.multiplier, last_place * 1e-4);
    // A small distance delta of the balls obeys delta'' + beta delta' + k(t) delta = 0.
    for (int k : {1, 2})
      EXPECT_NEAR(std::abs(orbit->multipliers[k]), std::exp(-0.5 * 0.05 * orbit->period), 1e-11);  // steps
    if (row.speed == 2.4) {
      EXPECT_NEAR(orbit->multipliers[1].real(), .574, last_place * 1e-3);
      EXPECT_NEAR(orbit->multipliers[1].imag(), .700, last_place * 1e-3);
      EXPECT_NEAR(std::abs(orbit->multipliers[3]), .542, last_place * 1e-3);
      EXPECT_NEAR(std::abs(orbit->multipliers[5]), .397, last_place * 1e-3);
    }
  }
}

TEST(CoincidentOrbit, LosesStabilityInAPitchforkBetween440And450) {
  const Found orbit = continued(coincident(3.4), 3.4, 4.5, 0.1);
  expect_shape(orbit, 4.5, 1.7752, 1e-4, .1809, .2031);
  ASSERT_TRUE(orbit);
  EXPECT_FALSE(orbit->stable());
  EXPECT_NEAR(orbit->multipliers[1].real(), 1.10, last_place * 1e-2);
  EXPECT_EQ(orbit->multipliers[1].imag(), 0.0);
  EXPECT_NEAR((orbit->multipliers[1] * orbit->multipliers[2]).real(), std::exp(-0.05 * orbit->period), 1e-11);  // steps
}

// One ball of the whole mass has the same motion; so do four or eight in one place, with more transverse pairs.
TEST(CoincidentOrbit, IsOneForEveryNumberOfBalls) {
  const double speed = 2.4;
  const Found two = coincident(speed);
  ASSERT_TRUE(two);
  for (int n : {1, 4, 8}) {
    const model::Parameters p = rotor(n);
    std::array<double, model::max_balls> phi;
    phi.fill(1.0);
    const VectorXd z = settled(p, speed, phi, 300.0);
    const Found orbit = refine_orbit({p, speed}, {z}, turn_time(p, speed, z, 0));
    ASSERT_TRUE(orbit) << n;
    EXPECT_NEAR(orbit->period, two->period, 1e-10);  // steps of 1e-12 over a period
    for (int k = 1; k <= 2 * (n - 1); ++k) EXPECT_NEAR(std::abs(orbit->multipliers[k]), .90532, 1e-5);
    for (int k = 1; k <= 5; ++k)
      EXPECT_NEAR(std::abs(orbit->multipliers[2 * (n - 1) + k]), std::abs(two->multipliers[2 + k]), 1e-9);
  }
}

TEST(CapturedOrbit, HasTheRecordedShapeAndMultipliers) {
  struct Row {
    double speed, period, period_digit, r_min, r_max, first, first_digit, next, next_digit;
  };
  const Found seed = captured();
  ASSERT_TRUE(seed);
  for (const Row& row : {Row{2.95, 4.541, 1e-3, .0131, .1168, .880, 1e-3, .877, 1e-3},
                         Row{3.0, 4.6501, 1e-4, .0101, .1140, .8808, 1e-4, .8297, 1e-4},
                         Row{3.4, 4.6893, 1e-4, .0045, .1069, .8754, 1e-4, .6689, 1e-4},
                         Row{4.0, 4.2201, 1e-4, .0144, .0985, .9049, 1e-4, .6571, 1e-4},
                         Row{4.4, 3.9944, 1e-4, .0142, .0902, .9209, 1e-4, .7002, 1e-4},
                         Row{5.0, 3.6630, 1e-4, .0118, .0859, .9419, 1e-4, .6857, 1e-4},
                         Row{6.0, 3.1658, 1e-4, .0100, .0846, .9541, 1e-4, .7010, 1e-4}}) {
    const Found orbit = continued(seed, captured_speed, row.speed, row.speed < 3.0 ? 0.05 : 0.2);
    expect_shape(orbit, row.speed, row.period, row.period_digit, row.r_min, row.r_max);
    if (!orbit) continue;
    EXPECT_EQ(orbit->winding[0], 0);
    EXPECT_EQ(orbit->winding[1], -1);
    EXPECT_TRUE(orbit->stable());
    EXPECT_NEAR(std::abs(orbit->multipliers[1]), row.first, last_place * row.first_digit);
    EXPECT_NEAR(std::abs(orbit->multipliers[3]), row.next, last_place * row.next_digit);
    if (row.speed == 3.0) {
      EXPECT_NEAR(orbit->multipliers[1].real(), .607, last_place * 1e-3);
      EXPECT_NEAR(orbit->multipliers[1].imag(), .638, last_place * 1e-3);
    }
    if (row.speed == 4.4) {
      EXPECT_NEAR(orbit->multipliers[1].real(), -.168, last_place * 1e-3);
      EXPECT_NEAR(orbit->multipliers[1].imag(), .906, last_place * 1e-3);
    }
  }
  const Found far = continued(seed, captured_speed, 6.5, 0.2);
  ASSERT_TRUE(far);
  EXPECT_TRUE(far->stable());
}

TEST(CapturedOrbit, HasAnExchangeCopy) {
  const model::Parameters p = rotor();
  const Found orbit = captured();
  ASSERT_TRUE(orbit);
  std::vector<VectorXd> exchanged = orbit->nodes;
  for (VectorXd& z : exchanged) {
    std::swap(z[4], z[5]);
    std::swap(z[6], z[7]);
  }
  const Found copy = refine_orbit({p, captured_speed}, {exchanged}, orbit->period);
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->winding[0], -1);
  EXPECT_EQ(copy->winding[1], 0);
  EXPECT_NEAR(copy->period, orbit->period, 1e-10);  // both to steps of 1e-12
}

// How far down an orbit can be continued, and its leading multiplier there.
struct Fold {
  double speed;
  std::complex<double> multiplier;
};
Fold fold_below(Found orbit, double speed, double step) {
  while (step > 1e-6) {
    const Found next = refine_orbit({rotor(), speed - step}, orbit->nodes, orbit->period);
    if (next) {
      orbit = next;
      speed -= step;
    } else {
      step *= 0.5;
    }
  }
  return {speed, orbit->multipliers[1]};
}

TEST(CapturedOrbit, IsBornInASaddleNodeBetween290And295) {
  const Found orbit = continued(captured(), captured_speed, 2.95, 0.05);
  ASSERT_TRUE(orbit);
  const Fold fold = fold_below(orbit, 2.95, 0.01);
  EXPECT_NEAR(fold.speed, 2.90434, 1e-5);            // recorded by this code: where its own last step failed
  EXPECT_LT(std::abs(fold.multiplier - 1.0), 0.01);  // falls like the square root of the distance, here 0.6 times it
}

TEST(PeriodFourOrbit, IsWhereThreeRecordedStartsEnd) {
  const model::Parameters p = rotor();
  for (const auto& phi : {std::array{5.54933, 5.46019}, std::array{1.17174, 1.00534}, std::array{.84736, .92647}}) {
    // The slowest rate is -0.00061: after 6000 units the remainder of a deviation of 1 is small enough for a good
    // guess.
    const VectorXd z = settled(p, 4.4, {phi[0], phi[1]}, 6000.0);
    const Found orbit = refine_orbit({p, 4.4}, {z}, 16.25);
    ASSERT_TRUE(orbit);
    EXPECT_NEAR(orbit->period, 16.2484, last_place * 1e-4);
    EXPECT_EQ(std::min(orbit->winding[0], orbit->winding[1]), -4);
    EXPECT_EQ(std::max(orbit->winding[0], orbit->winding[1]), 0);
    const Range r = radii(4.4, *orbit);
    EXPECT_NEAR(r.smallest, .002, last_place * 1e-3);
    EXPECT_NEAR(r.largest, .1036, last_place * 1e-4);
    const int held = orbit->winding[0] == 0 ? 0 : 1;
    double slowest = 0.0, fastest = 0.0;
    for (const VectorXd& state : equipoise::sample_orbit({p, 4.4}, *orbit, 500)) {
      slowest = std::min(slowest, state[model::index::q(held, 2)]);
      fastest = std::max(fastest, state[model::index::q(held, 2)]);
    }
    EXPECT_NEAR(slowest, -.66, last_place * 1e-2);
    EXPECT_NEAR(fastest, .54, last_place * 1e-2);
    EXPECT_TRUE(orbit->stable());
    EXPECT_NEAR(orbit->multipliers[1].real(), -.877, last_place * 1e-3);
    EXPECT_NEAR(orbit->multipliers[1].imag(), .459, last_place * 1e-3);
    EXPECT_NEAR(std::abs(orbit->multipliers[1]), .9901, last_place * 1e-4);
    EXPECT_LT(std::abs(orbit->multipliers[3]), .052);
  }
}

TEST(PeriodFourOrbit, EndsInASaddleNodeBelowAndAPeriodDoublingAbove) {
  const model::Parameters p = rotor();
  const Found orbit = refine_orbit({p, 4.4}, {settled(p, 4.4, {1.17174, 1.00534}, 6000.0)}, 16.25);
  ASSERT_TRUE(orbit);
  EXPECT_TRUE(continued(orbit, 4.4, 4.285, 0.005));
  EXPECT_FALSE(continued(orbit, 4.4, 4.284, 0.005));
  const Fold fold = fold_below(continued(orbit, 4.4, 4.285, 0.005), 4.285, 1e-4);
  EXPECT_NEAR(fold.speed, 4.28401, 1e-5);            // recorded by this code, as above
  EXPECT_LT(std::abs(fold.multiplier - 1.0), 0.06);  // as above, 30 times the root of up to 2e-6

  const Found before = continued(orbit, 4.4, 4.408, 0.002), after = continued(orbit, 4.4, 4.409, 0.0015);
  ASSERT_TRUE(before && after);
  EXPECT_TRUE(before->stable());
  EXPECT_FALSE(after->stable());
  EXPECT_LT(after->multipliers[1].real(), -1.0);
  EXPECT_EQ(after->multipliers[1].imag(), 0.0);

  // The doubled orbit is another one, and is not taken for two turns of the single one, which at 4.41 leaves like
  // e^{.014 t}.
  const Found single = continued(after, 4.409, 4.41, 0.001);
  ASSERT_TRUE(single);
  VectorXd beside = single->nodes[0];
  beside[model::index::q(0, 2)] += 1e-3;
  const Found doubled = refine_orbit({p, 4.41}, {*advance_state({p, 4.41}, beside, 4000.0)}, 2.0 * single->period);
  ASSERT_TRUE(doubled);
  EXPECT_GT(doubled->period, 1.9 * single->period);
  EXPECT_EQ(doubled->winding[0] + doubled->winding[1], -8);
  EXPECT_TRUE(doubled->stable());
}

TEST(RefineOrbit, ReturnsTheSmallestPeriod) {
  const model::Parameters p = rotor();
  const Found once = captured();
  ASSERT_TRUE(once);
  for (int k : {2, 3, 8, 16}) {
    const Found orbit = refine_orbit({p, captured_speed}, {once->nodes[0]}, k * once->period * 1.0001);
    ASSERT_TRUE(orbit) << k;
    EXPECT_NEAR(orbit->period, once->period, 1e-10);  // both to steps of 1e-12
    EXPECT_EQ(orbit->winding[1], -1);
  }
}

TEST(RefineOrbit, RejectsEquilibria) {
  const model::Parameters p = rotor();
  const auto angles = model::balanced_states(p).angles[0];
  VectorXd z = model::centred_state(p, angles.data());
  EXPECT_FALSE(refine_orbit({p, 2.4}, {z}, 5.0));
  z[0] += 1e-3;
  z[5] += 1e-2;
  EXPECT_FALSE(refine_orbit({p, 2.4}, {z}, 5.0));
}

// Real part of the leading eigenvalue; unit/linearisation_test.cpp has the table of all.
TEST(RefineEquilibrium, FindsBalancedStatesAndTheirStability) {
  struct Row {
    double drag, speed, rate;
  };
  for (const Row& row :
       {Row{.01, 1.5, .02182},  Row{.01, 2.0, .00014},  Row{.01, 2.2, -.00404}, Row{.01, 2.4, -.00411},
        Row{.01, 2.6, -.00415}, Row{.01, 3.0, -.00421}, Row{.01, 4.0, -.00428}, Row{.01, 5.0, -.00431},
        Row{.01, 6.0, -.00433}, Row{.05, 1.5, .00551},  Row{.05, 2.0, -.02113}, Row{.05, 2.2, -.02399},
        Row{.05, 2.4, -.02406}, Row{.05, 2.6, -.02410}, Row{.05, 3.0, -.02416}, Row{.05, 4.0, -.02423},
        Row{.05, 5.0, -.02426}, Row{.05, 6.0, -.02427}, Row{.10, 1.5, -.01399}, Row{.25, 1.5, -.01486},
        Row{.25, 2.0, -.02074}, Row{.25, 2.4, -.02829}, Row{.25, 3.0, -.04471}, Row{.25, 4.0, -.12396}}) {
    const model::Parameters p = rotor(2, row.drag);
    const auto angles = model::balanced_states(p).angles[0];
    const VectorXd exact = model::centred_state(p, angles.data());
    VectorXd guess = exact;
    for (int i = 0; i < guess.size(); ++i) guess[i] += 0.01 * std::sin(1.0 + 2.3 * i);
    const auto found = refine_equilibrium({p, row.speed}, guess);
    ASSERT_TRUE(found) << row.drag << " " << row.speed;
    EXPECT_LT((found->state - exact).cwiseAbs().maxCoeff(), 1e-13);  // residual times the inverse Jacobian
    EXPECT_LT(found->residual, 1e-14 * (1.0 + row.speed * row.speed));
    EXPECT_NEAR(found->eigenvalues[0].real(), row.rate, last_place * 1e-5) << row.drag << " " << row.speed;
    for (int k = 1; k < found->eigenvalues.size(); ++k)
      EXPECT_LE(found->eigenvalues[k].real(), found->eigenvalues[k - 1].real());
  }
}

TEST(RefineEquilibrium, ReachesFamiliesWhereTheJacobianIsSingular) {
  for (int n : {3, 4, 5, 8}) {
    const model::Parameters p = rotor(n);
    std::array<double, model::max_balls> phi{};
    for (int i = 0; i < n; ++i) phi[i] = 0.5 + two_pi * i / n + 0.1 * i;
    ASSERT_TRUE(model::project_to_balanced(p, phi.data()));
    VectorXd guess = model::centred_state(p, phi.data());
    for (int i = 0; i < guess.size(); ++i) guess[i] += 0.02 * std::sin(1.0 + 2.3 * i);
    const auto found = refine_equilibrium({p, 2.4}, guess);
    ASSERT_TRUE(found) << n;
    EXPECT_LT(found->residual, 1e-14 * (1.0 + 2.4 * 2.4));
    // The least step: about as near to the guess as the member of the continuum from which the guess was made.
    EXPECT_LT((found->state - guess).norm(), 1.1 * (guess - model::centred_state(p, phi.data())).norm());
    int zeros = 0;
    for (const auto& value : found->eigenvalues) zeros += std::abs(value) < 1e-12;  // simple, found to rounding
    EXPECT_EQ(zeros, n - 2);
  }
}

}  // namespace orbit_test
