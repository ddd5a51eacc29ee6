// Curves in a plane of two parameters on which balance and locked states change, the points where they change their
// kind, regions by what exists and is stable, and boxes in which it is proved what balance does.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/extras/planes/stability_plane.hpp"

namespace equipoise {

/// What happens on a curve. The values are stored in files.
enum class CurveKind : signed char {
  hopf = 0,         ///< a pair of eigenvalues crosses the imaginary axis
  zero = 1,         ///< a real eigenvalue at balance crosses zero
  existence = 2,    ///< the balls just reach: in line they cancel the unbalance; beyond there is no balanced state
  fold = 3,         ///< two locked states merge; beyond there is neither
  pitchfork = 4,    ///< alike balls of a locked state part, with the rotor centred: a real eigenvalue crosses zero
  cycle_fold = 5,   ///< two cycles merge: a multiplier is 1
  cycle_flip = 6,   ///< a cycle's period doubles: a multiplier is -1
  cycle_torus = 7,  ///< a second swing begins about a cycle: a pair of multipliers is on the unit circle
};
inline constexpr std::array<const char*, 8> curve_kind_names{"hopf",      "zero",       "existence",  "fold",
                                                             "pitchfork", "cycle-fold", "cycle-flip", "cycle-torus"};
/// Curves of cycles: periodic motions in the rotating frame.
constexpr bool is_of_cycles(CurveKind kind) { return kind >= CurveKind::cycle_fold; }

/// What a curve is of that is not of a locked state; locked states have their own names.
inline constexpr char of_balance[] = "balance";

struct CurvePoint {
  double x = 0.0, y = 0.0;
  double frequency = std::numeric_limits<double>::quiet_NaN();  ///< of the pair, or of the cycle, omega_c
  /// First Lyapunov coefficient as a change of the growth rate: omega_c per square of the largest swing of a ball, in
  /// radians. Negative: a swing that grows settles small (supercritical). Not a number of continua.
  double lyapunov = frequency;
  /// Unstable eigenvalues, or multipliers, in addition to those that cross: 0 where the motion itself loses stability.
  int others = 0;
  double swing = frequency;  ///< of a cycle: half of what the ball covers that swings most, radians
  /// Of model::System, that of which this is a point, or a state of the cycle; none of `existence`.
  std::vector<double> state;
  /// Its eigenvalues, those that grow most first; of a cycle its multipliers but that of a shift in time.
  std::vector<std::complex<double>> rates;
};

/// The numbers of a point: as CSV and JSON name them, those of cycles only there.
struct CurveNumber : Column {
  double (*value)(const CurvePoint&);
  bool whole = false, of_cycles = false;
};
inline constexpr std::array<CurveNumber, 6> curve_numbers{{
    {{"x", "parameter x of the point"}, [](const CurvePoint& p) { return p.x; }},
    {{"y", "parameter y of the point"}, [](const CurvePoint& p) { return p.y; }},
    {{"frequency", "frequency of the pair or the cycle", study::Dimension::speed},
     [](const CurvePoint& p) { return p.frequency; }},
    {{"lyapunov", "growth rate per square of the swing, omega_c/rad^2"},
     [](const CurvePoint& p) { return p.lyapunov; }},
    {{"others", "other unstable eigenvalues"}, [](const CurvePoint& p) { return static_cast<double>(p.others); }, true},
    {{"swing", "half of what the ball of a cycle covers that swings most", study::Dimension::angle},
     [](const CurvePoint& p) { return p.swing; },
     false,
     true},
}};

/// Why a curve ends. The values are stored in files.
enum class CurveEnd : signed char {
  plane = 0,          ///< at the plane's edge
  closed = 1,         ///< at its own beginning
  no_balance = 2,     ///< where the balanced state ends
  no_pair = 3,        ///< the pair's frequency falls to 0 (Bogdanov-Takens)
  lost = 4,           ///< it could not be followed further
  vanishes = 5,       ///< the cycle shrinks to a state at rest
  long_period = 6,    ///< the cycle's period grows beyond a bound
  resonance = 7,      ///< a torus's pair of multipliers meets at 1 or -1
  points = 8,         ///< the curve has as many points as it may have
  multiplier = 9,     ///< a multiplier of the cycle grows beyond a bound
  stopped = 10,       ///< the computation was stopped
  single_cycle = 11,  ///< the cycle is a single one passed twice: on a curve of period doublings
};
inline constexpr std::array<const char*, 12> curve_end_names{"plane",  "closed",     "no-balance",  "no-pair",
                                                             "lost",   "vanishes",   "long-period", "resonance",
                                                             "points", "multiplier", "stopped",     "single-cycle"};

struct ChartCurve {
  CurveKind kind = CurveKind::hopf;
  std::string of = of_balance;     ///< or the locked state's name
  std::vector<CurvePoint> points;  ///< in order along the curve
  std::array<CurveEnd, 2> ends{};  ///< of the first and the last point
  double error = 0.0;              ///< no point is further from the curve, as a part of the plane's sides
};

/// A point where a curve changes its kind. The values are stored in files.
enum class SpecialKind : signed char {
  generalised_hopf = 0,   ///< the first Lyapunov coefficient passes through 0
  double_hopf = 1,        ///< a second pair lies on the imaginary axis
  zero_hopf = 2,          ///< a real eigenvalue is zero next to the pair
  bogdanov_takens = 3,    ///< the pair's frequency is 0
  cusp = 4,               ///< two folds meet
  fold_hopf = 5,          ///< a pair lies on the imaginary axis where two locked states merge
  cycle_cusp = 6,         ///< two folds of cycles meet
  resonance_1_1 = 7,      ///< a second multiplier of a cycle is 1
  resonance_1_2 = 8,      ///< or -1
  resonance_1_3 = 9,      ///< a torus's pair of multipliers is at a third of a turn
  resonance_1_4 = 10,     ///< or at a quarter
  fold_flip = 11,         ///< multipliers 1 and -1
  fold_torus = 12,        ///< a multiplier 1 and a pair on the unit circle
  flip_torus = 13,        ///< a multiplier -1 and a pair
  double_torus = 14,      ///< two pairs
  generalised_flip = 15,  ///< of a period doubling the cubic coefficient is 0: a fold of doubled cycles ends there
};
inline constexpr std::array<const char*, 16> special_kind_names{
    "generalised-hopf", "double-hopf",   "zero-hopf",     "bogdanov-takens", "cusp",          "fold-hopf",
    "cycle-cusp",       "resonance-1-1", "resonance-1-2", "resonance-1-3",   "resonance-1-4", "fold-flip",
    "fold-torus",       "flip-torus",    "double-torus",  "generalised-flip"};

struct SpecialPoint {
  SpecialKind kind = SpecialKind::generalised_hopf;
  std::size_t curve = 0;  ///< on which it was found
  double x = 0.0, y = 0.0;
  double frequency = 0.0;  ///< of the curve's pair, or of the cycle
  double second = 0.0;     ///< of a double Hopf point's other pair
  std::vector<double> state;
};

/// A connected part of the grid in which the same states at rest exist and are stable.
struct ChartRegion {
  BalanceKind balance = BalanceKind::not_computed;
  struct Locked {
    int stable = 0, unstable = 0;  ///< states
    bool operator==(const Locked& other) const { return stable == other.stable && unstable == other.unstable; }
  };
  std::vector<Locked> locked;  ///< in the order of BifurcationChart::locked
  std::size_t points = 0;
  double part = 0.0;        ///< of the grid's points
  double x = 0.0, y = 0.0;  ///< the point furthest from the region's edge
};

/// What interval arithmetic proves of every point of a box.
struct ProofBox {
  std::array<double, 2> x{}, y{};  ///< from, to
  BalanceKind kind = BalanceKind::open;
};

struct BifurcationChart {
  StabilityPlane plane;  ///< the grid from which curves were begun; its times are those of the whole chart
  std::vector<ChartCurve> curves;
  std::vector<SpecialPoint> specials;
  std::vector<std::string> locked;  ///< names of the kinds of locked state
  std::string no_locked;            ///< why they are not known of this rotor; empty: they are
  bool cycles = false;              ///< curves of cycles were looked for
  /// Up to which curves of cycles are followed.
  struct CycleBounds {
    double turns = 0.0;       ///< see longest_period() (extras/cycles/cycle_shooting.hpp)
    double multiplier = 0.0;  ///< modulus
    std::size_t points = 0;   ///< each way
  } cycle_bounds;
  std::size_t cycles_left = 0;       ///< places where cycles change that were not followed: the chart was stopped
  std::string no_cycles;             ///< why they are not known of this rotor; empty: they are, or were not requested
  std::vector<ChartRegion> regions;  ///< the largest first; none if the chart was stopped
  std::vector<int> region_of;        ///< by point of the grid
  std::vector<ProofBox> boxes;       ///< cover the plane; none if nothing was to be proved
  double undecided = 0.0;            ///< the part of the plane at which proofs were to end
  std::string not_proved;  ///< why nothing can be proved of this rotor; empty: boxes were tried, or not requested
  bool complete = true;

  /// Part of the plane, 0 to 1.
  double proved(BalanceKind kind) const {
    double area = 0.0;
    for (const ProofBox& b : boxes)
      if (b.kind == kind) area += (b.x[1] - b.x[0]) * (b.y[1] - b.y[0]);
    return area / ((plane.x.high - plane.x.low) * (plane.y.high - plane.y.low));
  }
};

/// As check_stability_file() and write_stability_file(): points of all curves one after the other, with the number of
/// their curve; special points; regions; boxes.
void check_chart_file(const std::string& path, const BifurcationChart& chart);
void write_chart_file(const std::string& path, const BifurcationChart& chart);

}  // namespace equipoise
