// simulate() against Lagrange's equations in fixed axes, integrated by SUNDIALS (lagrangian.hpp), over 100 time units.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "cases.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "lagrangian.hpp"

namespace inertial_frame_test {

using cases::Case;
using equipoise::Trajectory;
using lagrangian::FixedState;

// Every 0.25, so that all corners and releases but one (12.3) are output times too.
std::vector<double> output_times() {
  std::vector<double> times;
  for (int i = 0; i <= 400; ++i) times.push_back(0.25 * i);
  return times;
}

// Largest difference of one variable and its largest magnitude.
class Deviations {
 public:
  void add(const std::string& variable, double value, double reference) {
    Entry& e = entries_[variable];
    e.difference = std::max(e.difference, std::fabs(value - reference));
    e.magnitude = std::max(e.magnitude, std::fabs(reference));
    finite_ = finite_ && std::isfinite(value) && std::isfinite(reference);
  }
  // Over all variables, relative to each one's largest magnitude.
  double largest(std::string& variable) const {
    double result = 0.0;
    for (const auto& [name, e] : entries_)
      if (e.difference > result * e.magnitude) {
        result = e.difference / e.magnitude;
        variable = name;
      }
    return finite_ ? result : INFINITY;
  }

 private:
  struct Entry {
    double difference = 0.0, magnitude = 0.0;
  };
  std::map<std::string, Entry> entries_;
  bool finite_ = true;
};

Deviations compare(const Trajectory& run, const std::vector<FixedState>& reference,
                   const equipoise::model::Parameters& p) {
  Deviations d;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const FixedState& r = reference[k];
    const double w = run.psi_dot[k], c = std::cos(run.psi[k]), s = std::sin(run.psi[k]);
    const double u = run.x_dot[k] - w * run.y[k], v = run.y_dot[k] + w * run.x[k];
    d.add("psi", run.psi[k], r.rotor.angle);
    d.add("psi'", w, r.rotor.rate);
    d.add("X", run.x[k] * c - run.y[k] * s, r.X);
    d.add("Y", run.x[k] * s + run.y[k] * c, r.Y);
    d.add("X'", u * c - v * s, r.X_dot);
    d.add("Y'", u * s + v * c, r.Y_dot);
    const double sag =
        -(1.0 + p.total_mass()) * p.gravity / p.stiffness[1];  // radial is from where weight alone puts it
    d.add("r", run.radial[k], std::hypot(r.X, r.Y - sag));
    d.add("bearing X", run.bearing_x[k], p.damping[0] * r.X_dot + p.stiffness[0] * r.X);
    d.add("bearing Y", run.bearing_y[k], p.damping[1] * r.Y_dot + p.stiffness[1] * r.Y);
    for (int i = 0; i < p.balls; ++i) {
      const std::string ball = std::to_string(i + 1);
      d.add("phi" + ball, run.phi[i][k], r.theta[i] - r.rotor.angle);
      d.add("theta'" + ball, w + run.phi_dot[i][k], r.theta_dot[i]);
    }
  }
  return d;
}

class InertialFrame : public testing::TestWithParam<Case> {};

TEST_P(InertialFrame, GivesTheSameTrajectory) {
  const Case& c = GetParam();
  const auto times = output_times();
  EXPECT_NEAR(c.study.release_time(), c.release, 1e-13);  // one division and one product away from the table's numbers
  const Trajectory run = equipoise::simulate(c.study, times);
  ASSERT_EQ(run.status, equipoise::IntegrationStatus::done);
  ASSERT_EQ(run.t, times);
  std::string worst;
  const double largest =
      compare(run, lagrangian::integrate(c.study, c.study.release_time(), times), c.study.parameters).largest(worst);
  RecordProperty("largest_relative_difference", fmt::format("{:.2g} in {}", largest, worst));
  // As promised for simulate() at its default tolerance; the reference itself is accurate to 1e-11 (next test).
  EXPECT_LT(largest, 1e-9) << "in " << worst;
}

INSTANTIATE_TEST_SUITE_P(Case, InertialFrame, testing::ValuesIn(cases::all()),
                         [](const auto& info) { return info.param.name; });

TEST(InertialFrameReference, DoesNotChangeWithItsStep) {
  const auto times = output_times();
  for (const Case& c : cases::all()) {
    if (c.name.find("everything_3") == std::string::npos && c.name.find("gravity") == std::string::npos) continue;
    const auto fine = lagrangian::integrate(c.study, c.release, times);
    const auto coarse = lagrangian::integrate(c.study, c.release, times, 1e-12);
    double largest = 0.0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      largest = std::max({largest, std::fabs(fine[k].X - coarse[k].X), std::fabs(fine[k].Y - coarse[k].Y)});
      for (int i = 0; i < c.study.parameters.balls; ++i)
        largest = std::max(largest, std::fabs(fine[k].theta[i] - coarse[k].theta[i]));
    }
    RecordProperty("change_" + c.name, fmt::format("{:.2g}", largest));
    // A hundredth of the 1e-9 that it must judge, although the coarse run's tolerance is fifty times the fine one's.
    EXPECT_LT(largest, 1e-11) << c.name;
  }
}

}  // namespace inertial_frame_test
