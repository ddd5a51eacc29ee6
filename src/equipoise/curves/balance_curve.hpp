// One curve on which balance changes, from a place near it to both of its ends.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/curves/balance_plane.hpp"
#include "equipoise/curves/curve_follower.hpp"
#include "equipoise/planes/bifurcation_chart.hpp"

namespace equipoise {

/// A place on a curve.
struct CurvePlace {
  Eigen::VectorXd at;  ///< in the unit square
  EigenPair pair;      ///< of a Hopf curve
  CurvePoint point;
};

class BalanceCurve {
 public:
  /// `like`: the pair that crosses, of a Hopf curve.
  BalanceCurve(const BalancePlane& plane, CurveKind kind, const EigenPair& like);

  /// False if there is no curve near `guess`. A stopped curve ends where it has come to.
  bool follow(const Eigen::VectorXd& guess, const StopFlag* stop);

  const std::vector<CurvePlace>& places() const { return places_; }
  const std::array<CurveEnd, 2>& ends() const { return ends_; }
  double error() const { return follower_.error(); }
  /// Points where the curve changes its kind, in order; the curve's number is left 0.
  std::vector<SpecialPoint> specials() const;

 private:
  struct Way {
    std::vector<CurvePlace> places;
    CurveEnd end = CurveEnd::lost;
  };
  std::optional<Eigen::VectorXd> equation(const Eigen::VectorXd& at) const;
  std::optional<CurvePlace> described(const Eigen::VectorXd& at) const;
  Way way(const CurvePlace& from, const Eigen::VectorXd& towards, const StopFlag* stop);
  std::optional<CurvePlace> at_edge(const Eigen::VectorXd& inside, const Eigen::VectorXd& outside) const;
  std::optional<CurvePlace> at_vanishing_pair(const CurvePlace& before, const Eigen::VectorXd& after) const;
  /// Where the curve meets the end of balance.
  std::optional<CurvePlace> at_balance_end(const CurvePlace& before) const;
  CurveEnd reason_beyond(const CurveFollower::Step& last, double step) const;
  std::optional<CurvePlace> between(const CurvePlace& a, const CurvePlace& b, double part) const;
  template <class Changed>
  std::optional<CurvePlace> located(const CurvePlace& a, const CurvePlace& b, const Changed& changed) const;

  const BalancePlane& plane_;
  CurveKind kind_;
  mutable EigenPair like_;
  CurveFollower follower_;
  std::vector<CurvePlace> places_;
  std::array<CurveEnd, 2> ends_{CurveEnd::lost, CurveEnd::lost};
};

}  // namespace equipoise
