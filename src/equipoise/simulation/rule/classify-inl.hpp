// The observer of a lane block that decides outcomes: by entry into a trapping region, or by windows of time that show
// a known or a stationary motion. Included once per CPU target.
#if defined(EQUIPOISE_CLASSIFICATION_CLASSIFY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_CLASSIFICATION_CLASSIFY_INL
#undef EQUIPOISE_CLASSIFICATION_CLASSIFY_INL
#else
#define EQUIPOISE_CLASSIFICATION_CLASSIFY_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/simulation/rule/region_values-inl.hpp"
#include "equipoise/simulation/rule/window_features.hpp"
#include "equipoise/simulation/rule/window_samples-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/results/types/outcome.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Hooks: see NoObserver in simulation/batch/batch_block-inl.hpp.
//
// Except for plain rotors the rotor's angle is known, r is measured from the sag, and ClassificationRule::section is
// tested if set. Plain rotors pay for none of this.
template <int room, int groups, BatchKind kind = BatchKind::plain>
class ClassifyOutcome {
 public:
  static constexpr bool angle_known = kind != BatchKind::plain, smooth = kind >= BatchKind::smooth,
                        tilts = kind == BatchKind::tilting;
  static constexpr int dimension = model::dimension(room) + (tilts ? 7 : smooth ? 3 : 0);  // the largest size
  static constexpr int lanes = static_cast<int>(pack_lanes);

  ClassifyOutcome(const BatchTask& task, const ClassificationRule& rule, std::vector<Outcome>& outcomes,
                  std::vector<PilotRecord>* pilot)
      : n(task.held ? 1 : task.parameters->balls),
        rule_(rule),
        task_(task),
        size_(task.dimension()),
        psi_place_(task.layout().psi),
        speed_place_(task.layout().speed),
        samples_(task, rule),
        outcomes_(outcomes),
        pilot_(pilot),
        trackers_(groups * lanes),
        continuum_reach_(groups * lanes),
        window_catch_(groups * lanes) {}

  void begin(int slot, std::size_t start, double t, const double* z) {
    start_[slot] = start;
    if (task_.own) take_rotor(slot, *task_.own[start]);
    samples_.open(slot / lanes, slot % lanes, t, z + 4);
    verdict_[slot] = {};
    trackers_[slot].begin(rule_, own(slot));
    continuum_reach_[slot] = rule_.continuum.reach;
    window_catch_[slot] = {WindowCatch{t}, WindowCatch{t}};
    element(least_value_[slot / lanes], slot % lanes) = 1e300;
  }

  HWY_INLINE void stage(int row, int g, const Pack* z) { samples_.stage(row, g, z); }

  HWY_INLINE unsigned step(int g, unsigned active, Mask accepted, Pack t, Pack h, const Pack* z) {
    samples_.gather(g, accepted, t, h, z);
    const unsigned accepted_bits = lane_bits(accepted) & active;
    unsigned done = caught_by_regions(g, accepted, accepted_bits, z);
    if (rule_.at_horizon)
      done = 0;
    else if (rule_.continuum.regions)
      done |= caught_by_continuum(g, accepted_bits & ~done, z);
    const unsigned full = accepted_bits & samples_.ended(g, t) & ~done;
    if (full) done |= close_windows(g, full, t, z);
    return done;
  }

  // For a lane that step() has just ended; 0: a stationary motion that the rule does not list.
  int attractor_of(int slot) const { return verdict_[slot].attractor; }

  void end(int slot, std::size_t start, BatchEnd how, double t, const double* z) {
    Outcome& outcome = outcomes_[start];
    outcome = {how == BatchEnd::decided    ? OutcomeKind::attracted
               : how == BatchEnd::diverged ? OutcomeKind::diverged
               : how == BatchEnd::failed   ? OutcomeKind::failed
                                           : OutcomeKind::undecided,
               DecidedBy::nothing, 0, t};
    Verdict verdict = verdict_[slot];
    if constexpr (smooth) {
      if (speed_place_ >= 0) outcome.mean_speed = static_cast<float>(trackers_[slot].mean_speed());
      if (verdict.runs_away) outcome.kind = OutcomeKind::undecided;
    }
    if (how == BatchEnd::reached_end && !rule_.at_horizon && !pilot_)
      if (const int attractor = trackers_[slot].settled_at_end()) {
        outcome.kind = OutcomeKind::attracted;
        verdict = {DecidedBy::windows, attractor};
      }
    if (how == BatchEnd::reached_end && rule_.at_horizon) {
      if (!verdict.attractor && rule_.continuum.regions && rule_.continuum.regions->ask(z, 0.0, own(slot)).attractor)
        verdict.attractor = balanced_id;
      if constexpr (angle_known)
        if (!verdict.attractor && rule_.section.regions)
          verdict.attractor = rule_.section.regions->ask(z, angle(slot, t, z), own(slot)).attractor;
      if (!verdict.attractor) verdict.attractor = trackers_[slot].attractor_at_end();
      if (verdict.attractor) {
        outcome.kind = OutcomeKind::attracted;
        verdict.by = DecidedBy::horizon;
      }
    }
    if (outcome.kind == OutcomeKind::attracted) {
      outcome.attractor = static_cast<short>(verdict.attractor);
      outcome.by = verdict.by;
    } else if (how == BatchEnd::reached_end && outcome.kind == OutcomeKind::undecided && !pilot_) {
      outcome.attractor = static_cast<short>(trackers_[slot].chaos_at_end());  // what it may be, if it is chaotic
    }
    if (pilot_) {
      (*pilot_)[start] = trackers_[slot].record();
      if (rule_.blind) (*pilot_)[start].least_value = element(least_value_[slot / lanes], slot % lanes);
    }
  }

 private:
  // A constant if the state contains only the rotor's centre and the balls.
  HWY_INLINE auto size() const {
    if constexpr (smooth)
      return size_;
    else
      return n.size();
  }

  // The lane's own rotor; null: the task's.
  const OwnRotor* own(int slot) const { return task_.own ? task_.own[start_[slot]] : nullptr; }

  // psi in a state of a lane at time t.
  double angle(int slot, double t, const double* z) const {
    if constexpr (smooth)
      if (psi_place_ >= 0) return z[psi_place_];
    const OwnRotor* rotor = own(slot);
    return (rotor ? rotor->segment : task_.segment).psi_at(t);
  }

  void take_rotor(int slot, const OwnRotor& rotor) {
    const int g = slot / lanes, lane = slot % lanes;
    samples_.take_rotor(g, lane, rotor);
    const std::size_t row = static_cast<std::size_t>(size_), square = row * row;
    for (std::size_t k = 0; k < rule_.balanced.size(); ++k) {
      for (std::size_t i = 0; i < row; ++i) element(places_[g][k][i], lane) = rotor.places[k * row + i];
      for (std::size_t i = 0; i < square; ++i) element(factors_[g][k][i], lane) = rotor.factors[k * square + i];
    }
  }

  struct Verdict {
    DecidedBy by = DecidedBy::nothing;
    int attractor = 0;
    bool runs_away = false;  // a driven rotor that is given up
  };

  struct WindowCatch {
    double asked_from = 0.0;      // not before
    int attractor = 0, left = 0;  // half windows that are still watched
  };

  // Lanes inside a trapping region. Cheap tests of bounds spare most of them the quadratic forms.
  HWY_INLINE unsigned caught_by_regions(int g, Mask accepted, unsigned accepted_bits, const Pack* z) {
    unsigned caught = 0;
    for (std::size_t k = 0; k < rule_.balanced.size(); ++k) {
      const BalancedRegion& region = rule_.balanced[k];
      Mask near = accepted;
      for (int i = 0; i < 4; ++i) near = near & (away(g, k, i, z) < Pack(region.reach[i]));
      for (int i = 4 + n; i < size(); ++i) near = near & (away(g, k, i, z) < Pack(region.reach[i]));
      if (!any(near)) continue;
      const unsigned inside =
          lane_bits(near & (balanced_value(g, k, z) < Pack(region.level))) & accepted_bits & ~caught;
      if (inside) caught |= mark(g, inside, {region.by, balanced_id});
    }
    if (rule_.blind) watch_values(g, accepted, z);
    const Pack r2 = z[0] * z[0] + z[1] * z[1];
    for (const OrbitRegionTable& region : rule_.cycles) {
      Mask near = accepted & (Pack(region.r2_low) < r2) & (r2 < Pack(region.r2_high));
      for (int i = 0; i < n; ++i)
        near = near & (Pack(region.q_low[i]) < z[4 + n + i]) & (z[4 + n + i] < Pack(region.q_high[i]));
      if (!any(near)) continue;
      const unsigned inside = lane_bits(near & inside_cycle(region, z)) & accepted_bits & ~caught;
      if (inside) caught |= mark(g, inside, {DecidedBy::validated, region.attractor});
    }
    if (rule_.at_horizon) mark(g, accepted_bits & ~caught, {});
    return caught;
  }

  // All plain balanced states have the same centre.
  HWY_INLINE Pack away(int g, std::size_t k, int i, const Pack* z) {
    if constexpr (smooth) return absolute(z[i] - (task_.own ? places_[g][k][i] : Pack(rule_.balanced[k].place[i])));
    return absolute(z[i]);
  }

  HWY_NOINLINE Pack balanced_value(int g, std::size_t k, const Pack* z) {
    if (task_.own) return balanced_region_value(places_[g][k], factors_[g][k], n, size(), z);
    return balanced_region_value(rule_.balanced[k].place.data(), rule_.balanced[k].factor.data(), n, size(), z);
  }

  // How near to balance each lane has come.
  HWY_NOINLINE void watch_values(int g, Mask accepted, const Pack* z) {
    for (std::size_t k = 0; k < rule_.balanced.size(); ++k) {
      const Pack least = minimum(least_value_[g], balanced_value(g, k, z));
      least_value_[g] = select(accepted, least, least_value_[g]);
    }
  }

  HWY_NOINLINE Mask inside_cycle(const OrbitRegionTable& region, const Pack* z) {
    return orbit_region_value(region, n, size(), z) < Pack(region.level);
  }

  // Lanes caught by a continuum of balanced states. They are tested one by one. After a refusal a lane is tested again
  // only at half the distance, or when it comes back from far away.
  HWY_NOINLINE unsigned caught_by_continuum(int g, unsigned accepted, const Pack* z) {
    unsigned caught = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(accepted & (1u << lane))) continue;
      double state[dimension];
      double& reach = continuum_reach_[g * lanes + lane];
      double away = 0.0;
      for (int i = 0; i < size(); ++i) {
        state[i] = element(z[i], lane);
        if (i < 4 || (i >= 4 + n && i < 4 + 2 * n)) away = std::fmax(away, std::fabs(state[i]));
      }
      if (away >= rule_.continuum.reach) reach = rule_.continuum.reach;
      if (!(away < reach)) continue;
      const OwnRotor* rotor = own(g * lanes + lane);
      const model::Parameters& p = rotor ? rotor->system.parameters() : *task_.parameters;
      if (std::abs(model::unbalance(p, state + 4)) >= reach) continue;
      if (rule_.continuum.regions->ask(state, 0.0, rotor).attractor)
        caught |= mark(g, 1u << lane, {DecidedBy::validated, balanced_id});
      else
        reach *= 0.5;
    }
    return caught;
  }

  HWY_NOINLINE unsigned mark(int g, unsigned bits, Verdict verdict) {
    for (int lane = 0; lane < lanes; ++lane)
      if (bits & (1u << lane)) verdict_[g * lanes + lane] = verdict;
    return bits;
  }

  // Hands finished half windows of the `full` lanes to their trackers, and opens new ones.
  HWY_NOINLINE unsigned close_windows(int g, unsigned full, Pack t, const Pack* z) {
    unsigned decided = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(full & (1u << lane))) continue;
      const double now = element(t, lane);
      double phi[room];
      for (int i = 0; i < n; ++i) phi[i] = element(z[4 + i], lane);
      const WindowSums sums = samples_.sums(g, lane, now, phi);
      if constexpr (smooth)
        if (std::fabs(sums.rotor_turned) > rule_.fastest * sums.duration) {
          verdict_[g * lanes + lane].runs_away = true;
          decided |= 1u << lane;
        }
      WindowConclusion verdict = trackers_[g * lanes + lane].add(sums);
      DecidedBy by = DecidedBy::windows;
      for (int which = angle_known ? 0 : 1; which < 2 && !rule_.at_horizon; ++which)
        if (const int attractor = kept_by_regions(which, g * lanes + lane, sums, now, z, verdict.decided)) {
          verdict = {true, attractor};
          by = DecidedBy::validated;
        }
      if (verdict.decided && !rule_.at_horizon) {
        verdict_[g * lanes + lane] = {by, verdict.attractor};
        decided |= 1u << lane;
      }
      samples_.open(g, lane, now, phi);
    }
    return decided;
  }

  bool within_bounds(const WindowRegions& regions, const WindowSums& sums) const {
    bool like = sums.r2_min > regions.r2_low && sums.r2_max < regions.r2_high;
    for (int i = 0; i < n; ++i) like = like && sums.q_min[i] > regions.q_low && sums.q_max[i] < regions.q_high;
    return like;
  }

  // The trapping region that has caught a lane, once nothing more is to be learnt from the lane; `over`: its windows
  // decide now.
  int kept_by_regions(int which, int slot, const WindowSums& sums, double now, const Pack* z, bool over) {
    const WindowRegions& regions = which == 0 ? rule_.section : rule_.windowed;
    if (!regions.regions) return 0;
    WindowCatch& caught = window_catch_[slot][which];
    if (caught.attractor == 0 && within_bounds(regions, sums)) {
      if (now >= caught.asked_from) ask(regions, slot, now, z, caught);
      caught.left = rule_.blind ? regions.watched : 0;
    }
    return over || caught.left-- <= 0 ? caught.attractor : 0;
  }

  void ask(const WindowRegions& regions, int slot, double now, const Pack* z, WindowCatch& caught) const {
    double state[dimension];
    for (int i = 0; i < size(); ++i) state[i] = element(z[i], slot % lanes);
    const Caught answer = regions.regions->ask(state, angle(slot, now, state), own(slot));
    caught.attractor = answer.attractor;
    caught.asked_from = now + std::max(answer.wait, regions.rest * trackers_[slot].elapsed());
  }

  const model::BallCount<room> n;
  const ClassificationRule& rule_;
  const BatchTask& task_;
  const int size_, psi_place_, speed_place_;
  WindowSamples<room, groups, kind> samples_;
  std::vector<Outcome>& outcomes_;
  std::vector<PilotRecord>* pilot_;
  Pack least_value_[groups];
  // Of each lane's rotor.
  static constexpr std::size_t most_states = tilts ? most_balanced_of_tilt : most_balanced;
  Pack places_[groups][most_states][dimension], factors_[groups][most_states][dimension * dimension];
  std::size_t start_[groups * lanes] = {};
  Verdict verdict_[groups * lanes];
  std::vector<WindowTracker> trackers_;
  std::vector<double> continuum_reach_;
  std::vector<std::array<WindowCatch, 2>> window_catch_;  // by ClassificationRule::section, by windowed
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
