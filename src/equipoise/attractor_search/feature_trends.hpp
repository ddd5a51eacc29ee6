// How the features of one motion change from rotor to rotor of a family's part.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/batch/own_rotor.hpp"
#include "equipoise/classification/classification_rule.hpp"

namespace equipoise {

/// Features that a motion of the rotor at these coordinates (OwnRotor::coordinates) showed.
struct ShownFeatures {
  std::vector<double> coordinates;
  Features features{};
};

/// A motion's windows look otherwise for every rotor. What they look like is a polynomial of the coordinates, so that
/// one entry of a rule, brought back to the part's middle, tells the motion of all.
class FeatureTrends {
 public:
  /// Fits the trend of an attractor: `first` is what it surely shows, `others` what rotors showed that began there,
  /// some of which went elsewhere. `agreement`: how well windows of such a motion agree (same_motion()). Returns the
  /// row of OwnRotor::shifts that it fills; -1: too few stayed.
  int add(int attractor, int balls, double agreement, const ShownFeatures& first, std::vector<ShownFeatures> others);
  /// One rotor's chaos: whether it lasts for a rotor with these coordinates.
  struct Lasting {
    std::vector<double> coordinates;
    bool lasts = false;
  };
  /// Chaos that was followed for many rotors; returns its number.
  int add_chaos(std::vector<Lasting> tried);
  /// What the attractor shows where the rotor has these coordinates: of several motions the first, if it has a trend.
  std::optional<Features> features(int attractor, const std::vector<double>& coordinates) const;
  /// Fills in the rotor's shifts, and which chaos lasts for it.
  void place(OwnRotor& rotor) const;

 private:
  struct Trend {
    int attractor, balls, degree;
    Eigen::MatrixXd coefficients;  // a row a term, a column a feature
  };
  std::vector<Trend> trends_;
  std::vector<std::vector<Lasting>> chaos_;
};

}  // namespace equipoise
