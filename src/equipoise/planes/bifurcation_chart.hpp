// Curves in a plane of two parameters on which balance changes, the points where they change their kind, and boxes in
// which it is proved what balance does.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "equipoise/planes/stability_plane.hpp"

namespace equipoise {

/// What happens on a curve. The values stand in files.
enum class CurveKind : signed char {
  hopf = 0,       ///< a pair of eigenvalues at balance crosses the imaginary axis
  zero = 1,       ///< a real eigenvalue at balance crosses zero
  existence = 2,  ///< the balls just reach: in line they cancel the unbalance; beyond there is no balanced state
};
inline constexpr std::array<const char*, 3> curve_kind_names{"hopf", "zero", "existence"};

struct CurvePoint {
  double x = 0.0, y = 0.0;
  double frequency = std::numeric_limits<double>::quiet_NaN();  ///< of the pair, omega_c
  /// First Lyapunov coefficient as a change of the growth rate: omega_c per square of the largest swing of a ball, in
  /// radians. Negative: a swing that grows settles small (supercritical). Not a number of continua.
  double lyapunov = frequency;
  int others = 0;  ///< unstable eigenvalues besides the pair: 0 where balance itself loses stability
};

/// Why a curve ends. The values stand in files.
enum class CurveEnd : signed char {
  plane = 0,       ///< at the plane's edge
  closed = 1,      ///< at its own beginning
  no_balance = 2,  ///< where the balanced state ends
  no_pair = 3,     ///< the pair's frequency falls to 0 (Bogdanov-Takens)
  lost = 4,        ///< it could not be followed further
};
inline constexpr std::array<const char*, 5> curve_end_names{"plane", "closed", "no-balance", "no-pair", "lost"};

struct ChartCurve {
  CurveKind kind = CurveKind::hopf;
  std::vector<CurvePoint> points;  ///< in order along the curve
  std::array<CurveEnd, 2> ends{};  ///< of the first and the last point
  double error = 0.0;              ///< no point is farther from the curve, as a part of the plane's sides
};

/// A point where a curve changes its kind. The values stand in files.
enum class SpecialKind : signed char {
  generalised_hopf = 0,  ///< the first Lyapunov coefficient passes through 0
  double_hopf = 1,       ///< a second pair lies on the imaginary axis
  zero_hopf = 2,         ///< a real eigenvalue is zero beside the pair
  bogdanov_takens = 3,   ///< the pair's frequency is 0
};
inline constexpr std::array<const char*, 4> special_kind_names{"generalised-hopf", "double-hopf", "zero-hopf",
                                                               "bogdanov-takens"};

struct SpecialPoint {
  SpecialKind kind = SpecialKind::generalised_hopf;
  std::size_t curve = 0;  ///< on which it was found
  double x = 0.0, y = 0.0;
  double frequency = 0.0;  ///< of the curve's pair
  double second = 0.0;     ///< of a double Hopf point's other pair
};

/// What interval arithmetic proves of every point of a box. The values stand in files.
enum class ProvedKind : signed char {
  open = -1,     ///< nothing
  none = 0,      ///< the balls cannot cancel the unbalance
  stable = 1,    ///< a balanced state exists and every eigenvalue has a negative real part
  unstable = 2,  ///< a balanced state exists and some eigenvalue has a positive real part
};

struct ProofBox {
  std::array<double, 2> x{}, y{};  ///< from, to
  ProvedKind kind = ProvedKind::open;
};

struct BifurcationChart {
  Study study;
  StabilityPlane plane;  ///< the grid from which curves were begun
  std::vector<ChartCurve> curves;
  std::vector<SpecialPoint> specials;
  std::vector<ProofBox> boxes;  ///< cover the plane; none if nothing was to be proved
  double undecided = 0.0;       ///< the part of the plane at which proofs were to end
  std::string not_proved;       ///< why nothing can be proved of this rotor; empty: boxes were tried, or not asked for
  bool complete = true;
  int threads = 1;
  double seconds = 0.0, cpu_seconds = 0.0;
  std::string cpu_target;

  /// Part of the plane, 0 to 1.
  double proved(ProvedKind kind) const {
    double area = 0.0;
    for (const ProofBox& b : boxes)
      if (b.kind == kind) area += (b.x[1] - b.x[0]) * (b.y[1] - b.y[0]);
    return area / ((plane.x.high - plane.x.low) * (plane.y.high - plane.y.low));
  }
};

}  // namespace equipoise
