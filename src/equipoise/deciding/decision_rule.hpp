// How a trajectory's fate is recognised at the final speed: data shared by all lanes.
#pragma once

#include <array>
#include <vector>

#include "equipoise/deciding/trap_set.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

struct OwnRotor;

/// A linearly stable balanced state and a level set of a Lyapunov function around it.
struct BalancedTrap {
  std::array<double, model::max_balls> phi{};  ///< ball angles of the balanced state
  /// Its other components: 0 but for a driven rotor's speed and for all of them where the race is off centre.
  std::array<double, max_dimension> centre{};
  int state = 0;  ///< its number among the rotor's balanced states (model/balanced_state.hpp)
  /// Upper triangular F, row-major dimension x dimension of the system: the Lyapunov function of a deviation d is
  /// V = |F d|^2.
  std::vector<double> factor;
  double level = 0.0;                         ///< inside: V < level
  std::array<double, max_dimension> reach{};  ///< no point inside deviates further in that component
  DecidedBy by = DecidedBy::validated;

  /// The balanced state as a whole. Of a trajectory that has a rotor of its own (lanes/own_rotor.hpp) that rotor's
  /// stands in its place.
  std::array<double, max_dimension> place(int balls) const {
    std::array<double, max_dimension> result = centre;
    for (int i = 0; i < balls; ++i) result[model::index::phi(i)] = phi[i];
    return result;
  }
};

/// A trap around a stable periodic orbit (traps/cycle_trap.hpp) whose phase is the angle of one ball, the clock, as
/// lanes ask it at every step: chords between the states of a table over that angle, one quadratic form a cell. Columns
/// of a row, D = dimension - 1 (all but the clock's angle, in the order of the state): D values where the cell begins,
/// D changes across the cell, D (D + 1) / 2 entries of the upper triangular F.
struct CycleTable {
  int attractor = 0;
  int clock = 0;                                           ///< ball whose angle tells the phase
  int turns = 1;                                           ///< of the clock in one period
  int cells = 0;                                           ///< of the table a turn
  std::vector<double> table;                               ///< turns x cells rows, by growing clock angle
  double level = 0.0;                                      ///< inside: |F d|^2 < level
  double r2_low = 0.0, r2_high = 0.0;                      ///< r^2 of everything inside
  std::array<double, model::max_balls> q_low{}, q_high{};  ///< ball rates of everything inside
};
constexpr int cycle_table_columns(int dimension) { return 2 * (dimension - 1) + (dimension - 1) * dimension / 2; }

/// Features of a window: smallest, largest and root-mean-square r; then for each ball mean, smallest and largest rate
/// phi'; then the same of psi', all 0 where it is prescribed. Interchangeable balls are sorted by mean rate.
/// feature_count(balls) of them are used.
using Features = std::array<double, 6 + 3 * model::max_balls>;
constexpr int feature_count(int balls) { return 6 + 3 * balls; }
/// The place of the largest r.
inline constexpr int radius_feature = 1;
/// The place of the mean psi'; least and greatest follow.
constexpr int speed_feature(int balls) { return 3 + 3 * balls; }

/// Bounds on the features of short windows.
struct FeatureBox {
  Features low{}, high{};
  int attractor = 0;
  int hits_needed = 3;  ///< successive short windows inside that decide
  int trend = -1;       ///< as KnownFeatures::trend
  int chaos = -1;       ///< of the attractor's chaos, as KnownFeatures::chaos: passing chaos looks like it
};
inline constexpr int most_boxes = 24;

/// Long-window features of an attractor.
struct KnownFeatures {
  Features features{};
  int attractor = 0;
  bool chaotic = false;  ///< no two windows are quite the same
  /// Of rotors that differ: its number among OwnRotor::chaos_lasts; -1: for none of them it ends.
  int chaos = -1;
  /// Of rotors that differ: the row of OwnRotor::shifts that features of their own have to be brought back by; -1:
  /// none.
  int trend = -1;
};

/// A continuum of balanced states (three balls or more).
struct FamilyTrap {
  double reach = 0.0;  ///< asked only when all velocities, x, y and imbalance are below this
  Traps traps;
};

/// Of motions of a system whose rotor's angle does not matter, one state at a time: asked where half a short window
/// ends that has stayed within these bounds of r^2 and of all q.
struct WindowTraps {
  Traps traps;
  double r2_low = 0.0, r2_high = 1e300, q_low = -1e300, q_high = 1e300;
  /// Asked again after this share of all the time that a lane has been followed, if that is longer than half a window.
  double rest = 0.0;
  /// Audits (DecisionRule::blind): half windows for which what is caught is followed on, so that boxes learn what
  /// they show.
  int watched = 12;
};

/// A driven rotor that turns faster, in critical speeds, is beyond any machine: the integrator's steps shrink with the
/// turns to be made.
inline constexpr double runaway_speed = 1e4;

/// As many isolated balanced states there are: two balls have two, one ball one, more a continuum.
inline constexpr std::size_t most_balanced = 2;

struct DecisionRule {
  int balls = 2;
  bool interchangeable = true;  ///< equal balls: features do not depend on their order
  bool at_horizon = false;      ///< nothing ends early; what holds at the task's end decides
  bool blind = false;           ///< audits: boxes are watched and decide nothing; V is recorded
  /// Of rotors that differ: chaos of one for which it may end, or which looks a little otherwise than what is known, is
  /// told only once it has lasted for so long. 0: all have one rotor.
  double chaos_lasts = 0.0;
  std::vector<BalancedTrap> balanced;  ///< at most most_balanced
  std::vector<CycleTable> cycles;
  FamilyTrap family;
  /// Of a rotor with anisotropic supports or gravity, driven or not: asked where half a short window ends. Null: none;
  /// not asked by kernels of plain rotors.
  Traps strobed;
  WindowTraps windowed;
  double sag = 0.0;  ///< r is measured from Y = sag, X = 0 in fixed axes; not by those either
  /// A driven rotor that turns faster on average over half a short window runs away for good, and is given up.
  double fastest = runaway_speed;
  double window = 16.0;              ///< length of a short window
  double first_long_window = 100.0;  ///< long windows end at this time and at its doublings
  double sameness = 0.02;            ///< relative change between long windows that counts as none
  int repeats_needed = 2;            ///< successive long windows that repeat the one before
  std::vector<FeatureBox> boxes;     ///< at most most_boxes
  std::vector<KnownFeatures> known;  ///< attractors by their long windows
};

/// What the pilot keeps of a trajectory: the features of its last long window, the range of that window's short ones,
/// for every box of the rule the longest run of windows inside, and how near it came to balance.
struct PilotRecord {
  Features features{};
  FeatureBox range;
  bool finished_window = false;  ///< features and range hold something
  std::array<int, most_boxes> longest_run{};
  double least_value = 1e300;  ///< smallest V of any balanced trap along the way; known in audits (DecisionRule::blind)
};

}  // namespace equipoise
