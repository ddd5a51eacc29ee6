// Motions of systems with events: multipliers through impacts by saltation matrices, motions without contact, stuck
// balls.
#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/periodic_orbits/return_map.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace event_motion_test {

using namespace equipoise;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::string rotor = "[rotor]\neccentricity = 0.01\ndamping = 0.5\n";

Study study_of(const std::string& balancer, const std::string& speed, const std::string& more = "") {
  return parse_study(rotor + more + "[balancer]\n" + balancer + "[speed]\n" + speed + "\n", "test");
}

// Free balls at rest in the race, the rotor centred.
VectorXd start(const model::System& system, std::vector<double> phi) {
  VectorXd y = VectorXd::Zero(system.dimension());
  for (int i = 0; i < system.balls(); ++i) y[model::index::phi(i)] = phi[static_cast<std::size_t>(i)];
  return y;
}

// Newton's law of impact on balls 0 and 1 at a prescribed speed, with the mass matrix of docs/explanation/equations.md
// ("Linearisation").
VectorXd struck(const model::Parameters& p, VectorXd z) {
  MatrixXd mass = MatrixXd::Zero(4, 4);
  mass(0, 0) = mass(1, 1) = 1.0 + p.total_mass();
  for (int i : {0, 1}) {
    const double s = p.mass[i] * std::sin(z[4 + i]), c = p.mass[i] * std::cos(z[4 + i]);
    mass(0, 2 + i) = mass(2 + i, 0) = -s;
    mass(1, 2 + i) = mass(2 + i, 1) = c;
    mass(2 + i, 2 + i) = p.mass[i];
  }
  const Eigen::Vector4d w(0.0, 0.0, -1.0, 1.0);
  const Eigen::Vector4d change = mass.inverse() * w;
  const double impulse = -(1.0 + p.restitution) * (z[7] - z[6]) / w.dot(change);
  z[2] += impulse * change[0];
  z[3] += impulse * change[1];
  z.tail(2) += impulse * change.tail(2);
  return z;
}

// How a deviation before the impact of state `z` becomes one after it.
MatrixXd saltation(const model::System& passing, const model::Parameters& p, const VectorXd& z) {
  const Eigen::Index size = z.size();
  MatrixXd reset(size, size);
  constexpr double h = 1e-3;  // its fourth power is rounding
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto at = [&](double shift) {
      VectorXd moved = z;
      moved[k] += shift * h;
      return struck(p, moved);
    };
    reset.col(k) = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
  }
  VectorXd gap = VectorXd::Zero(size);
  gap[4] = -1.0;
  gap[5] = 1.0;
  const VectorXd before = model::rate(passing, z), behind = model::rate(passing, struck(p, z));
  return reset + (behind - reset * before) * gap.transpose() / gap.dot(before);
}

TEST(MultipliersThroughImpacts, AreThoseOfSaltationMatrices) {
  const Study study = study_of("balls = 2\nmass = 0.03\ndrag = [0.05, 0.1]\ncontact_angle = 0.5\n",
                               "profile = \"constant\"\nspeed = 2.0");
  const model::System system = study.system(), passing = without_events(system);
  std::optional<Motion> impacts;
  for (std::uint64_t k = 0; k < 40 && (!impacts || impacts->events.empty()); ++k) {
    VectorXd y = VectorXd::Zero(system.dimension());
    start_angles(7, k, 2, y.data() + model::index::phi(0));
    if (model::least_gap(study.parameters, &y[model::index::phi(0)]) > 0.0) impacts = motion_from(system, y);
  }
  ASSERT_TRUE(impacts && impacts->kind == MotionKind::periodic && impacts->stable);
  ASSERT_EQ(impacts->events.size(), 2U);
  EXPECT_EQ(motion_name(study.parameters, *impacts).name, "pair drift");

  VectorXd z = impacts->state;
  MatrixXd derivative = MatrixXd::Identity(z.size(), z.size());
  double now = 0.0;
  for (const BallEvent& e : impacts->events) {
    EXPECT_EQ(e.kind, BallEventKind::strike);
    const auto flight = follow_derivative(passing, z, e.time - now, 1e-12);
    ASSERT_TRUE(flight);
    // Errors of integration, 1e-12 a step.
    EXPECT_NEAR(std::fabs(wrapped(flight->end[5] - flight->end[4])), study.parameters.contact_angle, 1e-9);
    derivative = saltation(passing, study.parameters, flight->end) * flight->tangents * derivative;
    z = struck(study.parameters, flight->end);
    now = e.time;
  }
  const auto flight = follow_derivative(passing, z, impacts->period - now, 1e-12);
  ASSERT_TRUE(flight);
  derivative = flight->tangents * derivative;
  VectorXd back = flight->end - impacts->state;
  for (int i : {4, 5}) back[i] = wrapped(back[i]);
  EXPECT_LT(back.lpNorm<Eigen::Infinity>(), 1e-8);  // two impacts propagate the errors of integration

  std::vector<std::complex<double>> expected;
  const Eigen::VectorXcd values = equipoise::dense::eigenvalues(derivative);
  expected.assign(values.begin(), values.end());
  // Central differences of the return map: 1e-6 of a derivative of order 1 to 10.
  for (const std::complex<double>& value : impacts->spectrum) {
    double nearest = 1.0;
    for (const auto& e : expected) nearest = std::min(nearest, std::abs(e - value));
    EXPECT_LT(nearest, 1e-5) << value;
  }
  double slowest = 0.0;
  for (const auto& e : expected)
    if (std::abs(e - 1.0) > 1e-4) slowest = std::max(slowest, std::abs(e));
  EXPECT_NEAR(slowest, std::abs(impacts->spectrum[1]), 1e-5);
}

// Where nothing touches, the motion is bit-identical to that of passing balls.
TEST(MotionsWithoutTouch, AreThoseOfPassingBalls) {
  const Study study =
      study_of("balls = 2\nmass = 0.05\ndrag = 0.05\ncontact_angle = 0.3\n", "profile = \"constant\"\nspeed = 2.4");
  const model::System system = study.system();
  const VectorXd y = start(system, {2.4, 3.8});
  const auto motion = motion_from(system, y), passing = motion_from(without_events(system), y);
  ASSERT_TRUE(motion && passing);
  EXPECT_FALSE(motion->eventful);
  EXPECT_EQ(motion_name(study.parameters, *motion).name, motion_name(study.parameters, *passing).name);
  EXPECT_EQ(motion->spectrum.size(), passing->spectrum.size());
  EXPECT_LT((motion->spectrum - passing->spectrum).cwiseAbs().maxCoeff(), 1e-9);  // refined from different states
}

class StuckForGood : public testing::TestWithParam<std::string> {};

// Once balls are said to be stuck, none moves for 3000 units more, some hundred decay times.
TEST_P(StuckForGood, NoBallEverMovesAgain) {
  const std::string motor = "profile = \"torque\"\ninitial = 0.0\ntorque = { constant = 0.3, slope = -0.1 }";
  const std::string constant = "profile = \"constant\"\nspeed = 2.4";
  const std::string which = GetParam();
  const std::string more = which == "gravity" ? "gravity = 0.002\n" : which == "motor" ? "inertia = 0.5\n" : "";
  const Study study = study_of("balls = 2\nmass = 0.05\ndrag = 0.05\nrolling = 1e-3\nstiction = 2e-3\n",
                               which == "motor" ? motor : constant, more);
  const model::System system = study.system();
  const double step = system.section() == model::Section::stroboscopic ? system.section_period() : 3.0;
  int stuck = 0;
  for (std::uint64_t k = 0; k < 24; ++k) {
    VectorXd z = VectorXd::Zero(system.dimension());
    start_angles(7, k, 2, z.data() + model::index::phi(0));
    if (which == "motor") z[system.layout().speed] = 2.8;
    std::optional<StuckEnd> end;
    for (int i = 0; i < 100 && !end; ++i) {
      EventLog log;
      ASSERT_EQ(follow_events(system, z, step, 1e-9, log), IntegrationStatus::done);
      end = stuck_for_good(system, z, 0.0);
    }
    if (!end) continue;
    ++stuck;
    EventLog log;
    VectorXd later = z;
    ASSERT_EQ(follow_events(system, later, step * std::round(3000.0 / step), 1e-9, log), IntegrationStatus::done);
    EXPECT_EQ(log.count, 0) << k;
    // The rotor comes where predicted, up to many times the steps' errors of 1e-9 of the unbalances.
    EXPECT_LT((later - end->state).head(4).lpNorm<Eigen::Infinity>(), 1e-7) << k;
    const Motion motion = describe_stuck(system, *end);
    EXPECT_EQ(motion.balanced, halves_the_shaking(study.parameters, motion.speed, end->r_mean));
    EXPECT_EQ(motion_name(study.parameters, motion).id, motion.balanced ? 1 : 7);
  }
  EXPECT_GE(stuck, 6);
}
INSTANTIATE_TEST_SUITE_P(Of, StuckForGood, testing::Values("constant", "motor", "gravity"),
                         [](const auto& info) { return info.param; });

}  // namespace event_motion_test
