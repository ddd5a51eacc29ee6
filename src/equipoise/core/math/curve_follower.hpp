// Follows a curve by pseudo-arclength continuation.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include <Eigen/Core>

namespace equipoise {

/// One equation fewer than unknowns; empty where the equations are not defined. Unknowns are of size 1. Method: H. B.
/// Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems (1977).
class CurveFollower {
 public:
  using Equations = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;

  static constexpr double longest_step = 0.01, shortest_step = 1e-7, precision = 1e-11;
  struct Limits {
    double longest = longest_step;
    double precise = precision;          ///< a correction this short is the last
    double flat = 0.03, sharpest = 0.1;  ///< radians between tangents: below steps grow, above they shrink
    /// Slopes cost far more than equations: they are kept and corrected by what the equations show (C. G. Broyden,
    /// Math. Comp. 19 (1965) 577), and tangents follow from the points.
    bool slopes_are_dear = false;
  };

  using Slopes = std::function<std::optional<Eigen::MatrixXd>(const Eigen::VectorXd&)>;

  /// `slopes`: derivatives of the equations; differences() if there are none.
  explicit CurveFollower(Equations equations, Slopes slopes = {})
      : equations_(std::move(equations)), slopes_(std::move(slopes)) {}
  CurveFollower(Equations equations, Slopes slopes, const Limits& limits)
      : equations_(std::move(equations)), slopes_(std::move(slopes)), limits_(limits) {}

  /// The point of the curve with normal . X = normal . guess. Empty if Newton's method does not find it to the
  /// precision.
  std::optional<Eigen::VectorXd> at_plane(const Eigen::VectorXd& guess, const Eigen::VectorXd& normal) const;
  /// A point of the curve near `guess`: across the equations' gradients.
  std::optional<Eigen::VectorXd> nearby(const Eigen::VectorXd& guess) const;
  /// Unit tangent on the side of `towards`. Empty next to places where the equations are not defined.
  std::optional<Eigen::VectorXd> tangent(const Eigen::VectorXd& at, const Eigen::VectorXd& towards) const;

  struct Step {
    Eigen::VectorXd point, tangent;
    double length = 0.0;    ///< of the chord to this point; 0: the first
    Eigen::VectorXd chord;  ///< its direction
    Eigen::VectorXd bend;   ///< the tangent's change by length, where slopes are dear and two chords are known
  };
  /// The next point: `step` is shortened until the curve turns by little, and lengthened where it turns by less. Empty
  /// if even the shortest step fails.
  std::optional<Step> next(const Step& from, double& step) const;

  /// Derivatives by central differences.
  std::optional<Eigen::MatrixXd> differences(const Eigen::VectorXd& at) const;

  /// Last correction of the points that were found: their largest distance from the curve.
  double error() const { return error_; }

 private:
  std::optional<Eigen::MatrixXd> slopes(const Eigen::VectorXd& at) const {
    return slopes_ ? slopes_(at) : differences(at);
  }

  std::optional<Eigen::VectorXd> at_plane_by(Eigen::MatrixXd& slopes, const Eigen::VectorXd& guess,
                                             const Eigen::VectorXd& normal) const;
  std::optional<Step> step_to(const Step& from, double step) const;

  Equations equations_;
  Slopes slopes_;
  Limits limits_;
  mutable Eigen::MatrixXd kept_;
  mutable double error_ = 0.0;
};

}  // namespace equipoise
