// Content of the page for one machine, before it is drawn.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

/// One table of the study as written: {"rotor", "mass 2.2 kg; damping 20 N s/m"}.
using GivenTable = std::array<std::string, 2>;

/// What a study says of its machine, and what follows without simulation.
struct GivenMachine {
  std::vector<GivenTable> given;
  Explanation explanation;
  /// What the study does not state and what is then assumed, and which estimate matters most
  /// (report/explain/explain.hpp); empty without the study's text.
  std::vector<std::string> assumed;
  std::string matters_most;
};

/// A stretch of a motion at equally spaced times, dimensionless.
struct MotionPath {
  std::vector<double> psi;  ///< rotor angle
  /// Centre of the race, or of a section of a shaft that tilts, in fixed axes, from where it rests.
  std::vector<double> x, y;
  std::vector<std::vector<double>> phi;  ///< by ball: angle from the heavy side, in the rotating frame; unwrapped
};

/// What one ball does on a motion, in the rotating frame.
struct BallOnMotion {
  double place = 0.0;            ///< an angle on its way, at the same time for all balls
  double low = 0.0, high = 0.0;  ///< ends of its oscillation, unwrapped; at most a turn
  double drift = 0.0;            ///< mean rate; 0 if the ball returns; otherwise `low` and `high` are meaningless
};

/// A motion in which starts end.
struct DrawnMotion : OutcomeShare {
  std::vector<double> x, y;  ///< of its path
  std::vector<BallOnMotion> balls;
  double r_min = 0.0, r_mean = 0.0, r_max = 0.0;
  double speed = 0.0;      ///< of the rotor, mean
  bool continuum = false;  ///< one member of a continuum
  bool one_start = false;  ///< the end of one start's run, because the motion itself is not known
  /// Of a tilting rotor, with bearings: along the shaft the outermost one that moves more, whose path and distances
  /// these are.
  std::optional<double> bearing{};
};

/// Distribution of a figure of transients: starts (weighted on a grid) by equal bins and by outcome.
struct FigureDistribution {
  const TransientLimit* limited = nullptr;  ///< the figure, and its limit
  double low = 0.0, high = 0.0;             ///< outer edges
  struct Outcome {
    int code = 0;
    std::string name;
    std::vector<double> bins;  ///< shares of all starts drawn
  };
  std::vector<Outcome> outcomes;  ///< as they are listed
};

/// Whose run is shown.
enum class RunOf {
  bare,              ///< the rotor without balls
  median,            ///< the start with the median peak displacement
  worst_in_hundred,  ///< the start whose peak only one in a hundred exceeds
};

/// One run followed again. Every entry covers a stretch of time; the next begins where it ends.
struct ShownRun {
  RunOf of = RunOf::median;
  std::uint64_t index = 0;                      ///< of the start; of `bare`: whose rotor it is
  int code = 0;                                 ///< not of `bare`
  OutcomeShare outcome;                         ///< its name; not of `bare`
  double peak = 0.0;                            ///< displacement, as gathered in the ensemble
  double again = 0.0;                           ///< and as found here
  double at_end = 0.0;                          ///< largest displacement in the last tenth of what is shown
  std::vector<double> t, r_low, r_high, speed;  ///< middle of the stretch; extremes of the displacement; mean psi'
};

struct MachinePage : GivenMachine {
  BasinResult basin;                 ///< without its starts
  std::vector<DrawnMotion> motions;  ///< the most frequent first
  std::size_t motions_left_out = 0;  ///< rarer ones
  std::uint64_t starts_drawn = 0;    ///< in `peaks`, and candidates for `runs`: the first ones
  std::vector<FigureDistribution> peaks;
  std::vector<ShownRun> runs;  ///< in the order of RunOf; fewer if stopped, or if one start is both
};

}  // namespace equipoise
