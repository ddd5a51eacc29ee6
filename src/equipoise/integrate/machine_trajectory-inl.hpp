// One trajectory of a machine from event to event: pieces of the drive, release, balls that touch, stick or slide. All
// events are located in time, so that every step of the integrator is smooth. Included once per CPU target.
#if defined(EQUIPOISE_INTEGRATE_MACHINE_TRAJECTORY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_MACHINE_TRAJECTORY_INL
#undef EQUIPOISE_INTEGRATE_MACHINE_TRAJECTORY_INL
#else
#define EQUIPOISE_INTEGRATE_MACHINE_TRAJECTORY_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/stop_flag.hpp"
#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/integrate/ball_contacts-inl.hpp"
#include "equipoise/model/frames.hpp"
#include "equipoise/model/machine-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <int room>
class MachineTrajectory {
 public:
  static constexpr int dimension = model::machine_dimension(room);  // the largest size
  using Scale = ErrorScale<dimension>;

  // `z`: dimension(n) numbers at t = 0 (model/parameters.hpp). `error`: the integral of the speed error there.
  MachineTrajectory(const model::Parameters& p, const model::Drive& drive, const Scale& scale, const double* z,
                    double error = 0.0)
      : n(p.balls), p_(p), drive_(drive), scale_(scale), flow_(p), contacts_(p) {
    std::copy(z, z + model::dimension(n), state_.begin());
    state_[model::machine_index::psi(n)] = drive.psi;
    state_[model::machine_index::speed(n)] = drive.speed;
    state_[model::machine_index::error_integral(n)] = error;
    enter_piece();
    contacts_.begin(state_.data(), flow_);
    const double speed = drive.speed;
    if (drive.release_speed) rising_ = *drive.release_speed > speed;
    clamped_ = drive.release_time > 0.0 && !(drive.release_speed && *drive.release_speed == speed);
    if (clamped_)
      std::fill_n(flow_.held, n, true);
    else
      begin_free();
  }

  double time() const { return t_; }
  const double* state() const { return state_.data(); }
  bool clamped() const { return clamped_; }
  // When the balls were let go; infinite before.
  double released() const { return released_; }
  // Events that changed what the balls do, release included.
  long events() const { return events_; }
  // The equations of the present step, and with them what each ball does.
  const MachineFlow<room>& flow() const { return flow_; }
  // Of the ball in place k around the race and the next one, the angle between them beyond touching.
  double gap(int k) const { return contacts_.gap(k, state_.data(), flow_); }

  // Past the end of a piece of the drive, if the time is there: psi' may jump.
  void enter() {
    while (t_ >= flow_.drive.end) cross();
  }

  // Goes on to `end`, or until observe(from, to, state_at) answers true, which it is asked after each step; state_at(t,
  // out) is the state within. Ends early, as `done`, once `stop` is set.
  template <class Observe>
  IntegrationStatus advance(double end, Observe&& observe, const StopFlag* stop = nullptr) {
    bool ended = false;
    while (t_ < end && !ended && !is_set(stop)) {
      enter();
      if (clamped_ && t_ >= drive_.release_time) release();
      double until = std::min(end, flow_.drive.end);
      if (clamped_) until = std::min(until, drive_.release_time);
      event_ = false;
      AdaptiveIntegrator<MachineFlow<room>, dimension> integrator(flow_, scale_, flow_.size());
      const IntegrationStatus status = integrator.advance(
          t_, until, state_.data(),
          [&](double from, double to, auto&& state_at) {
            const double last = first_event(from, to, state_at);
            ended = observe(from, last, state_at);
            // Before the step's end, even if by nothing that matters, is where the integrator stops.
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
  // Events at one time after which a trajectory is given up: what the balls do then has no solution of this kind.
  static constexpr int most_events_at_once = 200;

  void enter_piece() { flow_.drive = drive_.pieces[piece_]; }

  // Into the next piece of the drive; psi' may jump there if it is prescribed.
  void cross() {
    ++piece_;
    enter_piece();
    if (flow_.drive.driven()) return;
    double& speed = state_[model::machine_index::speed(n)];
    model::apply_speed_jump(flow_.drive.speed - speed, state_.data());
    speed = flow_.drive.speed;
    state_[model::machine_index::psi(n)] = flow_.drive.psi;
  }

  void release() {
    clamped_ = false;
    ++events_;
    let_go();
  }

  // Balls that touch at the same rate press on each other or part.
  void begin_free() {
    let_go();
    if (p_.balls_collide()) contacts_.pass(t_, {}, state_.data(), flow_);
  }

  void let_go() {
    released_ = t_;
    std::fill_n(flow_.held, n, false);
    if (p_.balls_stick())
      for (int i = 0; i < n; ++i) settle_ball(i);
  }

  // Decides whether a ball at rest stays so; else in which sense it starts.
  void settle_ball(int i) {
    const double rate = state_[4 + n + i];
    flow_.rolling[i] = (rate > 0.0) - (rate < 0.0);
    if (rate != 0.0) return;
    flow_.held[i] = true;
    const auto forces = forces_on(i, state_.data());
    if (std::fabs(forces.tangential) <= p_.stiction[i] * std::fabs(forces.normal)) return;
    flow_.held[i] = false;
    flow_.rolling[i] = forces.tangential > 0.0 ? 1 : -1;
  }

  typename MachineFlow<room>::BallForces forces_on(int i, const double* z) const {
    double dz[dimension];
    return flow_.forces_on(i, z, flow_.evaluate(t_, z, dz));
  }

  // What has come to happen at a state: the release, to balls, to pairs of neighbours.
  struct Happened {
    bool release = false;
    std::array<bool, room> ball{}, pair{};
    bool any = false;
  };

  Happened look(double t, const double* z) const {
    Happened now;
    if (clamped_) {
      const double speed = z[model::machine_index::speed(n)];
      if (drive_.release_speed)
        now.release = now.any = rising_ ? speed >= *drive_.release_speed : speed <= *drive_.release_speed;
      return now;
    }
    if (p_.balls_collide()) now.any = contacts_.look(t, z, flow_, now.pair);
    if (!p_.balls_stick()) return now;
    BodyResult<double> result{};
    bool evaluated = false;
    for (int i = 0; i < n; ++i) {
      if (flow_.held[i]) {
        double dz[dimension];
        if (!evaluated) result = flow_.evaluate(t, z, dz);
        evaluated = true;
        const auto forces = flow_.forces_on(i, z, result);
        now.ball[i] = std::fabs(forces.tangential) > p_.stiction[i] * std::fabs(forces.normal);
      } else {
        now.ball[i] = flow_.rolling[i] * z[4 + n + i] < 0.0;
      }
      now.any = now.any || now.ball[i];
    }
    return now;
  }

  bool watches() const { return clamped_ ? drive_.release_speed.has_value() : p_.balls_collide() || p_.balls_stick(); }

  // The end of the step, or the time in it at which something first happens. Looked for at four places of a step, which
  // the tolerance keeps to a small part of any ball's swing.
  template <class StateAt>
  double first_event(double from, double to, StateAt&& state_at) {
    if (!watches()) return to;
    constexpr int looks = 4;
    double z[dimension], low = from;
    if (!clamped_ && !p_.balls_stick()) {
      double end[dimension];
      state_at.roughly(from, z);
      state_at.roughly(to, end);
      if (!contacts_.may_meet(to - from, z, end, flow_)) return to;
    }
    for (int k = 1; k <= looks; ++k) {
      double high = k == looks ? to : from + (to - from) * k / looks;
      state_at(high, z);
      Happened there = look(high, z);
      if (!there.any) {
        low = high;
        continue;
      }
      for (;;) {
        const double middle = 0.5 * (low + high);
        if (!(low < middle && middle < high)) break;
        state_at(middle, z);
        const Happened half = look(middle, z);
        (half.any ? high : low) = middle;
        if (half.any) there = half;
      }
      event_ = true;
      happened_ = there;
      return high;
    }
    return to;
  }

  // False if events do not come to an end at this time.
  bool pass_event() {
    at_once_ = t_ - last_event_ > 1e-12 * std::max(1.0, t_) ? 0 : at_once_ + 1;
    last_event_ = t_;
    if (at_once_ > most_events_at_once) return false;
    if (happened_.release) {
      release();
      return true;
    }
    ++events_;
    for (int i = 0; i < n; ++i) {
      if (!happened_.ball[i]) continue;
      if (flow_.held[i]) {
        flow_.rolling[i] = forces_on(i, state_.data()).tangential > 0.0 ? 1 : -1;
        flow_.held[i] = false;
      } else {
        state_[4 + n + i] = 0.0;
        settle_ball(i);
      }
    }
    if (p_.balls_collide()) contacts_.pass(t_, happened_.pair, state_.data(), flow_);
    return true;
  }

  const model::BallCount<room> n;
  const model::Parameters& p_;
  const model::Drive& drive_;
  Scale scale_;
  MachineFlow<room> flow_;
  BallContacts<room> contacts_;
  std::array<double, dimension> state_{};
  double t_ = 0.0, released_ = std::numeric_limits<double>::infinity();
  double last_event_ = -1.0;
  std::size_t piece_ = 0;
  int at_once_ = 0;
  long events_ = 0;
  bool clamped_ = false, rising_ = true, event_ = false;
  Happened happened_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
