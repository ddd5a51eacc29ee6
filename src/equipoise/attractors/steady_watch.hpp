// When a machine's trajectory has become steady, and what its balls then do: for motions that are told by measuring
// them alone (a driven rotor, balls that touch or stick), without a list of attractors.
#pragma once

#include <array>
#include <string>

#include "equipoise/attractors/decision_rule.hpp"
#include "equipoise/attractors/window_features.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// A machine's motion at one time.
struct SteadySample {
  double r2 = 0.0;                              ///< squared distance from the static position
  std::array<double, model::max_balls> rate{};  ///< phi'
};

/// What the balls do in a steady motion. Identifiers as in motion_name(); from first_free_id on for three balls or
/// more.
struct SteadyKind {
  int id = 0;
  std::string name;
};

/// Kinds by what each ball does: `balanced` where all rest on the rotor and it shakes less than half as much as without
/// balls at that speed, `locked` where they rest and it does not; else by how many are captured (no mean drift) and
/// whether the others drift alike.
SteadyKind steady_kind(const model::Parameters& p, const Features& features, double speed);
/// Every kind of n balls, in the order of identifiers.
std::vector<SteadyKind> steady_kinds(int balls);

/// Distance at which the rotor without balls would whirl at `speed` (mean of both supports).
double bare_response(const model::Parameters& p, double speed);

/// Watches one trajectory. Steady is a motion whose features and mean speed repeat from each of two long windows to the
/// next (window_features.hpp), one that is of the same kind throughout five of them (a torus, chaos), or one that
/// shrinks towards balance within 1/20 of the bare rotor's response.
class SteadyWatch {
 public:
  /// `typical_speed` sets the windows' lengths: they hold several turns of it.
  SteadyWatch(const model::Parameters& p, double typical_speed);

  /// Forgets all, and begins at time `t` with the rotor at angle `psi` and the balls at `phi`.
  void begin(double t, double psi, const double* phi);
  /// A step to time `t`: samples at a third, two thirds and its end; angles there. True once steady.
  bool step(double t, double psi, const double* phi, const std::array<SteadySample, 3>& samples);

  /// Whether the mean speed repeats, steady or not.
  bool speed_repeats() const { return speed_repeats_ >= 2; }
  /// Of the last long window; begin() leaves them.
  const Features& features() const { return features_; }
  double mean_speed() const { return mean_speed_; }
  /// Whether a long window has been finished since begin().
  bool has_features() const { return has_features_; }

 private:
  void open_half(double t, const double* phi);
  void finish_half(double t, const double* phi);
  bool finish_long(double t, double psi);
  bool repeats(const Features& before) const;

  const model::Parameters& p_;
  DecisionRule rule_;
  WindowTracker tracker_;
  WindowSums sums_;
  double begin_ = 0.0, half_begin_ = 0.0, long_begin_ = 0.0, long_end_ = 0.0, long_psi_ = 0.0, last_ = 0.0;
  std::array<double, model::max_balls> half_phi_{};
  double mean_speed_ = 0.0, largest_r_ = 0.0, previous_r_ = 0.0, fastest_ = 0.0, previous_fastest_ = 0.0;
  int speed_repeats_ = 0, repeats_ = 0, speed_windows_ = 0, kind_repeats_ = 0, kind_ = 0;
  bool has_features_ = false;
  Features features_{};
};

}  // namespace equipoise
