// Orders of DOP853's solution, error estimates and dense output by halving the step; exactness on polynomials.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/machine/model/flow-inl.hpp"

namespace convergence_test {

namespace kernels = equipoise::HWY_NAMESPACE;
namespace dop853 = equipoise::HWY_NAMESPACE::dop853;
namespace tableau = equipoise::HWY_NAMESPACE::dop853::tableau;
namespace model = equipoise::model;

template <int dimension>
using State = std::array<double, dimension>;

// Everything one step yields.
template <int dimension>
struct Step {
  State<dimension> end;
  double error5, error3, combined;  // maximum norms of the two estimates; the norm that controls steps
  double rows[7][dimension];
  const State<dimension> begin;

  State<dimension> at(double fraction) const {
    State<dimension> out;
    dop853::dense_state<double, dimension>(fraction, begin.data(), rows, out.data());
    return out;
  }
};

template <int dimension, class System>
Step<dimension> take_step(const System& f, double t, double h, const State<dimension>& y) {
  double k[tableau::dense_stages][dimension], stage[dimension], unit[dimension], error5[dimension], error3[dimension];
  Step<dimension> step{.end = {}, .error5 = 0.0, .error3 = 0.0, .combined = 0.0, .rows = {}, .begin = y};
  std::fill(unit, unit + dimension, 1.0);
  f(t, y.data(), k[0]);
  dop853::evaluate_stages(f, t, h, y.data(), k);
  dop853::step_end(h, y.data(), k, step.end.data(), error5, error3);
  for (int i = 0; i < dimension; ++i) {
    step.error5 = std::max(step.error5, std::fabs(h * error5[i]));
    step.error3 = std::max(step.error3, std::fabs(h * error3[i]));
  }
  step.combined = std::sqrt(dop853::squared_error<double, dimension>(h, error5, error3, unit));
  f(t + h, step.end.data(), k[12]);
  for (int row = 13; row < tableau::dense_stages; ++row) {
    dop853::stage_state(row, h, y.data(), k, stage);
    f(t + tableau::c[row] * h, stage, k[row]);
  }
  dop853::dense_coefficients<double, dimension>(h, y.data(), step.end.data(), k, step.rows);
  return step;
}

template <int dimension, class System>
State<dimension> integrate(const System& f, double begin, double end, int steps, State<dimension> y) {
  const double h = (end - begin) / steps;
  for (int i = 0; i < steps; ++i) y = take_step<dimension>(f, begin + i * h, h, y).end;
  return y;
}

template <std::size_t dimension>
double distance(const State<dimension>& a, const State<dimension>& b) {
  double result = 0.0;
  for (std::size_t i = 0; i < dimension; ++i) result = std::max(result, std::fabs(a[i] - b[i]));
  return result;
}

// A nonlinear, non-autonomous system with a closed-form solution.
struct Known {
  void operator()(double t, const double* y, double* dy) const {
    dy[0] = 2.0 * t * std::pow(y[1], 0.2) * y[3];
    dy[1] = 10.0 * t * std::exp(5.0 * (y[2] - 1.0)) * y[3];
    dy[2] = 2.0 * t * y[3];
    dy[3] = -2.0 * t * std::log(y[0]);
  }
  static State<4> solution(double t) {
    const double s = std::sin(t * t);
    return {std::exp(s), std::exp(5.0 * s), s + 1.0, std::cos(t * t)};
  }
};

// Two balls on anisotropic supports, under gravity, at a changing speed.
struct Balancer {
  using Flow = kernels::FreeFlow<double, 2, kernels::Terms{}>;
  Balancer() : flow(parameters(), {0.0, 100.0, 0.2, 1.7, 0.03, false}) {}
  void operator()(double t, const double* z, double* dz) const { flow(t, z, dz); }
  static model::Parameters parameters() {
    model::Parameters p;
    p.mass = {0.05, 0.04};
    p.drag = {0.1, 0.2};
    p.stiffness = {1.0, 1.3};
    p.gravity = 0.05;
    return p;
  }
  static State<8> start() { return {0.05, -0.03, 0.1, 0.02, 0.4, 2.1, 0.3, -0.2}; }
  Flow flow;
};

// log2 of the ratio of each error to the next, which has half the step.
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) result.push_back(std::log2(errors[i] / errors[i + 1]));
  return result;
}

// Bands are at most half an order wide, so that neighbouring orders are distinguished at the steps that doubles allow.
void expect_orders(const std::string& what, const std::vector<double>& errors, double order, double below,
                   double above) {
  for (double measured : orders(errors)) {
    EXPECT_GT(measured, order - below) << fmt::format("errors {}", fmt::join(errors, " "));
    EXPECT_LT(measured, order + above) << fmt::format("errors {}", fmt::join(errors, " "));
  }
  testing::Test::RecordProperty("orders_of_" + what, fmt::format("{:.2f}", fmt::join(orders(errors), " ")));
}

TEST(Dop853, HasASolutionOfOrder8OnAKnownProblem) {
  std::vector<double> errors;
  for (int steps : {8, 16, 32})
    errors.push_back(distance(integrate<4>(Known{}, 0.5, 1.5, steps, Known::solution(0.5)), Known::solution(1.5)));
  expect_orders("solution", errors, 8.0, 0.4, 0.4);  // finer steps would meet rounding, 1e-13 for states of 150
}

TEST(Dop853, HasASolutionOfOrder8OnTheBalancer) {
  const Balancer f;
  const auto reference = integrate<8>(f, 0.0, 12.0, 800, Balancer::start());
  std::vector<double> errors;
  for (int steps : {32, 64, 128})
    errors.push_back(distance(integrate<8>(f, 0.0, 12.0, steps, Balancer::start()), reference));
  expect_orders("solution", errors, 8.0, 0.5, 0.5);
}

TEST(Dop853, HasErrorEstimatesOfOrders5And3ThatCombineTo8) {
  const Balancer f;
  std::vector<double> error5, error3, combined;
  for (double h : {0.2, 0.1, 0.05}) {
    const auto step = take_step<8>(f, 0.0, h, Balancer::start());
    error5.push_back(step.error5);
    error3.push_back(step.error3);
    combined.push_back(step.combined);
  }
  // Local errors have one more power of h than the order. The step controller relies on h^8 for the combination.
  expect_orders("error5", error5, 6.0, 0.3, 0.3);
  expect_orders("error3", error3, 4.0, 0.3, 0.3);
  expect_orders("combined", combined, 8.0, 0.5, 0.5);
}

TEST(Dop853, OverestimatesTheErrorOfAStep) {
  for (double h : {0.1, 0.05}) {
    const auto step = take_step<4>(Known{}, 0.7, h, Known::solution(0.7));
    EXPECT_GT(step.combined, distance(step.end, Known::solution(0.7 + h)));
  }
}

TEST(Dop853, HasDenseOutputOfOrder7) {
  const auto largest = [](double h) {
    const auto step = take_step<4>(Known{}, 0.7, h, Known::solution(0.7));
    double error = 0.0;
    for (double s = 0.05; s < 1.0; s += 0.05)
      error = std::max(error, distance(step.at(s), Known::solution(0.7 + s * h)));
    return error;
  };
  // Within one step order 7 means an error of h^8.
  expect_orders("dense_output", {largest(0.16), largest(0.08), largest(0.04)}, 8.0, 0.5, 0.5);
}

TEST(Dop853, HasDenseOutputThatJoinsSmoothly) {
  const auto first = take_step<4>(Known{}, 0.7, 0.1, Known::solution(0.7));
  EXPECT_EQ(distance(first.at(0.0), first.begin), 0.0);
  EXPECT_LT(distance(first.at(1.0), first.end), 1e-15 * 10.0);  // rounding; states reach 10
  State<4> slope;
  Known{}(0.8, first.end.data(), slope.data());
  const double delta = 1e-5;
  const auto before = first.at(1.0 - delta);
  for (int i = 0; i < 4; ++i)  // one-sided difference: error delta h y''/2, y'' up to some hundreds
    EXPECT_NEAR((first.end[i] - before[i]) / (0.1 * delta), slope[i], 1e-3);
}

// y' = (k + 1) t^k on one long step.
struct Power {
  int k;
  void operator()(double t, const double*, double* dy) const { dy[0] = (k + 1) * std::pow(t, k); }
};

TEST(Dop853, IntegratesPolynomialsExactlyUpToItsOrder) {
  const auto step = [](int k) { return take_step<1>(Power{k}, 0.0, 1.0, State<1>{0.25}); };
  // Weights as large as 500 cancel in the sums: rounding of 1e-13, and as much from the weights' digits.
  constexpr double exact = 2e-13, wrong = 1e-6;
  for (int k = 0; k <= 7; ++k) EXPECT_NEAR(step(k).end[0], 1.25, exact) << "degree " << k;
  EXPECT_GT(std::fabs(step(8).end[0] - 1.25), wrong);
  for (int k = 0; k <= 4; ++k) EXPECT_LT(step(k).error5, exact) << "degree " << k;
  EXPECT_GT(step(5).error5, wrong);
  for (int k = 0; k <= 2; ++k) EXPECT_LT(step(k).error3, exact) << "degree " << k;
  EXPECT_GT(step(3).error3, wrong);
  for (int k = 0; k <= 6; ++k)
    for (double s : {0.1, 0.35, 0.5, 0.8})
      EXPECT_NEAR(step(k).at(s)[0], 0.25 + std::pow(s, k + 1), exact) << "degree " << k;
  EXPECT_GT(std::fabs(step(7).at(0.5)[0] - 0.25 - std::pow(0.5, 8)), wrong);
}

TEST(Dop853, EvaluatesEveryStageAtTheTimeItsWeightsAddUpTo) {
  for (int row = 1; row < tableau::dense_stages; ++row) {
    double sum = 0.0;
    for (double weight : tableau::a[row]) sum += weight;
    EXPECT_NEAR(sum, tableau::c[row], 1e-13) << "stage " << row;  // weights up to 43 to 16 digits
  }
}

TEST(AdaptiveIntegrator, KeepsErrorsInProportionToItsTolerance) {
  const Known f;
  for (double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    kernels::ErrorScale<4> scale;
    scale.tolerance = tolerance;
    scale.floor.fill(1e-3);
    kernels::AdaptiveIntegrator<Known, 4> integrator(f, scale);
    auto y = Known::solution(0.5);
    double dense = 0.0;
    ASSERT_EQ(integrator.advance(0.5, 4.0, y.data(),
                                 [&](double from, double to, auto&& state_at) {
                                   State<4> middle;
                                   state_at(0.5 * (from + to), middle.data());
                                   dense = std::max(dense, distance(middle, Known::solution(0.5 * (from + to))));
                                 }),
              equipoise::IntegrationStatus::done);
    const double error = distance(y, Known::solution(4.0));
    RecordProperty(fmt::format("errors_at_{:.0e}", tolerance),
                   fmt::format("{:.2g} at the end, {:.2g} within", error, dense));
    // States reach exp(5) = 150, so one step's error may be 150 times the tolerance. Within steps dense output is only
    // of order 7, and this problem's tenth derivatives are large.
    EXPECT_LT(error, 1e3 * tolerance);
    EXPECT_LT(dense, 3e4 * tolerance);
  }
}

}  // namespace convergence_test
