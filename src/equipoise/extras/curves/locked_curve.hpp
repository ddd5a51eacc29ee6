// One curve on which a locked state changes: folds, pitchforks, Hopf.
#pragma once

#include "equipoise/extras/curves/followed_curve.hpp"
#include "equipoise/extras/curves/locked_states.hpp"

namespace equipoise {

/// Unknown are the two parameters and the state. Equations: the state is at rest, and a test function is 0. Of folds
/// that is the bordered one (W. Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria, 2000): g of
/// [J b; c' 0] [v; g] = [0; 1]. Of pitchforks it is the push by which alike balls in one place part, of Hopf curves the
/// pair's real part. Derivatives by the state are exact at a prescribed speed.
class LockedCurve : public FollowedCurve {
 public:
  LockedCurve(const BalancePlane& plane, CurveKind kind, const LockedKind& locked, const model::System& system,
              const EigenPair& like)
      : FollowedCurve(plane, kind, like), symmetry_(system, locked) {}

  /// From a state near the curve at a place near it.
  bool follow_from(const Eigen::VectorXd& at, const Eigen::VectorXd& state, const StopFlag* stop, const Known& known);
  std::vector<SpecialPoint> specials() const override;

 private:
  std::optional<Eigen::VectorXd> equation(const Eigen::VectorXd& at) const override;
  std::optional<Eigen::MatrixXd> slopes(const Eigen::VectorXd& at) const override;
  std::optional<CurvePlace> described(const Eigen::VectorXd& at) const override;
  std::optional<BalanceSpectrum> spectrum(const Eigen::VectorXd& at) const override;
  SpecialKind kind_at_zero(const CurvePlace& place) const override;
  void stay_near(const CurvePlace& place) const override;

  Eigen::VectorXd state(const Eigen::VectorXd& at) const;
  std::optional<double> test(const Eigen::MatrixXd& jacobian) const;
  /// By which a change J' of the Jacobian changes the test function: Re(left' J' right).
  struct Weights {
    Eigen::VectorXcd right, left;
    double of(const Eigen::MatrixXd& change) const { return (left.transpose() * change * right)(0).real(); }
  };
  std::optional<Weights> weights(const Eigen::MatrixXd& jacobian) const;
  /// The change of the test function where the state changes by `along`.
  double bend(const model::System& system, const Eigen::VectorXd& state, const Weights& w,
              const Eigen::VectorXd& along) const;

  LockedSymmetry symmetry_;
  mutable Eigen::VectorXd row_, column_;  // c and b
};

}  // namespace equipoise
