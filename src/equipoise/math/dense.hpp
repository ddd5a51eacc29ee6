// Decompositions of dense matrices, compiled once, in dense.cpp: Eigen's templates are slow to compile.
#pragma once

#include <memory>

#include <Eigen/Core>

namespace equipoise::dense {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);
/// Of the eigenvalues.
double largest_real_part(const Eigen::MatrixXd& a);

struct EigenPairs {
  bool found = false;  ///< the iteration converged; if not, the rest is not a number
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< columns in the same order
};
EigenPairs eigenpairs(const Eigen::MatrixXd& a);

/// Of a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);
/// Of unit length, columns in the order of the eigenvalues.
Eigen::MatrixXd symmetric_eigenvectors(const Eigen::MatrixXd& a);

double determinant(const Eigen::MatrixXd& a);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& a);

/// A x = b by LU decomposition with partial pivoting.
class LinearSolver {
 public:
  explicit LinearSolver(const Eigen::MatrixXd& a);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// About 1 over the condition number, 0 where A is singular.
  double inverse_condition() const;

 private:
  std::shared_ptr<const Eigen::PartialPivLU<Eigen::MatrixXd>> lu_;
};

/// The shortest of the x that make |A x - b| least, for square A of any rank, by a complete orthogonal decomposition;
/// pivots below `threshold` of the largest are zeros.
class LeastNormSolver {
 public:
  LeastNormSolver(const Eigen::MatrixXd& a, double threshold);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  std::shared_ptr<const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> decomposition_;
};

/// A x = b for a symmetric, semidefinite A.
Eigen::VectorXd solve_semidefinite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// A = U^T U with U upper triangular, for a symmetric, positive definite A.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& a);
  bool definite() const { return definite_; }
  Eigen::MatrixXd upper() const;
  /// U x = b.
  Eigen::VectorXd solve_upper(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_upper(const Eigen::MatrixXd& b) const;

 private:
  Eigen::MatrixXd lower_;
  bool definite_;
};

/// Q of A P = Q R with columns pivoted: its last columns span what A's do not.
Eigen::MatrixXd pivoted_orthogonal_factor(const Eigen::MatrixXd& a);

}  // namespace equipoise::dense
