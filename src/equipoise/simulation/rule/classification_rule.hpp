// How a trajectory's outcome is decided at the final speed: data made by the attractor search and shared by all lanes.
// This room: the rule by which a batch decides an outcome, in the form that lanes evaluate.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

struct OwnRotor;

struct Caught {
  int attractor = 0;  ///< its identifier; 0: not caught
  double wait = 0.0;  ///< if not caught: how long another test would be useless
};

/// Says which attractor has caught a state: how lanes test trapping regions that no table of level sets describes.
class TrappingRegions {
 public:
  virtual ~TrappingRegions() = default;
  /// `psi`: the rotor's angle; `own`: the trajectory's own rotor, null if it has none. Thread-safe.
  virtual Caught ask(const double* state, double psi, const OwnRotor* own) const = 0;
};
using SharedRegions = std::shared_ptr<const TrappingRegions>;

/// Regions that a function tests, with the arguments of TrappingRegions::ask().
template <class Test>
SharedRegions regions_by(Test test) {
  struct Regions final : TrappingRegions {
    explicit Regions(Test t) : test(std::move(t)) {}
    Caught ask(const double* state, double psi, const OwnRotor* own) const override { return test(state, psi, own); }
    Test test;
  };
  return std::make_shared<const Regions>(std::move(test));
}

/// A linearly stable balanced state and a level set of a Lyapunov function around it.
struct BalancedRegion {
  /// The balanced state. A trajectory with its own rotor (simulation/batch/own_rotor.hpp) has that rotor's instead.
  std::array<double, max_dimension> place{};
  int state = 0;  ///< its number among the rotor's balanced states (machine/balance/balanced_state.hpp)
  /// Upper triangular F, row-major dimension x dimension of the system: the Lyapunov function of a deviation d is
  /// V = |F d|^2.
  std::vector<double> factor;
  double level = 0.0;                         ///< inside: V < level
  std::array<double, max_dimension> reach{};  ///< largest deviation inside, by component
  DecidedBy by = DecidedBy::validated;

  const double* angles() const { return &place[model::index::phi(0)]; }  ///< of the balls in the balanced state
};

/// A trapping region around a stable periodic orbit (classification/trapping_regions/orbit_region.hpp) in the form that
/// lanes evaluate at every step. Its phase is the angle of one ball, the clock. A table over that angle holds the
/// orbit, with chords between its states, and one quadratic form a cell. Let D = dimension - 1: all but the clock's
/// angle, in the order of the state. A row has D values where the cell begins, D changes across it, and D (D + 1) / 2
/// entries of the upper triangle of F.
struct OrbitRegionTable {
  int attractor = 0;
  int clock = 0;                                           ///< ball whose angle is the phase
  int turns = 1;                                           ///< of the clock in one period
  int cells = 0;                                           ///< of the table in one turn
  std::vector<double> table;                               ///< turns x cells rows, in order of the clock's angle
  double level = 0.0;                                      ///< inside: |F d|^2 < level
  double r2_low = 0.0, r2_high = 0.0;                      ///< r^2 of everything inside
  std::array<double, model::max_balls> q_low{}, q_high{};  ///< ball rates of everything inside
};
constexpr int cycle_table_columns(int dimension) { return 2 * (dimension - 1) + (dimension - 1) * dimension / 2; }

/// Features of a window: smallest, largest and root-mean-square r; then mean, smallest and largest rate phi' of each
/// ball; then the same of psi', all 0 at a prescribed speed. Interchangeable balls are sorted by mean rate. Only
/// feature_count(balls) of them are used.
using Features = std::array<double, 6 + 3 * model::max_balls>;
constexpr int feature_count(int balls) { return 6 + 3 * balls; }
/// Index of the mean psi'; the smallest and the largest follow.
constexpr int speed_feature(int balls) { return 3 + 3 * balls; }

/// Bounds on the features of short windows.
struct FeatureBox {
  Features low{}, high{};
  int attractor = 0;
  int hits_needed = 3;  ///< this many successive short windows inside decide
  int trend = -1;       ///< as KnownFeatures::trend
  int chaos = -1;       ///< as KnownFeatures::chaos, of the attractor: transient chaos looks like it
};
inline constexpr int most_boxes = 24;

/// Long-window features of an attractor.
struct KnownFeatures {
  Features features{};
  int attractor = 0;
  bool chaotic = false;  ///< no two windows are quite the same
  /// Where rotors differ: its index in OwnRotor::chaos_lasts; -1 if it ends for none of them.
  int chaos = -1;
  /// Where rotors differ: the row of OwnRotor::shifts to subtract from a rotor's features; -1: none.
  int trend = -1;
};

/// A continuum of balanced states (three balls or more).
struct ContinuumRegions {
  double reach = 0.0;  ///< asked only when all velocities, x, y and unbalance are below this
  SharedRegions regions;
};

/// Regions that test one state at a time, where a half short window ends that has stayed within these bounds of r^2 and
/// of all q.
struct WindowRegions {
  SharedRegions regions;  ///< may be null
  double r2_low = -1.0, r2_high = 1e300, q_low = -1e300, q_high = 1e300;
  /// A lane is not tested again for this share of the time followed so far, if that is longer than half a window.
  double rest = 0.0;
  /// Audits (ClassificationRule::blind): half windows for which a caught trajectory is followed on, so that boxes see
  /// them.
  int watched = 0;
};

/// A driven rotor that turns faster, in critical speeds, is given up: no machine does, and the integrator's steps
/// shrink with the speed.
inline constexpr double runaway_speed = 1e4;

/// The most isolated balanced states: one ball has one, two balls have two, more have a continuum.
inline constexpr std::size_t most_balanced = 2;
/// Of a tilting rotor; two planes of two balls have four, other planes may have more.
inline constexpr std::size_t most_balanced_of_tilt = 4;

struct ClassificationRule {
  int balls = 2;
  bool interchangeable = true;  ///< alike balls: features do not depend on their order
  bool at_horizon = false;      ///< nothing ends early; the state at the task's end decides
  bool blind = false;           ///< audits: boxes are watched but decide nothing; V is recorded
  /// Where rotors differ: chaos that may end for a rotor, or that differs a little from known chaos, is decided only
  /// after lasting this long. 0: all have one rotor.
  double chaos_lasts = 0.0;
  std::vector<BalancedRegion> balanced;  ///< at most most_balanced, or most_balanced_of_tilt
  std::vector<OrbitRegionTable> cycles;
  ContinuumRegions continuum;
  /// Of a rotor with anisotropic supports or gravity, driven or not. At the horizon they decide. Kernels of plain
  /// rotors do not test them.
  WindowRegions section;
  WindowRegions windowed;  ///< of motions of a system that does not depend on the rotor's angle
  double sag = 0.0;        ///< r is measured from Y = sag, X = 0 in fixed axes; not by kernels of plain rotors
  /// A driven rotor that turns faster on average over half a short window runs away for good, and is given up.
  double fastest = runaway_speed;
  double window = 16.0;              ///< length of a short window
  double first_long_window = 100.0;  ///< long windows end at this time and at its doublings
  double sameness = 0.02;            ///< relative change between long windows that counts as none
  int repeats_needed = 2;            ///< successive long windows that repeat the one before
  std::vector<FeatureBox> boxes;     ///< at most most_boxes
  std::vector<KnownFeatures> known;  ///< long-window features of attractors
};

/// What the pilot keeps of a trajectory: features of its last long window, the range of that window's short ones, the
/// longest run of windows inside each box, and how near it became balanced.
struct PilotRecord {
  Features features{};
  FeatureBox range;
  bool finished_window = false;  ///< features and range are set
  std::array<int, most_boxes> longest_run{};
  double least_value =
      1e300;  ///< smallest V of any balanced trapping region along the way; known in audits (ClassificationRule::blind)
};

// Driven rotors whose balls are clamped until the rotor reaches a speed: the rule of release, and how trajectories end.

/// When clamped balls are released, or the trajectory is given up.
struct ReleaseRule {
  double release_speed = std::numeric_limits<double>::infinity();  ///< infinite: never
  std::vector<double> own_speeds{};  ///< each trajectory's, if they have rotors of their own; else empty
  bool rising = true;                ///< released from that speed on; else from that speed down
  ClassificationRule windows;  ///< only its windows are set: they decide when a rotor that never gets there is steady
};

struct ClampedEnd {
  /// Attracted if steady; undecided at the task's end, or earlier if the rotor runs away.
  Outcome outcome;
  /// Whether it reached release_speed, or seemed to, in the step from `outcome.time` to `crossed_by`. Its state is that
  /// at `outcome.time`.
  bool crossing = false;
  double crossed_by = 0.0;
  double nearest = 0.0;  ///< the speed that came nearest to release_speed
};

}  // namespace equipoise
