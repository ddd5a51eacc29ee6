// Derivatives along the real and the imaginary part of the eigenvector, combined to those along the complex one.
#include "equipoise/extras/curves/followed_curve.hpp"

#include <cmath>

#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/higher_derivatives.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr Complex i_unit(0.0, 1.0);

// The eigenvector of the eigenvalue nearest to i frequency.
std::optional<VectorXcd> swing_vector(const Eigen::MatrixXd& a, double frequency) {
  const dense::EigenPairs pairs = dense::eigenpairs(a);
  if (!pairs.found) return std::nullopt;
  Eigen::Index nearest = 0;
  (pairs.values.array() - Complex(0.0, frequency)).abs().minCoeff(&nearest);
  return VectorXcd(pairs.vectors.col(nearest));
}

class Derivatives {
 public:
  explicit Derivatives(const BalanceSpectrum& at) : at_(at) {}

  VectorXcd second(const VectorXcd& u, const VectorXcd& v) const {
    const VectorXd ur = u.real(), ui = u.imag(), vr = v.real(), vi = v.imag();
    return (real(ur, vr) - real(ui, vi)).cast<Complex>() + i_unit * (real(ur, vi) + real(ui, vr)).cast<Complex>();
  }
  // Along q, q and the conjugate of q.
  VectorXcd third(const VectorXcd& q) const {
    const VectorXd a = q.real(), b = q.imag();
    return (real(a, a, a) + real(a, b, b)).cast<Complex>() + i_unit * (real(a, a, b) + real(b, b, b)).cast<Complex>();
  }

 private:
  VectorXd real(const VectorXd& u, const VectorXd& v) const {
    return model::second_derivative(at_.system, at_.state, u, v);
  }
  VectorXd real(const VectorXd& u, const VectorXd& v, const VectorXd& w) const {
    return model::third_derivative(at_.system, at_.state, u, v, w);
  }

  const BalanceSpectrum& at_;
};

}  // namespace

std::optional<double> first_lyapunov(const BalanceSpectrum& at, double frequency) {
  const bool has_derivatives = at.system.plain() || (at.system.tilts() && at.system.prescribed());
  if (at.family || !has_derivatives || !(frequency > 0.0)) return std::nullopt;
  const Eigen::MatrixXd& a = at.jacobian;
  auto q = swing_vector(a, frequency);
  auto p = swing_vector(a.transpose(), frequency);  // p^T a = i frequency p^T
  if (!q || !p) return std::nullopt;
  double swing = 0.0;
  for (int k = 0; k < at.system.balls(); ++k) swing = std::max(swing, 2.0 * std::abs((*q)[model::index::phi(k)]));
  if (!(swing > 0.0)) return std::nullopt;
  *q /= swing;  // then the state is w q + its conjugate with |w| the amplitude of the ball that swings most
  const Complex product = (p->transpose() * *q)(0);
  if (!(std::abs(product) > 1e-12 * p->norm() * q->norm())) return std::nullopt;
  *p /= product;
  if (dense::LinearSolver(a).inverse_condition() < 1e-14) return std::nullopt;
  const Derivatives along(at);
  const VectorXcd across = q->conjugate();
  const VectorXcd shift = dense::inverse(a).cast<Complex>() * along.second(*q, across);
  Eigen::MatrixXcd twice = -a.cast<Complex>();
  twice.diagonal().array() += Complex(0.0, 2.0 * frequency);
  const VectorXcd overtone = dense::inverse(twice) * along.second(*q, *q);
  const VectorXcd cubic = along.third(*q) - 2.0 * along.second(*q, shift) + along.second(across, overtone);
  return 0.5 * (p->transpose() * cubic)(0).real();
}

}  // namespace equipoise
