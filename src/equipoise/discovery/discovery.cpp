// Pilot, refinement, traps, audit.
#include "equipoise/discovery/discovery.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/stage_progress.hpp"
#include "equipoise/deciding/pilot.hpp"
#include "equipoise/deciding/window_features.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/discovery/own_windows.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/motions/motion_description.hpp"
#include "equipoise/orbits/stroboscopic.hpp"
#include "equipoise/proof/certificate.hpp"
#include "equipoise/spin_up/start_source.hpp"
#include "equipoise/traps/orbit_trap.hpp"
#include "equipoise/traps/strobed_balance.hpp"
#include "equipoise/traps/strobed_trap.hpp"
#include "equipoise/traps/validated_level.hpp"

namespace equipoise {

namespace {

// Pilot starts are drawn from a seed of their own, so the decision rule depends on the study but not on its seed.
constexpr std::uint64_t pilot_seed = 0x9e3779b97f4a7c15;
// Scouts find motions; with their traps in place all of the pilot shows how far those and the boxes can be trusted.
constexpr std::size_t scouts = 1024, coincident_starts = 32, pilot_starts = 4096, chunk = 256;
// Long windows end at 1, 2, 4, 8 and 16 times the first: four comparisons, of which two in a row must agree.
constexpr double pilot_windows = 16.0;
// Windows of one motion agree this well; motions met so far differ by more.
constexpr double grouping = 0.05;
// Windows of one chaotic motion.
constexpr double loose_grouping = 0.3;
// Windows of one torus that did not repeat themselves: its extremes may take longer to show than any window lasts.
constexpr double torus_grouping = 0.15;
// Groups that are followed, the largest first: more are the debris of a motion that does not settle.
constexpr std::size_t most_groups = 24;

// Boxes around what a motion does, widened by so many times its range: a wide one is entered sooner, and the audit
// makes it ask for more hits. Whichever is satisfied first decides.
constexpr std::array box_widths{1.0, 2.0, 4.0};

// Half a window holds whole strobes, so that what repeats with the rotor looks the same in all of them.
double whole_strobes(double window, double strobe) { return 2.0 * strobe * std::ceil(0.5 * window / strobe - 1e-9); }

DecisionRule first_rule(const Study& study, const BalancedAnalysis& balanced, double final_speed) {
  DecisionRule rule;
  rule.balls = study.parameters.balls;
  rule.interchangeable = study.parameters.equal_balls();
  rule.traps = balanced.traps;
  // Slow rotors move slowly: a window holds several revolutions of every motion met between 1.4 and 6.5 critical
  // speeds.
  rule.window = std::max(16.0, 32.0 / std::max(std::fabs(final_speed), 0.1));
  if (model::is_strobed(study.parameters)) {
    rule.window = whole_strobes(rule.window, model::strobe_period(study.parameters, final_speed));
    rule.sag = model::static_sag(study.parameters);
  }
  rule.first_long_window = std::max(100.0, 6.0 * rule.window);
  if (balanced.slowest_rate < 0.0) {
    // Long enough that whatever is only on its slow way to balance shrinks visibly from one window to the next.
    rule.first_long_window = std::max(rule.first_long_window, 1.0 / -balanced.slowest_rate);
    rule.first_long_window = std::min(rule.first_long_window, *study.numerics.horizon / 8.0);
    rule.sameness = std::min(rule.sameness, 0.2 * -balanced.slowest_rate * rule.first_long_window);
  }
  return rule;
}

// The pilot's trajectories: states at the final speed once and for all, and what became of them under a rule.
struct Pilot {
  std::vector<double> begin, states;
  std::vector<Fate> fates;
  std::vector<PilotRecord> records;
  std::size_t followed = 0;  // so many of them so far
};

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
  Discoverer(const Study& study, const StartSource& source, const DiscoverySettings& settings)
      : study_(study),
        source_(source),
        settings_(settings),
        stages_("looking for attractors", settings.progress),
        speed_(source.last_segment().speed),
        strobed_(model::is_strobed(study.parameters)) {}

  Discovery run() {
    stages_.begin("balanced states");
    std::vector<Motion> balanced;
    if (strobed_) {
      StrobedBalance found = analyse_strobed_balance(study_.parameters, speed_, settings_.stop);
      result_.balanced = std::move(found.analysis);
      balanced = std::move(found.motions);
      for (const Motion& motion : balanced) result_.catalogue.add(study_.parameters, motion, continuum());
    } else {
      result_.balanced = analyse_balanced(study_.parameters, speed_);
      list_balanced();
    }
    if (is_stopped()) return stopped();
    result_.rule = first_rule(study_, result_.balanced, speed_);
    result_.rule.blind = true;
    if (const auto trap = continuum_trap(result_.balanced.continuum, result_.balanced.survey, trial_settings())) {
      if (strobed_) family_ = strobed_family_test(study_.parameters, speed_, *trap);
      if (strobed_ && !result_.catalogue.find(balanced_id)) list_creep(*trap);
      if (!strobed_) result_.rule.family = family_test(*trap, study_.parameters.balls);
    }
    if (strobed_) {
      for (const Motion& motion : balanced) make_strobed_trap(motion, balanced_id);
      result_.rule.strobed = traps_as_rule(study_.parameters, speed_, strobed_traps_, family_);
    }
    if (!make_pilot() || !follow_pilot(scouts + coincident_starts)) return stopped();
    find_candidates();
    add_seeds();
    if (!refine_and_list()) return stopped();
    make_boxes();
    if (!follow_pilot(pilot_.fates.size())) return stopped();
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

  std::optional<ContinuumPart> continuum() const {
    if (!result_.balanced.continuum) return std::nullopt;
    return result_.balanced.survey;
  }

  void list_balanced() {
    using Kind = model::BalancedStates::Kind;
    const model::Parameters& p = study_.parameters;
    const model::BalancedStates& states = result_.balanced.states;
    if (states.kind == Kind::none) return;
    Eigen::VectorXd centre = Eigen::VectorXd::Zero(model::dimension(p.balls));
    if (states.kind == Kind::isolated) {
      for (const auto& phi : states.angles) {  // unequal balls: each state is an attractor of its own
        centre = model::centred_state(p, phi.data());
        if (const auto refined = refine_equilibrium({p, speed_}, centre))
          result_.catalogue.add(p, describe_equilibrium({p, speed_}, *refined));
        if (p.balls == 2 && states.angles.size() == 2) break;  // mirror images are one motion
      }
      return;
    }
    // Of a continuum one state stands for all, an attracting one if there are any.
    centre = model::centred_state(p, result_.balanced.survey.typical.data());
    if (const auto refined = refine_equilibrium({p, speed_}, centre))
      result_.catalogue.add(p, describe_equilibrium({p, speed_}, *refined), continuum());
  }

  // Under gravity one of the motions that the continuum's trap leads to stands for all.
  void list_creep(const ContinuumTrap& trap) {
    const auto m = trap.continuum->member(result_.balanced.survey.typical.data());
    if (m)
      result_.catalogue.add(study_.parameters, describe_creep({study_.parameters, speed_}, m->centre, m->rate),
                            continuum());
  }

  // Proved or widened levels of the balanced traps.
  void level_balanced() {
    const model::Parameters& p = study_.parameters;
    std::vector<BalancedTrap>& traps = result_.rule.traps;
    const std::vector<BalancedTrap> narrow = traps;
    const bool mirror = p.balls == 2 && p.equal_balls();
    if (traps.empty()) return;
    const bool proving = study_.numerics.decide == DecideMode::proof;
    const double nearest_foreign = proving ? 0.0 : nearest_elsewhere();
    for (std::size_t i = 0; i < traps.size(); ++i) {
      if (mirror && i > 0) {
        set_level(traps[i], traps[0].level);
        traps[i].by = traps[0].by;
        continue;
      }
      if (proving)
        prove(traps[i]);
      else
        widen(traps[i], narrow, trial_settings(), result_.balanced.slowest_rate, nearest_foreign);
    }
  }

  // The smallest V on any of the pilot's trajectories that ended elsewhere. What is undecided is followed on: it may be
  // on its slow way to balance.
  double nearest_elsewhere() {
    const auto size = static_cast<std::ptrdiff_t>(model::dimension(study_.parameters.balls));
    double nearest = 1e300;
    std::vector<std::size_t> open;
    std::vector<double> states;
    for (std::size_t i = 0; i < pilot_.fates.size(); ++i) {
      if (pilot_.fates[i].attractor == balanced_id) continue;
      if (pilot_.fates[i].outcome != Outcome::undecided) {
        nearest = std::min(nearest, pilot_.records[i].least_value);
        continue;
      }
      open.push_back(i);
      const auto state = pilot_.states.begin() + static_cast<std::ptrdiff_t>(i) * size;
      states.insert(states.end(), state, state + size);
    }
    const std::vector<char> came =
        come_to_balance(std::move(states), result_.rule.traps, trial_settings(), result_.balanced.slowest_rate);
    for (std::size_t k = 0; k < open.size(); ++k)
      if (!came[k]) nearest = std::min(nearest, pilot_.records[open[k]].least_value);
    return nearest;
  }

  void prove(BalancedTrap& trap) {
    const Certificate certificate = largest_certificate(study_.parameters, speed_, trap.phi.data(), form_of(trap),
                                                        trap.level / level_margin, nullptr, settings_.stop);
    // What the kernels compute in place of V is off by rounding: a part in 10^13.
    set_level(trap, certificate.level * (1.0 - 1e-9));
    trap.by = DecidedBy::proof;
  }

  TrialSettings trial_settings() {
    return {&study_.parameters, speed_, source_.tolerance(), settings_.threads, settings_.stop, &stages_};
  }

  // Random starts, starts with all balls together, and more random ones.
  bool make_pilot() {
    const model::Parameters& p = study_.parameters;
    std::vector<double> phi, states;
    std::vector<Fate> fates;
    const auto append = [&] { pilot_.begin.insert(pilot_.begin.end(), states.begin(), states.end()); };
    if (!source_.make(pilot_seed, 0, scouts, phi, states, fates)) return false;
    append();
    phi.clear();
    for (std::size_t k = 0; k < coincident_starts; ++k)
      phi.insert(phi.end(), p.balls, two_pi * static_cast<double>(k) / coincident_starts);
    if (!source_.follow(phi, states, fates)) return false;
    append();
    if (!source_.make(pilot_seed, scouts, pilot_starts - scouts, phi, states, fates)) return false;
    append();
    const std::size_t count = pilot_.begin.size() / model::dimension(p.balls);
    pilot_.fates.resize(count);
    pilot_.records.resize(count);
    return true;
  }

  // Decides the first `count` of the pilot's starts by the rule as it stands.
  bool follow_pilot(std::size_t count) {
    const int size = model::dimension(study_.parameters.balls);
    pilot_.followed = count;
    pilot_.states = pilot_.begin;
    const double horizon = std::min(*study_.numerics.horizon, pilot_windows * result_.rule.first_long_window);
    std::atomic<bool> complete{true};
    stages_.begin("pilot trajectories", count);
    tbb::task_arena arena(settings_.threads);
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, (count + chunk - 1) / chunk, [&](std::size_t k) {
        const std::size_t first = k * chunk, length = std::min(chunk, count - first);
        LaneTask task;
        task.parameters = &study_.parameters;
        task.segment = source_.last_segment();
        task.end = task.segment.begin + horizon;
        task.tolerance = source_.tolerance();
        task.count = length;
        task.states = &pilot_.states[first * size];
        task.stop = settings_.stop;
        std::vector<Fate> fates(length);
        std::vector<PilotRecord> records(length);
        if (decide_lanes(task, result_.rule, fates, &records))
          stages_.add(length);
        else
          complete = false;
        std::copy(fates.begin(), fates.end(), pilot_.fates.begin() + static_cast<std::ptrdiff_t>(first));
        std::copy(records.begin(), records.end(), pilot_.records.begin() + static_cast<std::ptrdiff_t>(first));
      });
    });
    return complete;
  }

  Eigen::VectorXd pilot_state(std::size_t i) const {
    const int size = model::dimension(study_.parameters.balls);
    const Eigen::Map<const Eigen::VectorXd> state(&pilot_.states[i * size], size);
    if (!strobed_) return state;
    const auto strobed =
        at_next_strobe({study_.parameters, speed_}, state, source_.last_segment().psi_at(pilot_.fates[i].time));
    return strobed.value_or(state);
  }

  // Groups of trajectories that the rule cannot name yet: stationary ones, and ones that neither settled nor came to
  // balance.
  void find_candidates() {
    const int balls = study_.parameters.balls;
    const std::vector<KnownFeatures>& known = result_.rule.known;
    std::vector<std::size_t> stationary, wandering;
    for (std::size_t i = 0; i < pilot_.followed; ++i) {
      const Fate& fate = pilot_.fates[i];
      if (fate.outcome == Outcome::attracted && fate.attractor == 0) stationary.push_back(i);
      if (fate.outcome == Outcome::undecided && pilot_.records[i].finished_window &&
          !nearest_known(pilot_.records[i].features, known, balls))
        wandering.push_back(i);
    }
    candidates_.clear();
    for (const auto& [which, tolerance] : {std::pair{&stationary, grouping}, std::pair{&wandering, loose_grouping}}) {
      auto groups = group_records(pilot_.records, *which, balls, tolerance);
      std::stable_sort(groups.begin(), groups.end(),
                       [](const MotionGroup& a, const MotionGroup& b) { return a.members.size() > b.members.size(); });
      if (groups.size() > most_groups) groups.resize(most_groups);
      for (const MotionGroup& group : groups)
        candidates_.push_back({group.members, group.features, group.range, pilot_state(group.members.front())});
    }
  }

  void add_seeds() {
    for (const std::vector<double>& seed : settings_.seeds)
      candidates_.push_back(
          {{}, {}, {}, Eigen::Map<const Eigen::VectorXd>(seed.data(), static_cast<Eigen::Index>(seed.size()))});
  }

  // Follows the candidates until they are steady; lists those that become so, with what recognises them.
  bool refine_and_list() {
    stages_.begin("motions followed until they are steady", candidates_.size());
    tbb::task_arena arena(settings_.threads);
    arena.execute([&] {
      tbb::parallel_for(
          std::size_t{0}, candidates_.size(),
          [&](std::size_t k) {
            if (is_stopped()) return;
            candidates_[k].motion =
                motion_from({study_.parameters, speed_}, candidates_[k].state, motion_patience, settings_.stop);
            stages_.add(1);
          },
          tbb::simple_partitioner());
    });
    if (is_stopped()) return false;
    compare_with_motions();
    const Catalogue before = result_.catalogue;
    for (Candidate& c : candidates_) {
      if (!c.motion || !c.motion->stable) continue;
      c.attractor = result_.catalogue.add(study_.parameters, *c.motion);
      // Balance is never told by what it looks like: traps know it, or the way to it is followed.
      if (!c.shows_motion || c.attractor == balanced_id) continue;
      result_.rule.known.push_back({c.features, c.attractor, c.motion->kind == MotionKind::chaotic});
    }
    for (const Attractor& a : result_.catalogue.listed_since(before))
      if (strobed_)
        make_strobed_trap(a.motion, a.id);
      else
        make_orbit_traps(a);
    if (strobed_) result_.rule.strobed = traps_as_rule(study_.parameters, speed_, strobed_traps_, family_);
    return !is_stopped();
  }

  // A trajectory may seem stationary near an unstable motion, or on chaos that ends, and come to a stable one in the
  // end: what its windows showed is then not what recognises that one.
  void compare_with_motions() {
    std::vector<Candidate*> followed;
    std::vector<const Motion*> motions;
    for (Candidate& c : candidates_) {
      if (!c.motion || !c.motion->stable || c.members.empty()) continue;
      followed.push_back(&c);
      motions.push_back(&*c.motion);
    }
    const std::vector<PilotRecord> own = own_windows(study_.parameters, speed_, motions, result_.rule, pilot_windows,
                                                     source_.tolerance(), settings_.stop);
    for (std::size_t k = 0; k < followed.size(); ++k) {
      Candidate& c = *followed[k];
      c.shows_motion = own[k].finished_window &&
                       same_motion(c.features, own[k].features, study_.parameters.balls, agreement(c.motion->kind));
    }
  }

  // How well two windows of one motion agree.
  static double agreement(MotionKind kind) {
    if (kind == MotionKind::chaotic) return loose_grouping;
    return kind == MotionKind::quasi_periodic ? torus_grouping : grouping;
  }

  void make_strobed_trap(const Motion& motion, int id) {
    constexpr int most_strobes = 8;  // all of them are compared with every state
    const bool continuum = motion.kind == MotionKind::equilibrium && continuum_dimension(study_.parameters) > 0;
    if (!motion.stable || continuum || motion.strobes == 0 || motion.strobes > most_strobes) return;
    auto trap = strobed_trap(study_.parameters, speed_, motion, id);
    if (trap && validate(*trap, trial_settings(), slowest_strobed_rate(motion)))
      strobed_traps_.push_back(std::make_shared<StrobedTrap>(*std::move(trap)));
  }

  void make_orbit_traps(const Attractor& a) {
    if (a.motion.kind != MotionKind::periodic) return;
    std::vector<OrbitTrap> traps = orbit_traps(study_.parameters, speed_, a.motion, a.id);
    if (!validate(traps, trial_settings(), slowest_rate(a.motion))) return;
    result_.rule.orbits.insert(result_.rule.orbits.end(), traps.begin(), traps.end());
  }

  // Of approach to a periodic orbit; the exponent nearest zero belongs to the shift in time.
  static double slowest_rate(const Motion& motion) {
    double slowest = -1e300;
    for (Eigen::Index k = 1; k < motion.spectrum.size(); ++k)
      slowest = std::max(slowest, std::log(std::abs(motion.spectrum[k])) / motion.period);
    return slowest;
  }

  // Around what the scouts of each attractor did.
  void make_boxes() {
    constexpr std::size_t members_needed = 3;
    DecisionRule& rule = result_.rule;
    for (const double widths : box_widths)
      for (const Candidate& c : candidates_) {
        const Attractor* a = result_.catalogue.find(c.attractor);
        if (!a || !c.shows_motion || c.attractor == balanced_id) continue;
        // A refined orbit vouches for a lone member.
        if (c.members.size() < (a->motion.kind == MotionKind::periodic ? 1 : members_needed)) continue;
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
      box.hits_needed = hits_from_audit(pilot_.fates, pilot_.records, b, box.attractor, restless);
      if (box.hits_needed) kept.push_back(box);
    }
    result_.rule.boxes = kept;
  }

  // A torus or chaos may not repeat itself within the pilot's time; its last long window tells it all the same.
  void name_undecided() {
    const DecisionRule& rule = result_.rule;
    for (std::size_t i = 0; i < pilot_.followed; ++i) {
      if (pilot_.fates[i].outcome != Outcome::undecided || !pilot_.records[i].finished_window) continue;
      const Features& features = pilot_.records[i].features;
      if (const KnownFeatures* known = nearest_known(features, rule.known, rule.balls))
        pilot_.fates[i].attractor = static_cast<short>(known->attractor);
      else if (strobed_)
        pilot_.fates[i].attractor = static_cast<short>(loosely_known(features));
    }
  }

  // Modulated by the rotor, a torus has a frequency more.
  int loosely_known(const Features& features) const {
    for (const KnownFeatures& known : result_.rule.known)
      if (same_motion(known.features, features, result_.rule.balls, torus_grouping)) return known.attractor;
    return 0;
  }

  const Study& study_;
  const StartSource& source_;
  const DiscoverySettings& settings_;
  StageProgress stages_;
  double speed_;
  bool strobed_;
  Discovery result_;
  std::vector<std::shared_ptr<const StrobedTrap>> strobed_traps_;
  StrobedFamilyTest family_;
  Pilot pilot_;
  std::vector<Candidate> candidates_;
};

// What is discovered of a study depends on this much of it.
Study at_final_speed(const Study& study) {
  Study steady = study;
  steady.speed = {};
  steady.speed.speed = study.speed_profile().final_speed();
  steady.release = {};
  steady.initial = {};
  steady.sampling = {};
  return with_horizon(steady);
}

}  // namespace

Discovery discover(const Study& study, const DiscoverySettings& settings) {
  const Study steady = at_final_speed(study);
  const auto make = [&] { return Discoverer(steady, StartSource(steady, settings.stop), settings).run(); };
  if (!settings.cache) return make();
  const std::string key = fmt::format("{}\n{}", to_toml(steady), settings.seeds);
  if (const auto at = settings.cache->made.find(key); at != settings.cache->made.end()) return at->second;
  Discovery discovery = make();
  if (!discovery.stopped) settings.cache->made.emplace(key, discovery);
  return discovery;
}

}  // namespace equipoise
