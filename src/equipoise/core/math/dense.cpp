// Decompositions of dense matrices; the only file that compiles Eigen's.
#include "equipoise/core/math/dense.hpp"

#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace equipoise::dense {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

VectorXcd eigenvalues(const MatrixXd& a) { return a.eigenvalues(); }

double largest_real_part(const MatrixXd& a) { return eigenvalues(a).real().maxCoeff(); }

EigenPairs eigenpairs(const MatrixXd& a) {
  const Eigen::EigenSolver<MatrixXd> solver(a);
  if (solver.info() != Eigen::Success) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {false, VectorXcd::Constant(a.rows(), none), MatrixXcd::Constant(a.rows(), a.cols(), none)};
  }
  return {true, solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

MatrixXd symmetric_eigenvectors(const MatrixXd& a) { return Eigen::SelfAdjointEigenSolver<MatrixXd>(a).eigenvectors(); }

Schur schur(const MatrixXd& a) {
  const Eigen::ComplexSchur<MatrixXd> decomposition(a);
  return {decomposition.matrixU(), decomposition.matrixT()};
}

double determinant(const MatrixXd& a) { return a.determinant(); }
MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }
MatrixXcd inverse(const MatrixXcd& a) { return a.inverse(); }

LinearSolver::LinearSolver(const MatrixXd& a) : lu_(std::make_shared<Eigen::PartialPivLU<MatrixXd>>(a)) {}
VectorXd LinearSolver::solve(const VectorXd& b) const { return lu_->solve(b); }
MatrixXd LinearSolver::solve(const MatrixXd& b) const { return lu_->solve(b); }
double LinearSolver::inverse_condition() const { return lu_->rcond(); }

LeastNormSolver::LeastNormSolver(const MatrixXd& a, double threshold) {
  const auto decomposition = std::make_shared<Eigen::CompleteOrthogonalDecomposition<MatrixXd>>();
  decomposition->setThreshold(threshold);
  decomposition->compute(a);
  decomposition_ = decomposition;
}
VectorXd LeastNormSolver::solve(const VectorXd& b) const { return decomposition_->solve(b); }

VectorXd solve_semidefinite(const MatrixXd& a, const VectorXd& b) { return a.ldlt().solve(b); }

Cholesky::Cholesky(const MatrixXd& a) {
  const Eigen::LLT<MatrixXd> factor(a);
  lower_ = factor.matrixLLT();
  definite_ = factor.info() == Eigen::Success;
}
MatrixXd Cholesky::upper() const { return lower_.adjoint().triangularView<Eigen::Upper>(); }
VectorXd Cholesky::solve_upper(const VectorXd& b) const {
  return lower_.adjoint().triangularView<Eigen::Upper>().solve(b);
}
MatrixXd Cholesky::solve_upper(const MatrixXd& b) const {
  return lower_.adjoint().triangularView<Eigen::Upper>().solve(b);
}

MatrixXd pivoted_orthogonal_factor(const MatrixXd& a) { return Eigen::ColPivHouseholderQR<MatrixXd>(a).householderQ(); }

}  // namespace equipoise::dense
