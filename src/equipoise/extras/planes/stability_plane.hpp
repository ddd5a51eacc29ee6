// Where balance is stable in a plane of two parameters.
// This room: results over a plane of two parameters, their regions and files.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/columns/column.hpp"
#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/types/attractor.hpp"
#include "equipoise/results/types/left_out.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// What balance does at a point. The values are stored in files.
enum class BalanceKind : signed char {
  not_computed = -1,
  open = -1,     ///< of a box: nothing is proved
  none = 0,      ///< no balanced state: the balls cannot cancel the unbalance, or nothing turns for good
  stable = 1,    ///< every deviation dies out
  unstable = 2,  ///< some deviation grows
  marginal = 3,  ///< the slowest deviation changes by less than 1e-9 omega_c: linear theory does not decide
  unknown = 4,   ///< no balanced motion was found under gravity or on unequal supports, or no member of a continuum
};
/// In the order of their values, without not_computed. For JSON, files and Python.
inline constexpr std::array<const char*, 5> balance_kind_names{"none", "stable", "unstable", "marginal", "unknown"};

struct BalancePoint {
  BalanceKind kind = BalanceKind::not_computed;
  short unstable = 0;                                        ///< eigenvalues with a positive real part
  unsigned char left_out = 0;                                ///< bits of LeftOut
  bool one_of_many : 1 = false;                              ///< a member of a continuum, with the balls spread evenly
  bool of_several : 1 = false;                               ///< the most stable of states whose rates differ
  bool contact : 1 = false;                                  ///< balls that can touch
  bool by_multipliers : 1 = false;                           ///< the equations depend on the rotor's angle
  double growth = std::numeric_limits<double>::quiet_NaN();  ///< largest real part of an eigenvalue
  double frequency = growth;                                 ///< its imaginary part, 0 or more
  double margin = growth;                                    ///< lambda + sum mu_i - 2 max(lambda, mu_i)

  /// Whether the slowest deviation swings: beyond the last digits of a real eigenvalue, or of a multiplier.
  bool swings() const { return frequency > 1e-7; }
};

/// The numbers of a point, as files name them.
struct PointNumber : Column {
  double (*value)(const BalancePoint&);
  bool whole = false;  ///< a whole number
};
inline constexpr std::array<PointNumber, 5> point_numbers{{
    {{"kind", "0 no balanced state, 1 stable, 2 unstable, 3 marginal, 4 not found, -1 not computed"},
     [](const BalancePoint& p) { return static_cast<double>(p.kind); },
     true},
    {{"unstable", "number of eigenvalues with a positive real part"},
     [](const BalancePoint& p) { return static_cast<double>(p.unstable); },
     true},
    {{"growth", "largest real part of an eigenvalue at balance", study::Dimension::speed, "stable where negative"},
     [](const BalancePoint& p) { return p.growth; }},
    {{"frequency", "imaginary part of that eigenvalue, 0 or more", study::Dimension::speed},
     [](const BalancePoint& p) { return p.frequency; }},
    {{"margin", "lambda + sum mu_i - 2 max(lambda, mu_i): a balanced state exists where this is 0 or more"},
     [](const BalancePoint& p) { return p.margin; }},
}};

/// Where what balance does changes along one of the two parameters, from the study's own value on.
struct BalanceBoundary {
  enum class Change {
    none,       ///< no change up to the end of the plane
    hopf,       ///< a pair of eigenvalues crosses
    zero,       ///< a real eigenvalue crosses
    existence,  ///< the balanced state ends or begins
    lost,       ///< it is not found any more, or is marginal
    jump,       ///< balance is another motion there, as where a motor comes to hold another speed
  };
  bool along_x = true, upwards = true;
  Change change = Change::none;
  double value = 0.0;      ///< of the parameter; without a change the last that was looked at
  double frequency = 0.0;  ///< of a pair
};
inline constexpr std::array<const char*, 6> boundary_change_names{"none", "hopf", "zero", "existence", "lost", "jump"};

/// The point of the plane that is the study itself.
struct OwnPoint {
  double x = 0.0, y = 0.0;
  BalancePoint point;
  std::optional<ContinuumPart> continuum;   ///< of members drawn evenly from all, where the point is one of many
  std::vector<BalanceBoundary> boundaries;  ///< down and up along x, then y; none if it lies outside the plane
};

/// Rows follow y, points within a row x; they are the centres of pixels.
struct StabilityPlane : RunInfo {
  Study study;  ///< as given; its values of the two keys play no part
  SliceAxis x, y;
  std::vector<BalancePoint> points;
  std::optional<OwnPoint> own;  ///< none if the study's values are not single numbers
  bool complete = true;

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(x.pixels) + static_cast<std::size_t>(column);
  }
  template <class Holds>
  std::size_t count_if(const Holds& holds) const {
    std::size_t sum = 0;
    for (const BalancePoint& p : points) sum += holds(p);
    return sum;
  }
  std::size_t count(BalanceKind kind) const {
    return count_if([=](const BalancePoint& p) { return p.kind == kind; });
  }
  /// Whether some of its points, or the study itself, are members of a continuum of balanced states.
  bool one_of_many() const {
    return (own && own->point.one_of_many) || count_if([](const BalancePoint& p) { return p.one_of_many; }) > 0;
  }
  /// Whether some of its points have several balanced states, isolated, whose rates differ.
  bool of_several() const {
    return count_if([](const BalancePoint& p) { return p.of_several; }) > 0;
  }
  bool contact() const {
    return count_if([](const BalancePoint& p) { return p.contact; }) > 0;
  }
};

/// Throws InputError unless `path` can be written and is new or holds the same plane of the same study, whole or not.
void check_stability_file(const std::string& path, const StabilityPlane& plane);
/// Writes `path` again: dimensions y and x with their coordinates, variables of point_numbers(y, x), every one with
/// units and long_name; study and version as attributes; a checksum. Throws RunError if it cannot be written.
void write_stability_file(const std::string& path, const StabilityPlane& plane);

}  // namespace equipoise
