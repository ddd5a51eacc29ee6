// What a study's starts can come to: the attractors of the final speed, found by a pilot, refined, named, and the rule
// that recognises them early.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractor_search/feature_trends.hpp"
#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/balanced_regions/balanced_analysis.hpp"
#include "equipoise/balanced_regions/family_regions.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/rotor_family/study_family.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/running/search_log.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/trapping_regions/coasting_region.hpp"
#include "equipoise/types/warm_start_levels.hpp"

namespace equipoise {

struct AttractorSearchCache;
struct FamilyMesh;

struct AttractorSearchSettings {
  int threads = 1;
  const StopFlag* stop = nullptr;
  /// States near motions known from elsewhere (a neighbouring parameter, an earlier run), as the system has them.
  std::vector<std::vector<double>> warm_start_states{};
  AttractorSearchCache* cache = nullptr;
  /// Told of the stages, from any thread, never from two at once; Progress::preparing is set.
  std::function<void(const Progress&)> progress{};
  /// The seeds are all that was found at a neighbouring parameter: a pilot of a quarter of the starts then looks for
  /// what is new. What that misses is listed once a start comes to it, as ever.
  bool warm_start = false;
  WarmStartLevels warm_start_levels = {};  ///< of the neighbour's search, if informed
  SearchLog* notes = nullptr;              ///< of what searches find out step by step, or null
  std::string family{};                    ///< what tells a family's notes from those of others
};

/// Everything found before the first start is decided. Depends on the rotor, its final speed, [numerics],
/// settings.seeds, informed and hints alone (each state where the rotor's angle is 0, if that matters): not on how a
/// prescribed speed is reached, so that all spin-ups to one speed share it. A driven rotor's depends on its whole
/// spin-up.
struct AttractorSearch {
  BalancedAnalysis balanced;
  Catalogue catalogue;
  ClassificationRule rule;
  FamilyRegions family;               ///< of a part of a family: where its balanced trapping regions stand
  FeatureTrends trends;               ///< and how its motions' features change
  WarmStartLevels warm_start_levels;  ///< for a neighbour's search
  std::vector<std::vector<double>> warm_start_states;  ///< for that too: a state on each motion that windows tell
  std::shared_ptr<const CoastingRegion> coasting;      ///< of a rotor that coasts
  bool stopped = false;

  /// Prepares a rotor of the part, whose coordinates are known, for the rule.
  void place(OwnRotor& rotor) const {
    family.place(rule.balanced, rotor);
    trends.place(rotor);
  }
};

/// Discoveries made so far, by what they depend on. Not to be used by two runs at once.
struct AttractorSearchCache {
  std::map<std::string, AttractorSearch> made;
  std::map<std::string, std::shared_ptr<const FamilyMesh>> meshes;  ///< of studies with uncertain values
};

/// Of rotors that differ, chaos that ends, ends sooner than this for nearly all but those beside the one for which it
/// no longer ends.
inline constexpr double lasting_chaos = 10000.0;

/// How long a trajectory is followed to its motion (motion_from()): where many balls touch it takes a hundred times as
/// long, and a motion that does not come back is none the better known for it.
double followed_for(const model::System& system);

/// The part of a study that its discovery depends on, as text: studies that agree in it share one.
std::string attractor_search_subject(const Study& study);
/// What a search depends on in all: the key under which caches hold it.
std::string search_key(const std::string& subject, const AttractorSearchSettings& settings);
/// The same of a part of settings.family.
std::string search_key(const FamilyBox& part, const AttractorSearchSettings& settings);

/// Analyses the balanced states; runs pilot starts, free from rest at the final
/// speed (of a driven rotor see PilotRun::make()), and starts in the invariant subspace of coincident balls until they
/// are stationary; follows, refines and names one of each group; makes trapping regions and boxes and tries them. With
/// anisotropic supports or gravity motions are strobed ones. Starts that come to something else later are followed and
/// listed by StartRunner. A rotor that coasts has no final speed, and nothing is searched: balance and the rotor that
/// has stalled are listed, and starts are asked about both by CoastingRegion.
AttractorSearch search_attractors(const Study& study, const AttractorSearchSettings& settings);
/// The same for all rotors of a part of a family at once: pilots and tries draw theirs from it, motions of one name are
/// one, and trapping regions stand where each rotor has what they surround. Centres, forms and hints are those of the
/// part's middle. settings.cache is not asked.
AttractorSearch search_attractors(const StudyFamily& family, const FamilyBox& box,
                                  const AttractorSearchSettings& settings);

}  // namespace equipoise
