// A trajectory's own rotor: parameters, drive and horizon that differ from those of its neighbours in other lanes.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

struct KnownFeatures;

/// Must be of the same kind as the task's: see ride_together().
struct OwnRotor {
  model::System system;                                  ///< over the task's piece of the drive
  model::Segment segment{};                              ///< as BatchTask::segment
  double end = std::numeric_limits<double>::infinity();  ///< as BatchTask::end
  /// Its place in the rule's part of a family, a unit cube (classification/rotor_family/study_family.hpp).
  std::vector<double> coordinates{};
  /// Centres of the balanced states' trapping regions (ClassificationRule::balanced), one state after the other;
  /// not-a-number if this rotor lacks the state. Empty if there are no such regions.
  std::vector<double> places{};
  std::vector<double> factors{};  ///< of these regions, in place of BalancedRegion::factor
  /// Features of its motions minus those at the part's middle: feature_count(balls) numbers for each trend
  /// (classification/rotor_family/feature_trends.hpp). Empty if there are none.
  std::vector<double> shifts{};
  /// For each chaos that ends for some rotors: whether it was seen to last for all the nearest rotors tried.
  std::vector<char> chaos_lasts{};
  /// Motions of this rotor that the rule does not list, or null. Their attractors are -1, -2, ...
  const std::vector<KnownFeatures>* met = nullptr;
};

/// A rotor in the last piece of its drive, from time 0 on; a prescribed rotor angle begins at `psi`.
inline OwnRotor own_rotor(const model::System& system, double psi = 0.0) {
  return {system, {0.0, 1e300, psi, system.drive().speed, 0.0, false}};
}

inline std::vector<const OwnRotor*> pointers_to(std::span<const OwnRotor> rotors) {
  std::vector<const OwnRotor*> pointers;
  pointers.reserve(rotors.size());
  for (const OwnRotor& rotor : rotors) pointers.push_back(&rotor);
  return pointers;
}

/// OwnRotor::shifts, or null for a trajectory without a rotor of its own.
inline const double* shifts_of(const OwnRotor* own) { return own ? own->shifts.data() : nullptr; }

/// Whether trajectories of both systems can share a group of lanes.
inline bool ride_together(const model::System& a, const model::System& b) {
  return a.balls() == b.balls() && a.dimension() == b.dimension() && a.section() == b.section() &&
         a.prescribed() == b.prescribed() && a.plain() == b.plain() && a.events().contact == b.events().contact &&
         a.events().stick == b.events().stick && a.parameters().rolls == b.parameters().rolls;
}

}  // namespace equipoise
