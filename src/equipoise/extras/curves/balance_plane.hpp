// A plane of two parameters as a unit square, with what balance is at its points.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"

namespace equipoise {

class BalancePlane {
 public:
  explicit BalancePlane(const PlaneStudies& studies) : studies_(studies), x_(studies.x()), y_(studies.y()) {}

  const PlaneStudies& studies() const { return studies_; }
  double x(const Eigen::VectorXd& at) const { return x_.low + at[0] * (x_.high - x_.low); }
  double y(const Eigen::VectorXd& at) const { return y_.low + at[1] * (y_.high - y_.low); }
  Eigen::VectorXd place(double x, double y) const {
    return Eigen::Vector2d((x - x_.low) / (x_.high - x_.low), (y - y_.low) / (y_.high - y_.low));
  }

  /// Empty where no study can have the values, and where nothing turns.
  std::optional<model::System> system(const Eigen::VectorXd& at) const;
  /// Empty without a balanced state, and where no study can have the values.
  std::optional<BalanceSpectrum> spectrum(const Eigen::VectorXd& at) const;
  /// lambda + sum mu_i - 2 max(lambda, mu_i).
  std::optional<double> margin(const Eigen::VectorXd& at) const;
  /// With the balls in line, as they are where the margin is 0: a balanced state there, and no equilibrium elsewhere.
  std::optional<BalanceSpectrum> in_line(const Eigen::VectorXd& at) const;

 private:
  std::optional<Study> study_at(const Eigen::VectorXd& at) const;

  const PlaneStudies& studies_;
  SliceAxis x_, y_;
};

}  // namespace equipoise
