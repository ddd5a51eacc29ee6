// Makes trapping regions: around balance first, then around each listed motion, by the kind that suits it. One level
// serves balanced states that are images of each other.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/balanced_regions/family_regions.hpp"
#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"

namespace equipoise {

namespace {

// Calls level(region) for each trapping region, or only for the first if an exchange of the balls maps it to the other.
template <class Level>
void level_each(std::vector<BalancedRegion>& regions, const model::Parameters& p, Level&& level) {
  const bool images = p.balls == 2 && p.equal_balls();
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (!images || i == 0) {
      level(regions[i]);
      continue;
    }
    set_level(regions[i], regions[0].level);
    regions[i].by = regions[0].by;
  }
}

// The smallest V on pilot trajectories that ended elsewhere. Undecided ones may be on a slow way to balance. They are
// followed on, nearest first, until no other can be nearer than one that ended elsewhere.
double nearest_elsewhere(const Search& s) {
  const PilotRun& pilot = s.pilot;
  constexpr std::size_t together = 32;  // they fill the lanes
  const auto least = [&](std::size_t i) { return pilot.records()[i].least_value; };
  double nearest = 1e300;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < pilot.followed(); ++i) {
    const Outcome& outcome = pilot.outcomes()[i];
    if (outcome.attractor == balanced_id) continue;
    if (outcome.kind == OutcomeKind::undecided)
      open.push_back(i);
    else
      nearest = std::min(nearest, least(i));
  }
  std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) { return least(a) < least(b); });
  for (std::size_t first = 0; first < open.size() && least(open[first]) < nearest; first += together) {
    const std::size_t count = std::min(together, open.size() - first);
    std::vector<double> states;
    std::vector<OwnRotor> rotors;
    for (std::size_t k = 0; k < count; ++k) {
      const auto state = pilot.state(open[first + k]);
      states.insert(states.end(), state.begin(), state.end());
      if (const OwnRotor* own = pilot.rotor(open[first + k])) rotors.push_back(*own);
    }
    TrialSettings own = s.trials;
    own.rotors = rotors;
    const std::vector<char> came =
        come_to_balance(std::move(states), s.result.rule, own, s.result.balanced.slowest_rate);
    for (std::size_t k = 0; k < count; ++k)
      if (!came[k]) nearest = std::min(nearest, least(open[first + k]));
  }
  return nearest;
}

// Levels of balanced trapping regions beyond those in which samples of V decrease: proved.
void prove_levels(Search& s) {
  level_each(s.result.rule.balanced, s.system.parameters(), [&](BalancedRegion& region) {
    const Certificate certificate = largest_certificate(s.system, region.angles(), form_of(region),
                                                        region.level / level_margin, nullptr, s.settings.stop);
    // The kernels' V is off by rounding, a part in 10^13.
    set_level(region, certificate.level * (1.0 - 1e-9));
    region.by = DecidedBy::proof;
  });
}

// Or widened as far as trials and the pilot allow. Returns the factor of the first region.
double widen_levels(Search& s) {
  std::vector<BalancedRegion>& regions = s.result.rule.balanced;
  if (regions.empty()) return 0.0;
  const std::vector<BalancedRegion> narrow = regions;
  double nearest_foreign = nearest_elsewhere(s);
  // Twice the level is tried, and no balls may overlap there.
  for (const BalancedRegion& region : narrow)
    nearest_foreign = std::min(nearest_foreign, touching_level(s.system, region));
  const double near = s.settings.warm_start_levels.level(balanced_id);
  level_each(regions, s.system.parameters(), [&](BalancedRegion& region) {
    widen(region, narrow, s.trials, s.result.balanced.slowest_rate, nearest_foreign, near);
  });
  return regions.front().level / narrow.front().level;
}

// Where rotors differ, testing all places of a motion costs a hundred times as much as following a start for a unit of
// time.
constexpr double rest_of_drawn = 0.25;

// A weak motor brings a balanced rotor to its speed slowly, and trials of wider levels wait for that. They would take
// longer than starts take to reach the narrow level.
constexpr double slowest_worth_widening = 1e-3;

}  // namespace

void SearchRegions::find_balanced() {
  s_.stages.begin("balanced states");
  BalancedAnalysis& balanced = s_.result.balanced;
  balanced = analyse_balanced(s_.system, s_.settings.stop, s_.settings.warm_start_levels.weights);
  if (s_.drawn) draw_rotors(balanced);
  s_.result.warm_start_levels.weights = balanced.weights;
  const auto part = balanced.continuum ? std::optional<ContinuumPart>(balanced.sample) : std::nullopt;
  for (const Motion& motion : balanced.motions) s_.result.catalogue.add(s_.study.parameters, motion, part);
  if (s_.is_stopped()) return;
  s_.result.rule = first_rule(s_.study, balanced, s_.system);
  s_.result.rule.blind = true;
  if (s_.drawn) s_.result.rule.chaos_lasts = std::min(lasting_chaos, 0.25 * *s_.study.numerics.horizon);
  s_.balance_box = balance_box(s_.system, balanced, s_.result.rule.window, *s_.study.numerics.horizon);
  // Where balls touch, level sets of neighbouring members of a continuum catch late. Testing a state against them costs
  // as much as following it for a hundred turns.
  if (!s_.balance_box || !s_.system.events().contact)
    continuum_ = continuum_region(balanced.continuum, balanced.sample, s_.trials);
  if (!s_.system.autonomous() && balanced.motions.empty() && (continuum_ || s_.balance_box)) list_member(part);
  for (const Motion& motion : balanced.motions) add(motion, balanced_id);
  if (s_.drawn && balanced.regions.empty()) balance_of_some();
  find_stalled();
  set_rule();
}

// Draws rotors for trials, and makes balanced trapping regions that hold for all of them.
void SearchRegions::draw_rotors(BalancedAnalysis& balanced) {
  constexpr std::size_t draws = 256, looked_at = 64;
  s_.rotors = s_.drawn->ends();
  for (std::size_t k = 0; k < draws; ++k) s_.rotors.push_back(s_.drawn->rotor(k));
  const std::span<const OwnRotor> all(s_.rotors);
  s_.result.family = FamilyRegions(balanced.regions, all, all.first(std::min(all.size(), looked_at)), balanced.weights);
  for (OwnRotor& rotor : s_.rotors) s_.result.family.place(balanced.regions, rotor);
  s_.trials.rotors = s_.rotors;
}

// If some rotors of a part do not balance, no region holds for all. This makes one around the balanced state of a rotor
// at the part's ends, for the rotors that do balance.
void SearchRegions::balance_of_some() {
  if (!s_.system.autonomous() || s_.result.balanced.continuum) return;
  const std::vector<OwnRotor> ends = s_.drawn->ends();
  for (const OwnRotor& own : ends) {
    const bool middle = &own == &ends.front();  // it has been analysed
    const BalancedAnalysis there = middle ? s_.result.balanced : analyse_balanced(own.system, s_.settings.stop);
    if (s_.is_stopped()) return;
    if (!there.stable || there.motions.empty() || there.continuum) continue;
    if (!s_.result.catalogue.find(balanced_id)) s_.result.catalogue.add(own.system.parameters(), there.motions.front());
    if (add_path_region(own.system, there.motions.front(), balanced_id, &own)) return;
  }
}

// Where nothing of a continuum rests, one of the motions that it leaves is listed for all: the typical member's, if
// known.
void SearchRegions::list_member(const std::optional<ContinuumPart>& part) {
  const BalancedAnalysis& balanced = s_.result.balanced;
  const auto m = balanced.sample.attracts() ? balanced.continuum->member(balanced.sample.typical.data()) : std::nullopt;
  if (m) {
    s_.result.catalogue.add(s_.study.parameters, describe_creep(s_.system, m->centre, m->rate), part);
  } else if (balanced.stable) {
    s_.result.catalogue.add({balanced_id, "balanced", "", measured_motion(), {}});
  }
}

// Under gravity a rotor can rest against its motor.
void SearchRegions::find_stalled() {
  const auto well = model::GravityWell::of(s_.system);
  if (!well) return;
  stalled_ = StalledRegion{*well};
  for (const Eigen::VectorXd& place : places_to_hang(s_.system, *well)) {
    const auto motion = s_.motion_of_middle(place);
    if (!motion || !motion->stable) continue;
    const int id = s_.result.catalogue.add(s_.study.parameters, *motion);
    stalled_->rests.push_back({order_of(s_.system, motion->state.data()), id});
  }
}

void SearchRegions::set_rule() {
  set_window_regions(s_.result.rule, windowed_);
  if (s_.drawn) s_.result.rule.windowed.rest = rest_of_drawn;
  if (!s_.system.events().stick) {
    set_regions(s_.result.rule, s_.system, cycles_, continuum_, stalled_);
    return;
  }
  s_.result.rule.section.regions = stuck_balls(s_.system, s_.result.catalogue);
}

void SearchRegions::level_balanced() {
  if (s_.study.numerics.decide == ClassificationMode::proof)
    prove_levels(s_);
  else if (s_.system.plain() || (!s_.system.tilts() && s_.result.balanced.slowest_rate < -slowest_worth_widening))
    s_.result.warm_start_levels.levels.push_back({balanced_id, widen_levels(s_)});
}

// Around a motion that each rotor has in its own place, as one rotor was found to have it.
void SearchRegions::add_of_candidate(const Candidate& c) {
  constexpr int most_failures = 2;
  if (!s_.drawn || !s_.system.autonomous() || !worth_a_region(*c.motion, c.attractor) ||
      without_[c.attractor] >= most_failures)
    return;
  const OwnRotor& own = c.own ? *c.own : s_.rotors.front();
  if (!add_path_region(own.system, *c.motion, c.attractor, &own)) ++without_[c.attractor];
}

// Regions are made around the middle's motion, if it has that one.
void SearchRegions::add_listed(const Attractor& a) {
  if (!s_.drawn) return add(a.motion, a.id);
  if (s_.system.autonomous()) return;  // add_of_candidate() has tried each of its motions
  if (!worth_a_region(a.motion, a.id) || a.motion.state.size() == 0) return;
  const auto motion = s_.motion_of_middle(a.motion.state);
  if (motion && motion->stable && s_.result.catalogue.find(s_.study.parameters, *motion) == a.id) add(*motion, a.id);
}

// Windows recognise all others. States of a tilting rotor have too many directions: trials would cost more than they
// save, as do all trials for few starts.
bool SearchRegions::worth_a_region(const Motion& motion, int id) const {
  return !motion.eventful && (id == balanced_id || !(s_.system.tilts() || s_.settings.mode == SearchMode::few));
}

void SearchRegions::add(const Motion& motion, int id) {
  if (!worth_a_region(motion, id)) return;
  std::vector<OrbitRegion> regions = orbit_regions(s_.system, motion, id);
  if (regions.empty()) {
    if (id != balanced_id) add_path_region(s_.system, motion, id);
    return;
  }
  const auto is_it = [&](const model::Parameters& p, const Motion& m) { return s_.result.catalogue.find(p, m) == id; };
  TrialSettings trials = s_.trials;
  std::vector<OwnRotor> balancing;  // a region of balance holds for no other rotors
  if (s_.drawn && id == balanced_id) {
    std::copy_if(trials.rotors.begin(), trials.rotors.end(), std::back_inserter(balancing),
                 [&](const OwnRotor& rotor) { return !balanced_shifts(rotor.system, s_.system).empty(); });
    if (!balancing.empty()) trials.rotors = balancing;
  }
  const double floor = s_.drawn ? own_floor(regions.front(), trials, motion, is_it) : 0.0;
  if (!validate(regions, trials, motion.orbit.slowest_rate(), s_.settings.warm_start_levels.level(id), floor)) return;
  s_.result.warm_start_levels.levels.push_back({id, regions.front().level});
  for (OrbitRegion& region : regions) cycles_.push_back(std::make_shared<OrbitRegion>(std::move(region)));
}

// `own`: the rotor that has this motion, if trials have their own. False if no region is found.
bool SearchRegions::add_path_region(const model::System& system, const Motion& motion, int id, const OwnRotor* own) {
  if (motion.state.size() != system.dimension()) return false;
  for (const auto& region : windowed_)
    if (region->attractor() == id && region->value(motion.state.data(), own) < region->level()) return true;
  auto region = path_region(system, motion, id, s_.trials, own, s_.settings.warm_start_levels.level(id));
  if (!region) return false;
  s_.result.warm_start_levels.levels.push_back({id, region->level()});
  windowed_.push_back(std::move(region));
  return true;
}

}  // namespace equipoise
