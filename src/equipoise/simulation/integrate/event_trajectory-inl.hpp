// One trajectory of a machine from event to event: pieces of the drive, release, touching balls, stick or slide. All
// events are located in time, so that every step of the integrator is smooth. Included once per CPU target.
#if defined(EQUIPOISE_INTEGRATE_EVENT_TRAJECTORY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_EVENT_TRAJECTORY_INL
#undef EQUIPOISE_INTEGRATE_EVENT_TRAJECTORY_INL
#else
#define EQUIPOISE_INTEGRATE_EVENT_TRAJECTORY_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/simulation/integrate/ball_events-inl.hpp"
#include "equipoise/simulation/integrate/first_time.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/hybrid_flow-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// The error scale of a machine, for states laid out as model::machine_layout().
template <int dimension>
ErrorScale<dimension> machine_scale(const model::Parameters& p, double tolerance) {
  const model::StateLayout layout = model::machine_layout(p);
  auto scale = error_scale<dimension>(p, tolerance);
  scale.floor[layout.psi] = scale.floor[layout.speed] = scale.floor[layout.error] = 1.0;
  scale.absolute[layout.psi] = scale.angle[layout.psi] = true;
  if (layout.tilt >= 0) std::fill_n(&scale.floor[layout.tilt], 4, scale.floor[model::index::x]);
  return scale;
}

template <int room, bool tilt = false>
class EventTrajectory {
 public:
  using Flow = HybridFlow<double, room, tilt>;
  static constexpr int dimension = Flow::dimension;  // the largest size, laid out as model::machine_layout()
  using Scale = ErrorScale<dimension>;

  // `z`: dimension(n) numbers at t = 0 (machine/model/parameters.hpp), then the four of a tilt. `error`: the integral
  // of the speed error there.
  EventTrajectory(const model::Parameters& p, model::Drive drive, const Scale& scale, const double* z,
                  double error = 0.0)
      : n(p.balls),
        p_(p),
        drive_(std::move(drive)),
        scale_(scale),
        modes_(p),
        flow_(p, drive_.pieces.front(), &modes_),
        balls_(p, flow_, modes_) {
    std::copy(z, z + model::dimension(n), state_.begin());
    if constexpr (tilt) std::copy_n(z + model::dimension(n), 4, &state_[layout().tilt]);
    state_[layout().psi] = drive_.psi;
    state_[layout().speed] = drive_.speed;
    state_[layout().error] = error;
    if (drive_.release_speed) rising_ = *drive_.release_speed > drive_.speed;
    clamped_ = drive_.release_time > 0.0 && !(drive_.release_speed && *drive_.release_speed == drive_.speed);
    if (clamped_)
      balls_.clamp(state_.data());
    else
      let_go();
  }
  EventTrajectory(const EventTrajectory&) = delete;
  EventTrajectory& operator=(const EventTrajectory&) = delete;

  double time() const { return t_; }
  const double* state() const { return state_.data(); }
  bool clamped() const { return clamped_; }
  // When the balls were released; infinite before.
  double released() const { return released_; }
  // Events that changed what the balls do, release included.
  long events() const { return events_; }
  // The mode of the balls in the present step.
  const model::BallMode& mode() const { return balls_.mode(); }

  // Enters the next piece of the drive if its time has come; psi' may jump.
  void enter() {
    while (t_ >= piece().end) cross();
  }

  // Advances to `end`, or until observe(from, to, state_at), called after each step, returns true; state_at(t, out)
  // gives the state within the step. Returns early, as `done`, once `stop` is set.
  template <class Observe>
  IntegrationStatus advance(double end, Observe&& observe, const StopFlag* stop = nullptr) {
    bool ended = false;
    while (t_ < end && !ended && !is_set(stop)) {
      enter();
      if (clamped_ && t_ >= drive_.release_time) release();
      double until = std::min(end, piece().end);
      if (clamped_) until = std::min(until, drive_.release_time);
      event_ = false;
      AdaptiveIntegrator<Flow, dimension> integrator(flow_, scale_, flow_.size());
      const IntegrationStatus status = integrator.advance(
          t_, until, state_.data(),
          [&](double from, double to, auto&& state_at) {
            const double last = first_event(from, to, state_at);
            ended = observe(from, last, state_at);
            // The integrator stops only at a time before the step's end, even if by one rounding.
            return ended || event_ ? std::min(last, std::nextafter(to, from)) : to;
          },
          stop);
      if (status != IntegrationStatus::done) return status;
      t_ = integrator.reached();
      if (event_ && !pass_event()) return IntegrationStatus::failed;
    }
    return IntegrationStatus::done;
  }

 private:
  const model::DrivePiece& piece() const { return drive_.pieces[piece_]; }
  const model::StateLayout& layout() const { return flow_.layout(); }

  // Enters the next piece of the drive; psi' may jump if it is prescribed there.
  void cross() {
    ++piece_;
    flow_.enter(piece());
    if (piece().driven()) return;
    double& speed = state_[layout().speed];
    model::apply_speed_jump(piece().speed - speed, state_.data(), layout().tilt);
    speed = piece().speed;
    state_[layout().psi] = piece().psi;
  }

  void release() {
    clamped_ = false;
    ++events_;
    let_go();
  }

  void let_go() {
    released_ = t_;
    balls_.enter(t_, state_.data());
  }

  bool may_release(const double* z) const {
    const double speed = z[layout().speed];
    return rising_ ? speed >= *drive_.release_speed : speed <= *drive_.release_speed;
  }

  bool watches() const { return clamped_ ? drive_.release_speed.has_value() : p_.balls_collide() || p_.balls_stick(); }

  // The time of the first event in the step, or the step's end. Four times in the step are checked: the tolerance keeps
  // a step to a small part of any ball's swing.
  template <class StateAt>
  double first_event(double from, double to, StateAt&& state_at) {
    if (!watches()) return to;
    if (!clamped_ && !p_.balls_stick()) {
      double begin[dimension], end[dimension];
      state_at.roughly(from, begin);
      state_at.roughly(to, end);
      if (!balls_.may_meet(to - from, begin, end)) return to;
    }
    const auto release = [&](double t) {
      double z[dimension];
      state_at(t, z);
      return may_release(z);
    };
    const auto first = clamped_ ? first_time(from, to, release) : balls_.first(from, to, state_at);
    event_ = first.has_value();
    return first.value_or(to);
  }

  // False if events at this time never end.
  bool pass_event() {
    if (!count_.add(t_)) return false;
    if (clamped_) {
      release();
      return true;
    }
    if (balls_.pass(t_, state_.data(), balls_.happened(), count_.hold())) ++events_;
    return true;
  }

  const model::BallCount<room> n;
  const model::Parameters& p_;
  const model::Drive drive_;
  Scale scale_;
  ModeTable<double, room> modes_;
  Flow flow_;
  BallEvents<room, tilt> balls_;
  EventCount count_;
  std::array<double, dimension> state_{};
  double t_ = 0.0, released_ = std::numeric_limits<double>::infinity();
  std::size_t piece_ = 0;
  long events_ = 0;
  bool clamped_ = false, rising_ = true, event_ = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
