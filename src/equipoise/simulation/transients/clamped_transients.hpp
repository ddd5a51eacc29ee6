// Peaks and times above a limit during the clamped spin-up: one grid in time serves every start.
//
// With the balls held, state, displacement from the place of rest and bearing force are base + Ux per_x + Uy per_y
// (simulation/integrate/clamped.hpp). So the squares of displacement and force at any time are quadratic polynomials in
// the start's unbalance U.
#pragma once

#include <array>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/types/transient_table.hpp"
#include "equipoise/simulation/integrate/clamped.hpp"

namespace equipoise {

/// Number of grid times of ClampedTransients: each takes 104 bytes, and 12 sums for every start.
double clamped_grid_points(const model::Parameters& p, const std::vector<model::Segment>& segments);
/// 0.44 GB, and 30 ms a start: about 27 000 turns of the rotor at a steadily rising speed.
inline constexpr double most_clamped_grid_points = 1 << 22;

/// Thread-safe after construction.
class ClampedTransients {
 public:
  /// Nothing is clamped: sums() are empty.
  ClampedTransients() = default;
  /// Integrates the clamped `segments` from (x, y, u, v) = `initial`; settings.release must be where they end. The grid
  /// has 64 points in a turn of the rotor at its fastest, or in a period of the supports if that is shorter. Between
  /// grid points a peak rises by less than 0.5 % of the oscillation. Once `stop` is set, sums() are empty. Throws
  /// RunError if the integration fails.
  ClampedTransients(const model::Parameters& p, const std::vector<model::Segment>& segments,
                    const std::array<double, 4>& initial, double tolerance, const TransientSettings& settings,
                    const StopFlag* stop = nullptr);

  /// The sums of a start with balls held at `phi`.
  TransientSums sums(const model::Parameters& p, const double* phi) const;

 private:
  /// 1, Ux, Uy, Ux^2, Ux Uy, Uy^2.
  using Monomials = std::array<double, 6>;
  /// Energy that the supports' dampers take over a clamped segment.
  struct Losses {
    model::Segment segment;
    double until = 0.0;  // the last grid time so far
    ClampedBasis end;    // at that time
    Monomials power{};   // at that time
    Monomials energy{};  // in total up to then
  };
  struct Squares {
    std::array<std::vector<double>, 6> coefficient;  // by monomial, then by time

    void add(const std::array<std::array<double, 2>, 3>& vectors);
    double at(const Monomials& m, std::size_t k) const;
    static Monomials of(const std::array<std::array<double, 2>, 3>& vectors);
    double largest(const Monomials& m) const;
    std::size_t place_of(const Monomials& m, double largest) const;  // the first that has it
  };

  void lose(const model::Parameters& p, double t, const model::Segment& segment, const ClampedBasis& basis);
  DriveWork work(const model::Parameters& p, const double* phi, const Monomials& m) const;

  TransientSettings settings_;
  bool proportional_ = false;  // everything is proportional to |U|: isotropic supports, no gravity, from rest
  std::vector<double> times_, speeds_;
  Squares radius_, force_, dynamic_;             // the last without the force at rest, only under gravity
  ClampedBasis begin_;                           // where the first segment begins
  std::vector<Losses> losses_;                   // one each segment, if work is requested
  double radius_peak_ = 0.0, force_peak_ = 0.0;  // for U = 1, if proportional_
  std::size_t radius_place_ = 0;                 // then: of the peak
};

}  // namespace equipoise
