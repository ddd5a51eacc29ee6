// Lyapunov functions of linear systems.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace equipoise {

/// Solves A^T P + P A = -Q for symmetric Q; all eigenvalues of A must have negative real parts.
Eigen::MatrixXd solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q);

/// The sum of (M^T)^i Q M^i over all i >= 0, which solves P - M^T P M = Q. Empty if M's eigenvalues do not lie well
/// inside the unit circle.
std::optional<Eigen::MatrixXd> solve_stein(Eigen::MatrixXd m, Eigen::MatrixXd q);

/// P = sum_k weight_k Re(conj(w_k) w_k^T) over A's left eigenvectors w_k of unit length, in the order of `rates`.
/// V = z^T P z falls at the rate 2 Re(rate_k) in every mode.
struct Modes {
  Eigen::VectorXcd rates;
  Eigen::MatrixXcd left;  ///< columns w_k
};
Modes left_modes(const Eigen::MatrixXd& a);
Eigen::MatrixXd modal_form(const Modes& modes, const Eigen::VectorXd& weights);

}  // namespace equipoise
