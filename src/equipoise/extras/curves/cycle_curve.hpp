// One curve on which cycles change: two merge, a period doubles, a torus is born.
#pragma once

#include "equipoise/extras/curves/followed_curve.hpp"
#include "equipoise/extras/cycles/cycle_branch.hpp"
#include "equipoise/extras/cycles/cycle_shooting.hpp"

namespace equipoise {

/// Each way.
inline constexpr std::size_t most_cycle_points = 500;

/// Unknown are the two parameters, the period and states of the cycle. Equations: multiple shooting with a fixed phase,
/// and a test function of the monodromy matrix (CycleTest).
class CycleCurve : public FollowedCurve {
 public:
  CycleCurve(const PlaneStudies& plane, const model::System& system, const CycleCrossing& crossing);

  bool follow_from(const CycleCrossing& crossing, const StopFlag* stop, const Known& known);
  std::vector<SpecialPoint> specials() const override;

 private:
  std::optional<Eigen::VectorXd> equation(const Eigen::VectorXd& at) const override;
  std::optional<Eigen::MatrixXd> slopes(const Eigen::VectorXd& at) const override;
  std::optional<CurvePlace> described(const Eigen::VectorXd& at) const override;
  CurveEnd undescribed() const override { return seen_.value ? CurveEnd::multiplier : CurveEnd::lost; }
  void stay_near(const CurvePlace& place) const override;
  bool too_far(const CurvePlace& before, const CurvePlace& place) const override;
  std::optional<CurveEnd> end_at(const CurvePlace& before, const CurvePlace& place, Way& way) const override;
  void end_inside(const CurveFollower::Step& last, double step, const CurvePlace& before, Way& way) const override;
  /// The way's end where from this place on it has the same cycles again, at another time of their period.
  std::optional<CurveEnd> end_of_repeating(const CurvePlace& before, const CurvePlace& place, Way& way) const;

  Eigen::Vector3d timeless(const Eigen::VectorXd& at) const;
  std::optional<std::size_t> same_chord(const CurvePlace& place, const std::vector<CurvePlace>& places,
                                        std::size_t count) const;
  Eigen::VectorXd half_a_period(const CurvePlace& place) const;
  void come_nearer_to_turn(Way& way, const CurvePlace& beyond) const;
  bool add_single_cycle(Way& way) const;

  CycleShape shape(const Eigen::VectorXd& at) const { return shooting_.shape(at.tail(shooting_.unknowns())); }
  /// What is known of the place that was requested last. False where nothing is.
  bool look_at(const Eigen::VectorXd& at) const;
  bool look_closer() const;
  double turn_at(const CurvePlace& place) const;
  bool may_turn(std::size_t k) const;
  std::optional<CurvePlace> zero_of(const CurvePlace& a, const CurvePlace& b, const PlaceNumber& value) const override;
  void add_changed_others(const CurvePlace& a, const CurvePlace& b, std::vector<SpecialPoint>& found) const;

  double birth_period_;
  mutable CycleShooting shooting_;
  mutable CycleTest test_;
  struct Seen {
    Eigen::VectorXd at;
    std::optional<model::System> system;
    CycleShape shape;
    std::optional<CycleArcs> arcs;
    std::optional<CycleTest::Value> value;
    std::optional<Eigen::RowVectorXd> test_slopes;
  };
  mutable Seen seen_;
};

}  // namespace equipoise
