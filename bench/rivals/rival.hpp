// What every engine under comparison is: a name, its settings and a way to take many trajectories to an end.
//
// A new rival is one file that derives from Rival and one line in rivals.cpp. It must call the engine's own equations
// (machine/model/flow-inl.hpp), so that no rival solves anything but the same problem.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "../timing.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::bench {

/// Rivals' tolerances: error allowed a step is absolute + relative |z_i|, in the way each has it.
inline constexpr double relative_tolerance = 1e-6, absolute_tolerance = 1e-8;
/// Where a method has to be given a first step; each finds its own within a few.
inline constexpr double first_step = 0.01;

/// Trajectories of one rotor with two balls over one segment of its motion.
struct Problem {
  model::Parameters parameters;
  model::Segment segment{};
  double end = 0.0;  ///< not after segment.end
};

class Rival {
 public:
  virtual ~Rival() = default;

  std::string name, settings;
  /// Starts a thread below which a timing would show the ends of its work rather than the work.
  std::size_t least_starts = 16;

  /// Takes rows of 8 numbers (machine/model/parameters.hpp) from segment.begin to problem.end. A trajectory that is
  /// lost ends as not-a-number. Throws RunError if the rival cannot run.
  virtual Cost run(const Problem& problem, std::vector<double>& states, int threads) = 0;
};

using RivalPointer = std::unique_ptr<Rival>;

/// This engine: advance_batch() of simulation/kernels/batch_kernels.hpp.
RivalPointer engine(double tolerance = 1e-6);
RivalPointer odeint_dopri5();
RivalPointer odeint_fehlberg78();
/// Boost.Odeint on a state of SIMD registers, one trajectory a lane.
RivalPointer odeint_dopri5_lanes();
RivalPointer cvode_adams();
RivalPointer arkode_dopri5();
/// `method`: of scipy.integrate.solve_ivp.
RivalPointer scipy(const std::string& method, const std::string& python);

/// A Python that has SciPy, empty if there is none, and SciPy's version.
std::string python_with_scipy(std::string& version);

/// Everyone but this engine, and what is missing here with the reason.
struct Rivals {
  std::vector<RivalPointer> present;
  std::vector<std::string> missing;
};
Rivals all_rivals();

}  // namespace equipoise::bench
