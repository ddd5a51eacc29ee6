// A trajectory's own rotor: parameters, drive and horizon that differ from those of its neighbours in other lanes.
#pragma once

#include <limits>
#include <vector>

#include "equipoise/model/speed.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

struct KnownFeatures;

/// Of the same kind as the task's: as many balls, a state of the same size and section, a motor or none.
struct OwnRotor {
  model::System system;                                  ///< over the piece of the drive that the task is about
  model::Segment segment{};                              ///< as LaneTask::segment
  double end = std::numeric_limits<double>::infinity();  ///< as LaneTask::end
  /// Where it lies in the part of a family that the rule is made for, in its unit cube (discovery/study_family.hpp).
  std::vector<double> coordinates{};
  /// Where the traps of balanced states have their centres (DecisionRule::balanced): a state each, one after the other;
  /// not-a-number where this rotor has none. Empty where there are no such traps.
  std::vector<double> places{};
  std::vector<double> factors{};  ///< theirs, in place of BalancedTrap::factor
  /// By how much the features of its motions differ from those of the part's middle: feature_count(balls) numbers a
  /// trend (discovery/feature_trends.hpp). Empty where there is none.
  std::vector<double> shifts{};
  /// Of each chaos that ends for some rotors: whether it was seen to last for all others beside this one.
  std::vector<char> chaos_lasts{};
  /// Motions of this very rotor that the rule does not list, or null: the first has the attractor -1, the next -2, ...
  const std::vector<KnownFeatures>* met = nullptr;
};

/// In the last piece of its drive from time 0 on, psi = `psi` there where it is prescribed.
inline OwnRotor own_rotor(const model::System& system, double psi = 0.0) {
  return {system, {0.0, 1e300, psi, system.drive().speed, 0.0, false}};
}

/// As LaneTask::own has them.
inline std::vector<const OwnRotor*> pointers_to(const std::vector<OwnRotor>& rotors) {
  std::vector<const OwnRotor*> pointers;
  for (const OwnRotor& rotor : rotors) pointers.push_back(&rotor);
  return pointers;
}

/// OwnRotor::shifts of a trajectory that may have no rotor of its own: null then.
inline const double* shifts_of(const OwnRotor* own) { return own ? own->shifts.data() : nullptr; }

/// Whether trajectories of the one can ride in lanes beside those of the other.
inline bool ride_together(const model::System& a, const model::System& b) {
  return a.balls() == b.balls() && a.dimension() == b.dimension() && a.section() == b.section() &&
         a.prescribed() == b.prescribed() && a.plain() == b.plain() && a.events().contact == b.events().contact &&
         a.events().stick == b.events().stick && a.parameters().rolls == b.parameters().rolls;
}

}  // namespace equipoise
