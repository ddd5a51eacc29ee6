// The equations of any system with contact or dry friction between two events, for every number type: (t, y) -> dy/dt
// for given modes of the balls. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_HYBRID_FLOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_HYBRID_FLOW_INL
#undef EQUIPOISE_MODEL_HYBRID_FLOW_INL
#else
#define EQUIPOISE_MODEL_HYBRID_FLOW_INL
#endif

#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/ball_mode.hpp"
#include "equipoise/machine/model/drive-inl.hpp"
#include "equipoise/machine/model/equations-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/system.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Modes of balls in the form that the equations take, one mode per lane of T.
template <class T, int room>
class ModeTable {
 public:
  explicit ModeTable(const model::Parameters& p) : n(p.balls) {
    for (int i = 0; i < n; ++i) {
      mass_[i] = T(p.mass[i]);
      held[i] = sense[i] = T(0.0);
      for (int j = 0; j < n; ++j) {
        together[i][j] = T(i == j ? 1.0 : 0.0);
        behind[i][j] = T(0.0);
      }
    }
  }

  // Copies the balls of `p` into lane `lane`.
  void take_balls(const model::Parameters& p, int lane) {
    for (int i = 0; i < n; ++i) element(mass_[i], lane) = p.mass[i];
  }

  void set(const model::BallMode& mode, int lane = 0) {
    for (int i = 0; i < n; ++i) {
      element(held[i], lane) = mode.held[i];
      element(sense[i], lane) = mode.held[i] ? 0 : mode.sense[i];
    }
    const unsigned bit = 1u << lane;
    bool holds = false;
    for (int i = 0; i < n; ++i) holds = holds || mode.held[i];
    held_ = holds ? held_ | bit : held_ & ~bit;
    const bool joins = any_moving_pair(mode);
    if (!joins && !(joined_ & bit)) return;
    joined_ = joins ? joined_ | bit : joined_ & ~bit;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        element(together[i][j], lane) = i == j;
        element(behind[i][j], lane) = 0.0;
      }
    if (joins) set_groups(mode, lane);
  }

  // Whether any lane holds a ball.
  bool any_held() const { return held_ != 0; }
  // Whether balls move joined in any lane.
  bool any_joined() const { return joined_ != 0; }

  T held[room];            // 1 or 0
  T sense[room];           // -1, 0 or 1
  T together[room][room];  // BallActions::together
  T behind[room][room];    // row i: 1 for ball i and those of its group behind it, if another is ahead; else 0

 private:
  static double& element(T& value, int lane) { return reinterpret_cast<double*>(&value)[lane]; }

  // Joined balls that are held stay together without pushes.
  bool moves_joined(const model::BallMode& mode, int k) const { return mode.joined[k] && !mode.held[mode.order[k]]; }
  bool any_moving_pair(const model::BallMode& mode) const {
    for (int k = 0; k < n; ++k)
      if (moves_joined(mode, k)) return true;
    return false;
  }

  void set_groups(const model::BallMode& mode, int lane) {
    for (int first = 0; first < n; ++first) {
      if (!moves_joined(mode, first) || moves_joined(mode, (first + n - 1) % n)) continue;
      int group[room], size = 0;
      double mass = 0.0;
      for (int k = first;; k = (k + 1) % n) {
        group[size++] = mode.order[k];
        mass += element(mass_[mode.order[k]], lane);
        if (!moves_joined(mode, k)) break;
      }
      for (int a = 0; a < size; ++a)
        for (int b = 0; b < size; ++b) {
          element(together[group[a]][group[b]], lane) = element(mass_[group[b]], lane) / mass;
          element(behind[group[a]][group[b]], lane) = b <= a && a + 1 < size;
        }
    }
  }

  const model::BallCount<room> n;
  T mass_[room];
  unsigned held_ = 0, joined_ = 0;  // bits of lanes
};

// Event functions: 0 or more until an event. `rates`: rates of balls along their senses. `forces`: friction's reserve
// on balls at rest, and pressures between joined balls.
template <class T>
struct EventMargins {
  T rates, forces;
};

// The state is that of the system or model::machine_layout().
template <class T, int room, bool tilt = false>
class HybridFlow {
 public:
  // Of the largest state, padded to an even number.
  static constexpr int dimension = model::dimension(room) + (tilt ? 8 : 4);
  static constexpr int least_size = model::dimension(room == model::any_count ? 1 : room);
  using Modes = ModeTable<T, room>;
  using Forces = BallForces<T, room>;

  // For the system's piece of its drive, in study time. `segment` says when the piece begins and, if the rotor turns as
  // prescribed, at which angle. `modes` may be given later: with().
  HybridFlow(const model::System& s, const model::Segment& segment, const Modes* modes = nullptr)
      : HybridFlow(s.parameters(), s.drive(), s.layout(), segment.begin, segment.psi, modes) {}

  // For any piece of a drive, laid out as model::machine_layout().
  HybridFlow(const model::Parameters& p, const model::DrivePiece& piece, const Modes* modes)
      : HybridFlow(p, piece, model::machine_layout(p), piece.begin, piece.psi, modes) {}

  int size() const { return size_; }
  const model::StateLayout& layout() const { return drive_.layout(); }
  HybridFlow with(const Modes& modes) const {
    HybridFlow result = *this;
    result.modes_ = &modes;
    return result;
  }

  // Copies rotor and drive of `from`, with a state of the same size, into lane `lane`.
  void take_lane(const HybridFlow& from, int lane) {
    using F = HybridFlow;
    balancer_.take_lane(from.balancer_, lane);
    drive_.take_lane(from.drive_, lane);
    take_lane_of(*this, from, lane, &F::mass_, &F::rolling_, &F::stiction_);
    resists_ = resists_ || from.resists_;
  }

  // Enters the next piece of the drive, laid out as model::machine_layout().
  void enter(const model::DrivePiece& piece) { drive_.enter(piece); }

  void operator()(const T& t, const T* y, T* dy) const {
    Forces forces;
    evaluate(t, y, dy, forces);
  }
  // The same; lowers `margins` to their values here where those are less.
  void operator()(const T& t, const T* y, T* dy, EventMargins<T>& margins) const {
    Forces forces;
    evaluate(t, y, dy, forces);
    if (resists_)
      for (int i = 0; i < n; ++i) margins.rates = minimum(margins.rates, modes_->sense[i] * y[4 + n + i]);
    if (resists_ && modes_->any_held())
      for (int i = 0; i < n; ++i) margins.forces = minimum(margins.forces, left_of_hold(i, forces));
    if (modes_->any_joined())
      for (int i = 0; i < n; ++i) margins.forces = minimum(margins.forces, pressure(i, forces));
  }

  // `forces` are set only if balls resist or move joined. One copy of the code serves all callers, so that all get the
  // same rounding.
  HWY_NOINLINE BodyResult<T> evaluate(const T& t, const T* y, T* dy, Forces& forces) const {
    const RotorMotion<T> rotor = drive_.rotor(t, y);
    const MotorState<T> motor = drive_.motor(t, rotor, y);
    BallActions<T, room> actions;
    actions.acted_on = resists_;
    if (resists_ || modes_->any_joined()) actions.forces = &forces;
    if (modes_->any_joined()) actions.together = modes_->together;
    if (resists_ || modes_->any_held())
      for (int i = 0; i < n; ++i) {
        actions.held[i] = T(0.5) < modes_->held[i];
        actions.resistance[i] = modes_->sense[i] * rolling_[i];
      }
    BodyResult<T> result;
    // Normal forces are first taken to point outward. Where a ball presses on the inner wall, friction changes sign.
    for (int attempt = 0; attempt < 2; ++attempt) {
      result = balancer_.full_derivative(rotor, actions, drive_.driven() ? &motor.torque : nullptr, y, dy);
      if (attempt > 0 || !resists_ || !turn_inward(forces, actions)) break;
    }
    drive_.rates(rotor, result.acceleration, motor.error_rate, dy);
    return result;
  }

  // Force with which ball i presses on the next one, if it moves joined with it; else 0.
  HWY_INLINE T pressure(int i, const Forces& forces) const {
    T sum(0.0);
    for (int j = 0; j < n; ++j) sum = sum - modes_->behind[i][j] * mass_[j] * forces.push[j];
    return sum;
  }

  // Change of the velocities u, v, q_1..q_n, and psi' under a motor (as entries of `change`, shaped like a state) for a
  // unit impulse that drives balls `first` and `second` apart along the race. All balls count as free: dry friction
  // does nothing in no time.
  void impulse_response(const T& t, const T* y, int first, int second, T* change) const {
    const RotorMotion<T> rotor = drive_.rotor(t, y);
    BallActions<T, room> actions;
    T before[dimension], after[dimension];
    const T idle(0.0), *torque = drive_.driven() ? &idle : nullptr;
    const T a0 = balancer_.full_derivative(rotor, actions, torque, y, before).acceleration;
    actions.push[first] = T(-1.0);
    actions.push[second] = T(1.0);
    const T a1 = balancer_.full_derivative(rotor, actions, torque, y, after).acceleration;
    for (int i = 0; i < size_; ++i) change[i] = T(0.0);
    for (int i : {model::index::u, model::index::v}) change[i] = after[i] - before[i];
    for (int i = 0; i < n; ++i) change[4 + n + i] = after[4 + n + i] - before[4 + n + i];
    if (drive_.driven()) change[layout().speed] = a1 - a0;
  }

 private:
  HybridFlow(const model::Parameters& p, const model::DrivePiece& piece, const model::StateLayout& layout, double begin,
             double psi, const Modes* modes)
      : n(p.balls),
        balancer_(p, layout.tilt),
        drive_(p, piece, layout, begin, psi),
        size_(layout.size),
        resists_(p.balls_stick()),
        modes_(modes) {
    for (int i = 0; i < n; ++i) {
      mass_[i] = T(p.rolls ? p.inertia_along_race() * p.mass[i] : p.mass[i]);
      rolling_[i] = T(p.rolling[i]);
      stiction_[i] = T(p.stiction[i]);
    }
  }

  // Friction's reserve on a held ball; 0 for others.
  HWY_INLINE T left_of_hold(int i, const Forces& forces) const {
    const T left = stiction_[i] * absolute(forces.normal[i]) - absolute(forces.tangential[i]);
    return select(T(0.5) < modes_->held[i], left, T(0.0));
  }

  HWY_INLINE bool turn_inward(const Forces& forces, BallActions<T, room>& actions) const {
    bool turned = false;
    for (int i = 0; i < n; ++i) {
      const T resistance = actions.resistance[i];
      const auto inward = T(0.0) < absolute(resistance);
      const auto pulls = forces.normal[i] < T(0.0);
      const auto both = inward & pulls;
      turned = turned || any(both);
      actions.resistance[i] = select(both, -resistance, resistance);
    }
    return turned;
  }

  const model::BallCount<room> n;
  BallBalancer<T, room, body_terms(tilt, true)> balancer_;
  RotorDrive<T> drive_;
  int size_;
  bool resists_;
  T mass_[room]{}, rolling_[room]{}, stiction_[room]{};  // mass_: inertia along the race
  const Modes* modes_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
