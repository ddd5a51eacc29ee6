// A curve in a plane of two parameters, followed from a place near it to both of its ends; curves of balance.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/core/math/curve_follower.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// A place on a curve.
struct CurvePlace {
  Eigen::VectorXd at;  ///< in the unit square, then what else is unknown on the curve
  EigenPair pair;      ///< of a Hopf curve; of a torus's multipliers
  CurvePoint point;
  /// Of a fold, of states or cycles, and of a period doubling: right and left eigenvector of the zero, of unit length
  /// and without jumps along the curve.
  Eigen::VectorXd right, left;
  double double_zero = 0.0;  ///< left . right: 0 where the zero is double
  double turn = 0.0;         ///< left . second derivative along `right` twice: 0 where the fold itself turns back
};

/// Derived classes define a kind of curve: its equations, and what is reported at a place.
class FollowedCurve {
 public:
  FollowedCurve(const FollowedCurve&) = delete;
  FollowedCurve& operator=(const FollowedCurve&) = delete;
  virtual ~FollowedCurve() = default;

  /// Whether a place of a curve is on one that is known already.
  using Known = std::function<bool(const CurvePlace&)>;
  /// False if there is no curve near `guess`, or a known one. A stopped curve ends where it has come to.
  bool follow(const Eigen::VectorXd& guess, const StopFlag* stop, const Known& known = {});

  const std::vector<CurvePlace>& places() const { return places_; }
  const std::array<CurveEnd, 2>& ends() const { return ends_; }
  double error() const { return follower_.error(); }
  /// Points where the curve changes its kind, in order; the curve's number is left 0.
  virtual std::vector<SpecialPoint> specials() const;

 protected:
  /// `like`: the pair that crosses, of a Hopf curve.
  FollowedCurve(const PlaneStudies& plane, CurveKind kind, const EigenPair& like,
                const CurveFollower::Limits& limits = {}, std::size_t most = 20000);

  virtual std::optional<Eigen::VectorXd> equation(const Eigen::VectorXd& at) const = 0;
  /// Its derivatives; by differences unless a curve knows them better.
  virtual std::optional<Eigen::MatrixXd> slopes(const Eigen::VectorXd& at) const { return follower_.differences(at); }
  virtual std::optional<CurvePlace> described(const Eigen::VectorXd& at) const = 0;
  /// Why the place requested last could not be described.
  virtual CurveEnd undescribed() const { return CurveEnd::lost; }
  /// What kind of point it is where a real eigenvalue of a Hopf curve is 0.
  virtual SpecialKind kind_at_zero(const CurvePlace&) const { return SpecialKind::zero_hopf; }
  /// The equations from here on are those near this place.
  virtual void stay_near(const CurvePlace& place) const;
  struct Way {
    std::vector<CurvePlace> places;
    CurveEnd end = CurveEnd::lost;
  };
  /// Whether something turns too far between two places for its turns to be counted.
  virtual bool too_far(const CurvePlace&, const CurvePlace&) const { return false; }
  /// Why a way ends before this place, if it does; it may get a last place there.
  virtual std::optional<CurveEnd> end_at(const CurvePlace& before, const CurvePlace& place, Way& way) const;
  /// Why a way ends inside the plane, if that is known; it may get a last place there. Arguments: the last step, the
  /// length that failed, the place before.
  virtual void end_inside(const CurveFollower::Step&, double, const CurvePlace&, Way&) const {}

  using PlaceNumber = std::function<double(const CurvePlace&)>;
  /// Where a number that has different signs at two places is 0. Empty if it passes through infinity.
  virtual std::optional<CurvePlace> zero_of(const CurvePlace& a, const CurvePlace& b, const PlaceNumber& value) const;
  /// Special points between two places at which a number of this kind of curve is 0.
  void add_zeros(const CurvePlace& a, const CurvePlace& b, std::vector<SpecialPoint>& found) const;
  CurvePlace place_at(const Eigen::VectorXd& at) const {
    CurvePlace place;
    place.at = at;
    place.point.x = plane_.x(at);
    place.point.y = plane_.y(at);
    return place;
  }
  static SpecialPoint special(SpecialKind kind, const CurvePlace& place, double second = 0.0) {
    return {kind, 0, place.point.x, place.point.y, place.point.frequency, second, place.point.state};
  }
  std::optional<CurvePlace> between(const CurvePlace& a, const CurvePlace& b, double part) const;
  /// The pair nearest to `like` among the rates of a state at rest: its frequency, what its swing does, and how many
  /// other rates are unstable. False if there is no pair.
  bool put_pair(const BalanceSpectrum& at, CurvePlace& place) const;

  const PlaneStudies& plane_;
  CurveKind kind_;
  mutable EigenPair like_;
  mutable Eigen::VectorXd row_, column_;  ///< of a fold's bordered matrix
  CurveFollower follower_;
  std::vector<CurvePlace> places_;
  std::array<CurveEnd, 2> ends_{CurveEnd::lost, CurveEnd::lost};

 private:
  Way way(const CurvePlace& from, const Eigen::VectorXd& towards, const StopFlag* stop);
  std::optional<CurvePlace> at_edge(const Eigen::VectorXd& inside, const Eigen::VectorXd& outside) const;
  /// Where `changed` turns from false, at a, to true, at b.
  std::optional<CurvePlace> located(const CurvePlace& a, const CurvePlace& b,
                                    const std::function<bool(const CurvePlace&)>& changed) const;
  /// Where the number of other unstable eigenvalues changes between two places: which they are.
  void add_crossing(const CurvePlace& a, const CurvePlace& b, std::vector<SpecialPoint>& found) const;
  const std::size_t most_;  // places each way
};

inline void put_state(const BalanceSpectrum& at, CurvePoint& point) {
  point.state.assign(at.state.begin(), at.state.end());
  point.rates = at.rates;
}

/// For an oscillation a little too large for linear theory, at a state with a pair of about this frequency on the
/// imaginary axis: its growth rate is Re(eigenvalue) + a^2 times this, with a the amplitude, in radians, of the ball
/// that swings most. First Lyapunov coefficient as in Kuznetsov, Elements of Applied Bifurcation Theory, section 5.4,
/// with exact derivatives and this scale of the eigenvector. Empty for a member of a continuum, under a motor, and if
/// the pair is not a pair or another eigenvalue is 0.
std::optional<double> first_lyapunov(const BalanceSpectrum& at, double frequency);

/// Unstable eigenvalues in addition to the pair.
int unstable_besides(const std::vector<std::complex<double>>& rates, const EigenPair& pair);

/// In the unit square: its unknowns are the two parameters alone.
class BalanceCurve : public FollowedCurve {
 public:
  BalanceCurve(const PlaneStudies& plane, CurveKind kind, const EigenPair& like) : FollowedCurve(plane, kind, like) {}

 private:
  std::optional<Eigen::VectorXd> equation(const Eigen::VectorXd& at) const override;
  std::optional<CurvePlace> described(const Eigen::VectorXd& at) const override;
  void end_inside(const CurveFollower::Step& last, double step, const CurvePlace& before, Way& way) const override;
  /// Where the curve meets the end of balance.
  std::optional<CurvePlace> at_balance_end(const CurvePlace& before) const;
  CurveEnd reason_beyond(const CurveFollower::Step& last, double step) const;
};

}  // namespace equipoise
