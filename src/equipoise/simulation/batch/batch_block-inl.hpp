// The time loop of ensembles: groups of SIMD lanes, each lane one trajectory with its own time and step, refilled as
// trajectories end. Included once per CPU target.
//
// Several groups may take each stage in turn, so that one group's chain of dependent operations hides behind another's.
// The loops over groups and stages stay rolled: unrolled, the code no longer fits the instruction caches.
// This room: many trajectories next to each other: the time loop of SIMD lanes, and its watches.
#if defined(EQUIPOISE_BATCH_BATCH_BLOCK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_BATCH_BATCH_BLOCK_INL
#undef EQUIPOISE_BATCH_BATCH_BLOCK_INL
#else
#define EQUIPOISE_BATCH_BATCH_BLOCK_INL
#endif

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "equipoise/simulation/batch/batch_events-inl.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/integrate/dop853-inl.hpp"
#include "equipoise/results/types/status.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Step sizes per lane: a proportional-integral controller on the logarithm of the error.

// log2 of a positive normal number, linear in the mantissa: exact at powers of two, up to 0.0861 too small between.
// Accurate enough for a step size (a tenth of it enters an exponent), at a few integer operations on every target.
HWY_INLINE Pack coarse_log2(Pack a) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  return Pack(hn::ConvertTo(d, hn::BitCast(di, a.v))) * Pack(0x1p-52) - Pack(1023.0);
}

// The inverse of coarse_log2: exact at whole numbers, up to 6.2 % too large between.
HWY_INLINE Pack coarse_exp2(Pack a) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  return Pack(hn::BitCast(d, hn::ConvertTo(di, ((a + Pack(1023.0)) * Pack(0x1p52)).v)));
}

struct StepChange {
  Pack factor;     // next step over this one
  Pack log_error;  // to keep if the step is accepted
};

// `error2`: square of the error norm of this step; `log_error`: of the last accepted step. Exponents in units of 1/8
// (the order of the estimate): proportional 0.4, integral 0.4; safety factor 0.9; bounds 0.2 and 6. A rejected step,
// error2 > 1, is judged by its own error alone.
HWY_INLINE StepChange step_change(Pack error2, Pack log_error) {
  const Mask usable = error2 < Pack(1e60);  // false for not-a-number
  const Pack bounded = maximum(select(usable, error2, Pack(1e60)), Pack(1e-12));
  const Pack log2_error = Pack(0.5) * coarse_log2(bounded);
  const Pack log2_safety(-0.152);
  const Pack smooth = multiply_add(Pack(-0.8 / 8), log2_error, multiply_add(Pack(0.4 / 8), log_error, log2_safety));
  const Pack direct = multiply_add(Pack(-1.0 / 8), log2_error, log2_safety);
  const Pack exponent = select(error2 <= Pack(1.0), smooth, direct);
  return {coarse_exp2(minimum(maximum(exponent, Pack(-2.32)), Pack(2.58))), log2_error};
}

// An observer of a lane block, bound to it in simulation/kernels/kernel-inl.hpp. This one has every hook and does
// nothing.
//   begin(slot, start, t, z)   trajectory `start` enters lane `slot` in state z (scalars)
//   stage(row, group, z)       state at stage `row` of the step being tried
//   step(group, active, accepted, t, h, z) -> bits of lanes to end now, called after every step tried; t, z: at the
//                              step's end; active: bits of lanes that hold a trajectory
//   corner(slot, t, z)         after an event in lane `slot`: its state has jumped to z, or its rates have
//   end(slot, start, how, t, z)    trajectory leaves
struct NoObserver {
  void begin(int, std::size_t, double, const double*) {}
  HWY_INLINE void stage(int, int, const Pack*) {}
  HWY_INLINE unsigned step(int, unsigned, Mask, Pack, Pack, const Pack*) { return 0; }
  void corner(int, double, const double*) {}
  void end(int, std::size_t, BatchEnd, double, const double*) {}
};

// All lanes share one rotor: its flow is a constant of the loop, and steps are a little faster.
struct OneRotor {
  static constexpr bool own = false;
};
// Trajectories have their own rotors, and every group of lanes its own flow. `make` makes the flow of a rotor.
template <class Make>
struct OwnRotors {
  static constexpr bool own = true;
  Make make;
};

template <class Flow, class Observer, int groups, class Rotors = OneRotor>
class BatchBlock {
 public:
  static constexpr bool own = Rotors::own;
  static constexpr int dimension = Flow::dimension;  // the largest size
  static constexpr int lanes = static_cast<int>(pack_lanes);
  static constexpr int slots = groups * lanes;
  using Events = BatchEvents<std::remove_const_t<Flow>>;
  static_assert(groups == 1 || !Events::happen);

  BatchBlock(const BatchTask& task, const Flow& flow, Observer& observer, Rotors rotors = {})
      : task_(task),
        rotors_(std::move(rotors)),
        events_(task, flow),
        flow_(make_flows(events_.bind(flow), std::make_index_sequence<flows>())),
        observer_(observer),
        size_(flow.size()) {
    for (int g = 0; g < flows; ++g) {
      end_[g] = Pack(task.end);
      for (int i = 0; i < size_; ++i) inverse_scale_[g][i] = Pack(inverse_scale(*task.parameters, i));
    }
  }

  // Runs every trajectory of the task. False if stopped before all were done.
  bool run() {
    for (int g = 0; g < groups; ++g) {
      active_[g] = 0;
      for (int i = 0; i < dimension; ++i) y_[g][i] = Pack(0.0);
      // Sums may take one component more than the state, to be even. Those stay 0.
      for (auto& stage : k_[g])
        for (int i = 0; i < dimension; ++i) stage[i] = Pack(0.0);
      t_[g] = end(g);
      h_[g] = Pack(0.0);
      log_error_[g] = Pack(0.0);
      unsigned filled = 0;
      for (int lane = 0; lane < lanes; ++lane) filled |= fill(g, lane);
      start_rates(g, filled);
    }
    if constexpr (own) {
      while (working_ > 0) {
        if (is_set(task_.stop)) return false;
        advance([this](int g) HWY_ATTR -> const Flow& { return flow_[g]; });
      }
    } else {
      const Flow flow = flow_[0];  // a local copy that no store can change: its constants are computed once
      while (working_ > 0) {
        if (is_set(task_.stop)) return false;
        advance([&flow](int) HWY_ATTR -> const Flow& { return flow; });
      }
    }
    if (task_.work) {
      task_.work->steps += work_.steps;
      task_.work->accepted += work_.accepted;
      if constexpr (Events::happen) task_.work->events += events_.passed();
    }
    return true;
  }

 private:
  using Size = decltype(std::declval<Flow>().size());
  static constexpr int flows = own ? groups : 1;

  template <std::size_t... g>
  static std::array<Flow, flows> make_flows(const Flow& flow, std::index_sequence<g...>) {
    return {((void)g, flow)...};
  }

  const Pack& end(int g) const { return end_[own ? g : 0]; }
  double inverse_scale(const model::Parameters& p, int component) const {
    return 1.0 / (task_.tolerance * batch_error_scale(p, component, task_.layout().tilt));
  }

  // Puts the rotor of trajectory `start` into its lane.
  void take_rotor(int g, int lane, std::size_t start) {
    if constexpr (own) {
      if (!task_.own) return;
      const OwnRotor& rotor = *task_.own[start];
      flow_[g].take_lane(rotors_.make(rotor), lane);
      element(end_[g], lane) = task_.end_of(start);
      for (int i = 0; i < size_; ++i) element(inverse_scale_[g][i], lane) = inverse_scale(rotor.system.parameters(), i);
      if constexpr (Events::happen) events_.take_rotor(lane, rotor);
    }
  }

  // Calls f with the size as a constant, even if the flow knows it only at run time: sums over the tableau then stay in
  // registers.
  template <class F>
  HWY_INLINE void with_size(F&& f) const {
    if constexpr (!std::is_same_v<Size, int>)
      f(size_);
    else
      with_even_size<Flow::least_size>(f);
  }

  // The size is rounded up to an even number: with some odd ones, compilers sum only a few components at a time.
  template <int size, class F>
  HWY_INLINE void with_even_size(F&& f) const {
    static_assert(size % 2 == 0 && dimension % 2 == 0);
    if constexpr (size >= dimension) {
      f(dop853::Full<dimension>{});
    } else {
      if (size_ <= size) return f(dop853::Full<size>{});
      with_even_size<size + 2>(f);
    }
  }

  // Tries one step in every lane.
  template <class FlowOf>
  HWY_INLINE void advance(const FlowOf& flow) {
    if constexpr (Events::happen) events_.begin_step();
    for (int g = 0; g < groups; ++g) step_[g] = minimum(h_[g], end(g) - t_[g]);
#pragma GCC unroll 1
    for (int row = 1; row < dop853::tableau::stages; ++row)
#pragma GCC unroll 1
      for (int g = 0; g < groups; ++g) {
        Pack z[dimension];
        with_size([&](auto size) HWY_ATTR { dop853::stage_state(row, step_[g], y_[g], k_[g], z, size); });
        observer_.stage(row, g, z);
        rates(flow(g), multiply_add(Pack(dop853::tableau::c[row]), step_[g], t_[g]), z, k_[g][row]);
      }
#pragma GCC unroll 1
    for (int g = 0; g < groups; ++g) finish_step(flow(g), g);
  }

  HWY_INLINE void finish_step(const Flow& flow, int g) {
    Pack z[dimension], error5[dimension], error3[dimension], k_end[dimension];
    with_size([&](auto size) HWY_ATTR { dop853::step_end(step_[g], y_[g], k_[g], z, error5, error3, size); });
    const Pack error2 =
        dop853::squared_error<Pack, dimension>(step_[g], error5, error3, inverse_scale_[own ? g : 0], size_);
    Mask accepted = error2 <= Pack(1.0);  // false for not-a-number
    // The last step lands on the end exactly.
    const Pack t_try = t_[g] + step_[g];
    const Pack t_new = select(end(g) - t_[g] <= h_[g], end(g), t_try);
    rates(flow, t_new, z, k_end);
    unsigned interrupted = 0;
    if constexpr (Events::happen) {
      interrupted = events_.look(active_[g] & lane_bits(accepted), {t_new, step_[g], y_[g], z, k_[g], k_end});
      accepted = accepted & mask_of(~interrupted);
    }
    const unsigned decided = observer_.step(g, active_[g], accepted, t_new, step_[g], z);

    const StepChange change = step_change(error2, log_error_[g]);
    const Mask moving = t_[g] < t_try;
    Pack size(0.0);
    for (int i = 0; i < 4; ++i) size = maximum(size, absolute(z[i]));
    const Mask bounded = size < Pack(divergence_limit);
    for (int i = 0; i < size_; ++i) {
      y_[g][i] = select(accepted, z[i], y_[g][i]);
      k_[g][0][i] = select(accepted, k_end[i], k_[g][0][i]);
    }
    t_[g] = select(accepted, t_new, t_[g]);
    h_[g] = change.factor * step_[g];
    log_error_[g] = select(accepted, change.log_error, log_error_[g]);

    const unsigned accepted_bits = lane_bits(accepted);
    work_.steps += static_cast<unsigned>(std::popcount(active_[g]));
    work_.accepted += static_cast<unsigned>(std::popcount(active_[g] & accepted_bits));
    const unsigned reached = accepted_bits & ~lane_bits(t_[g] < end(g));
    const unsigned diverged = accepted_bits & ~lane_bits(bounded);
    unsigned failed = ~lane_bits(moving);
    if constexpr (Events::happen)
      if (interrupted | events_.ready()) failed |= pass_events(g, interrupted);
    const unsigned leaving = (decided | reached | diverged | failed) & active_[g];
    if (leaving) replace(g, leaving, decided, diverged, reached);
  }

  HWY_INLINE void rates(const Flow& flow, const Pack& t, const Pack* z, Pack* dz) {
    if constexpr (Events::happen)
      flow(t, z, dz, events_.margins());
    else
      flow(t, z, dz);
  }

  // Makes interrupted lanes repeat their step, and carries out the events of lanes that have reached one. Returns the
  // bits of lanes whose events never end.
  HWY_NOINLINE unsigned pass_events(int g, unsigned interrupted) {
    unsigned failed = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      const unsigned bit = 1u << lane;
      if (interrupted & bit) element(h_[g], lane) = events_.step(lane);
      if (!(events_.ready() & bit)) continue;
      double z[dimension];
      for (int i = 0; i < size_; ++i) z[i] = element(y_[g][i], lane);
      const double t = element(t_[g], lane);
      if (!events_.pass(lane, t, z)) failed |= bit;
      for (int i = 0; i < size_; ++i) element(y_[g][i], lane) = z[i];
      element(h_[g], lane) = events_.step_after(lane);
      element(log_error_[g], lane) = 0.0;
      observer_.corner(g * lanes + lane, t, z);
    }
    if (events_.ready()) start_rates(g, events_.ready());
    return failed;
  }

  // Ends the trajectories in the `leaving` lanes of group g and refills them.
  HWY_NOINLINE void replace(int g, unsigned leaving, unsigned decided, unsigned diverged, unsigned reached) {
    unsigned filled = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      const unsigned bit = 1u << lane;
      if (!(leaving & bit)) continue;
      const BatchEnd how = decided & bit    ? BatchEnd::decided
                           : diverged & bit ? BatchEnd::diverged
                           : reached & bit  ? BatchEnd::reached_end
                                            : BatchEnd::failed;
      const std::size_t start = start_of_[g][lane];
      if constexpr (Events::happen)
        if (task_.met && events_.met(lane)) task_.met[start] = 1;
      double* row = task_.states + start * static_cast<std::size_t>(size_);
      for (int i = 0; i < size_; ++i) row[i] = element(y_[g][i], lane);
      observer_.end(g * lanes + lane, start, how, element(t_[g], lane), row);
      active_[g] &= ~bit;
      --working_;
      filled |= fill(g, lane);
    }
    if (filled) start_rates(g, filled);
  }

  // Puts the next trajectory into an empty lane and returns the lane's bit. Without one, parks the lane at the end with
  // step zero.
  unsigned fill(int g, int lane) {
    if (next_ == task_.count) {
      for (int i = 0; i < size_; ++i) element(y_[g][i], lane) = 0.0;
      element(t_[g], lane) = element(end_[own ? g : 0], lane);
      element(h_[g], lane) = 0.0;
      return 0;
    }
    const std::size_t start = next_++;
    double* row = task_.states + start * static_cast<std::size_t>(size_);
    const double begin = task_.begin_of(start);
    take_rotor(g, lane, start);
    if constexpr (Events::happen) events_.enter(lane, begin, row);
    for (int i = 0; i < size_; ++i) element(y_[g][i], lane) = row[i];
    element(t_[g], lane) = begin;
    element(h_[g], lane) = first_step(start, row);
    element(log_error_[g], lane) = 0.0;
    start_of_[g][lane] = start;
    active_[g] |= 1u << lane;
    ++working_;
    observer_.begin(g * lanes + lane, start, begin, row);
    return 1u << lane;
  }

  // A cautious first step from the fastest rate; the controller lengthens it within a few steps.
  double first_step(std::size_t start, const double* row) const {
    const model::Segment& segment = task_.own ? task_.own[start]->segment : task_.segment;
    const double begin = task_.begin_of(start), end = task_.end_of(start);
    double fastest = 1.0 + std::fabs(segment.speed) + std::fabs(segment.speed_at(end));
    const int balls = task_.held ? 0 : task_.parameters->balls;
    for (int i = 0; i < balls; ++i) fastest += std::fabs(row[model::index::q(i, balls)]);
    if (task_.layout().speed >= 0) fastest += std::fabs(row[task_.layout().speed]);
    const double span = end - begin;
    const double step = 0.2 / fastest;
    return step < span ? step : span;
  }

  // The rates at the states of lanes just filled, or after an event. Other lanes keep theirs: the compiler may round
  // this copy of the equations differently, and a trajectory must not depend on when its neighbours are replaced.
  HWY_NOINLINE void start_rates(int g, unsigned filled) {
    Pack k_start[dimension];
    flow_[own ? g : 0](t_[g], y_[g], k_start);
    for (int lane = 0; lane < lanes; ++lane)
      if (filled & (1u << lane))
        for (int i = 0; i < size_; ++i) element(k_[g][0][i], lane) = element(k_start[i], lane);
  }

  const BatchTask& task_;
  [[no_unique_address]] Rotors rotors_;
  [[no_unique_address]] Events events_;
  std::array<Flow, flows> flow_;
  Observer& observer_;
  const Size size_;
  Pack end_[flows];
  Pack inverse_scale_[flows][dimension];
  Pack y_[groups][dimension];
  Pack k_[groups][dop853::tableau::stages][dimension];
  Pack t_[groups], h_[groups], step_[groups], log_error_[groups];
  unsigned active_[groups];
  std::size_t start_of_[groups][lanes];
  std::size_t next_ = 0;
  int working_ = 0;
  BatchWork work_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
