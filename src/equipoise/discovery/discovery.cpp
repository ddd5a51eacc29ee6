// Pilot, refinement, traps, audit.
#include "equipoise/discovery/discovery.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/base/parallel.hpp"
#include "equipoise/base/stage_progress.hpp"
#include "equipoise/deciding/pilot.hpp"
#include "equipoise/deciding/window_features.hpp"
#include "equipoise/discovery/balance_box.hpp"
#include "equipoise/discovery/balanced_levels.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/discovery/machine_ends.hpp"
#include "equipoise/discovery/own_windows.hpp"
#include "equipoise/discovery/pilot_run.hpp"
#include "equipoise/model/capability.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/motions/motion_bytes.hpp"
#include "equipoise/motions/motion_description.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/traps/continuum_trap.hpp"
#include "equipoise/traps/cycle_forms.hpp"
#include "equipoise/traps/motion_trap.hpp"
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
// In a part of a family, beside what the whole had: its halves look again, and what is rare is followed start by start.
constexpr std::size_t most_groups_beside = 8;
// By so much longer, windows of chaos and of tori show what they are.
constexpr double later_windows = 4.0;

// Of rotors that differ it takes a hundred times as long to ask about all places of a motion as to follow a start for a
// unit of time.
constexpr double rest_of_drawn = 0.25;

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
  const double pace = system.coasts() ? study.stall_speed() : std::fabs(system.pace());
  rule.window = std::max(16.0, 32.0 / std::max(pace, 0.1));
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

// Where weights or unequal supports make balls strike each other with every turn, chains of ever smaller impacts are
// followed one by one.
bool is_dear(const model::System& system) {
  return system.events().contact && system.balls() > 2 && !system.autonomous();
}

// A quarter is enough where a neighbour's motions are known. Where two balls touch a start costs thirty times what it
// does where they pass each other, where many do fifty times.
std::size_t pilot_part(const model::System& system, const DiscoverySettings& settings) {
  return is_dear(system) ? 16 : settings.informed || system.events().contact ? 4 : 1;
}

// What starts come to without a state of it being known.
Motion measured_motion() {
  Motion motion;
  motion.kind = MotionKind::measured;
  motion.stable = true;
  return motion;
}

struct Candidate {
  std::vector<std::size_t> members;  // records; none for seeds
  Features features{};
  FeatureBox range;
  Eigen::VectorXd state;
  const OwnRotor* own = nullptr;  // its rotor, if starts draw theirs
  std::optional<Motion> motion{};
  int attractor = 0;
  int trend = -1;             // of rotors that differ: the row of its motion's features (FeatureTrends)
  bool shows_motion = false;  // its members' windows are those of the motion that it was followed to
  bool stationary = false;
};

class Discoverer {
 public:
  // `drawn`: the source, if it draws rotors; `study` is then that of its middle.
  // `subject`: all that the search depends on.
  Discoverer(const Study& study, const SpinUp& source, const DiscoverySettings& settings, const std::string& subject,
             const DrawnSource* drawn = nullptr)
      : study_(study),
        system_(study.system()),
        settings_(settings),
        drawn_(drawn),
        notes_(settings.notes, subject),
        stages_("looking for attractors", settings.progress),
        trials_{.system = &system_,
                .tolerance = source.tolerance(),
                .threads = settings.threads,
                .stop = settings.stop,
                .progress = &stages_,
                .notes = &notes_},
        pilot_(system_, source, study.initial, pilot_part(system_, settings), drawn) {
    result_.catalogue = Catalogue(drawn != nullptr);
  }

  Discovery run() {
    if (system_.coasts()) return coasting();
    find_balanced();
    if (is_stopped() || (settings_.informed && !list_seeds())) return stopped();
    if (!pilot_.make()) return stopped();
    for (OwnRotor& rotor : pilot_.rotors()) result_.place(rotor);
    if (!follow_pilot(pilot_.scouts())) return stopped();
    if (!list_found(settings_.informed ? Seeds::listed : Seeds::new_ones)) return stopped();
    make_boxes();
    if (!scouts_suffice()) {
      if (!follow_pilot(pilot_.size())) return stopped();
      // Of rotors that differ few show what the first ones did, and what nobody has named bars every box.
      if (drawn_ && !list_found(Seeds::listed)) return stopped();
      audit_boxes();
    }
    level_balanced();
    if (!list_found(Seeds::listed)) return stopped();
    if (balance_box_) ask_for_balance();
    if (drawn_ && !follow_chaos()) return stopped();
    if (!is_stopped()) notes_.finish();
    result_.rule.blind = false;
    result_.rule.at_horizon = study_.numerics.decide == DecideMode::horizon;
    return std::move(result_);
  }

 private:
  bool is_stopped() const { return is_set(settings_.stop); }
  template <class Work>
  auto noted(const char* question, const Work& work) {
    return notes_.answer(question, settings_.stop, work);
  }
  std::optional<Motion> motion_of_middle(const Eigen::VectorXd& state) {
    return noted("middle's motion", [&] { return motion_from(system_, state, motion_patience, settings_.stop); });
  }
  Discovery stopped() {
    result_.stopped = true;
    return std::move(result_);
  }

  // Which speed is left, and with it what else there is to come to, every start finds for itself.
  Discovery coasting() {
    result_.balanced = analyse_balanced(system_, settings_.stop);
    std::string& note = result_.balanced.note;
    if (note.empty()) note = "no torque acts in the end, and which speed the rotor keeps is not known beforehand";
    DecisionRule& rule = result_.rule = first_rule(study_, result_.balanced, system_);
    const double horizon = *study_.numerics.horizon;
    // Slow losses of speed are to show.
    rule.first_long_window = std::max(rule.first_long_window, horizon / 16.0);
    rule.at_horizon = study_.numerics.decide == DecideMode::horizon;
    const auto trap = std::make_shared<const CoastingTrap>(system_, study_.stall_speed(), horizon);
    result_.coasting = trap;
    const int stalled = list_ends_of_coasting();
    const Traps ends = ends_of_coasting(trap, stalled, settings_.stop);
    if (rule.at_horizon) {
      rule.strobed = ends;
    } else {
      rule.windowed.traps = ends;
      rule.windowed.r2_low = -1.0;
    }
    return std::move(result_);
  }

  // Each start's motion is its own.
  int list_ends_of_coasting() {
    Motion balanced = measured_motion();
    balanced.set_valued = system_.events().stick;
    result_.catalogue.add({balanced_id, balanced.set_valued ? "balanced, stuck" : "balanced", "", balanced, {}});
    return result_.catalogue.add({"stalled", "", 0}, measured_motion());
  }

  void find_balanced() {
    stages_.begin("balanced states");
    BalancedAnalysis& balanced = result_.balanced;
    balanced = analyse_balanced(system_, settings_.stop, settings_.hints.weights);
    if (drawn_) draw_rotors(balanced);
    result_.hints.weights = balanced.weights;
    const auto part = balanced.continuum ? std::optional<ContinuumPart>(balanced.survey) : std::nullopt;
    for (const Motion& motion : balanced.motions) result_.catalogue.add(study_.parameters, motion, part);
    if (is_stopped()) return;
    result_.rule = first_rule(study_, balanced, system_);
    result_.rule.blind = true;
    if (drawn_) result_.rule.chaos_lasts = std::min(lasting_chaos, 0.25 * *study_.numerics.horizon);
    balance_box_ = balance_box(system_, balanced, result_.rule.window, *study_.numerics.horizon);
    // Where balls touch, a continuum's level sets catch late what lies side by side in it, and each state that they are
    // asked about costs as much as to follow it for a hundred turns.
    if (!balance_box_ || !system_.events().contact)
      continuum_ = continuum_trap(balanced.continuum, balanced.survey, trials_);
    if (!system_.autonomous() && balanced.motions.empty() && (continuum_ || balance_box_)) list_member(part);
    for (const Motion& motion : balanced.motions) add_traps(motion, balanced_id);
    if (drawn_ && balanced.traps.empty()) balance_of_some();
    find_stalled();
    set_rule_traps();
  }

  // Rotors for tries, and balanced traps that hold for all of them.
  void draw_rotors(BalancedAnalysis& balanced) {
    constexpr std::size_t draws = 256, looked_at = 64;
    rotors_ = drawn_->ends();
    for (std::size_t k = 0; k < draws; ++k) rotors_.push_back(drawn_->rotor(k));
    const std::span<const OwnRotor> all(rotors_);
    result_.family = BalancedFamily(balanced.traps, all, all.first(std::min(all.size(), looked_at)), balanced.weights);
    for (OwnRotor& rotor : rotors_) result_.family.place(balanced.traps, rotor);
    trials_.rotors = rotors_;
  }

  // Where a part holds rotors that do not balance, no trap holds for all: one around the balanced state of a rotor at
  // the part's ends that does, for those that do too.
  void balance_of_some() {
    if (!system_.autonomous() || result_.balanced.continuum) return;
    const std::vector<OwnRotor> ends = drawn_->ends();
    for (const OwnRotor& own : ends) {
      const bool middle = &own == &ends.front();  // which has been analysed
      const BalancedAnalysis there = middle ? result_.balanced : analyse_balanced(own.system, settings_.stop);
      if (is_stopped()) return;
      if (!there.stable || there.motions.empty() || there.continuum) continue;
      if (!result_.catalogue.find(balanced_id)) result_.catalogue.add(own.system.parameters(), there.motions.front());
      if (add_motion_trap(own.system, there.motions.front(), balanced_id, &own)) return;
    }
  }

  // Of the motions that a continuum leaves where nothing of it rests one stands for all: of the typical member where
  // that is known.
  void list_member(const std::optional<ContinuumPart>& part) {
    const BalancedAnalysis& balanced = result_.balanced;
    const auto m =
        balanced.survey.attracts() ? balanced.continuum->member(balanced.survey.typical.data()) : std::nullopt;
    if (m) {
      result_.catalogue.add(study_.parameters, describe_creep(system_, m->centre, m->rate), part);
    } else if (balanced.stable) {
      result_.catalogue.add({balanced_id, "balanced", "", measured_motion(), {}});
    }
  }

  // Where gravity holds the rotor against its motor it can rest.
  void find_stalled() {
    const auto well = model::GravityWell::of(system_);
    if (!well) return;
    stalled_ = StalledTrap{*well};
    for (const Eigen::VectorXd& place : places_to_hang(system_, *well)) {
      const auto motion = motion_of_middle(place);
      if (!motion || !motion->stable) continue;
      const int id = result_.catalogue.add(study_.parameters, *motion);
      stalled_->rests.push_back({order_of(system_, motion->state.data()), id});
    }
  }

  void set_rule_traps() {
    set_window_traps(result_.rule, windowed_);
    if (drawn_) result_.rule.windowed.rest = rest_of_drawn;
    if (!system_.events().stick) {
      set_traps(result_.rule, system_, cycles_, continuum_, stalled_);
      return;
    }
    result_.rule.strobed = stuck_balls(system_, result_.catalogue);
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
    return pilot_.follow(count, result_.rule, horizon, settings_.threads, settings_.stop, stages_, notes_);
  }

  enum class Seeds { listed, new_ones };

  // Lists what the pilot came to that the rule cannot name. Stationary motions come first: most of what wanders looks
  // like one of them, a torus that had not repeated itself yet, and need not be followed.
  bool list_found(Seeds seeds) {
    find_candidates();
    const auto wandering =
        std::stable_partition(candidates_.begin(), candidates_.end(), [](const Candidate& c) { return c.stationary; });
    std::vector<Candidate> later(wandering, candidates_.end());
    candidates_.erase(wandering, candidates_.end());
    if (seeds == Seeds::new_ones) add_seeds();
    if (!refine_and_list()) return false;
    found_ = std::move(candidates_);
    candidates_.clear();
    for (Candidate& c : later) (name_by_looks(c) ? found_ : candidates_).push_back(c);
    if (!refine_and_list()) return false;
    found_.insert(found_.end(), candidates_.begin(), candidates_.end());
    return true;
  }

  // As what is listed and looks the same; boxes are made around what it did all the same.
  bool name_by_looks(Candidate& c) {
    const KnownFeatures* known =
        nearest_known(c.features, result_.rule.known, study_.parameters.balls, shifts_of(c.own));
    if (!known) return false;
    c.attractor = known->attractor;
    c.trend = known->trend;
    c.shows_motion = true;
    // One entry tells the motion of all rotors; chaos looks different in every window.
    if (!drawn_ || known->chaotic) add_known(c, known->chaotic);
    return true;
  }

  // Features of a candidate, or of one of its members, as the middle's motion shows them.
  Features brought_back(const Candidate& c, const Features& f, const OwnRotor* own) const {
    return equipoise::brought_back(f, c.trend, shifts_of(own), study_.parameters.balls);
  }
  void add_known(const Candidate& c, bool chaotic) {
    // Until it is known for which rotors it lasts, chaos may end for all.
    result_.rule.known.push_back(
        {brought_back(c, c.features, c.own), c.attractor, chaotic, chaotic && drawn_ ? 0 : -1, c.trend});
  }

  // Groups of trajectories that the rule cannot name yet: stationary ones, and ones that neither settled nor came to
  // balance.
  void find_candidates() {
    const int balls = study_.parameters.balls;
    const std::vector<KnownFeatures>& known = result_.rule.known;
    std::vector<std::size_t> stationary, wandering;
    for (std::size_t i = 0; i < pilot_.followed(); ++i) {
      const Fate& fate = pilot_.fates()[i];
      if (fate.attractor == 0 && shows_balance(i)) continue;
      if (fate.outcome == Outcome::attracted && fate.attractor == 0) stationary.push_back(i);
      if (fate.outcome == Outcome::undecided && pilot_.records()[i].finished_window &&
          !nearest_known(pilot_.records()[i].features, known, balls, shifts_of(pilot_.rotor(i))))
        wandering.push_back(i);
    }
    candidates_.clear();
    for (const auto& [which, tolerance] : {std::pair{&stationary, grouping}, std::pair{&wandering, loose_grouping}}) {
      auto groups = group_records(pilot_.records(), *which, balls, tolerance);
      std::stable_sort(groups.begin(), groups.end(),
                       [](const MotionGroup& a, const MotionGroup& b) { return a.members.size() > b.members.size(); });
      groups.resize(std::min(groups.size(), drawn_ && settings_.informed ? most_groups_beside : most_groups));
      for (const MotionGroup& group : groups) {
        candidates_.push_back({group.members, group.features, group.range,
                               pilot_.state_at_strobe(group.members.front()), pilot_.rotor(group.members.front())});
        candidates_.back().stationary = which == &stationary;
      }
    }
    if (balance_box_) drop_balanced_candidates();
    if (settings_.informed) recognise_candidates();
  }

  // What is on its slow way to balance is followed on lanes before it is followed to a motion, which it may never be
  // on.
  void drop_balanced_candidates() {
    std::vector<double> states;
    for (const Candidate& c : candidates_) states.insert(states.end(), c.state.begin(), c.state.end());
    DecisionRule only_balance = result_.rule;
    only_balance.boxes = {*balance_box_};
    only_balance.first_long_window = *study_.numerics.horizon;
    const double time = 2.0 * balance_box_->hits_needed * 0.5 * result_.rule.window;
    const std::vector<Fate> fates =
        fates_by_windows(states, rotors_of(candidates_), only_balance, time / only_balance.first_long_window);
    std::vector<Candidate> others;
    for (std::size_t k = 0; k < candidates_.size(); ++k)
      if (fates[k].attractor != balanced_id) others.push_back(std::move(candidates_[k]));
    candidates_ = std::move(others);
  }

  // Long windows, three of which tell what is stationary, leave it time: what creeps near balance looks the same in all
  // of them, and would be followed to a motion that never comes back.
  void ask_for_balance() {
    DecisionRule& rule = result_.rule;
    rule.boxes.push_back(*balance_box_);
    rule.first_long_window = std::max(rule.first_long_window, balance_box_->hits_needed * 0.5 * rule.window / 3.0);
  }

  bool shows_balance(std::size_t i) const {
    const PilotRecord& record = pilot_.records()[i];
    return balance_box_ && record.finished_window && inside(*balance_box_, record.features, study_.parameters.balls);
  }

  // Where all random scouts came to what is listed and no box is to be audited, the rest of the pilot would only look
  // for what is rarer than one in a thousand, which is listed as well once a start comes to it. Of a smooth rotor at a
  // prescribed speed that feels no gravity this costs less than to follow a few such starts, of all others most of the
  // search.
  bool scouts_suffice() const {
    const std::vector<Fate>& fates = pilot_.fates();
    return !(system_.simple() && system_.autonomous()) && result_.rule.boxes.empty() &&
           std::all_of(fates.begin(), fates.begin() + static_cast<std::ptrdiff_t>(pilot_.random_ones()),
                       [](const Fate& fate) { return fate.outcome == Outcome::attracted && fate.attractor != 0; });
  }

  // Whose later windows, which are longer, show a neighbour's motion, or that its traps catch, need not be followed.
  void recognise_candidates() {
    std::vector<double> states;
    for (const Candidate& c : candidates_) states.insert(states.end(), c.state.begin(), c.state.end());
    DecisionRule later = result_.rule;
    later.first_long_window *= later_windows;
    later.boxes.clear();
    const std::vector<Fate> fates = fates_by_windows(states, rotors_of(candidates_), later, pilot_windows);
    std::vector<Candidate> unknown;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (fates[k].attractor == 0)
        unknown.push_back(std::move(candidates_[k]));
      else if (const KnownFeatures* known = looks_of(fates[k].attractor, candidates_[k])) {
        candidates_[k].attractor = known->attractor;
        candidates_[k].trend = known->trend;
        add_known(candidates_[k], known->chaotic);
      }
    }
    candidates_ = std::move(unknown);
  }

  static std::vector<const OwnRotor*> rotors_of(const std::vector<Candidate>& candidates) {
    std::vector<const OwnRotor*> rotors;
    for (const Candidate& c : candidates)
      if (c.own) rotors.push_back(c.own);
    return rotors;
  }
  const model::System& system_of(const Candidate& c) const { return c.own ? c.own->system : system_; }

  // The attractor's, if they agree as well as two windows of it do.
  const KnownFeatures* looks_of(int attractor, const Candidate& c) const {
    const Attractor* a = result_.catalogue.find(attractor);
    for (const KnownFeatures& k : result_.rule.known)
      if (a && k.attractor == attractor &&
          same_motion(k.features, equipoise::brought_back(c.features, k.trend, shifts_of(c.own), result_.rule.balls),
                      result_.rule.balls, agreement(a->motion.kind)))
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

  // Of rotors that differ a few at a time: most others are what these come to, as another rotor has it.
  bool refine_and_list() {
    if (!drawn_) return refine_candidates();
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

  // Chaos that goes on for so long counts as lasting for rotors that differ.
  double patience() const { return drawn_ ? std::min(followed_for(system_), lasting_chaos) : followed_for(system_); }

  // The same state of the pilot is a candidate again if it came to no motion, or to one that looks different each time.
  const Candidate* followed_before(const Candidate& c) const {
    const auto at = std::find_if(followed_.begin(), followed_.end(),
                                 [&](const Candidate& f) { return f.own == c.own && f.state == c.state; });
    return at == followed_.end() ? nullptr : &*at;
  }

  // Follows the candidates until they are steady; lists those that become so, with what recognises them.
  bool refine_candidates() {
    stages_.begin("motions followed until they are steady", candidates_.size());
    const std::uint64_t first = notes_.reserve(candidates_.size());
    in_parallel(settings_.threads, candidates_.size(), [&](std::size_t k) {
      if (is_stopped()) return;
      Candidate& c = candidates_[k];
      const Candidate* before = followed_before(c);
      c.motion = before ? before->motion : notes_.answer_at(first + k, "motion", settings_.stop, [&] {
        return motion_from(system_of(c), c.state, patience(), settings_.stop);
      });
      stages_.add(1);
    });
    if (is_stopped()) return false;
    for (const Candidate& c : candidates_)
      if (!followed_before(c)) followed_.push_back(c);
    compare_with_motions();
    const Catalogue before = result_.catalogue;
    for (Candidate& c : candidates_)
      if (c.motion && c.motion->stable) c.attractor = result_.catalogue.add(system_of(c).parameters(), *c.motion);
    for (Candidate& c : candidates_) {
      // Balance is never told by what it looks like: traps know it, or the way to it is followed.
      if (!c.motion || !c.motion->stable || !c.shows_motion || c.attractor == balanced_id) continue;
      if (drawn_ ? looks_known(c) : is_known(c.attractor)) {
        if (c.members.empty()) c.shows_motion = false;  // another seed came to the same
        if (!c.shows_motion) continue;
      } else {
        if (!add_trend(c)) return false;
        add_trap_of_candidate(c);
        result_.seeds.emplace_back(c.motion->state.begin(), c.motion->state.end());
      }
      add_known(c, c.motion->kind == MotionKind::chaotic);
      if (c.motion->kind == MotionKind::chaotic) chaos_.try_emplace(c.attractor, c.motion->state);
    }
    for (const Attractor& a : result_.catalogue.listed_since(before)) add_traps_of_middle(a);
    set_rule_traps();
    return !is_stopped();
  }

  std::vector<PilotRecord> own_windows(const std::vector<const Motion*>& motions,
                                       const std::vector<const OwnRotor*>& own) {
    return noted("windows of motions", [&] {
      return equipoise::own_windows(system_, motions, own, result_.rule, pilot_windows, trials_.tolerance,
                                    settings_.stop);
    });
  }
  std::vector<Fate> fates_by_windows(const std::vector<double>& states, const std::vector<const OwnRotor*>& own,
                                     const DecisionRule& rule, double longest) {
    return noted("fates by windows", [&] {
      return equipoise::fates_by_windows(system_, states, own, rule, longest, trials_.tolerance, settings_.stop);
    });
  }

  // Rotors that set off from one's motion: the more, the more values differ.
  std::size_t tried() const {
    constexpr std::size_t most = 128;
    const std::size_t wanted = std::size_t{24} << std::min<std::size_t>(rotors_.front().coordinates.size(), 3);
    return std::min({most, wanted, rotors_.size()});
  }

  // Of rotors that differ several motions may have one name. Sees to it that a candidate that looks like what is known
  // under its own has that one's trend.
  bool looks_known(Candidate& c) const {
    const DecisionRule& rule = result_.rule;
    const KnownFeatures* known = nearest_known(c.features, rule.known, rule.balls, shifts_of(c.own));
    if (!known || known->attractor != c.attractor) return false;
    c.trend = known->trend;
    return true;
  }

  // How a candidate's motion looks for others of the family: rotors all over the part set off from it.
  bool add_trend(Candidate& c) {
    if (!drawn_ || is_dear(system_)) return !is_stopped();
    std::vector<const Motion*> motions;
    std::vector<const OwnRotor*> own;
    for (std::size_t k = 0; k < tried(); ++k) {
      motions.push_back(&*c.motion);
      own.push_back(&rotors_[k]);
    }
    const std::vector<PilotRecord> windows = own_windows(motions, own);
    if (is_stopped()) return false;
    std::vector<ShownFeatures> others;
    for (std::size_t k = 0; k < windows.size(); ++k)
      if (windows[k].finished_window) others.push_back({own[k]->coordinates, windows[k].features});
    const OwnRotor& first = c.own ? *c.own : rotors_.front();
    c.trend = result_.trends.add(c.attractor, study_.parameters.balls, agreement(c.motion->kind),
                                 {first.coordinates, c.features}, std::move(others));
    if (c.trend < 0) return true;
    for (OwnRotor& rotor : rotors_) result_.trends.place(rotor);
    for (OwnRotor& rotor : pilot_.rotors()) result_.trends.place(rotor);
    return true;
  }

  // For which rotors chaos lasts: all over the part they set off from one's.
  bool follow_chaos() {
    std::map<int, int> numbers;
    for (const auto& [attractor, state] : chaos_) {
      if (is_dear(system_)) continue;
      numbers[attractor] = result_.trends.add_chaos(lasting(attractor, state));
      if (is_stopped()) return false;
    }
    const int unknown = static_cast<int>(numbers.size());
    for (KnownFeatures& known : result_.rule.known)
      if (known.chaos >= 0) known.chaos = numbers.contains(known.attractor) ? numbers[known.attractor] : unknown;
    for (FeatureBox& box : result_.rule.boxes)
      if (numbers.contains(box.attractor)) box.chaos = numbers[box.attractor];
    return true;
  }

  // What comes to another motion has ended; what becomes regular has kept its name.
  std::vector<FeatureTrends::Lasting> lasting(int attractor, const Eigen::VectorXd& state) {
    std::vector<double> states;
    std::vector<const OwnRotor*> own;
    for (std::size_t k = 0; k < tried(); ++k) {
      states.insert(states.end(), state.begin(), state.end());
      own.push_back(&rotors_[k]);
    }
    const DecisionRule& rule = result_.rule;
    const std::vector<Fate> fates = fates_by_windows(states, own, rule, rule.chaos_lasts / rule.first_long_window);
    std::vector<FeatureTrends::Lasting> result;
    for (std::size_t k = 0; k < tried(); ++k)
      result.push_back({own[k]->coordinates, fates[k].attractor == attractor ||
                                                 fates[k].outcome == Outcome::undecided ||
                                                 fates[k].time >= 0.9 * rule.chaos_lasts});
    return result;
  }

  // Around a motion that every rotor has elsewhere, as one was found to have it.
  void add_trap_of_candidate(const Candidate& c) {
    constexpr int most_failures = 2;
    if (!drawn_ || !system_.autonomous() || c.motion->eventful || without_trap_[c.attractor] >= most_failures) return;
    const OwnRotor& own = c.own ? *c.own : rotors_.front();
    if (!add_motion_trap(own.system, *c.motion, c.attractor, &own)) ++without_trap_[c.attractor];
  }

  // Traps are made around the middle's motion, if it has that one.
  void add_traps_of_middle(const Attractor& a) {
    if (!drawn_) return add_traps(a.motion, a.id);
    if (system_.autonomous()) return;  // each of its motions has been looked at
    if (a.motion.eventful || a.motion.state.size() == 0) return;
    const auto motion = motion_of_middle(a.motion.state);
    if (motion && motion->stable && result_.catalogue.find(study_.parameters, *motion) == a.id)
      add_traps(*motion, a.id);
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
    std::vector<const OwnRotor*> own;
    for (Candidate& c : candidates_) {
      if (!c.motion || !c.motion->stable || (c.members.empty() && !settings_.informed)) continue;
      followed.push_back(&c);
      motions.push_back(&*c.motion);
      if (drawn_) own.push_back(c.own ? c.own : &rotors_.front());
    }
    const std::vector<PilotRecord> windows = own_windows(motions, own);
    for (std::size_t k = 0; k < followed.size(); ++k) {
      Candidate& c = *followed[k];
      // Of a continuum that dry friction leaves every member looks its own way.
      c.shows_motion = !c.motion->set_valued && windows[k].finished_window;
      if (c.members.empty()) {
        c.features = windows[k].features;
        c.range = windows[k].range;
        continue;
      }
      c.shows_motion = c.shows_motion &&
                       same_motion(c.features, windows[k].features, study_.parameters.balls, agreement(c.motion->kind));
    }
  }

  // How well two windows of one motion agree.
  static double agreement(MotionKind kind) {
    if (kind == MotionKind::chaotic) return loose_grouping;
    return kind == MotionKind::quasi_periodic ? torus_grouping : grouping;
  }

  void add_traps(const Motion& motion, int id) {
    if (motion.eventful) return;  // windows tell it
    // The torus of another rotor lies beside this one, by more than the cloud that stands for it tells.
    if (motion.kind == MotionKind::quasi_periodic && !drawn_ && !model::lacking(system_, model::Answer::torus_traps))
      add_torus(motion, id);
    std::vector<CycleTrap> traps = cycle_traps(system_, motion, id);
    if (traps.empty()) {
      if (id != balanced_id) add_motion_trap(system_, motion, id);
      return;
    }
    const auto is_it = [&](const model::Parameters& p, const Motion& m) { return result_.catalogue.find(p, m) == id; };
    const double floor = drawn_ ? own_floor(traps.front(), trials_, motion, is_it) : 0.0;
    if (!validate(traps, trials_, motion.orbit.slowest_rate(), settings_.hints.level(id, false), floor)) return;
    result_.hints.levels.push_back({id, false, traps.front().level});
    for (CycleTrap& trap : traps) cycles_.push_back(std::make_shared<CycleTrap>(std::move(trap)));
  }

  // `own`: the rotor whose motion it is, if tries have their own. False if there is none.
  bool add_motion_trap(const model::System& system, const Motion& motion, int id, const OwnRotor* own = nullptr) {
    if (motion.state.size() != system.dimension()) return false;
    for (const auto& trap : windowed_)
      if (trap->attractor() == id && trap->value(motion.state.data(), own) < trap->level()) return true;
    auto trap = motion_trap(system, motion, id, trials_, own, settings_.hints.level(id, false));
    if (!trap) return false;
    result_.hints.levels.push_back({id, false, trap->level()});
    windowed_.push_back(std::move(trap));
    return true;
  }

  // Where the neighbour's has none it is not looked for: that takes long, and windows tell the torus too.
  void add_torus(const Motion& motion, int id) {
    const LevelHint* hint = settings_.hints.find(id, true);
    auto torus =
        hint && hint->level == 0.0 ? nullptr : torus_trap(system_, motion, id, trials_, hint ? hint->level : 0.0);
    result_.hints.levels.push_back({id, true, torus ? torus->level() : 0.0});
    if (torus) windowed_.push_back(std::move(torus));
  }

  // Around what the scouts of each attractor did.
  void make_boxes() {
    constexpr std::size_t members_needed = 3;
    DecisionRule& rule = result_.rule;
    std::vector<Candidate> all = seeds_;
    all.insert(all.end(), found_.begin(), found_.end());
    for (const double widths : box_widths)
      for (const Candidate& c : all) {
        const Attractor* a = result_.catalogue.find(c.attractor);
        if (!a || !c.shows_motion || c.attractor == balanced_id) continue;
        // A refined orbit vouches for a lone member, and a motion for itself.
        if (!c.members.empty() && c.members.size() < (a->motion.kind == MotionKind::periodic ? 1 : members_needed))
          continue;
        FeatureBox box = box_around(range_of(c), rule.balls, c.attractor, widths);
        box.trend = c.trend;
        if (box.attractor && rule.boxes.size() + 1 < most_boxes) rule.boxes.push_back(box);
      }
  }

  // Of all its members, as the middle's motion would show it.
  FeatureBox range_of(const Candidate& c) const {
    if (c.members.empty() || c.trend < 0) return c.range;
    FeatureBox range;
    for (std::size_t m = 0; m < c.members.size(); ++m) {
      const FeatureBox& shown = pilot_.records()[c.members[m]].range;
      const OwnRotor* own = pilot_.rotor(c.members[m]);
      const Features low = brought_back(c, shown.low, own), high = brought_back(c, shown.high, own);
      for (int k = 0; k < feature_count(study_.parameters.balls); ++k) {
        range.low[k] = m ? std::min(range.low[k], low[k]) : low[k];
        range.high[k] = m ? std::max(range.high[k], high[k]) : high[k];
      }
    }
    return range;
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
    for (const Candidate& c : found_)
      for (const std::size_t i : c.members)
        if (drawn_ && pilot_.fates()[i].attractor == 0) pilot_.name(i, c.attractor);
    for (std::size_t i = 0; i < pilot_.followed(); ++i) {
      if (pilot_.fates()[i].outcome != Outcome::undecided || !pilot_.records()[i].finished_window) continue;
      const Features& features = pilot_.records()[i].features;
      if (shows_balance(i))
        pilot_.name(i, balanced_id);
      else if (const KnownFeatures* known = nearest_known(features, rule.known, rule.balls, shifts_of(pilot_.rotor(i))))
        pilot_.name(i, known->attractor);
      else if (!system_.autonomous())
        pilot_.name(i, loosely_known(features, shifts_of(pilot_.rotor(i))));
    }
  }

  // Modulated by the rotor, a torus has a frequency more.
  int loosely_known(const Features& features, const double* shifts) const {
    const int balls = result_.rule.balls;
    for (const KnownFeatures& known : result_.rule.known)
      if (same_motion(known.features, equipoise::brought_back(features, known.trend, shifts, balls), balls,
                      torus_grouping))
        return known.attractor;
    return 0;
  }

  const Study& study_;
  const model::System system_;
  const DiscoverySettings& settings_;
  const DrawnSource* const drawn_;
  NotePage notes_;
  StageProgress stages_;
  TrialSettings trials_;
  std::vector<OwnRotor> rotors_;  // for tries: the middle's first
  PilotRun pilot_;
  Discovery result_;
  CycleTraps cycles_;
  std::vector<std::shared_ptr<const WindowTrap>> windowed_;
  std::optional<ContinuumTrap> continuum_;
  std::optional<StalledTrap> stalled_;
  std::optional<FeatureBox> balance_box_;  // beside traps
  std::map<int, Eigen::VectorXd> chaos_;   // by attractor: a state on one rotor's
  std::map<int, int> without_trap_;        // by attractor: motions around which none was found
  // Being followed; all that were; what the pilot came to; a neighbour's.
  std::vector<Candidate> candidates_, followed_, found_, seeds_;
};

}  // namespace

Discovery discover(const StudyFamily& family, const FamilyBox& box, const DiscoverySettings& settings) {
  const DrawnSource source(family, box, settings.stop);
  return Discoverer(source.middle(), source, settings, search_key(box, settings), &source).run();
}

double followed_for(const model::System& system) { return is_dear(system) ? 0.25 * motion_patience : motion_patience; }

std::string discovery_subject(const Study& study) { return to_toml(at_final_speed(study)); }

std::string search_key(const std::string& subject, const DiscoverySettings& settings) {
  std::string key = fmt::format("{}\n{}\n{}", subject, settings.seeds, settings.informed);
  for (const LevelHint& h : settings.hints.levels) key += fmt::format("\n{} {} {}", h.attractor, h.torus, h.level);
  for (const ModeWeight& w : settings.hints.weights) key += fmt::format("\n{} {} {}", w.re, w.im, w.weight);
  return key;
}

std::string search_key(const FamilyBox& part, const DiscoverySettings& settings) {
  return search_key(fmt::format("{}\n{} to {}", settings.family, part.low, part.high), settings);
}

Discovery discover(const Study& study, const DiscoverySettings& settings) {
  const Study steady = at_final_speed(study);
  const std::string key = search_key(to_toml(steady), settings);
  const auto make = [&] {
    const std::unique_ptr<SpinUp> source = make_spin_up(steady, settings.stop);
    return Discoverer(steady, *source, settings, key).run();
  };
  if (!settings.cache) return make();
  if (const auto at = settings.cache->made.find(key); at != settings.cache->made.end()) return at->second;
  Discovery discovery = make();
  if (!discovery.stopped) settings.cache->made.emplace(key, discovery);
  return discovery;
}

}  // namespace equipoise
