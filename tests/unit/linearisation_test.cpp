// The Jacobian against the second-order form M z'' + C z' + K z = 0 about balanced states
// (docs/explanation/equations.md, "Linearisation"), against recorded eigenvalues and against differences.
#include "equipoise/machine/mechanics/linearisation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/gradient.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/system.hpp"
#include "../support/parameters.hpp"

namespace linearisation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using equipoise::base_rotor;
using equipoise::pi;
namespace model = equipoise::model;

// A balanced state of `p` with the ball angles written to `phi`.
std::vector<double> balanced_angles(const model::Parameters& p) {
  const auto states = model::balanced_states(p);
  if (states.kind == model::BalancedStates::Kind::isolated)
    return {states.angles[0].begin(), states.angles[0].begin() + p.balls};
  std::vector<double> phi;
  for (int i = 0; i < p.balls; ++i) phi.push_back(0.5 + 2.0 * pi * i / p.balls + 0.1 * i);
  EXPECT_TRUE(model::project_to_balanced(p, phi.data()));
  return phi;
}

// Unknowns (x, y, dphi_1, .., dphi_n), constant speed w, isotropic supports. Written down from the derivation, then
// turned into a first-order system in the project's variables (x, y, u, v, phi, q) with u = x' - w y, v = y' + w x.
MatrixXd second_order_form(const model::Parameters& p, double w, const std::vector<double>& phi) {
  const int n = p.balls, size = 2 + n;
  const double total = 1.0 + p.total_mass(), zeta = p.damping[0];
  MatrixXd M = MatrixXd::Zero(size, size), C = M, K = M;
  M(0, 0) = M(1, 1) = total;
  C(0, 0) = C(1, 1) = zeta;
  C(0, 1) = -2.0 * total * w;
  C(1, 0) = 2.0 * total * w;
  K(0, 0) = K(1, 1) = p.stiffness[0] - total * w * w;
  K(0, 1) = -zeta * w;
  K(1, 0) = zeta * w;
  for (int i = 0; i < n; ++i) {
    const int j = 2 + i;
    const double mu = p.mass[i], s = std::sin(phi[i]), c = std::cos(phi[i]);
    M(0, j) = M(j, 0) = -mu * s;
    M(1, j) = M(j, 1) = mu * c;
    M(j, j) = p.rolls ? 7.0 / 5.0 * mu : mu;
    C(0, j) = -2.0 * w * mu * c;
    C(1, j) = -2.0 * w * mu * s;
    C(j, 0) = 2.0 * w * mu * c;
    C(j, 1) = 2.0 * w * mu * s;
    C(j, j) = mu * p.drag[i];
    K(0, j) = K(j, 0) = w * w * mu * s;
    K(1, j) = K(j, 1) = -w * w * mu * c;
  }
  // z = position s and z' = velocity s for the project's state s.
  MatrixXd position = MatrixXd::Zero(size, 2 * size), velocity = position;
  position(0, 0) = position(1, 1) = 1.0;
  velocity(0, 2) = velocity(1, 3) = 1.0;
  velocity(0, 1) = w;
  velocity(1, 0) = -w;
  for (int i = 0; i < n; ++i) {
    position(2 + i, 4 + i) = 1.0;
    velocity(2 + i, 4 + n + i) = 1.0;
  }
  const MatrixXd acceleration = -equipoise::dense::inverse(M) * (C * velocity + K * position);
  MatrixXd rate(2 * size, 2 * size);
  rate.topRows(2) = velocity.topRows(2);
  rate.row(2) = acceleration.row(0) - w * velocity.row(1);
  rate.row(3) = acceleration.row(1) + w * velocity.row(0);
  rate.middleRows(4, n) = velocity.bottomRows(n);
  rate.bottomRows(n) = acceleration.bottomRows(n);
  return rate;
}

MatrixXd jacobian_at(const model::Parameters& p, double w, const std::vector<double>& phi) {
  return model::jacobian(p, w, model::centred_state(p, phi.data()).data());
}

TEST(Jacobian, EqualsTheSecondOrderFormAtBalancedStates) {
  double largest = 0.0;
  for (int n : {1, 2, 3, 4, 5, 8}) {
    for (double w : {0.0, 0.8, 1.5, 2.4, 6.0}) {
      for (int kind = 0; kind < 4; ++kind) {
        const bool unequal = kind % 2;
        model::Parameters p = base_rotor(n);
        p.rolls = kind >= 2;
        if (p.rolls) p.ball_radius.fill(0.2);  // no effect at constant speed
        p.damping = {0.37, 0.37};
        if (n == 1) p.mass[0] = p.eccentricity;
        if (unequal && n > 1)
          for (int i = 0; i < n; ++i) {
            p.mass[i] *= 1.0 + 0.1 * (i % 3) / n;
            p.drag[i] *= 1.0 + 0.7 * i;
          }
        const auto phi = balanced_angles(p);
        const MatrixXd expected = second_order_form(p, w, phi), actual = jacobian_at(p, w, phi);
        const double difference = (actual - expected).cwiseAbs().maxCoeff() / (1.0 + expected.cwiseAbs().maxCoeff());
        largest = std::max(largest, difference);
        // Rounding of one small solve; the balanced angles themselves are good to 1e-15 / mu.
        EXPECT_LT(difference, 1e-13) << n << " balls, speed " << w;
      }
    }
  }
  RecordProperty("largest_relative_difference", fmt::format("{:.2g}", largest));
}

TEST(Jacobian, EqualsDifferencesOfTheDerivativeAnywhere) {
  double largest = 0.0;
  for (int n : {1, 2, 3, 8}) {
    model::Parameters p = base_rotor(n, 0.3, 0.04);
    for (int i = 0; i < n; ++i) p.mass[i] += 0.005 * i;
    VectorXd z(model::dimension(n));
    for (int i = 0; i < z.size(); ++i) z[i] = 0.6 * std::sin(1.0 + 2.3 * i);
    const MatrixXd exact = model::jacobian(p, 2.2, z.data());
    const double step = 1e-3;
    for (int column = 0; column < z.size(); ++column) {
      VectorXd sum = VectorXd::Zero(z.size());
      // Sixth-order central differences: truncation and rounding are both about 1e-13 at this step.
      const double weights[] = {45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0};
      for (int k = 1; k <= 3; ++k) {
        VectorXd up = z, down = z;
        up[column] += k * step;
        down[column] -= k * step;
        sum += weights[k - 1] / step * (model::derivative(p, 2.2, up.data()) - model::derivative(p, 2.2, down.data()));
      }
      const double difference = (sum - exact.col(column)).cwiseAbs().maxCoeff();
      largest = std::max(largest, difference);
      // A few times both, for derivatives of size 10.
      EXPECT_LT(difference, 1e-11) << n << " balls, column " << column;
    }
  }
  RecordProperty("largest_difference", fmt::format("{:.2g}", largest));
}

// Leading eigenvalues of two balls (mu = 0.05, lambda = 0.01, zeta = 0.5), found by an earlier, independent code and
// printed to the digits given here.
struct Leading {
  double drag, speed, real, imaginary;
  double real_digit, imaginary_digit;  // the last printed places
};

constexpr Leading leading[] = {{.01, 1.5, .02182, .4892, 1e-5, 1e-4},  {.01, 1.5, -.00322, .0585, 1e-5, 1e-4},
                               {.01, 2.0, .00014, .6824, 1e-5, 1e-4},  {.01, 2.0, -.00394, .0684, 1e-5, 1e-4},
                               {.01, 2.2, -.00404, .0734, 1e-5, 1e-4}, {.01, 2.2, -.00857, .744, 1e-5, 1e-3},
                               {.01, 2.4, -.00411, .0787, 1e-5, 1e-4}, {.01, 2.4, -.01409, .803, 1e-5, 1e-3},
                               {.01, 2.6, -.00415, .0841, 1e-5, 1e-4}, {.01, 2.6, -.01765, .863, 1e-5, 1e-3},
                               {.01, 3.0, -.00421, .095, 1e-5, 1e-3},  {.01, 3.0, -.0217, .983, 1e-4, 1e-3},
                               {.01, 4.0, -.00428, .124, 1e-5, 1e-3},  {.01, 4.0, -.0256, 1.288, 1e-4, 1e-3},
                               {.01, 5.0, -.00431, .153, 1e-5, 1e-3},  {.01, 5.0, -.0270, 1.598, 1e-4, 1e-3},
                               {.01, 6.0, -.00433, .183, 1e-5, 1e-3},  {.01, 6.0, -.0276, 1.909, 1e-4, 1e-3},
                               {.05, 1.5, .00551, .4874, 1e-5, 1e-4},  {.05, 1.5, -.02321, .0539, 1e-5, 1e-4},
                               {.05, 2.0, -.02113, .6828, 1e-5, 1e-4}, {.05, 2.0, -.02390, .0643, 1e-5, 1e-4},
                               {.05, 2.2, -.02399, .0695, 1e-5, 1e-4}, {.05, 2.2, -.0304, .744, 1e-4, 1e-3},
                               {.05, 2.4, -.02406, .0750, 1e-5, 1e-4}, {.05, 2.4, -.0361, .803, 1e-4, 1e-3},
                               {.05, 2.6, -.02410, .0807, 1e-5, 1e-4}, {.05, 2.6, -.0397, .862, 1e-4, 1e-3},
                               {.05, 3.0, -.02416, .092, 1e-5, 1e-3},  {.05, 3.0, -.0438, .982, 1e-4, 1e-3},
                               {.05, 4.0, -.02423, .122, 1e-5, 1e-3},  {.05, 4.0, -.0477, 1.288, 1e-4, 1e-3},
                               {.05, 5.0, -.02426, .151, 1e-5, 1e-3},  {.05, 5.0, -.0490, 1.597, 1e-4, 1e-3},
                               {.05, 6.0, -.02427, .181, 1e-5, 1e-3},  {.05, 6.0, -.0497, 1.908, 1e-4, 1e-3},
                               {.10, 1.5, -.01399, .4845, 1e-5, 1e-4}, {.10, 1.5, -.04821, .0334, 1e-5, 1e-4},
                               {.25, 1.5, -.01486, 0.0, 1e-5, 1e-9},   {.25, 2.0, -.02074, 0.0, 1e-5, 1e-9},
                               {.25, 2.2, -.02422, 0.0, 1e-5, 1e-9},   {.25, 2.4, -.02829, 0.0, 1e-5, 1e-9},
                               {.25, 2.6, -.03300, 0.0, 1e-5, 1e-9},   {.25, 3.0, -.04471, 0.0, 1e-5, 1e-9},
                               {.25, 4.0, -.12396, .004, 1e-5, 1e-3},  {.25, 5.0, -.12399, .090, 1e-5, 1e-3},
                               {.25, 6.0, -.12400, .135, 1e-5, 1e-3}};

TEST(Eigenvalues, AreTheRecordedOnesOfTwoBalls) {
  for (const Leading& row : leading) {
    const model::Parameters p = base_rotor(2, row.drag, 0.05);
    for (int state = 0; state < 2; ++state) {
      const auto angles = model::balanced_states(p).angles.at(state);
      const Eigen::VectorXcd found = equipoise::dense::eigenvalues(jacobian_at(p, row.speed, {angles[0], angles[1]}));
      bool present = false;
      for (const std::complex<double>& value : found)
        // Printed numbers are rounded: half a unit of the last place, and a little more where a digit was cut off.
        present = present || (std::fabs(value.real() - row.real) < 0.6 * row.real_digit &&
                              std::fabs(value.imag() - row.imaginary) < 0.6 * row.imaginary_digit);
      EXPECT_TRUE(present) << "drag " << row.drag << ", speed " << row.speed << ": " << row.real << " + "
                           << row.imaginary << "i not among\n"
                           << found;
    }
  }
}

TEST(Eigenvalues, VanishOnceForEveryBallBeyondTwo) {
  for (int n : {2, 3, 4, 5, 8}) {
    model::Parameters p = base_rotor(n);
    for (int i = 0; i < n; ++i) p.mass[i] += 0.003 * i;
    const auto phi = balanced_angles(p);
    int zeros = 0;
    for (const std::complex<double>& value : equipoise::dense::eigenvalues(jacobian_at(p, 2.4, phi))) {
      // Zero eigenvalues belong to directions along the continuum, found to rounding; the next smallest are about
      // beta/2.
      if (std::abs(value) < 1e-12)
        ++zeros;
      else
        EXPECT_GT(std::abs(value), 1e-3) << n << " balls";
    }
    EXPECT_EQ(zeros, n - 2) << n << " balls";
  }
}

TEST(Eigenvalues, VanishAlongTheFamilyOfBalancedStates) {
  model::Parameters p = base_rotor(3);
  p.mass[2] = 0.07;
  const auto phi = balanced_angles(p);
  // Moving along the continuum keeps sum mu_i e^{i phi_i}: the angles' rates d solve two linear equations.
  const double d[] = {p.mass[1] * p.mass[2] * std::sin(phi[2] - phi[1]),
                      p.mass[2] * p.mass[0] * std::sin(phi[0] - phi[2]),
                      p.mass[0] * p.mass[1] * std::sin(phi[1] - phi[0])};
  VectorXd along = VectorXd::Zero(10);
  for (int i = 0; i < 3; ++i) along[4 + i] = d[i] / std::hypot(d[0], d[1], d[2]);
  // Rounding of products of size w^2 mu.
  EXPECT_LT((jacobian_at(p, 2.4, phi) * along).norm(), 1e-14);
}

TEST(Derivative, VanishesAtBalancedStates) {
  for (int n : {1, 2, 3, 4, 5, 8}) {
    model::Parameters p = base_rotor(n, 0.05, n == 1 ? 0.01 : 0.05);
    const auto phi = balanced_angles(p);
    for (double w : {0.5, 2.4, 6.0})
      // The balanced state's residual, 4e-15 of the masses, times w^2.
      EXPECT_LT(model::derivative(p, w, model::centred_state(p, phi.data()).data()).norm(), 1e-13) << n << " balls";
  }
}

// With a slope for every variable that 16 balls on a tilting rotor would have.
template <bool tilt>
MatrixXd widest_jacobian(const model::System& system, const VectorXd& y) {
  constexpr int most = equipoise::HWY_NAMESPACE::SmoothFlow<double, model::any_count, tilt>::dimension;
  using Dual = equipoise::Gradient<double, most>;
  const int size = system.dimension();
  std::vector<Dual> z(most), rate(most);
  for (int i = 0; i < size; ++i) z[i] = Dual(y[i], i);
  equipoise::HWY_NAMESPACE::SmoothFlow<Dual, model::any_count, tilt>(system, 0.0)(Dual(0.0), z.data(), rate.data());
  MatrixXd result(size, size);
  for (int i = 0; i < size; ++i)
    for (int k = 0; k < size; ++k) result(i, k) = rate[i].slope[k];
  return result;
}

TEST(Jacobian, HasTheSameBitsWhateverTheWidthOfItsNumbers) {
  const auto state = [](const model::System& system) {
    VectorXd y(system.dimension());
    for (int i = 0; i < y.size(); ++i) y[i] = 0.1 * std::sin(1.0 + 2.0 * i);
    return y;
  };
  for (int n : {1, 2, 3, 6, 7, 16}) {
    model::Parameters p = base_rotor(n);
    p.gravity = 0.1;
    const model::System plane(p, 2.4);
    EXPECT_EQ(model::jacobian(plane, state(plane)), widest_jacobian<false>(plane, state(plane))) << n << " balls";
    p.tilt.transverse_inertia = 0.4;
    p.tilt.polar_inertia = 0.2;
    p.tilt.stiffness = {{{0.1, 0.3}, {0.1, 0.3}}};
    const model::System tilting(p, 2.4);
    ASSERT_TRUE(tilting.tilts());
    EXPECT_EQ(model::jacobian(tilting, state(tilting)), widest_jacobian<true>(tilting, state(tilting)))
        << n << " balls";
  }
}

}  // namespace linearisation_test
