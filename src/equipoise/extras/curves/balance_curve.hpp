// One curve on which balance changes.
#pragma once

#include "equipoise/extras/curves/followed_curve.hpp"

namespace equipoise {

/// In the unit square: its unknowns are the two parameters alone.
class BalanceCurve : public FollowedCurve {
 public:
  BalanceCurve(const BalancePlane& plane, CurveKind kind, const EigenPair& like) : FollowedCurve(plane, kind, like) {}

 private:
  std::optional<Eigen::VectorXd> equation(const Eigen::VectorXd& at) const override;
  std::optional<CurvePlace> described(const Eigen::VectorXd& at) const override;
  std::optional<BalanceSpectrum> spectrum(const Eigen::VectorXd& at) const override { return plane_.spectrum(at); }
  SpecialKind kind_at_zero(const CurvePlace&) const override { return SpecialKind::zero_hopf; }
  void end_inside(const CurveFollower::Step& last, double step, const CurvePlace& before, Way& way) const override;
  /// Where the curve meets the end of balance.
  std::optional<CurvePlace> at_balance_end(const CurvePlace& before) const;
  CurveEnd reason_beyond(const CurveFollower::Step& last, double step) const;
};

}  // namespace equipoise
