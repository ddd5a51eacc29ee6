// Trajectories of a tilting rotor in fixed axes, sampled densely, and what transients are by these samples.
#pragma once

#include <array>
#include <vector>

#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/study/contents/study.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise::tilting {

// A bearing as it is stated: springs and dampers in X and Y.
struct StatedBearing {
  double at;
  std::array<double, 2> stiffness, damping;
};

// What is watched at one time: the worst of some places.
struct Seen {
  double t = 0.0, radial = 0.0;
  std::vector<double> force;                      // of each bearing, or of all supports together
  std::vector<double> dynamic;                    // the same without what it is where the rotor rests
  std::vector<double> velocity2;                  // by place
  std::vector<double> velocity2_x;                // along X alone
  double power = 0.0;                             // of a motor
  std::array<std::complex<double>, 2> turning{};  // unbalances of the outermost two places, as the rotor sees them
  double unbalance = 0.0;                         // judged() of them
};

// Centre and slope where the rotor rests, by Cramer's rule.
std::array<double, 2> rest_of(const model::Parameters& p);

// The unbalances of the outermost two places' planes, each over its plane's share; at one place the static one.
std::array<std::complex<double>, 2> judged(const model::Parameters& p, const std::vector<double>& places,
                                           const Fixed& f);

Seen seen(const model::Parameters& p, const std::vector<double>& places, const FixedFlow& flow, double t,
          const double* y, const std::vector<StatedBearing>& bearings = {});

// A stretch of a run: its balls are held or not, and psi'' is this.
struct Stretch {
  double begin, end;
  bool held;
  double acceleration;
};
std::vector<Stretch> stretches(const Study& s, double until);

// 200 times in a unit of time: what lies between them is below 1e-4 of a peak.
std::vector<Seen> dense(const Study& s, const std::vector<Stretch>& over, const std::vector<double>& places,
                        const std::vector<StatedBearing>& bearings = {});

// What transient_row() tells, of dense samples; windows begin at `window_begin`.
TransientRow figures(const TransientSettings& asked, const std::vector<Seen>& all, double window_begin);

}  // namespace equipoise::tilting
