// The studies of a plane: one study with other values of two numbers; the plane as a unit square, with what balance is
// at its points.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <Eigen/Core>

#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

inline constexpr std::uint64_t most_stability_points = std::uint64_t{1} << 24;

class PlaneStudies {
 public:
  /// Throws InputError for keys that are not numbers of rotor, balancer or speed, and if the study at a corner is
  /// invalid; also passes on what `check` throws for the study there.
  PlaneStudies(const Study& study, const SliceAxis& x, const SliceAxis& y,
               const std::function<void(const Study&)>& check = {});

  /// Unchecked if both keys are numbers of the study: a derivative at the end of a range looks beyond it.
  Study at(double x, double y) const;

  const Study& study() const { return study_; }  ///< as given
  const SliceAxis& x() const { return x_; }
  const SliceAxis& y() const { return y_; }
  /// Whether a study can have these values.
  bool valid(double x, double y) const;
  /// The given study's own values; none if one of them is not a single number.
  std::optional<double> own_x() const { return own(x_.key); }
  std::optional<double> own_y() const { return own(y_.key); }

  // Places in the unit square.
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
  Study read(double x, double y) const;
  std::optional<double> own(const std::string& key) const;

  Study study_;
  SliceAxis x_, y_;
};

}  // namespace equipoise
