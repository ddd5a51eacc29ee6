// The observer of a lane block that decides fates: entry into a Lyapunov level set of a balanced state, or a stationary
// motion away from it. Included once per CPU target.
#if defined(EQUIPOISE_ATTRACTORS_DECISION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_ATTRACTORS_DECISION_INL
#undef EQUIPOISE_ATTRACTORS_DECISION_INL
#else
#define EQUIPOISE_ATTRACTORS_DECISION_INL
#endif

#include <vector>

#include "equipoise/attractors/decision_rule.hpp"
#include "equipoise/attractors/fate.hpp"
#include "equipoise/attractors/window_features.hpp"
#include "equipoise/base/angles.hpp"
#include "equipoise/base/pack-inl.hpp"
#include "equipoise/ensemble/lane_task.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Hooks: see NoObserver in ensemble/lane_block-inl.hpp. Windows are sampled at two stages inside each step and at its
// end (a third of a step apart), so that no motion is seen fewer than eight times a period at the steps the tolerance
// allows; tests/unit/window_test.cpp measures it.
template <int n, int groups>
class DecideFate {
 public:
  static constexpr int dimension = model::dimension(n);
  static constexpr int lanes = static_cast<int>(pack_lanes);

  DecideFate(const model::Parameters& p, const DecisionRule& rule, std::vector<Fate>& fates,
             std::vector<PilotRecord>* pilot)
      : rule_(rule),
        parameters_(p),
        fates_(fates),
        pilot_(pilot),
        trackers_(groups * lanes),
        family_reach_(groups * lanes) {}

  void begin(int slot, std::size_t, double t, const double* z) {
    open_window(slot / lanes, slot % lanes, t, z + 4);
    trackers_[slot].begin(rule_);
    family_reach_[slot] = rule_.family.reach;
    verdict_[slot / lanes][slot % lanes] = Outcome::undecided;
  }

  template <int row>
  HWY_INLINE void stage(int g, const Pack* z) {
    if constexpr (row == first_sample) take(first_[g], z);
    if constexpr (row == second_sample) take(second_[g], z);
  }

  HWY_INLINE unsigned step(int g, unsigned active, Mask accepted, Pack t, Pack h, const Pack* z) {
    gather(g, accepted, h, z);
    const unsigned accepted_bits = lane_bits(accepted) & active;
    unsigned done = 0;
    unsigned caught = caught_by_trap(accepted, z) & accepted_bits;
    if (rule_.family.caught) caught |= caught_by_family(g, accepted_bits, z);
    if (caught) done |= mark(g, caught, Outcome::balanced);
    const unsigned full = accepted_bits & ~lane_bits(t < window_end_[g]) & ~done;
    if (full) done |= close_windows(g, full, t, z);
    return done;
  }

  void end(int slot, std::size_t start, LaneEnd how, double t, const double*) {
    Fate& fate = fates_[start];
    fate.time = t;
    fate.outcome = how == LaneEnd::decided    ? verdict_[slot / lanes][slot % lanes]
                   : how == LaneEnd::diverged ? Outcome::diverged
                   : how == LaneEnd::failed   ? Outcome::failed
                                              : Outcome::undecided;
    if (pilot_ && how == LaneEnd::decided && fate.outcome == Outcome::not_balanced)
      (*pilot_)[start] = {trackers_[slot].long_features(), trackers_[slot].range(), true};
  }

 private:
  // Stages at c = 1/3 and c = 0.6.
  static constexpr int first_sample = 5, second_sample = 9;

  struct Sample {
    Pack r2, q[n];
  };

  static HWY_INLINE void take(Sample& sample, const Pack* z) {
    sample.r2 = z[0] * z[0] + z[1] * z[1];
    for (int i = 0; i < n; ++i) sample.q[i] = z[4 + n + i];
  }

  // Adds the samples of an accepted step to the windows of its lanes.
  HWY_INLINE void gather(int g, Mask accepted, Pack h, const Pack* z) {
    Sample last;
    take(last, z);
    const Pack low = minimum(minimum(first_[g].r2, second_[g].r2), last.r2);
    const Pack high = maximum(maximum(first_[g].r2, second_[g].r2), last.r2);
    r2_min_[g] = select(accepted, minimum(r2_min_[g], low), r2_min_[g]);
    r2_max_[g] = select(accepted, maximum(r2_max_[g], high), r2_max_[g]);
    const Pack integral = multiply_add(h * Pack(1.0 / 3), first_[g].r2 + second_[g].r2 + last.r2, r2_integral_[g]);
    r2_integral_[g] = select(accepted, integral, r2_integral_[g]);
    for (int i = 0; i < n; ++i) {
      const Pack slow = minimum(minimum(first_[g].q[i], second_[g].q[i]), last.q[i]);
      const Pack fast = maximum(maximum(first_[g].q[i], second_[g].q[i]), last.q[i]);
      q_min_[g][i] = select(accepted, minimum(q_min_[g][i], slow), q_min_[g][i]);
      q_max_[g][i] = select(accepted, maximum(q_max_[g][i], fast), q_max_[g][i]);
    }
  }

  // Lanes inside a trap's level set. The box test costs little and spares most of them the quadratic form.
  HWY_INLINE unsigned caught_by_trap(Mask accepted, const Pack* z) {
    unsigned caught = 0;
    for (const BalancedTrap& trap : rule_.traps) {
      Mask near = accepted;
      for (int i = 0; i < 4; ++i) near = near & (absolute(z[i]) < Pack(trap.reach[i]));
      for (int i = 0; i < n; ++i) near = near & (absolute(z[4 + n + i]) < Pack(trap.reach[4 + n + i]));
      if (any(near)) caught |= lane_bits(near & inside_level(trap, z));
    }
    return caught;
  }

  HWY_NOINLINE Mask inside_level(const BalancedTrap& trap, const Pack* z) {
    Pack d[dimension];
    for (int i = 0; i < dimension; ++i) d[i] = z[i];
    for (int i = 0; i < n; ++i) {
      const Pack away = z[4 + i] - Pack(trap.phi[i]);
      d[4 + i] = away - Pack(two_pi) * nearest_integer(away * Pack(1.0 / two_pi));
    }
    Pack v(0.0);
    for (int row = 0; row < dimension; ++row) {
      Pack sum(0.0);
      for (int column = row; column < dimension; ++column)
        sum = multiply_add(Pack(trap.factor[row * dimension + column]), d[column], sum);
      v = multiply_add(sum, sum, v);
    }
    return v < Pack(trap.level);
  }

  // Lanes caught by a continuum of balanced states: asked one by one, and after a refusal only again at a tenth of the
  // distance.
  HWY_NOINLINE unsigned caught_by_family(int g, unsigned accepted, const Pack* z) {
    unsigned caught = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(accepted & (1u << lane))) continue;
      double state[dimension];
      double& reach = family_reach_[g * lanes + lane];
      bool near = true;
      for (int i = 0; i < dimension; ++i) {
        state[i] = element(z[i], lane);
        if (i < 4 || i >= 4 + n) near = near && std::fabs(state[i]) < reach;
      }
      if (!near) continue;
      double imbalance_x = parameters_.eccentricity, imbalance_y = 0.0;
      for (int i = 0; i < n; ++i) {
        imbalance_x += parameters_.mass[i] * std::cos(state[4 + i]);
        imbalance_y += parameters_.mass[i] * std::sin(state[4 + i]);
      }
      if (std::hypot(imbalance_x, imbalance_y) >= reach) continue;
      if (rule_.family.caught(state))
        caught |= 1u << lane;
      else
        reach *= 0.1;
    }
    return caught;
  }

  HWY_NOINLINE unsigned mark(int g, unsigned bits, Outcome outcome) {
    for (int lane = 0; lane < lanes; ++lane)
      if (bits & (1u << lane)) verdict_[g][lane] = outcome;
    return bits;
  }

  // Hands the finished windows of the `full` lanes to their trackers and opens new ones.
  HWY_NOINLINE unsigned close_windows(int g, unsigned full, Pack t, const Pack* z) {
    unsigned decided = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(full & (1u << lane))) continue;
      const double now = element(t, lane);
      double phi[n];
      WindowSums sums;
      sums.duration = now - (element(window_end_[g], lane) - rule_.window);
      sums.r2_min = element(r2_min_[g], lane);
      sums.r2_max = element(r2_max_[g], lane);
      sums.r2_integral = element(r2_integral_[g], lane);
      for (int i = 0; i < n; ++i) {
        phi[i] = element(z[4 + i], lane);
        sums.turned[i] = phi[i] - element(phi_start_[g][i], lane);
        sums.q_min[i] = element(q_min_[g][i], lane);
        sums.q_max[i] = element(q_max_[g][i], lane);
      }
      if (trackers_[g * lanes + lane].add(sums) != WindowVerdict::open) decided |= 1u << lane;
      open_window(g, lane, now, phi);
    }
    return mark(g, decided, Outcome::not_balanced);
  }

  void open_window(int g, int lane, double t, const double* phi) {
    element(window_end_[g], lane) = t + rule_.window;
    element(r2_min_[g], lane) = 1e300;
    element(r2_max_[g], lane) = 0.0;
    element(r2_integral_[g], lane) = 0.0;
    for (int i = 0; i < n; ++i) {
      element(phi_start_[g][i], lane) = phi[i];
      element(q_min_[g][i], lane) = 1e300;
      element(q_max_[g][i], lane) = -1e300;
    }
  }

  static double& element(Pack& p, int lane) { return reinterpret_cast<double*>(&p)[lane]; }
  static double element(const Pack& p, int lane) { return reinterpret_cast<const double*>(&p)[lane]; }

  const DecisionRule& rule_;
  const model::Parameters& parameters_;
  std::vector<Fate>& fates_;
  std::vector<PilotRecord>* pilot_;
  Sample first_[groups], second_[groups];
  Pack r2_min_[groups], r2_max_[groups], r2_integral_[groups], window_end_[groups];
  Pack q_min_[groups][n], q_max_[groups][n], phi_start_[groups][n];
  Outcome verdict_[groups][lanes] = {};
  std::vector<WindowTracker> trackers_;
  std::vector<double> family_reach_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
