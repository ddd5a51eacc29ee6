// What a study's starts can come to: the attractors of the final speed, found by a pilot, refined, named, and the rule
// that recognises them early.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/base/run_options.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/traps/balanced_analysis.hpp"
#include "equipoise/traps/trap_hints.hpp"

namespace equipoise {

struct DiscoveryCache;

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
  TrapHints hints = {};  ///< of the neighbour's search, if informed
};

/// Everything found before the first start is decided. Depends on the rotor, its final speed, [numerics],
/// settings.seeds, informed and hints alone (each state where the rotor's angle is 0, if that matters): not on how a
/// prescribed speed is reached, so that all spin-ups to one speed share it. A driven rotor's depends on its whole
/// spin-up.
struct Discovery {
  BalancedAnalysis balanced;
  Catalogue catalogue;
  DecisionRule rule;
  TrapHints hints;  ///< for a neighbour's search
  bool stopped = false;
};

/// Discoveries made so far, by what they depend on. Not to be used by two runs at once.
struct DiscoveryCache {
  std::map<std::string, Discovery> made;
};

/// The part of a study that its discovery depends on, as text: studies that agree in it share one.
std::string discovery_subject(const Study& study);

/// For any system but those that coast. Analyses the balanced states; runs pilot starts, free from rest at the final
/// speed (of a driven rotor see PilotRun::make()), and starts in the invariant subspace of coincident balls until they
/// are stationary; follows, refines and names one of each group; makes traps and boxes and tries them. With anisotropic
/// supports or gravity motions are strobed ones. Starts that come to something else later are followed and listed by
/// StartRunner.
Discovery discover(const Study& study, const DiscoverySettings& settings);

}  // namespace equipoise
