// Decompositions of dense matrices, compiled once, in dense.cpp: Eigen's templates are slow to compile.
// This room: dual numbers, intervals, affine forms, dense matrices, curves followed; no physics.
#pragma once

#include <memory>

#include <Eigen/Core>

namespace equipoise::dense {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);
/// Largest real part of the eigenvalues.
double largest_real_part(const Eigen::MatrixXd& a);

struct EigenPairs {
  bool found = false;  ///< the iteration converged; otherwise values and vectors are NaN
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< columns in the same order
};
EigenPairs eigenpairs(const Eigen::MatrixXd& a);

/// For a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);
/// Columns of unit length, in the order of the eigenvalues.
Eigen::MatrixXd symmetric_eigenvectors(const Eigen::MatrixXd& a);

/// A = U T U^* with U unitary and T upper triangular.
struct Schur {
  Eigen::MatrixXcd u, t;
};
Schur schur(const Eigen::MatrixXd& a);

double determinant(const Eigen::MatrixXd& a);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& a);

/// A x = b by LU decomposition with partial pivoting.
class LinearSolver {
 public:
  explicit LinearSolver(const Eigen::MatrixXd& a);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// About 1 over the condition number; 0 if A is singular.
  double inverse_condition() const;

 private:
  std::shared_ptr<const Eigen::PartialPivLU<Eigen::MatrixXd>> lu_;
};

/// The shortest x that minimises |A x - b|, for square A of any rank, by a complete orthogonal decomposition. Pivots
/// below `threshold` times the largest count as zero.
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

/// Q of A P = Q R with pivoted columns: its last columns span what A's columns do not.
Eigen::MatrixXd pivoted_orthogonal_factor(const Eigen::MatrixXd& a);

}  // namespace equipoise::dense
