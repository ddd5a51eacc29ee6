// How the features of one motion change from rotor to rotor within a part of a family.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "equipoise/simulation/batch/own_rotor.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// Features of a motion on the rotor at these coordinates (OwnRotor::coordinates).
struct ShownFeatures {
  std::vector<double> coordinates;
  Features features{};
};

/// A motion's windows look different on every rotor. Their features are fitted by a polynomial of the coordinates. One
/// entry of a rule then recognises the motion on all rotors, once features are brought back to the part's middle.
class FeatureTrends {
 public:
  /// Fits the trend of a motion. `first` certainly shows it; `others` come from rotors that began there, and some went
  /// elsewhere. `agreement`: how well windows of such a motion agree (same_motion()). Returns the row of
  /// OwnRotor::shifts that it fills, or -1 if too few stayed.
  int add(int balls, double agreement, const ShownFeatures& first, std::vector<ShownFeatures> others);
  /// Whether chaos lasts for the rotor at these coordinates.
  struct Lasting {
    std::vector<double> coordinates;
    bool lasts = false;
  };
  /// Adds chaos that was followed on many rotors; returns its number.
  int add_chaos(std::vector<Lasting> tried);
  /// Fills the rotor's shifts, and which chaos lasts for it.
  void place(OwnRotor& rotor) const;

 private:
  struct Trend {
    int degree;
    Eigen::MatrixXd coefficients;  // a row each term, a column each feature
  };
  std::vector<Trend> trends_;
  std::vector<std::vector<Lasting>> chaos_;
};

}  // namespace equipoise
