// Finds the attractors of a study's final speed with a pilot, refines and names them, and makes the rule that
// recognises them early.
// This room: the attractors of a final speed, and the rule made from them.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/balanced_regions/family_regions.hpp"
#include "equipoise/classification/rotor_family/feature_trends.hpp"
#include "equipoise/classification/rotor_family/study_family.hpp"
#include "equipoise/classification/trapping_regions/coasting_region.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct AttractorSearchCache;
struct FamilyMesh;

struct AttractorSearchSettings {
  int threads = 1;
  const StopFlag* stop = nullptr;
  /// States near motions known from elsewhere (a neighbouring parameter, an earlier run), in the system's layout.
  std::vector<std::vector<double>> warm_start_states{};
  AttractorSearchCache* cache = nullptr;
  /// Called for each stage, from any thread but one at a time; Progress::preparing is set.
  std::function<void(const Progress&)> progress{};
  SearchMode mode = SearchMode::full;  ///< warm: warm_start_states and warm_start_levels are a neighbour's
  double starts = many_starts;         ///< that the search serves: it does less for few (SearchPlan)
  WarmStartLevels warm_start_levels = {};
  SearchLog* notes = nullptr;  ///< log of the steps of searches, or null
  std::string family{};        ///< distinguishes a family's notes from those of others
};

/// All that is found before the first start is decided. It depends on the rotor, its final speed, [numerics] and the
/// settings' mode, starts, warm_start_levels and warm_start_states (each with rotor angle 0 if that matters) alone. How
/// a prescribed speed is reached does not matter, so all spin-ups to it share a search. A driven rotor's search depends
/// on its whole spin-up.
struct AttractorSearch {
  BalancedAnalysis balanced;
  Catalogue catalogue;
  ClassificationRule rule;
  FamilyRegions family;               ///< for a part of a family: where its balanced trapping regions are
  FeatureTrends trends;               ///< and how the features of its motions change
  WarmStartLevels warm_start_levels;  ///< for a neighbour's search
  std::vector<std::vector<double>> warm_start_states;  ///< also for that: a state on each motion that windows recognise
  std::shared_ptr<const CoastingRegion> coasting;      ///< if the rotor coasts
  bool stopped = false;

  /// Prepares a rotor of the part, whose coordinates must be set, for the rule.
  void place(OwnRotor& rotor) const {
    family.place(rule.balanced, rotor);
    trends.place(rotor);
  }
};

/// Searches made so far, by everything that they depend on. Not to be used by two runs at once.
struct AttractorSearchCache {
  std::map<std::string, AttractorSearch> made;
  std::map<std::string, std::shared_ptr<const FamilyMesh>> meshes;  ///< for studies with uncertain values
};

/// Where rotors differ, transient chaos ends sooner than this for nearly all rotors, except those next to the one where
/// it becomes lasting.
inline constexpr double lasting_chaos = 10000.0;

/// How long a trajectory is followed to its motion (motion_from()). Many touching balls make each time unit a hundred
/// times as costly, and patience with a motion that does not come back gains nothing. For few starts, motions with
/// events are followed for an eighth.
double followed_for(const model::System& system, SearchMode mode);
inline constexpr std::size_t few_scouts = 32, most_followed_of_few = 8;

/// The part of a study that its search depends on, as text: studies that agree in it share one.
std::string attractor_search_subject(const Study& study);
/// All that a search depends on: its key in caches.
std::string search_key(const std::string& subject, const AttractorSearchSettings& settings);
/// The same for a part of settings.family.
std::string search_key(const FamilyBox& part, const AttractorSearchSettings& settings);

/// Analyses the balanced states. Runs pilot starts, free from rest at the final speed (for a driven rotor see
/// PilotRun::make()), and starts in the invariant subspace of coincident balls, until they are stationary. Follows,
/// refines and names one of each group; makes trapping regions and boxes and tries them. With anisotropic supports or
/// gravity, motions are those on the stroboscopic section. Session later follows and lists any other motion that a
/// start comes to. A coasting rotor has no final speed, so nothing is searched: balance and the stalled rotor are
/// listed, and CoastingRegion tests starts for both.
AttractorSearch search_attractors(const Study& study, const AttractorSearchSettings& settings);
/// The same for all rotors of a part of a family at once. Pilots and trials draw rotors from it, motions of one name
/// are one, and trapping regions move with each rotor's motion. Centres, forms and levels are those of the part's
/// middle. settings.cache is not used.
AttractorSearch search_attractors(const StudyFamily& family, const FamilyBox& box,
                                  const AttractorSearchSettings& settings);

}  // namespace equipoise
