// Events in lanes: located one lane at a time; the lane's step is then made to end there. Included once per CPU target.
#if defined(EQUIPOISE_BATCH_BATCH_EVENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_BATCH_BATCH_EVENTS_INL
#undef EQUIPOISE_BATCH_BATCH_EVENTS_INL
#else
#define EQUIPOISE_BATCH_BATCH_EVENTS_INL
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/integrate/ball_events-inl.hpp"
#include "equipoise/simulation/integrate/dop853-inl.hpp"
#include "equipoise/machine/model/hybrid_flow-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// For flows without events.
template <class Flow>
class BatchEvents {
 public:
  static constexpr bool happen = false;
  BatchEvents(const BatchTask&, const Flow&) {}
  static const Flow& bind(const Flow& flow) { return flow; }
};

// A step just tried in all lanes, from y at t - h to z at t; k: its stages, and `end` the rates at z.
template <int dimension>
struct TriedBatch {
  Pack t, h;
  const Pack* y;
  const Pack* z;
  const Pack (*k)[dimension];
  const Pack* end;
};

// For balls that collide or stick. A step is first tried as if there were no events. Bounds over the whole group show
// in which lanes one may have occurred; there dense output in doubles locates it. That lane's step is rejected and
// repeated to end at the event, which is then carried out: observers see ordinary steps. No lane depends on another.
template <int room>
class BatchEvents<HybridFlow<Pack, room>> {
 public:
  static constexpr bool happen = true;
  using Flow = HybridFlow<Pack, room>;
  static constexpr int dimension = Flow::dimension, lanes = static_cast<int>(pack_lanes);
  using Tried = TriedBatch<dimension>;

  BatchEvents(const BatchTask& task, const Flow& flow)
      : n(task.parameters->balls),
        modes_(*task.parameters),
        size_(flow.size()),
        pairs_(task.parameters->balls_collide() && n > 1 ? n : 0) {
    for (auto& one : ones_) one.emplace(*task.system, task.segment);
    // In every lane: pairs are also checked in lanes that no trajectory enters.
    for (int k = 0; k < pairs_; ++k)
      for (int lane = 0; lane < lanes; ++lane) set_pair(k, lane, k, (k + 1) % n, far);
  }
  BatchEvents(const BatchEvents&) = delete;
  BatchEvents& operator=(const BatchEvents&) = delete;

  Flow bind(const Flow& flow) const { return flow.with(modes_); }

  // Sets the rotor of the trajectory that enters lane `lane` next.
  void take_rotor(int lane, const OwnRotor& rotor) {
    modes_.take_balls(rotor.system.parameters(), lane);
    ones_[lane].emplace(rotor.system, rotor.segment);
  }

  // Sets the mode of a trajectory that enters a lane in state z; joined balls in z may be moved together.
  void enter(int lane, double t, double* z) {
    ones_[lane]->balls.enter(t, z);
    keep(lane);
    waiting_ &= ~(1u << lane);
    count_[lane] = {};
    hold_on_[lane] = 0.0;
    met_[lane] = any_joined(lane);
  }

  void begin_step() { margins_ = {Pack(far), Pack(far)}; }
  EventMargins<Pack>& margins() { return margins_; }

  // Bits of accepted lanes whose step is rejected: it is repeated up to the event, or the event is at its beginning.
  unsigned look(unsigned accepted, const Tried& tried) {
    const unsigned due = waiting_ & accepted;
    waiting_ = 0;  // lanes whose step was not accepted are searched again
    ready_ = due;
    const unsigned by_forces = lane_bits(margins_.forces < Pack(0.0));
    unsigned candidates = by_forces | lane_bits(margins_.rates < Pack(0.0));
    if (pairs_ > 0) candidates |= lane_bits(may_meet(tried) < Pack(0.0));
    candidates &= accepted & ~due;
    unsigned rejected = 0;
    for (int lane = 0; candidates >> lane; ++lane)
      if (candidates >> lane & 1u) rejected |= locate(lane, by_forces >> lane & 1u, tried);
    return rejected;
  }

  // Length of the step that a rejected lane repeats; 0 if the event is at its beginning.
  double step(int lane) const { return cut_[lane]; }
  // Bits of the lanes that have reached their event.
  unsigned ready() const { return ready_; }

  // Carries out the event of a lane in state z. False if events never end.
  bool pass(int lane, double t, double* z) {
    if (!count_[lane].add(t)) return false;
    BallEvents<room>& balls = ones_[lane]->balls;
    balls.set_mode(mode_[lane]);
    if (balls.pass(t, z, happened_[lane], count_[lane].hold() + hold_on_[lane]))
      ++passed_;
    else
      hold_on_[lane] = std::clamp(4.0 * hold_on_[lane], least_hold_on, most_hold_on);
    keep(lane);
    for (int k = 0; k < pairs_; ++k) met_[lane] = met_[lane] || happened_[lane].pair[k];
    return true;
  }
  // Whether balls of a lane's trajectory have touched.
  bool met(int lane) const { return met_[lane]; }
  // Number of events in all lanes that changed a ball mode.
  std::uint64_t passed() const { return passed_; }
  // The step with which a lane goes on: the one that was interrupted.
  double step_after(int lane) const { return whole_[lane]; }

 private:
  static constexpr double far = 1e300;
  // Events are located to this share of a step; dense output errs by more.
  static constexpr double share = 0x1p-30;
  // While a rotor slowly changes its speed, a ball stays at the limit of friction. Errors of steps release and stop it
  // thousands of times a turn, without any effect. Each such event raises the share by which friction holds this
  // trajectory's balls beyond its limit, so that a released ball moves visibly. At 1e-5 balls creep at 1e-6, and rates
  // err by 1e-7 within steps.
  static constexpr double least_hold_on = 1e-9, most_hold_on = 1e-4;

  void keep(int lane) {
    mode_[lane] = ones_[lane]->balls.mode();
    const double contact = ones_[lane]->parameters.contact_angle;
    modes_.set(mode_[lane], lane);
    for (int k = 0; k < pairs_; ++k) {
      const int i = mode_[lane].order[k], j = mode_[lane].order[(k + 1) % n];
      set_pair(k, lane, i, j, mode_[lane].joined[k] ? far : mode_[lane].turns[k] - contact);
    }
  }

  bool any_joined(int lane) const {
    for (int k = 0; k < pairs_; ++k)
      if (mode_[lane].joined[k]) return true;
    return false;
  }

  void set_pair(int k, int lane, int behind, int ahead, double apart) {
    element(behind_[k], lane) = behind * lanes + lane;
    element(ahead_[k], lane) = ahead * lanes + lane;
    element(apart_[k], lane) = apart;
  }

  // Below 0 if a pair may meet in the step. The cubic through gaps and rates at both ends stays above the least of its
  // four control points. The gap itself differs from it by less than a tenth of the distance that the rates give, plus
  // a thousandth of what a force of 1 gives.
  HWY_NOINLINE Pack may_meet(const Tried& s) const {
    const auto between = [&](const Pack* state, int from, int k) {
      const double* base = reinterpret_cast<const double*>(state + from);
      return gather(base, ahead_[k]) - gather(base, behind_[k]);
    };
    Pack least(far);
    const Pack third = Pack(1.0 / 3.0) * s.h, still = Pack(1e-3) * s.h * s.h;
    for (int k = 0; k < pairs_; ++k) {
      const Pack g0 = between(s.y, 4, k) + apart_[k], g1 = between(s.z, 4, k) + apart_[k];
      const Pack r0 = between(s.y, 4 + n, k), r1 = between(s.z, 4 + n, k);
      const Pack low = minimum(minimum(g0, g1), minimum(g0 + third * r0, g1 - third * r1));
      least = minimum(least, low - Pack(0.1) * s.h * (absolute(r0) + absolute(r1)) - still);
    }
    return least;
  }

  // Looks for an event in a lane's step; the lane's bit if the step is rejected. `by_forces`: forces may cause it.
  HWY_NOINLINE unsigned locate(int lane, bool by_forces, const Tried& s) {
    const unsigned bit = 1u << lane;
    const double h = element(s.h, lane), end = element(s.t, lane), begin = end - h;
    double y[dimension] = {}, z[dimension] = {};
    for (int i = 0; i < size_; ++i) {
      y[i] = element(s.y[i], lane);
      z[i] = element(s.z[i], lane);
      for (int row = 0; row < dop853::tableau::stages; ++row) k_[row][i] = element(s.k[row][i], lane);
      k_[dop853::tableau::stages][i] = element(s.end[i], lane);
    }
    One& one = *ones_[lane];
    one.balls.set_mode(mode_[lane]);
    one.balls.hold_on(hold_on_[lane]);
    double rows[7][dimension];
    dop853::prepare_dense<double, dimension>(one.flow, begin, h, y, z, k_, rows, size_);
    const auto found = one.balls.first(
        0.0, h, [&](double t, double* out) { dop853::dense_state<double, dimension>(t / h, y, rows, out, size_); },
        by_forces, begin, share);
    if (!found) return 0;
    happened_[lane] = one.balls.happened();
    whole_[lane] = h;
    if (*found == h) {
      ready_ |= bit;
      return 0;
    }
    cut_[lane] = *found;
    if (begin < begin + cut_[lane]) {
      waiting_ |= bit;
    } else {
      cut_[lane] = 0.0;
      ready_ |= bit;
    }
    return bit;
  }

  // A lane's rotor in doubles, and its balls.
  struct One {
    One(const model::System& s, const model::Segment& segment)
        : parameters(s.parameters()), modes(parameters), flow(s, segment, &modes), balls(parameters, flow, modes) {}
    One(const One&) = delete;
    One& operator=(const One&) = delete;

    model::Parameters parameters;
    ModeTable<double, room> modes;
    HybridFlow<double, room> flow;
    BallEvents<room> balls;
  };

  const model::BallCount<room> n;
  ModeTable<Pack, room> modes_;
  std::array<std::optional<One>, lanes> ones_;
  const int size_, pairs_;
  EventMargins<Pack> margins_;
  Pack behind_[room], ahead_[room], apart_[room];  // of pairs: places of both balls to gather from; turns less contact
  model::BallMode mode_[lanes];
  Happened<room> happened_[lanes];
  EventCount count_[lanes];
  double hold_on_[lanes] = {};
  bool met_[lanes] = {};
  double cut_[lanes] = {}, whole_[lanes] = {};
  double k_[dop853::tableau::dense_stages][dimension] = {};
  std::uint64_t passed_ = 0;
  unsigned waiting_ = 0, ready_ = 0;  // bits of lanes whose step will end at an event; has ended there
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
