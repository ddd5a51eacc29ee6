// The traps of a search, made as motions are found.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "equipoise/discovery/search.hpp"
#include "equipoise/traps/continuum_trap.hpp"
#include "equipoise/traps/cycle_trap.hpp"
#include "equipoise/traps/stalled_trap.hpp"
#include "equipoise/traps/trap_rule.hpp"
#include "equipoise/traps/window_trap.hpp"

namespace equipoise {

class SearchTraps {
 public:
  explicit SearchTraps(Search& search) : s_(search) {}

  /// Analyses the balanced states, lists them, and makes the first rule with their traps; of rotors that differ draws
  /// those for tries.
  void find_balanced();
  /// Around a motion that every rotor has elsewhere, as one was found to have it.
  void add_of_candidate(const Candidate& c);
  /// Around what was listed last; of rotors that differ around the middle's motion, if it has that one.
  void add_listed(const Attractor& a);
  /// Hands them to the rule.
  void set_rule();
  /// Proves or widens the levels of the balanced traps.
  void level_balanced();

 private:
  void draw_rotors(BalancedAnalysis& balanced);
  void balance_of_some();
  void list_member(const std::optional<ContinuumPart>& part);
  void find_stalled();
  void add(const Motion& motion, int id);
  bool add_motion_trap(const model::System& system, const Motion& motion, int id, const OwnRotor* own = nullptr);
  void add_torus(const Motion& motion, int id);

  Search& s_;
  CycleTraps cycles_;
  std::vector<std::shared_ptr<const WindowTrap>> windowed_;
  std::optional<ContinuumTrap> continuum_;
  std::optional<StalledTrap> stalled_;
  std::map<int, int> without_;  // by attractor: motions around which none was found
};

}  // namespace equipoise
