// Capture by a continuum of balanced states: stability across it, judged where the trajectory comes close.
#include "equipoise/attractors/family_trap.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "equipoise/attractors/lyapunov.hpp"
#include "equipoise/base/angles.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"

namespace equipoise {

namespace {

// Largest |f(z* + d) - A d| / |d|^2 over random directions at distance `radius`, times a margin for those not drawn.
double remainder_constant(const model::Parameters& p, double speed, const Eigen::VectorXd& centre,
                          const Eigen::MatrixXd& a, double radius) {
  constexpr int directions = 24;
  constexpr double margin = 4.0;
  std::mt19937_64 random(20190614);
  std::normal_distribution<double> normal;
  double largest = 0.0;
  for (int k = 0; k < directions; ++k) {
    Eigen::VectorXd d(centre.size());
    for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = normal(random);
    d *= radius / d.norm();
    const Eigen::VectorXd rest = model::derivative(p, speed, Eigen::VectorXd(centre + d).data()) - a * d;
    largest = std::max(largest, rest.norm() / (radius * radius));
  }
  return margin * largest;
}

bool caught(const model::Parameters& p, double speed, const double* state) {
  double phi[model::max_balls];
  for (int i = 0; i < p.balls; ++i) phi[i] = state[model::index::phi(i)];
  if (!model::project_to_balanced(p, phi)) return false;
  const Eigen::VectorXd centre = model::centred_state(p, phi);
  const Eigen::MatrixXd a = model::jacobian(p, speed, centre.data());
  const Eigen::Index size = a.rows();

  // The continuum's own directions: n - 2 zero eigenvalues (one for two balls without unbalance).
  const Eigen::Index along = std::max<Eigen::Index>(p.balls - 2, 1);
  const Eigen::Index across = size - along;
  // An orthonormal basis of A's range, the invariant subspace across the continuum.
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
  const Eigen::MatrixXd range = Eigen::MatrixXd(qr.householderQ()).leftCols(across);
  const Eigen::MatrixXd reduced = range.transpose() * a * range;
  if (!(reduced.eigenvalues().real().maxCoeff() < -1e-6)) return false;
  const Eigen::MatrixXd form = solve_lyapunov(reduced, Eigen::MatrixXd::Identity(across, across));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(form, Eigen::EigenvaluesOnly);
  const double largest = spectrum.eigenvalues().maxCoeff(), smallest = spectrum.eigenvalues().minCoeff();

  // dV/dt <= -|s|^2 + 2 |P| C |s|^3 < 0 while |s| < 1/(2 |P| C); the level set V < smallest * that^2 lies inside.
  const double radius = 1.0 / (2.0 * largest * remainder_constant(p, speed, centre, a, 1e-3));
  Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(state, size) - centre;
  const Eigen::VectorXd s = range.transpose() * d;
  return s.dot(form * s) < smallest * radius * radius;
}

}  // namespace

FamilyTrap family_trap(const model::Parameters& p, double speed) {
  // First asked a hundredth of the balls' reach away from balance; refused states are asked again ten times closer.
  return {0.01 * (p.eccentricity + p.total_mass()),
          [p, speed](const double* state) { return caught(p, speed, state); }};
}

}  // namespace equipoise
