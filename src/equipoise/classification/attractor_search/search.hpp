// One attractor search: what its parts share, and the parts, a file each (search_regions.cpp, search_boxes.cpp,
// rotor_trends.cpp).
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/attractor_search/pilot_run.hpp"
#include "equipoise/classification/rotor_family/drawn_source.hpp"
#include "equipoise/classification/trapping_regions/continuum_region.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/classification/trapping_regions/region_rule.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/classification/trapping_regions/path_region.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/core/running/stage_progress.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// A state that is followed to its motion: of a group of pilot trajectories that look alike, or given.
struct Candidate {
  std::vector<std::size_t> members;  ///< records; none for given states
  Features features{};
  FeatureBox range;
  Eigen::VectorXd state;
  const OwnRotor* own = nullptr;  ///< its rotor, if starts draw theirs
  std::optional<Motion> motion{};
  int attractor = 0;
  int trend = -1;             ///< where rotors differ: the row of its motion's features (FeatureTrends)
  bool shows_motion = false;  ///< its windows are those of the motion that it was followed to
  bool own_windows = false;   ///< they are the motion's own: no member shows it
  bool stationary = false;
};

/// Windows of one motion agree this well; motions met so far differ by more.
inline constexpr double grouping = 0.05;
/// Windows of one chaotic motion.
inline constexpr double loose_grouping = 0.3;
/// Windows of one torus that did not repeat: its extremes may take longer to appear than any window lasts.
inline constexpr double torus_grouping = 0.15;
constexpr double agreement(MotionKind kind) {
  if (kind == MotionKind::chaotic) return loose_grouping;
  return kind == MotionKind::quasi_periodic ? torus_grouping : grouping;
}

/// Where gravity or anisotropic supports make balls strike each other every turn, chains of ever smaller impacts are
/// followed one by one.
bool is_dear(const model::System& system);

/// A motion that starts come to but no state of which is known.
Motion measured_motion();

/// How much of a search is done. It follows from the system, the mode and the starts that the search serves. For a
/// coasting rotor there is none at all (discover_coasting()).
struct SearchPlan {
  /// `drawn`: for a part of a family.
  SearchPlan(const model::System& system, const AttractorSearchSettings& settings, bool drawn);

  bool balance_alone;    ///< every start that comes to anything else is followed by itself
  PilotRun::Size pilot;  ///< else
  std::size_t groups;    ///< of pilot trajectories that are followed, the largest first
  double patience;       ///< how long each is followed
};

struct Search {
  /// `drawn`: the source, if it draws rotors; `study` is then that of its middle. `subject`: everything that the search
  /// depends on.
  Search(const Study& study, const SpinUp& source, const AttractorSearchSettings& settings, const std::string& subject,
         const DrawnSource* drawn);

  bool is_stopped() const { return is_set(settings.stop); }
  int balls() const { return study.parameters.balls; }
  template <class Work, class Fits>
  auto noted(const char* question, const Work& work, const Fits& fits) {
    return notes.answer(question, settings.stop, work, fits);
  }
  std::optional<Motion> motion_of_middle(const Eigen::VectorXd& state);
  /// The windows of stable motions, each followed from its own state as the pilot's trajectories are, until they repeat
  /// or for pilot_windows. `own`: their rotors, unless all are motions of `system`. If stopped, records lack a finished
  /// window.
  std::vector<PilotRecord> windows_of(const std::vector<const Motion*>& motions,
                                      const std::vector<const OwnRotor*>& own);
  /// Decides trajectories by the rule's trapping regions and windows alone, for `longest` times its first long window.
  /// The states lie on a stroboscopic section, if there is one.
  std::vector<Outcome> outcomes_of(const std::vector<double>& states, const std::vector<const OwnRotor*>& own,
                                   ClassificationRule rule, double longest);
  std::vector<Outcome> outcomes_of(const std::vector<Candidate>& candidates, const ClassificationRule& rule,
                                   double longest);

  /// The known motion that looks like this, or null. `own`: the rotor that shows it, or null.
  const KnownFeatures* known_as(const Features& f, const OwnRotor* own) const;
  /// The first known entry, or that of one attractor, that looks the same up to a tolerance; or null.
  const KnownFeatures* looks_like(const Features& f, const OwnRotor* own, double tolerance, int attractor = 0) const;
  bool shows_balance(std::size_t i) const;

  const Study& study;
  const model::System system;
  const AttractorSearchSettings& settings;
  const DrawnSource* const drawn;
  NotePage notes;
  const SearchPlan plan;
  StageProgress stages;
  TrialSettings trials;
  std::vector<OwnRotor> rotors;  ///< for trials: the middle's first
  PilotRun pilot;
  AttractorSearch result;
  std::optional<FeatureBox> balance_box;  ///< decides next to trapping regions
};

/// The rule that a search begins with, when only balanced states are known. The study must have its horizon.
ClassificationRule first_rule(const Study& study, const BalancedAnalysis& balanced, const model::System& system);

/// Under gravity, or under a motor if the rotor's angle matters, balls creep along a continuum of balanced states,
/// touch and part again. Their motion does not come back for thousands of turns, and the member that they are at does
/// not matter to the rotor. So balanced means that windows stay balanced: the rotor vibrates at most half as much as
/// without balls (halves_the_shaking()), and no ball drifts. That must last for ten e-foldings of the fastest growth
/// or, without growth, five of the slowest decay. Empty for all other systems, and if there is no balance.
std::optional<FeatureBox> balance_box(const model::System& system, const BalancedAnalysis& balanced, double window,
                                      double horizon);

/// Makes boxes around the windows of each attractor's scouts. `found`: candidates of the pilot and of a neighbour.
void make_boxes(Search& search, const std::vector<Candidate>& found);
/// Sets how many hits each box takes, by what the whole pilot did under trapping regions and stationarity alone.
/// `found`: candidates of the pilot.
void audit_boxes(Search& search, const std::vector<Candidate>& found);
/// If all random scouts ended in listed motions and no box needs an audit, the rest of the pilot would only find
/// motions rarer than one in a thousand. Session also lists those, once a start ends in one. At a prescribed speed
/// without events and gravity, the rest costs less than following a few such starts; in all other cases it is most of
/// the search.
bool scouts_suffice(const Search& search);

/// Where rotors differ: fits how a candidate's motion looks on the others (FeatureTrends::add()). False if stopped.
bool add_trend(Search& search, Candidate& c);
/// And finds on which of them chaos lasts. `chaos`: by attractor, a state on one rotor's chaos. False if stopped.
bool follow_chaos(Search& search, const std::map<int, Eigen::VectorXd>& chaos);
/// Features of a candidate or one of its members, shown by the rotor `own`, as the middle's motion shows them.
Features of_middle(const Search& search, const Candidate& c, const Features& f, const OwnRotor* own);

/// For a coasting rotor: each start finds its own final speed, and with it the motions that it can come to.
AttractorSearch discover_coasting(const Study& study, const StopFlag* stop);

/// The trapping regions of a search, made as motions are found.
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

  Search& s_;
  OrbitRegions cycles_;
  std::vector<std::shared_ptr<const PathRegion>> windowed_;
  std::optional<ContinuumRegion> continuum_;
  std::optional<StalledRegion> stalled_;
  std::map<int, int> without_;  // by attractor: motions for which no region was found
};

}  // namespace equipoise
