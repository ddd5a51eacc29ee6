// Lyapunov equations by Schur form (Bartels and Stewart, Commun. ACM 15 (1972) 820), and modal quadratic forms.
#include "equipoise/core/math/lyapunov.hpp"

#include <complex>
#include <utility>

#include "equipoise/core/math/dense.hpp"

namespace equipoise {

Eigen::MatrixXd solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q) {
  // With A = U T U^* and X = U^* P U the equation reads T^* X + X T = -U^* Q U, solved column by column.
  const auto [u, t] = dense::schur(a);
  const Eigen::MatrixXcd c = -(u.adjoint() * q * u);
  const Eigen::Index size = a.rows();
  Eigen::MatrixXcd x = Eigen::MatrixXcd::Zero(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    Eigen::VectorXcd right = c.col(j);
    for (Eigen::Index k = 0; k < j; ++k) right -= x.col(k) * t(k, j);
    Eigen::MatrixXcd left = t.adjoint();
    left.diagonal().array() += t(j, j);
    x.col(j) = left.triangularView<Eigen::Lower>().solve(right);
  }
  const Eigen::MatrixXd p = (u * x * u.adjoint()).real();
  return 0.5 * (p + p.transpose());
}

std::optional<Eigen::MatrixXd> solve_stein(Eigen::MatrixXd m, Eigen::MatrixXd q) {
  constexpr int most_doublings = 60;
  for (int k = 0; k < most_doublings; ++k) {
    const Eigen::MatrixXd more = m.transpose() * q * m;
    q += more;
    if (!q.allFinite()) return std::nullopt;
    if (more.norm() < 1e-14 * q.norm()) return q;
    m = m * m;
  }
  return std::nullopt;
}

Modes left_modes(const Eigen::MatrixXd& a) {
  dense::EigenPairs pairs = dense::eigenpairs(a.transpose());
  Modes modes{std::move(pairs.values), std::move(pairs.vectors)};
  modes.left.colwise().normalize();
  return modes;
}

Eigen::MatrixXd modal_form(const Modes& modes, const Eigen::VectorXd& weights) {
  const Eigen::MatrixXcd form =
      modes.left.conjugate() * weights.cast<std::complex<double>>().asDiagonal() * modes.left.transpose();
  const Eigen::MatrixXd p = form.real();
  return 0.5 * (p + p.transpose());
}

}  // namespace equipoise
