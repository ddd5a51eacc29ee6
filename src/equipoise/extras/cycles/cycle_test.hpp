// Test functions whose zeros are folds, period doublings and tori of cycles, with their derivatives' weights.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/extras/cycles/cycle_shooting.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// Of folds and period doublings g of [A b; c' 0] [v; g] = [0; 1] (W. Govaerts, Numerical Methods for Bifurcations of
/// Dynamical Equilibria, 2000): A is the monodromy matrix minus 1, bordered by the shift in time and the phase; or the
/// monodromy matrix plus 1. Of tori the product of the pair minus 1. All in units of System::scale().
class CycleTest {
 public:
  /// `cosine`: of the angle of a torus's pair.
  CycleTest(CurveKind change, double cosine) : change_(change), cosine_(cosine) {}

  /// The vectors b and c from a cycle near the curve. False if they are not defined.
  bool begin(const CycleArcs& arcs, const Eigen::VectorXd& phase);
  /// What values are compared with from here on.
  void stay_near(const Eigen::VectorXd& right, const Eigen::VectorXd& left, double cosine) {
    if (right.size() > 0) row_ = right, column_ = left;
    cosine_ = cosine;
  }
  void set_phase(const Eigen::VectorXd& phase) { phase_ = phase; }

  struct Value {
    double value = 0.0;
    Eigen::VectorXd right, left;  ///< of folds and period doublings: null vectors, of unit length
    double cosine = 0.0;          ///< of a torus's pair: half of its sum
    CycleWeights weights;
  };
  std::optional<Value> at(const CycleArcs& arcs) const;

 private:
  Eigen::MatrixXd matrix(const CycleArcs& arcs) const;
  std::optional<Value> torus(const CycleArcs& arcs) const;

  CurveKind change_;
  double cosine_;
  Eigen::VectorXd phase_, row_, column_;
};

}  // namespace equipoise
