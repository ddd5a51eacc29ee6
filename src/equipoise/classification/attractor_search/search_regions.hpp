// The trapping regions of a search, made as motions are found.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "equipoise/classification/attractor_search/search.hpp"
#include "equipoise/classification/trapping_regions/continuum_region.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/classification/trapping_regions/region_rule.hpp"
#include "equipoise/classification/trapping_regions/stalled_region.hpp"
#include "equipoise/classification/trapping_regions/window_region.hpp"

namespace equipoise {

class SearchRegions {
 public:
  explicit SearchRegions(Search& search) : s_(search) {}

  /// Analyses and lists the balanced states, and makes the first rule with their trapping regions. Where rotors differ,
  /// draws those for trials.
  void find_balanced();
  /// Around a motion that each rotor has in its own place, as one rotor was found to have it.
  void add_of_candidate(const Candidate& c);
  /// Around the last listed motion; where rotors differ, around the middle's, if it has that one.
  void add_listed(const Attractor& a);
  /// Hands the regions to the rule.
  void set_rule();
  /// Proves or widens the levels of the balanced trapping regions.
  void level_balanced();

 private:
  void draw_rotors(BalancedAnalysis& balanced);
  void balance_of_some();
  void list_member(const std::optional<ContinuumPart>& part);
  void find_stalled();
  bool worth_a_region(const Motion& motion, int id) const;
  void add(const Motion& motion, int id);
  bool add_path_region(const model::System& system, const Motion& motion, int id, const OwnRotor* own = nullptr);
  void add_torus(const Motion& motion, int id);

  Search& s_;
  OrbitRegions cycles_;
  std::vector<std::shared_ptr<const WindowRegion>> windowed_;
  std::optional<ContinuumRegion> continuum_;
  std::optional<StalledRegion> stalled_;
  std::map<int, int> without_;  // by attractor: motions for which no region was found
};

}  // namespace equipoise
