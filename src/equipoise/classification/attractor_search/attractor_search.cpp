// Takes pilot starts to attractors: groups the motions that they come to, follows, names and lists them.
#include "equipoise/classification/attractor_search/attractor_search.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "equipoise/attractors/equilibria/equilibria.hpp"
#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/classification/attractor_search/search.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/simulation/rule/pilot.hpp"
#include "equipoise/simulation/rule/window_features.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"

namespace equipoise {

namespace {

// Windows longer by this factor show what chaos and tori are.
constexpr double later_windows = 4.0;

class Discoverer {
 public:
  Discoverer(const Study& study, const SpinUp& source, const AttractorSearchSettings& settings,
             const std::string& subject, const DrawnSource* drawn = nullptr)
      : s_(study, source, settings, subject, drawn) {}

  AttractorSearch run() {
    regions_.find_balanced();
    if (s_.is_stopped()) return stopped();
    if (s_.plan.balance_alone) return finished();
    const bool few = s_.settings.mode == SearchMode::few;  // the scouts are then all that is looked at
    if (is_warm() && !list_warm_start_states()) return stopped();
    if (!s_.pilot.make()) return stopped();
    for (OwnRotor& rotor : s_.pilot.rotors()) s_.result.place(rotor);
    if (!follow_pilot(s_.pilot.scouts())) return stopped();
    if (!list_found(!few && !is_warm())) return stopped();
    if (few) {
      if (s_.study.numerics.decide == ClassificationMode::proof) regions_.level_balanced();
      return finished();
    }
    std::vector<Candidate> all = seeds_;
    all.insert(all.end(), found_.begin(), found_.end());
    make_boxes(s_, all);
    if (!scouts_suffice(s_)) {
      if (!follow_pilot(s_.pilot.size())) return stopped();
      // Where rotors differ, the scouts show little of the others, and an unnamed motion bars every box.
      if (s_.drawn && !list_found()) return stopped();
      audit_boxes(s_, found_);
    }
    regions_.level_balanced();
    if (!list_found()) return stopped();
    return finished();
  }

 private:
  bool is_warm() const { return s_.settings.mode == SearchMode::warm; }

  AttractorSearch finished() {
    if (s_.balance_box) ask_for_balance();
    if (s_.drawn && !follow_chaos(s_, chaos_)) return stopped();
    if (!s_.is_stopped()) s_.notes.finish();
    s_.result.rule.blind = false;
    s_.result.rule.at_horizon = s_.study.numerics.decide == ClassificationMode::horizon;
    return std::move(s_.result);
  }

  AttractorSearch stopped() {
    s_.result.stopped = true;
    return std::move(s_.result);
  }

  // Decides the first `count` pilot starts by the current rule.
  bool follow_pilot(std::size_t count) {
    const double horizon = std::min(*s_.study.numerics.horizon, pilot_windows * s_.result.rule.first_long_window);
    return s_.pilot.follow(count, s_.result.rule, horizon, s_.settings.threads, s_.settings.stop, s_.stages, s_.notes);
  }

  // Lists the motions that the pilot came to and the rule cannot name, and, `with_given`, those of known states.
  // Stationary ones come first: most wandering trajectories look like one of them, as tori that had not repeated yet,
  // and need not be followed.
  bool list_found(bool with_given = false) {
    find_candidates();
    if (with_given) {
      add_warm_start_states();
      add_equilibria();
    }
    const auto wandering =
        std::stable_partition(candidates_.begin(), candidates_.end(), [](const Candidate& c) { return c.stationary; });
    std::vector<Candidate> later(wandering, candidates_.end());
    candidates_.erase(wandering, candidates_.end());
    if (!refine_and_list()) return false;
    found_ = std::move(candidates_);
    candidates_.clear();
    for (Candidate& c : later) (name_by_looks(c) ? found_ : candidates_).push_back(c);
    if (!refine_and_list()) return false;
    found_.insert(found_.end(), candidates_.begin(), candidates_.end());
    return true;
  }

  // Names a candidate after a listed attractor that looks the same. Boxes are made around its windows all the same.
  bool name_by_looks(Candidate& c) {
    const KnownFeatures* known = s_.known_as(c.features, c.own);
    if (!known) return false;
    c.attractor = known->attractor;
    c.trend = known->trend;
    c.shows_motion = true;
    // One entry recognises the motion of all rotors, but chaos looks different in every window.
    if (!s_.drawn || known->chaotic) add_known(c, known->chaotic);
    return true;
  }

  void add_known(const Candidate& c, bool chaotic) {
    // Until follow_chaos() finds the rotors for which chaos lasts, it may end for all.
    s_.result.rule.known.push_back(
        {of_middle(s_, c, c.features, c.own), c.attractor, chaotic, chaotic && s_.drawn ? 0 : -1, c.trend});
  }

  // Groups trajectories that the rule cannot name: stationary ones, and ones that neither became steady nor balanced.
  void find_candidates() {
    std::vector<std::size_t> stationary, wandering;
    for (std::size_t i = 0; i < s_.pilot.followed(); ++i) {
      const Outcome& outcome = s_.pilot.outcomes()[i];
      if (outcome.attractor == 0 && s_.shows_balance(i)) continue;
      if (outcome.kind == OutcomeKind::attracted && outcome.attractor == 0) stationary.push_back(i);
      if (outcome.kind == OutcomeKind::undecided && s_.pilot.records()[i].finished_window &&
          !s_.known_as(s_.pilot.records()[i].features, s_.pilot.rotor(i)))
        wandering.push_back(i);
    }
    candidates_.clear();
    for (const auto& [which, tolerance] : {std::pair{&stationary, grouping}, std::pair{&wandering, loose_grouping}}) {
      auto groups = group_records(s_.pilot.records(), *which, s_.balls(), tolerance);
      std::stable_sort(groups.begin(), groups.end(),
                       [](const MotionGroup& a, const MotionGroup& b) { return a.members.size() > b.members.size(); });
      groups.resize(std::min(groups.size(), s_.plan.groups));
      for (const MotionGroup& group : groups) {
        candidates_.push_back({group.members, group.features, group.range,
                               s_.pilot.state_on_section(group.members.front()),
                               s_.pilot.rotor(group.members.front())});
        candidates_.back().stationary = which == &stationary;
      }
    }
    if (s_.balance_box) drop_balanced_candidates();
    if (is_warm()) recognise_candidates();
  }

  // Trajectories on a slow way to balance are followed on lanes first. To follow one to a motion may take for ever.
  void drop_balanced_candidates() {
    ClassificationRule only_balance = s_.result.rule;
    only_balance.boxes = {*s_.balance_box};
    only_balance.first_long_window = *s_.study.numerics.horizon;
    const double time = 2.0 * s_.balance_box->hits_needed * 0.5 * s_.result.rule.window;
    const std::vector<Outcome> outcomes =
        s_.outcomes_of(candidates_, only_balance, time / only_balance.first_long_window);
    std::vector<Candidate> others;
    for (std::size_t k = 0; k < candidates_.size(); ++k)
      if (outcomes[k].attractor != balanced_id) others.push_back(std::move(candidates_[k]));
    candidates_ = std::move(others);
  }

  // A trajectory that creeps near balance looks the same in all long windows, and would be followed to a motion that
  // never comes back. Three long windows make it stationary, so they must leave the balance box time to decide.
  void ask_for_balance() {
    ClassificationRule& rule = s_.result.rule;
    rule.boxes.push_back(*s_.balance_box);
    rule.first_long_window = std::max(rule.first_long_window, s_.balance_box->hits_needed * 0.5 * rule.window / 3.0);
  }

  // A candidate need not be followed if its later, longer windows show a neighbour's motion, or its trapping regions
  // catch it.
  void recognise_candidates() {
    ClassificationRule later = s_.result.rule;
    later.first_long_window *= later_windows;
    later.boxes.clear();
    const std::vector<Outcome> outcomes = s_.outcomes_of(candidates_, later, pilot_windows);
    std::vector<Candidate> unknown;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (outcomes[k].kind != OutcomeKind::attracted || outcomes[k].attractor == 0)
        unknown.push_back(std::move(candidates_[k]));
      else if (const Attractor* a = s_.result.catalogue.find(outcomes[k].attractor)) {
        Candidate& c = candidates_[k];
        // As well as two windows of that attractor agree.
        const KnownFeatures* known = s_.looks_like(c.features, c.own, agreement(a->motion.kind), a->id);
        if (!known) continue;
        c.attractor = known->attractor;
        c.trend = known->trend;
        add_known(c, known->chaotic);
      }
    }
    candidates_ = std::move(unknown);
  }

  const model::System& system_of(const Candidate& c) const { return c.own ? c.own->system : s_.system; }

  void add_state(const Eigen::VectorXd& state) {
    Candidate& c = candidates_.emplace_back();
    c.state = state;
    c.stationary = true;
  }

  void add_warm_start_states() {
    for (const std::vector<double>& seed : s_.settings.warm_start_states)
      add_state(Eigen::Map<const Eigen::VectorXd>(seed.data(), static_cast<Eigen::Index>(seed.size())));
  }

  // Of a tilting rotor, which has many: races off centre while others are centred attract few starts.
  void add_equilibria() {
    constexpr int arrangements = 200;
    if (!s_.system.tilts() || !s_.system.autonomous() || !s_.system.prescribed() || s_.drawn) return;
    for (const Equilibrium& e : unbalanced_equilibria(s_.system, arrangements, s_.settings.stop))
      if (attracts(e.eigenvalues, free_angles(s_.system, e.state))) add_state(e.state);
  }

  // A neighbour's motions come first. Their trapping regions or looks then decide most of the pilot, and only the rest
  // need be followed.
  bool list_warm_start_states() {
    add_warm_start_states();
    if (!refine_and_list()) return false;
    seeds_ = std::move(candidates_);
    return true;
  }

  // Where rotors differ, a few at a time are followed: most others are the same motions on another rotor.
  bool refine_and_list() {
    if (!s_.drawn) return refine_candidates();
    constexpr std::size_t at_once = 4;
    const std::vector<Candidate> all = std::move(candidates_);
    std::vector<Candidate> done;
    for (auto next = all.begin(); next != all.end();) {
      candidates_.clear();
      for (; next != all.end() && candidates_.size() < at_once; ++next) {
        Candidate c = *next;
        (!c.members.empty() && name_by_looks(c) ? done : candidates_).push_back(std::move(c));
      }
      if (!refine_candidates()) return false;
      done.insert(done.end(), candidates_.begin(), candidates_.end());
    }
    candidates_ = std::move(done);
    return true;
  }

  // A state of the pilot becomes a candidate again if it ended in no motion, or to one that looks different each time.
  const Candidate* followed_before(const Candidate& c) const {
    const auto at = std::find_if(followed_.begin(), followed_.end(),
                                 [&](const Candidate& f) { return f.own == c.own && f.state == c.state; });
    return at == followed_.end() ? nullptr : &*at;
  }

  // Follows candidates until they are steady. Lists those that become so, with the windows that recognise them.
  bool refine_candidates() {
    s_.stages.begin("motions followed until they are steady", candidates_.size());
    const std::uint64_t first = s_.notes.reserve(candidates_.size());
    in_parallel(s_.settings.threads, candidates_.size(), [&](std::size_t k) {
      if (s_.is_stopped()) return;
      Candidate& c = candidates_[k];
      const Candidate* before = followed_before(c);
      c.motion = before ? before->motion
                        : s_.notes.answer_at(
                              first + k, "motion", s_.settings.stop,
                              [&] { return motion_from(system_of(c), c.state, s_.plan.patience, s_.settings.stop); },
                              [&](std::optional<Motion>& m) { return !m || fits_system(system_of(c), *m); });
      s_.stages.add(1);
    });
    if (s_.is_stopped()) return false;
    for (const Candidate& c : candidates_)
      if (!followed_before(c)) followed_.push_back(c);
    compare_with_motions();
    const Catalogue before = s_.result.catalogue;
    for (Candidate& c : candidates_)
      if (c.motion && c.motion->stable) c.attractor = s_.result.catalogue.add(system_of(c).parameters(), *c.motion);
    for (Candidate& c : candidates_) {
      // Looks never decide balance: a trapping region does, or the way to balance is followed.
      if (!c.motion || !c.motion->stable || !c.shows_motion || c.attractor == balanced_id) continue;
      if (s_.drawn ? looks_known(c) : is_known(c.attractor)) {
        if (c.own_windows) c.shows_motion = false;  // another state led to the same motion
        if (!c.shows_motion) continue;
      } else {
        if (!add_trend(s_, c)) return false;
        regions_.add_of_candidate(c);
        s_.result.warm_start_states.emplace_back(c.motion->state.begin(), c.motion->state.end());
      }
      add_known(c, c.motion->kind == MotionKind::chaotic);
      if (c.motion->kind == MotionKind::chaotic) chaos_.try_emplace(c.attractor, c.motion->state);
    }
    for (const Attractor& a : s_.result.catalogue.listed_since(before)) regions_.add_listed(a);
    regions_.set_rule();
    return !s_.is_stopped();
  }

  // Where rotors differ, several motions may share a name. If the candidate looks like a known motion of its own name,
  // it takes over that motion's trend.
  bool looks_known(Candidate& c) const {
    const KnownFeatures* known = s_.known_as(c.features, c.own);
    if (!known || known->attractor != c.attractor) return false;
    c.trend = known->trend;
    return true;
  }

  bool is_known(int attractor) const {
    const std::vector<KnownFeatures>& known = s_.result.rule.known;
    return std::any_of(known.begin(), known.end(), [&](const KnownFeatures& k) { return k.attractor == attractor; });
  }

  // A trajectory may seem stationary near an unstable motion, or on chaos that ends, and still end in a stable one.
  // Its windows do not recognise that motion then, and a neighbour's motion has none: they get the motion's own.
  void compare_with_motions() {
    std::vector<Candidate*> followed;
    std::vector<const Motion*> motions;
    std::vector<const OwnRotor*> own;
    for (Candidate& c : candidates_) {
      if (!c.motion || !c.motion->stable || (c.members.empty() && !is_warm())) continue;
      followed.push_back(&c);
      motions.push_back(&*c.motion);
      if (s_.drawn) own.push_back(c.own ? c.own : &s_.rotors.front());
    }
    const std::vector<PilotRecord> windows = s_.windows_of(motions, own);
    for (std::size_t k = 0; k < followed.size(); ++k) {
      Candidate& c = *followed[k];
      // Each member of a continuum that dry friction leaves looks different.
      c.shows_motion = !c.motion->set_valued && windows[k].finished_window;
      const bool shown =
          !c.members.empty() && same_motion(c.features, windows[k].features, s_.balls(), agreement(c.motion->kind));
      // Where rotors differ, a trajectory may linger where another rotor has its motion, so only what was met counts.
      if (s_.drawn && !c.members.empty()) {
        c.shows_motion = c.shows_motion && shown;
        continue;
      }
      c.own_windows = c.shows_motion && !shown;
      if (!c.shows_motion) continue;
      c.features = windows[k].features;  // members may still have been on their way
      if (c.own_windows) c.range = windows[k].range;
    }
  }

  Search s_;
  SearchRegions regions_{s_};
  std::map<int, Eigen::VectorXd> chaos_;  // by attractor: a state on one rotor's chaos
  // Being followed; all followed so far; those of the pilot; those of a neighbour.
  std::vector<Candidate> candidates_, followed_, found_, seeds_;
};

}  // namespace

AttractorSearch search_attractors(const StudyFamily& family, const FamilyBox& box,
                                  const AttractorSearchSettings& settings) {
  const DrawnSource source(family, box, settings.stop);
  return Discoverer(source.middle(), source, settings, search_key(box, settings), &source).run();
}

AttractorSearch search_attractors(const Study& study, const AttractorSearchSettings& settings) {
  const Study steady = at_final_speed(study);
  // Not kept: its regions read the stop flag, which is this run's.
  if (steady.system().coasts()) return discover_coasting(steady, settings.stop);
  const std::string key = search_key(to_toml(steady), settings);
  const auto make = [&] {
    const std::unique_ptr<SpinUp> source = make_spin_up(steady, settings.stop);
    return Discoverer(steady, *source, settings, key).run();
  };
  if (!settings.cache) return make();
  if (const auto at = settings.cache->made.find(key); at != settings.cache->made.end()) return at->second;
  AttractorSearch search = make();
  if (!search.stopped) settings.cache->made.emplace(key, search);
  return search;
}

}  // namespace equipoise
