// Pilot, refinement, traps, audit.
#include "equipoise/discovery/discovery.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/base/parallel.hpp"
#include "equipoise/base/stage_progress.hpp"
#include "equipoise/deciding/pilot.hpp"
#include "equipoise/deciding/window_features.hpp"
#include "equipoise/discovery/balanced_levels.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/discovery/own_windows.hpp"
#include "equipoise/discovery/pilot_run.hpp"
#include "equipoise/model/capability.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/motions/motion_description.hpp"
#include "equipoise/motions/stuck.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/traps/continuum_trap.hpp"
#include "equipoise/traps/cycle_forms.hpp"
#include "equipoise/traps/stalled_trap.hpp"
#include "equipoise/traps/torus_trap.hpp"
#include "equipoise/traps/trap_rule.hpp"
#include "equipoise/traps/validated_level.hpp"

namespace equipoise {

namespace {

// Windows of one motion agree this well; motions met so far differ by more.
constexpr double grouping = 0.05;
// Windows of one chaotic motion.
constexpr double loose_grouping = 0.3;
// Windows of one torus that did not repeat themselves: its extremes may take longer to show than any window lasts.
constexpr double torus_grouping = 0.15;
// Groups that are followed, the largest first: more are the debris of a motion that does not settle.
constexpr std::size_t most_groups = 24;
// By so much longer, windows of chaos and of tori show what they are.
constexpr double later_windows = 4.0;

// A weak motor brings a balanced rotor to its speed so slowly that tries of wider levels, which wait for that, would
// take longer than starts do that have to come into the narrow one.
constexpr double slowest_worth_widening = 1e-3;

// Boxes around what a motion does, widened by so many times its range: a wide one is entered sooner, and the audit
// makes it ask for more hits. Whichever is satisfied first decides.
constexpr std::array box_widths{1.0, 2.0, 4.0};

// Half a window holds whole strobes, so that what repeats with the rotor looks the same in all of them.
double whole_strobes(double window, double strobe) { return 2.0 * strobe * std::ceil(0.5 * window / strobe - 1e-9); }

DecisionRule first_rule(const Study& study, const BalancedAnalysis& balanced, const model::System& system) {
  DecisionRule rule;
  rule.balls = study.parameters.balls;
  rule.interchangeable = study.parameters.equal_balls();
  rule.balanced = balanced.traps;
  // Slow rotors move slowly: a window holds several revolutions of every motion met between 1.4 and 6.5 critical
  // speeds.
  rule.window = std::max(16.0, 32.0 / std::max(std::fabs(system.pace()), 0.1));
  rule.sag = model::static_sag(study.parameters);
  if (system.section() == model::Section::strobe) rule.window = whole_strobes(rule.window, system.strobe_period());
  if (system.runs_away(rule.fastest)) rule.fastest = model::out_of_reach;
  rule.first_long_window = std::max(100.0, 6.0 * rule.window);
  if (balanced.slowest_rate < 0.0) {
    // Long enough that whatever is only on its slow way to balance shrinks visibly from one window to the next.
    rule.first_long_window = std::max(rule.first_long_window, 1.0 / -balanced.slowest_rate);
    rule.first_long_window = std::min(rule.first_long_window, *study.numerics.horizon / 8.0);
    rule.sameness = std::min(rule.sameness, 0.2 * -balanced.slowest_rate * rule.first_long_window);
  }
  return rule;
}

struct Candidate {
  std::vector<std::size_t> members;  // records; none for seeds
  Features features{};
  FeatureBox range;
  Eigen::VectorXd state;
  std::optional<Motion> motion{};
  int attractor = 0;
  bool shows_motion = false;  // its members' windows are those of the motion that it was followed to
};

class Discoverer {
 public:
  Discoverer(const Study& study, const SpinUp& source, const DiscoverySettings& settings)
      : study_(study),
        system_(study.system()),
        settings_(settings),
        stages_("looking for attractors", settings.progress),
        trials_{.system = &system_,
                .tolerance = source.tolerance(),
                .threads = settings.threads,
                .stop = settings.stop,
                .progress = &stages_},
        pilot_(system_, source, study.initial, settings.informed ? 4 : 1) {}

  Discovery run() {
    find_balanced();
    if (is_stopped() || (settings_.informed && !list_seeds())) return stopped();
    if (!pilot_.make() || !follow_pilot(pilot_.scouts())) return stopped();
    find_candidates();
    if (!settings_.informed) add_seeds();
    if (!refine_and_list()) return stopped();
    make_boxes();
    if (!follow_pilot(pilot_.size())) return stopped();
    audit_boxes();
    level_balanced();
    find_candidates();
    if (!refine_and_list()) return stopped();
    result_.rule.blind = false;
    result_.rule.at_horizon = study_.numerics.decide == DecideMode::horizon;
    return std::move(result_);
  }

 private:
  bool is_stopped() const { return is_set(settings_.stop); }
  Discovery stopped() {
    result_.stopped = true;
    return std::move(result_);
  }

  void find_balanced() {
    stages_.begin("balanced states");
    BalancedAnalysis& balanced = result_.balanced;
    balanced = analyse_balanced(system_, settings_.stop, settings_.hints.weights);
    result_.hints.weights = balanced.weights;
    const auto part = balanced.continuum ? std::optional<ContinuumPart>(balanced.survey) : std::nullopt;
    for (const Motion& motion : balanced.motions) result_.catalogue.add(study_.parameters, motion, part);
    if (is_stopped()) return;
    result_.rule = first_rule(study_, balanced, system_);
    result_.rule.blind = true;
    continuum_ = continuum_trap(balanced.continuum, balanced.survey, trials_);
    // Under gravity one of the motions that the continuum's trap leads to stands for all.
    if (continuum_ && !system_.autonomous() && balanced.motions.empty())
      if (const auto m = balanced.continuum->member(balanced.survey.typical.data()))
        result_.catalogue.add(study_.parameters, describe_creep(system_, m->centre, m->rate), part);
    for (const Motion& motion : balanced.motions) add_traps(motion, balanced_id);
    find_stalled();
    set_rule_traps();
  }

  // Where gravity holds the rotor against its motor it can rest.
  void find_stalled() {
    const auto well = model::GravityWell::of(system_);
    if (!well) return;
    stalled_ = StalledTrap{*well};
    for (const Eigen::VectorXd& place : places_to_hang(system_, *well)) {
      const auto motion = motion_from(system_, place, motion_patience, settings_.stop);
      if (!motion || !motion->stable) continue;
      const int id = result_.catalogue.add(study_.parameters, *motion);
      stalled_->rests.push_back({order_of(system_, motion->state.data()), id});
    }
  }

  // Of balls that stick no single state attracts: what catches a start is that all of them are held for good.
  void set_rule_traps() {
    set_tori(result_.rule, tori_);
    if (!system_.events().stick) {
      set_traps(result_.rule, system_, cycles_, continuum_, stalled_);
      return;
    }
    result_.rule.strobed = {[system = system_, listed = result_.catalogue](const double* state, double psi) {
      const Eigen::Map<const Eigen::VectorXd> y(state, system.dimension());
      const auto end = stuck_for_good(system, y, psi);
      return end ? listed.find(system.parameters(), describe_stuck(system, *end)) : 0;
    }};
  }

  // Proved or widened levels of the balanced traps.
  void level_balanced() {
    if (study_.numerics.decide == DecideMode::proof)
      prove_levels(result_.rule.balanced, trials_);
    else if (system_.plain() || result_.balanced.slowest_rate < -slowest_worth_widening)
      result_.hints.levels.push_back({balanced_id, false,
                                      widen_levels(result_.rule, trials_, result_.balanced.slowest_rate, pilot_,
                                                   settings_.hints.level(balanced_id, false))});
  }

  // Decides the first `count` of the pilot's starts by the rule as it stands.
  bool follow_pilot(std::size_t count) {
    const double horizon = std::min(*study_.numerics.horizon, pilot_windows * result_.rule.first_long_window);
    return pilot_.follow(count, result_.rule, horizon, settings_.threads, settings_.stop, stages_);
  }

  // Groups of trajectories that the rule cannot name yet: stationary ones, and ones that neither settled nor came to
  // balance.
  void find_candidates() {
    const int balls = study_.parameters.balls;
    const std::vector<KnownFeatures>& known = result_.rule.known;
    std::vector<std::size_t> stationary, wandering;
    for (std::size_t i = 0; i < pilot_.followed(); ++i) {
      const Fate& fate = pilot_.fates()[i];
      if (fate.outcome == Outcome::attracted && fate.attractor == 0) stationary.push_back(i);
      if (fate.outcome == Outcome::undecided && pilot_.records()[i].finished_window &&
          !nearest_known(pilot_.records()[i].features, known, balls))
        wandering.push_back(i);
    }
    candidates_.clear();
    for (const auto& [which, tolerance] : {std::pair{&stationary, grouping}, std::pair{&wandering, loose_grouping}}) {
      auto groups = group_records(pilot_.records(), *which, balls, tolerance);
      std::stable_sort(groups.begin(), groups.end(),
                       [](const MotionGroup& a, const MotionGroup& b) { return a.members.size() > b.members.size(); });
      if (groups.size() > most_groups) groups.resize(most_groups);
      for (const MotionGroup& group : groups)
        candidates_.push_back(
            {group.members, group.features, group.range, pilot_.state_at_strobe(group.members.front())});
    }
    if (settings_.informed) recognise_candidates();
  }

  // Whose later windows, which are longer, show a neighbour's motion, or that its traps catch, need not be followed.
  void recognise_candidates() {
    std::vector<double> states;
    for (const Candidate& c : candidates_) states.insert(states.end(), c.state.begin(), c.state.end());
    DecisionRule later = result_.rule;
    later.first_long_window *= later_windows;
    const std::vector<Fate> fates =
        fates_by_windows(system_, std::move(states), later, pilot_windows, trials_.tolerance, settings_.stop);
    std::vector<Candidate> unknown;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (fates[k].attractor == 0)
        unknown.push_back(std::move(candidates_[k]));
      else if (const KnownFeatures* known = looks_of(fates[k].attractor, candidates_[k].features))
        result_.rule.known.push_back({candidates_[k].features, known->attractor, known->chaotic});
    }
    candidates_ = std::move(unknown);
  }

  // The attractor's, if they agree as well as two windows of it do.
  const KnownFeatures* looks_of(int attractor, const Features& features) const {
    const Attractor* a = result_.catalogue.find(attractor);
    for (const KnownFeatures& k : result_.rule.known)
      if (a && k.attractor == attractor &&
          same_motion(k.features, features, result_.rule.balls, agreement(a->motion.kind)))
        return &k;
    return nullptr;
  }

  void add_seeds() {
    for (const std::vector<double>& seed : settings_.seeds)
      candidates_.push_back(
          {{}, {}, {}, Eigen::Map<const Eigen::VectorXd>(seed.data(), static_cast<Eigen::Index>(seed.size()))});
  }

  // What a neighbour has comes first: the pilot's trajectories are then caught by its traps, or told by what it looks
  // like, and only what else they come to has to be followed.
  bool list_seeds() {
    add_seeds();
    if (!refine_and_list()) return false;
    seeds_ = std::move(candidates_);
    return true;
  }

  // Follows the candidates until they are steady; lists those that become so, with what recognises them.
  bool refine_and_list() {
    stages_.begin("motions followed until they are steady", candidates_.size());
    in_parallel(settings_.threads, candidates_.size(), [&](std::size_t k) {
      if (is_stopped()) return;
      candidates_[k].motion = motion_from(system_, candidates_[k].state, motion_patience, settings_.stop);
      stages_.add(1);
    });
    if (is_stopped()) return false;
    compare_with_motions();
    const Catalogue before = result_.catalogue;
    for (Candidate& c : candidates_) {
      if (!c.motion || !c.motion->stable) continue;
      c.attractor = result_.catalogue.add(study_.parameters, *c.motion);
      // Balance is never told by what it looks like: traps know it, or the way to it is followed.
      if (!c.shows_motion || c.attractor == balanced_id) continue;
      if (c.members.empty() && is_known(c.attractor)) c.shows_motion = false;  // another seed came to the same
      if (c.shows_motion)
        result_.rule.known.push_back({c.features, c.attractor, c.motion->kind == MotionKind::chaotic});
    }
    for (const Attractor& a : result_.catalogue.listed_since(before)) add_traps(a.motion, a.id);
    set_rule_traps();
    return !is_stopped();
  }

  bool is_known(int attractor) const {
    const std::vector<KnownFeatures>& known = result_.rule.known;
    return std::any_of(known.begin(), known.end(), [&](const KnownFeatures& k) { return k.attractor == attractor; });
  }

  // A trajectory may seem stationary near an unstable motion, or on chaos that ends, and come to a stable one in the
  // end: what its windows showed is then not what recognises that one. A neighbour's motion is known by its own.
  void compare_with_motions() {
    std::vector<Candidate*> followed;
    std::vector<const Motion*> motions;
    for (Candidate& c : candidates_) {
      if (!c.motion || !c.motion->stable || (c.members.empty() && !settings_.informed)) continue;
      followed.push_back(&c);
      motions.push_back(&*c.motion);
    }
    const std::vector<PilotRecord> own =
        own_windows(system_, motions, result_.rule, pilot_windows, trials_.tolerance, settings_.stop);
    for (std::size_t k = 0; k < followed.size(); ++k) {
      Candidate& c = *followed[k];
      // Of a continuum that dry friction leaves every member looks its own way.
      c.shows_motion = !c.motion->set_valued && own[k].finished_window;
      if (c.members.empty()) {
        c.features = own[k].features;
        c.range = own[k].range;
        continue;
      }
      c.shows_motion = c.shows_motion &&
                       same_motion(c.features, own[k].features, study_.parameters.balls, agreement(c.motion->kind));
    }
  }

  // How well two windows of one motion agree.
  static double agreement(MotionKind kind) {
    if (kind == MotionKind::chaotic) return loose_grouping;
    return kind == MotionKind::quasi_periodic ? torus_grouping : grouping;
  }

  void add_traps(const Motion& motion, int id) {
    if (motion.eventful) return;  // windows tell it
    if (motion.kind == MotionKind::quasi_periodic && !model::lacking(system_, model::Answer::torus_traps))
      add_torus(motion, id);
    std::vector<CycleTrap> traps = cycle_traps(system_, motion, id);
    if (traps.empty() || !validate(traps, trials_, motion.orbit.slowest_rate(), settings_.hints.level(id, false)))
      return;
    result_.hints.levels.push_back({id, false, traps.front().level});
    for (CycleTrap& trap : traps) cycles_.push_back(std::make_shared<CycleTrap>(std::move(trap)));
  }

  // Where the neighbour's has none it is not looked for: that takes long, and windows tell the torus too.
  void add_torus(const Motion& motion, int id) {
    const LevelHint* hint = settings_.hints.find(id, true);
    auto torus =
        hint && hint->level == 0.0 ? nullptr : torus_trap(system_, motion, id, trials_, hint ? hint->level : 0.0);
    result_.hints.levels.push_back({id, true, torus ? torus->level() : 0.0});
    if (torus) tori_.push_back(std::move(torus));
  }

  // Around what the scouts of each attractor did.
  void make_boxes() {
    constexpr std::size_t members_needed = 3;
    DecisionRule& rule = result_.rule;
    candidates_.insert(candidates_.begin(), seeds_.begin(), seeds_.end());
    for (const double widths : box_widths)
      for (const Candidate& c : candidates_) {
        const Attractor* a = result_.catalogue.find(c.attractor);
        if (!a || !c.shows_motion || c.attractor == balanced_id) continue;
        // A refined orbit vouches for a lone member, and a motion for itself.
        if (!c.members.empty() && c.members.size() < (a->motion.kind == MotionKind::periodic ? 1 : members_needed))
          continue;
        const FeatureBox box = box_around(c.range, rule.balls, c.attractor, widths);
        if (box.attractor && rule.boxes.size() < most_boxes) rule.boxes.push_back(box);
      }
  }

  // How many hits each box takes, from what the whole pilot did where only traps and stationarity decided.
  void audit_boxes() {
    name_undecided();
    std::vector<FeatureBox> kept;
    for (std::size_t b = 0; b < result_.rule.boxes.size(); ++b) {
      FeatureBox box = result_.rule.boxes[b];
      const bool restless = result_.catalogue.find(box.attractor)->motion.kind == MotionKind::chaotic;
      box.hits_needed = hits_from_audit(pilot_.fates(), pilot_.records(), b, box.attractor, restless);
      if (box.hits_needed) kept.push_back(box);
    }
    result_.rule.boxes = kept;
  }

  // A torus or chaos may not repeat itself within the pilot's time; its last long window tells it all the same.
  void name_undecided() {
    const DecisionRule& rule = result_.rule;
    for (std::size_t i = 0; i < pilot_.followed(); ++i) {
      if (pilot_.fates()[i].outcome != Outcome::undecided || !pilot_.records()[i].finished_window) continue;
      const Features& features = pilot_.records()[i].features;
      if (const KnownFeatures* known = nearest_known(features, rule.known, rule.balls))
        pilot_.name(i, known->attractor);
      else if (!system_.autonomous())
        pilot_.name(i, loosely_known(features));
    }
  }

  // Modulated by the rotor, a torus has a frequency more.
  int loosely_known(const Features& features) const {
    for (const KnownFeatures& known : result_.rule.known)
      if (same_motion(known.features, features, result_.rule.balls, torus_grouping)) return known.attractor;
    return 0;
  }

  const Study& study_;
  const model::System system_;
  const DiscoverySettings& settings_;
  StageProgress stages_;
  const TrialSettings trials_;
  PilotRun pilot_;
  Discovery result_;
  CycleTraps cycles_;
  std::vector<std::shared_ptr<const TorusTrap>> tori_;
  std::optional<ContinuumTrap> continuum_;
  std::optional<StalledTrap> stalled_;
  std::vector<Candidate> candidates_, seeds_;
};

// What is discovered of a study depends on this much of it. How a motor brings its rotor up is part of what can be met:
// a limited one may never pass a resonance.
Study at_final_speed(const Study& study) {
  Study steady = study;
  steady.sampling = {};
  if (study.speed.driven()) return with_horizon(steady);
  steady.speed = {};
  steady.speed.speed = study.speed_profile().final_speed();
  steady.release = {};
  steady.initial = {};
  return with_horizon(steady);
}

}  // namespace

std::string discovery_subject(const Study& study) { return to_toml(at_final_speed(study)); }

Discovery discover(const Study& study, const DiscoverySettings& settings) {
  const Study steady = at_final_speed(study);
  const auto make = [&] {
    const std::unique_ptr<SpinUp> source = make_spin_up(steady, settings.stop);
    return Discoverer(steady, *source, settings).run();
  };
  if (!settings.cache) return make();
  std::string key = fmt::format("{}\n{}\n{}", to_toml(steady), settings.seeds, settings.informed);
  for (const LevelHint& h : settings.hints.levels) key += fmt::format("\n{} {} {}", h.attractor, h.torus, h.level);
  for (const ModeWeight& w : settings.hints.weights) key += fmt::format("\n{} {} {}", w.re, w.im, w.weight);
  if (const auto at = settings.cache->made.find(key); at != settings.cache->made.end()) return at->second;
  Discovery discovery = make();
  if (!discovery.stopped) settings.cache->made.emplace(key, discovery);
  return discovery;
}

}  // namespace equipoise
