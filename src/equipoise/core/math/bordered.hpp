// What test functions of bifurcations are made from: a bordered matrix, and the eigenvector of one eigenvalue.
#pragma once

#include <complex>
#include <optional>

#include <Eigen/Core>

namespace equipoise {

/// Null vectors of a nearly singular matrix, not of unit length, and the value g that is 0 where it is singular.
struct Bordered {
  Eigen::VectorXd right, left;
  double value = 0.0;
};

/// Solves [A b; c' 0] [right; g] = [0; 1], and the same of its transpose for `left`, with c = `row` and b = `column`
/// (W. Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria, 2000). Not finite where it has no
/// solution.
Bordered bordered(const Eigen::MatrixXd& a, const Eigen::VectorXd& row, const Eigen::VectorXd& column);

/// Makes `row` and `column` the null vectors of A, of unit length, by inverse iteration of `rounds` rounds. False if
/// they are not finite.
bool fit_borders(const Eigen::MatrixXd& a, int rounds, Eigen::VectorXd& row, Eigen::VectorXd& column);

/// The eigenvector of the eigenvalue nearest to `value`; empty where the iteration does not converge.
std::optional<Eigen::VectorXcd> eigenvector_near(const Eigen::MatrixXd& a, std::complex<double> value);

}  // namespace equipoise
