// Locked states, in which the rotor is off centre and the balls rest on the line through its centre: all of them, and
// the curves on which they change.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/extras/curves/followed_curve.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// How the balls are divided between the two ends of the line. At constant speed the only force along the race is the
/// centrifugal one, so that each ball rests where the line meets the race (docs/explanation/equations.md).
struct LockedKind {
  std::string name;
  std::array<signed char, model::max_balls> side{};  ///< 1 for the first ball and those in the same place, else -1
  std::array<int, model::max_balls> cluster{};       ///< alike balls on one side share a number
  int clusters = 0;
  bool own_mirror = false;  ///< exchanging alike balls turns the sides round

  double moment(const model::Parameters& p) const;
};
/// Up to exchange of alike balls. None if there would be more than `most`.
std::vector<LockedKind> locked_kinds(const model::Parameters& p, std::size_t most = 64);
/// Why a system's locked states are not known; empty if they are.
std::string locked_states_lack(const model::System& system);

/// All states of this kind: none, or two that merge in a fold, in an order that a change of parameters keeps. Of a
/// motor as many as it can feed, by speed. For a kind that is its own mirror image one state stands for both.
std::vector<Eigen::VectorXd> locked_states(const model::System& system, const LockedKind& kind);

/// States whose alike balls on one side move as one: a smaller state, in which folds and Hopf curves are sought.
class LockedSymmetry {
 public:
  LockedSymmetry(const model::System& system, const LockedKind& kind);

  Eigen::Index size() const { return static_cast<Eigen::Index>(first_.size()); }
  Eigen::VectorXd reduced(const Eigen::VectorXd& state) const;
  Eigen::VectorXd whole(const Eigen::VectorXd& reduced) const { return spread_ * reduced; }
  Eigen::MatrixXd reduced(const Eigen::MatrixXd& jacobian) const;
  Eigen::VectorXd direction(Eigen::Index k) const { return spread_.col(k); }
  /// A left vector of the small state as one of the whole.
  Eigen::VectorXcd whole_left(const Eigen::VectorXcd& small) const;
  /// Of the small state's variables what counts as one.
  const Eigen::VectorXd& scale() const { return scale_; }

  /// Two balls of one cluster, with how many there are in it.
  struct Parting {
    int ball, other, balls;
  };
  const std::vector<Parting>& partings() const { return partings_; }
  /// Along which such balls part, and the place of the rate that answers.
  Eigen::VectorXd parting_direction(const Parting& parting) const;
  Eigen::Index parting_place(const Parting& parting) const { return model::index::q(parting.ball, balls_); }

  /// Those of the small state, and those by which balls of a cluster part.
  std::vector<std::complex<double>> rates(const Eigen::MatrixXd& jacobian) const;

 private:
  int balls_;
  Eigen::MatrixXd spread_;
  std::vector<Eigen::Index> first_;  // in the state, of each variable of the small one
  Eigen::VectorXd scale_;
  std::vector<Parting> partings_;
};

BalanceSpectrum locked_spectrum(const model::System& system, const LockedSymmetry& symmetry,
                                const Eigen::VectorXd& state);

/// Unknown are the two parameters and the state. Equations: the state is at rest, and a test function is 0. Of folds
/// that is the bordered one (W. Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria, 2000): g of
/// [J b; c' 0] [v; g] = [0; 1]. Of pitchforks it is the push by which alike balls in one place part, of Hopf curves the
/// pair's real part. Derivatives by the state are exact at a prescribed speed.
class LockedCurve : public FollowedCurve {
 public:
  LockedCurve(const PlaneStudies& plane, CurveKind kind, const LockedKind& locked, const model::System& system,
              const EigenPair& like)
      : FollowedCurve(plane, kind, like), symmetry_(system, locked) {}

  /// From a state near the curve at a place near it.
  bool follow_from(const Eigen::VectorXd& at, const Eigen::VectorXd& state, const StopFlag* stop, const Known& known);

 private:
  std::optional<Eigen::VectorXd> equation(const Eigen::VectorXd& at) const override;
  std::optional<Eigen::MatrixXd> slopes(const Eigen::VectorXd& at) const override;
  std::optional<CurvePlace> described(const Eigen::VectorXd& at) const override;
  SpecialKind kind_at_zero(const CurvePlace& place) const override;

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
};

}  // namespace equipoise
