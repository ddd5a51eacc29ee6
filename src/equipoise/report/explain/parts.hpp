// The parts of an explanation, in the order in which explain() makes them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/explanation.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A study's quantities, in the order of its own tables.
std::vector<ExplainedQuantity> quantity_table(const Study& study);

/// Fills `e.motion`, or `e.no_motion` with why not. Where the equations depend on the rotor's angle, by the multipliers
/// of the motion that a balanced state becomes. Gravity is left out of a continuum, and where a ball's weight exceeds
/// its centrifugal force.
void linearise(Explanation& e, const StopFlag* stop);
/// The angle that each ball takes up in the race, also where the study lets balls pass each other: real ones cannot.
/// Empty where the study does not give their size.
std::vector<double> ball_widths(const Study& study);

/// The rules of thumb applied to an explanation that lacks only advice and warnings. A rule that says nothing of the
/// study says why.
std::vector<RuleOfThumb> advice(const Explanation& e);

/// To an explanation that has all else. Once `stop` is set, those that need starts are left out.
void add_warnings(Explanation& e, const StopFlag* stop);

/// The estimated quantity to which balance is most sensitive, what a change of it does, and how that was judged. Once
/// `stop` is set, that it was stopped.
std::string what_matters_most(const Study& study, const StopFlag* stop);

/// Rates near one balanced state as all drags are multiplied by one factor.
class DragScan {
 public:
  /// At constant `speed`, on equal supports and without gravity. `family`: the state is one of a continuum.
  DragScan(const model::Parameters& p, double speed, const std::array<double, model::max_balls>& angles, bool family);

  /// Largest real part of an eigenvalue, the continuum's own zeros left out.
  double slowest(double factor) const;

  /// The factors within [low, high] at which balls settle at `share` of the fastest rate or faster. None if no factor
  /// makes balance stable.
  struct Range {
    double low, best, high;
  };
  std::optional<Range> range(double share, double low, double high) const;

 private:
  double fastest_within(double low, double high) const;
  double end_of(double best, double end, double rate) const;

  Eigen::MatrixXd without_, drag_;  // the equations are linear in drag
  int freedom_;
};

}  // namespace equipoise
