// What a study's starts can come to: the attractors of the final speed, found by a pilot, refined, named, and the rule
// that recognises them early.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/base/notes.hpp"
#include "equipoise/base/run_options.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/discovery/feature_trends.hpp"
#include "equipoise/discovery/study_family.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/traps/balanced_analysis.hpp"
#include "equipoise/traps/balanced_family.hpp"
#include "equipoise/traps/coasting_trap.hpp"
#include "equipoise/types/trap_hints.hpp"

namespace equipoise {

struct DiscoveryCache;
struct FamilyMesh;

struct DiscoverySettings {
  int threads = 1;
  const StopFlag* stop = nullptr;
  /// States near motions known from elsewhere (a neighbouring parameter, an earlier run), as the system has them.
  std::vector<std::vector<double>> seeds{};
  DiscoveryCache* cache = nullptr;
  /// Told of the stages, from any thread, never from two at once; Progress::preparing is set.
  std::function<void(const Progress&)> progress{};
  /// The seeds are all that was found at a neighbouring parameter: a pilot of a quarter of the starts then looks for
  /// what is new. What that misses is listed once a start comes to it, as ever.
  bool informed = false;
  TrapHints hints = {};    ///< of the neighbour's search, if informed
  Notes* notes = nullptr;  ///< of what searches find out step by step, or null
  std::string family{};    ///< what tells a family's notes from those of others
};

/// Everything found before the first start is decided. Depends on the rotor, its final speed, [numerics],
/// settings.seeds, informed and hints alone (each state where the rotor's angle is 0, if that matters): not on how a
/// prescribed speed is reached, so that all spin-ups to one speed share it. A driven rotor's depends on its whole
/// spin-up.
struct Discovery {
  BalancedAnalysis balanced;
  Catalogue catalogue;
  DecisionRule rule;
  BalancedFamily family;                         ///< of a part of a family: where its balanced traps stand
  FeatureTrends trends;                          ///< and how its motions' features change
  TrapHints hints;                               ///< for a neighbour's search
  std::vector<std::vector<double>> seeds;        ///< for that too: a state on each motion that windows tell
  std::shared_ptr<const CoastingTrap> coasting;  ///< of a rotor that coasts
  bool stopped = false;

  /// Prepares a rotor of the part, whose coordinates are known, for the rule.
  void place(OwnRotor& rotor) const {
    family.place(rule.balanced, rotor);
    trends.place(rotor);
  }
};

/// Discoveries made so far, by what they depend on. Not to be used by two runs at once.
struct DiscoveryCache {
  std::map<std::string, Discovery> made;
  std::map<std::string, std::shared_ptr<const FamilyMesh>> meshes;  ///< of studies with uncertain values
};

/// Of rotors that differ, chaos that ends, ends sooner than this for nearly all but those beside the one for which it
/// no longer ends.
inline constexpr double lasting_chaos = 10000.0;

/// How long a trajectory is followed to its motion (motion_from()): where many balls touch it takes a hundred times as
/// long, and a motion that does not come back is none the better known for it.
double followed_for(const model::System& system);

/// The part of a study that its discovery depends on, as text: studies that agree in it share one.
std::string discovery_subject(const Study& study);
/// What a search depends on in all: the key under which caches hold it.
std::string search_key(const std::string& subject, const DiscoverySettings& settings);
/// The same of a part of settings.family.
std::string search_key(const FamilyBox& part, const DiscoverySettings& settings);

/// Analyses the balanced states; runs pilot starts, free from rest at the final
/// speed (of a driven rotor see PilotRun::make()), and starts in the invariant subspace of coincident balls until they
/// are stationary; follows, refines and names one of each group; makes traps and boxes and tries them. With anisotropic
/// supports or gravity motions are strobed ones. Starts that come to something else later are followed and listed by
/// StartRunner. A rotor that coasts has no final speed, and nothing is searched: balance and the rotor that has stalled
/// are listed, and starts are asked about both by CoastingTrap.
Discovery discover(const Study& study, const DiscoverySettings& settings);
/// The same for all rotors of a part of a family at once: pilots and tries draw theirs from it, motions of one name are
/// one, and traps stand where each rotor has what they surround. Centres, forms and hints are those of the part's
/// middle. settings.cache is not asked.
Discovery discover(const StudyFamily& family, const FamilyBox& box, const DiscoverySettings& settings);

}  // namespace equipoise
