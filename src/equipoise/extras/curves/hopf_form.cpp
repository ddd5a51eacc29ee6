// Derivatives along the real and the imaginary part of the eigenvector, combined to those along the complex one.
#include "equipoise/extras/curves/followed_curve.hpp"

#include <cmath>

#include "equipoise/core/math/bordered.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/higher_derivatives.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr Complex i_unit(0.0, 1.0);

// Derivatives of the equations at a state.
VectorXcd second_along(const BalanceSpectrum& at, const VectorXcd& u, const VectorXcd& v) {
  const VectorXd ur = u.real(), ui = u.imag(), vr = v.real(), vi = v.imag();
  const auto real = [&](const VectorXd& a, const VectorXd& b) {
    return model::second_derivative(at.system, at.state, a, b);
  };
  return (real(ur, vr) - real(ui, vi)).cast<Complex>() + i_unit * (real(ur, vi) + real(ui, vr)).cast<Complex>();
}
// Along q, q and the conjugate of q.
VectorXcd third_along(const BalanceSpectrum& at, const VectorXcd& q) {
  const VectorXd a = q.real(), b = q.imag();
  const auto real = [&](const VectorXd& u, const VectorXd& v, const VectorXd& w) {
    return model::third_derivative(at.system, at.state, u, v, w);
  };
  return (real(a, a, a) + real(a, b, b)).cast<Complex>() + i_unit * (real(a, a, b) + real(b, b, b)).cast<Complex>();
}

}  // namespace

std::optional<double> first_lyapunov(const BalanceSpectrum& at, double frequency) {
  const bool has_derivatives = at.system.plain() || (at.system.tilts() && at.system.prescribed());
  if (at.family || !has_derivatives || !(frequency > 0.0)) return std::nullopt;
  const Eigen::MatrixXd& a = at.jacobian;
  auto q = eigenvector_near(a, Complex(0.0, frequency));
  auto p = eigenvector_near(a.transpose(), Complex(0.0, frequency));  // p^T a = i frequency p^T
  if (!q || !p) return std::nullopt;
  double swing = 0.0;
  for (int k = 0; k < at.system.balls(); ++k) swing = std::max(swing, 2.0 * std::abs((*q)[model::index::phi(k)]));
  if (!(swing > 0.0)) return std::nullopt;
  *q /= swing;  // then the state is w q + its conjugate with |w| the amplitude of the ball that swings most
  const Complex product = (p->transpose() * *q)(0);
  if (!(std::abs(product) > 1e-12 * p->norm() * q->norm())) return std::nullopt;
  *p /= product;
  if (dense::LinearSolver(a).inverse_condition() < 1e-14) return std::nullopt;
  const VectorXcd across = q->conjugate();
  const VectorXcd shift = dense::inverse(a).cast<Complex>() * second_along(at, *q, across);
  Eigen::MatrixXcd twice = -a.cast<Complex>();
  twice.diagonal().array() += Complex(0.0, 2.0 * frequency);
  const VectorXcd overtone = dense::inverse(twice) * second_along(at, *q, *q);
  const VectorXcd cubic = third_along(at, *q) - 2.0 * second_along(at, *q, shift) + second_along(at, across, overtone);
  return 0.5 * (p->transpose() * cubic)(0).real();
}

}  // namespace equipoise
