// One search for attractors: what its parts share, and the parts, a file each (first_rule.cpp, search_regions.cpp,
// search_boxes.cpp, rotor_trends.cpp, coasting.cpp).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractor_search/attractor_search.hpp"
#include "equipoise/attractor_search/pilot_run.hpp"
#include "equipoise/attractors/motion.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/rotor_family/drawn_source.hpp"
#include "equipoise/running/search_log.hpp"
#include "equipoise/running/stage_progress.hpp"
#include "equipoise/trapping_regions/trials.hpp"

namespace equipoise {

/// A state that is followed to its motion: of a group of the pilot's trajectories that look alike, or a seed.
struct Candidate {
  std::vector<std::size_t> members;  ///< records; none for seeds
  Features features{};
  FeatureBox range;
  Eigen::VectorXd state;
  const OwnRotor* own = nullptr;  ///< its rotor, if starts draw theirs
  std::optional<Motion> motion{};
  int attractor = 0;
  int trend = -1;             ///< of rotors that differ: the row of its motion's features (FeatureTrends)
  bool shows_motion = false;  ///< its members' windows are those of the motion that it was followed to
  bool stationary = false;
};

/// Windows of one motion agree this well; motions met so far differ by more.
inline constexpr double grouping = 0.05;
/// Windows of one chaotic motion.
inline constexpr double loose_grouping = 0.3;
/// Windows of one torus that did not repeat themselves: its extremes may take longer to show than any window lasts.
inline constexpr double torus_grouping = 0.15;
/// How well two windows of one motion agree.
constexpr double agreement(MotionKind kind) {
  if (kind == MotionKind::chaotic) return loose_grouping;
  return kind == MotionKind::quasi_periodic ? torus_grouping : grouping;
}

/// Where weights or unequal supports make balls strike each other with every turn, chains of ever smaller impacts are
/// followed one by one.
bool is_dear(const model::System& system);

/// What starts come to without a state of it being known.
Motion measured_motion();

struct Search {
  /// `drawn`: the source, if it draws rotors; `study` is then that of its middle. `subject`: all that the search
  /// depends on.
  Search(const Study& study, const SpinUp& source, const AttractorSearchSettings& settings, const std::string& subject,
         const DrawnSource* drawn);

  bool is_stopped() const { return is_set(settings.stop); }
  int balls() const { return study.parameters.balls; }
  template <class Work>
  auto noted(const char* question, const Work& work) {
    return notes.answer(question, settings.stop, work);
  }
  std::optional<Motion> motion_of_middle(const Eigen::VectorXd& state);
  /// What windows of these motions show (own_windows()), and fates of these states by windows (fates_by_windows()).
  std::vector<PilotRecord> windows_of(const std::vector<const Motion*>& motions,
                                      const std::vector<const OwnRotor*>& own);
  std::vector<Fate> fates_of(const std::vector<double>& states, const std::vector<const OwnRotor*>& own,
                             const ClassificationRule& rule, double longest);
  std::vector<Fate> fates_of(const std::vector<Candidate>& candidates, const ClassificationRule& rule, double longest);

  /// What is known and looks like this; null if nothing does. `own`: the rotor that shows it, or null.
  const KnownFeatures* known_as(const Features& f, const OwnRotor* own) const;
  /// Whether a window of the pilot's start `i` lies in the box of balance.
  bool shows_balance(std::size_t i) const;

  const Study& study;
  const model::System system;
  const AttractorSearchSettings& settings;
  const DrawnSource* const drawn;
  NotePage notes;
  StageProgress stages;
  TrialSettings trials;
  std::vector<OwnRotor> rotors;  ///< for tries: the middle's first
  PilotRun pilot;
  AttractorSearch result;
  std::optional<FeatureBox> balance_box;  ///< beside trapping regions
};

/// The rule that a search begins with, before any motion is known but the balanced states. The study has its horizon.
ClassificationRule first_rule(const Study& study, const BalancedAnalysis& balanced, const model::System& system);

/// Boxes around what the scouts of each attractor did; `found`: the pilot's candidates and a neighbour's.
void make_boxes(Search& search, const std::vector<Candidate>& found);
/// How many hits each box takes, from what the whole pilot did where only trapping regions and stationarity decided.
/// `found`: the pilot's candidates.
void audit_boxes(Search& search, const std::vector<Candidate>& found);
/// Where all random scouts came to what is listed and no box is to be audited, the rest of the pilot would only look
/// for what is rarer than one in a thousand, which is listed as well once a start comes to it. Of a smooth rotor at a
/// prescribed speed that feels no gravity this costs less than to follow a few such starts, of all others most of the
/// search.
bool scouts_suffice(const Search& search);

/// Of rotors that differ: how a candidate's motion looks for the others (FeatureTrends::add()). False if stopped.
bool add_trend(Search& search, Candidate& c);
/// And for which of them chaos lasts; `chaos`: by attractor a state on one rotor's. False if stopped.
bool follow_chaos(Search& search, const std::map<int, Eigen::VectorXd>& chaos);
/// Features of a candidate, or of one of its members, which the rotor `own` shows, as the middle's motion shows them.
Features of_middle(const Search& search, const Candidate& c, const Features& f, const OwnRotor* own);

/// Of a rotor that coasts every start finds for itself which speed is left, and with it what else there is to come to.
AttractorSearch discover_coasting(const Study& study, const StopFlag* stop);

}  // namespace equipoise
