// Integrates one body in double precision, piece by piece of the drive, watched by the sums of transients.
#include "equipoise/simulation/spin_up/held_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/simulation/integrate/first_time.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/hybrid_flow-inl.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/transients/transient_watch.hpp"

namespace equipoise {

namespace {

// One body; of a tilting rotor all balls, held, laid out as model::machine_layout().
template <bool tilt>
using OneBody = std::conditional_t<tilt, HWY_NAMESPACE::HybridFlow<double, model::any_count, true>,
                                   HWY_NAMESPACE::HeldFlow<double>>;

// How far a number still is from its limit: differences that shrink from d1 to d2 leave d2^2/(d1 - d2).
class Convergence {
 public:
  void add(double value) {
    earlier_ = before_;
    before_ = last_;
    last_ = value;
    ++count_;
  }
  double left() const {
    if (count_ < 3) return std::numeric_limits<double>::infinity();
    const double d1 = std::fabs(before_ - earlier_), d2 = std::fabs(last_ - before_);
    // Differences that do not shrink are the noise of windows without a whole number of turns, if they are small.
    return d2 < d1 ? std::min(d2 * d2 / (d1 - d2), 10.0 * d1) : 10.0 * d2;
  }

 private:
  double earlier_ = 0.0, before_ = 0.0, last_ = 0.0;
  int count_ = 0;
};

template <bool tilt>
class HeldFollower {
  using Body = OneBody<tilt>;

 public:
  HeldFollower(const Study& study, const InitialState& start, const TransientSettings& settings, const StopFlag* stop)
      : study_(study),
        p_(study.parameters),
        drive_(study.drive()),
        stop_(stop),
        window_(settings.window),
        watched_(by_hand(settings)),
        fixed_axes_(model::depends_on_rotor_angle(p_)),
        sag_(model::static_sag(p_)),
        modes_(p_),
        watch_(watched_) {
    for (const model::DrivePiece& piece : drive_.pieces) systems_.emplace_back(p_, piece);
    const model::System& first = systems_.front();
    initial_state(start, p_.balls, drive_.speed, full_.data());
    std::fill_n(&full_[model::index::q(0, p_.balls)], p_.balls, 0.0);
    if constexpr (tilt) {
      hold_all();
      initial_state(start, p_.balls, drive_.speed, y_.data(), layout().tilt);
      std::fill_n(&y_[model::index::q(0, p_.balls)], p_.balls, 0.0);
      y_[layout().psi] = drive_.pieces.front().prescribed ? drive_.pieces.front().psi : start.psi;
      y_[layout().speed] = drive_.speed;
    } else {
      std::array<double, max_dimension> state = full_;
      if (first.layout().psi >= 0) state[first.layout().psi] = start.psi;
      if (first.layout().speed >= 0) state[first.layout().speed] = drive_.speed;
      if (first.layout().error >= 0) state[first.layout().error] = 0.0;
      model::hold_balls(first, state.data(), y_.data());
    }
    const double* phi = &full_[model::index::phi(0)];
    turning_ = turning_unbalance(p_, watched_.shaft, phi);
    unbalance_ = size_of(turning_);
    size_ = std::max({p_.all_unbalances(), std::fabs(sag_), std::hypot(start.x, start.y)});
    if (size_ == 0.0) size_ = 1.0;
  }

  HeldRun run() {
    free_ = drive_.release_time <= 0.0;
    if (free_) run_.released = 0.0;
    for (piece_ = 0; piece_ + 1 < systems_.size() && going(); ++piece_) {
      begin();
      advance(drive_.pieces[piece_].end);
      cross();
    }
    if (going()) end();
    run_.sums = watch_.sums();
    return run_;
  }

 private:
  // Windows are opened by hand; the drive's work is left out, because it grows for as long as a motor is followed.
  static TransientSettings by_hand(TransientSettings settings) {
    settings.window = std::numeric_limits<double>::infinity();
    settings.work = WorkSource::none;
    return settings;
  }

  bool going() const { return !run_.lost && !is_set(stop_); }
  const model::DrivePiece& piece() const { return drive_.pieces[piece_]; }
  const model::System& system() const { return systems_[piece_]; }
  model::StateLayout layout() const {
    if constexpr (tilt)
      return model::machine_layout(p_);
    else
      return model::held_layout(system());
  }
  Body body() const {
    if constexpr (tilt)
      return {p_, piece(), &modes_};
    else
      return Body(system());
  }
  void hold_all() {
    model::BallMode mode;
    mode.held.fill(true);
    modes_.set(mode);
  }
  model::Segment segment() const { return piece().motion(true); }
  double speed(double t, const double* y) const {
    return piece().prescribed ? segment().speed_at(t) : y[layout().speed];
  }
  double psi(double t, const double* y) const {
    if (piece().prescribed) return segment().psi_at(t);
    return layout().psi >= 0 ? y[layout().psi] : 0.0;
  }

  // In fixed axes, where supports are simple; nothing sampled depends on the axes.
  TransientSample sample(double t, const double* y) const {
    if constexpr (tilt) {
      TransientSample here = transient_sample(p_, watched_.shaft, psi(t, y), t, y, y + layout().tilt);
      here.unbalance = turning_;
      for (auto& place : here.places) place.speed = speed(t, y);
      return here;
    }
    using namespace model::index;
    const double angle = fixed_axes_ ? psi(t, y) : 0.0, c = std::cos(angle), s = std::sin(angle);
    const std::array<double, 2> centre = model::in_fixed_axes(c, s, y[x], y[model::index::y]),
                                rate = model::in_fixed_axes(c, s, y[u], y[v]);
    const double up = centre[1] - sag_;
    const std::array<double, 2> force{p_.damping[0] * rate[0] + p_.stiffness[0] * centre[0],
                                      p_.damping[1] * rate[1] + p_.stiffness[1] * centre[1]};
    TransientSample sampled{t, turning_, {}};
    auto& here = sampled.places[0];
    here.r2 = centre[0] * centre[0] + up * up;
    here.slope = 2.0 * (centre[0] * rate[0] + up * rate[1]);
    here.force2 = force[0] * force[0] + force[1] * force[1];
    here.velocity2 = rate[0] * rate[0] + rate[1] * rate[1];
    const double dynamic = force[1] + model::total_weight(p_);
    here.dynamic2 = force[0] * force[0] + dynamic * dynamic;
    here.upright2 = rate[1] * rate[1];
    here.speed = speed(t, y);
    return sampled;
  }

  void begin() { watch_.begin(sample(t_, y_.data()), free_); }
  // Sums go on; the window begins here.
  void open_window() {
    watch_ = TransientWatch(watched_, watch_.sums());
    turned_ = 0.0;
    begin();
  }

  // To `to` within the piece; balls that would be released on the way count as free from then on.
  void advance(double to) {
    if (!free_ && drive_.release_time > t_ && drive_.release_time < to) integrate(drive_.release_time);
    while (going() && t_ < to) {
      if (!free_ && t_ >= drive_.release_time) let_go();
      integrate(to);
    }
    if (!free_ && t_ >= drive_.release_time) let_go();
  }

  void let_go() {
    free_ = true;
    run_.released = t_;
    begin();
  }

  bool reaches_release(double v) const {
    const double at = *drive_.release_speed;
    return at > drive_.speed ? v >= at : v <= at;
  }

  // To `to`, or to where a motor reaches the release speed.
  void integrate(double to) {
    const Body flow = body();
    HWY_NAMESPACE::ErrorScale<Body::dimension> scale;
    scale.tolerance = held_tolerance;
    scale.floor.fill(1.0);
    for (int i = 0; i < 4; ++i) scale.floor[i] = size_;
    if (tilt) std::fill_n(&scale.floor[layout().tilt], 4, size_);
    scale.angle.fill(true);
    scale.absolute.fill(true);
    HWY_NAMESPACE::AdaptiveIntegrator<Body, Body::dimension> integrator(flow, scale, flow.size());
    bool released = false;
    double v = speed(t_, y_.data());
    const auto watch = [&](double from, double t_new, auto&& state_at) {
      double until = t_new, y[Body::dimension];
      const auto speed_then = [&](double t) {
        state_at(t, y);
        return speed(t, y);
      };
      if (!free_ && drive_.release_speed && !piece().prescribed && reaches_release(speed_then(t_new))) {
        until = first_time(from, t_new, [&](double t) { return reaches_release(speed_then(t)); }).value_or(t_new);
        released = true;
      }
      watch_.step_to(until, [&](double t) {
        state_at(t, y);
        return sample(t, y);
      });
      const double last = speed_then(until);
      // Simpson's rule; where a motor's speed is constant enough for long steps, so is the middle.
      turned_ += (until - from) * (v + 4.0 * speed_then(0.5 * (from + until)) + last) / 6.0;
      v = last;
      return until;
    };
    const IntegrationStatus status = integrator.advance(t_, to, y_.data(), watch, stop_);
    t_ = integrator.reached();
    run_.lost = status != IntegrationStatus::done;
    if (released && going()) let_go();
  }

  // Into the next piece: psi' may jump, and with it u and v.
  void cross() {
    const model::DrivePiece& next = drive_.pieces[piece_ + 1];
    if (!piece().prescribed) return;
    const double jump = next.speed - segment().speed_at(piece().end);
    model::apply_speed_jump(jump, y_.data(), layout().tilt);
    if constexpr (tilt) {
      y_[layout().speed] = next.speed;
      y_[layout().psi] = next.psi;
    }
  }

  void end() {
    begin();
    const double slowest = slowest_decay();
    const bool damped = slowest > 0.0;
    const double horizon = piece().begin + *study_.numerics.horizon;
    if (!piece().prescribed || !damped) return come_to_rest(horizon);
    run_.end = tilt ? model::forced_vibration(p_, &full_[model::index::phi(0)], watched_.shaft.places,
                                              watched_.shaft.bearings, piece().speed)
                    : model::forced_vibration(p_, unbalance_, piece().speed);
    run_.end->unbalance = unbalance_;
    run_.speed = piece().speed;
    run_.steady = true;
    // Whatever the horizon was chosen for.
    const double last = std::max(horizon, piece().begin + 20.0 / slowest);
    for (int windows = 1; going() && t_ < last; ++windows) {
      open_window();
      advance(t_ + window_);
      const TransientSums sums = watch_.sums();
      if (seen_enough(watched_, {run_.end, 0.0}, {}, sums.window, windows, sums.free_peak.square)) return;
    }
  }

  // The rate at which the slowest deviation from forced vibration dies out.
  double slowest_decay() const {
    if (!tilt) return 0.5 * std::min(p_.damping[0], p_.damping[1]) / (1.0 + p_.total_mass());
    constexpr double rounding = 1e-9;
    const double rate = piece().prescribed ? model::slowest_decay(p_, piece().speed) : 0.0;
    return rate > rounding ? rate : 0.0;
  }

  // Until speed and displacement are nearly steady by the differences of windows. Windows grow, so that a slow change
  // shows in them.
  void come_to_rest(double horizon) {
    constexpr double alike = 3e-4, growth = 1.3, turns = 16.0;
    // What coasts, or is not damped, is not waited for; nor, for ever, a motor.
    const double patience = piece().prescribed || system().coasts() ? 5e3 : 2e5;  // rad
    double length = 4.0 * window_, angle = 0.0;
    Convergence speeds, peaks;
    if (drive_.release_time < horizon) advance(std::max(t_, drive_.release_time));
    while (going() && !run_.steady && t_ < horizon && std::fabs(angle) < patience) {
      open_window();
      const double from = t_;
      advance(std::min(t_ + length, horizon));
      if (!(t_ > from)) break;
      run_.speed = turned_ / (t_ - from);
      angle += turned_;
      const double peak = std::sqrt(watch_.sums().window.peak);
      speeds.add(run_.speed);
      peaks.add(peak);
      // A rotor that lingers at its resonance has to meet a tighter bound.
      const bool slow = study_.speed.driven() && std::fabs(run_.speed) < study_.stall_speed();
      run_.steady = speeds.left() <= (slow ? 0.1 : 1.0) * alike * std::max(std::fabs(run_.speed), 0.01) &&
                    peaks.left() <= 10.0 * alike * (peak + 1e-6 * size_);
      length *= growth;
    }
    if (!going() || !run_.steady) return;
    // Whole turns, over which what gravity and unequal supports do to the motion comes back.
    const double from = t_, turning = std::fabs(run_.speed);
    open_window();
    advance(t_ + (turning > 0.05 ? turns * two_pi / turning : 4.0 * window_));
    if (going()) run_.speed = turned_ / (t_ - from);
  }

  // A tight one, since figures are compared to a part in ten thousand.
  static constexpr double held_tolerance = 1e-9;

  const Study& study_;
  const model::Parameters& p_;
  const model::Drive drive_;
  const StopFlag* stop_;
  const double window_;
  const TransientSettings watched_;
  std::vector<model::System> systems_;        // one a piece
  std::array<double, max_dimension> full_{};  // the balls' angles, in a state of the system
  std::array<double, Body::dimension> y_{};
  const bool fixed_axes_;
  const double sag_;
  HWY_NAMESPACE::ModeTable<double, model::any_count> modes_;  // of a tilting rotor
  TurningUnbalance turning_{};
  double unbalance_ = 0.0, size_ = 1.0;
  TransientWatch watch_;
  std::size_t piece_ = 0;
  double t_ = 0.0, turned_ = 0.0;
  bool free_ = false;
  HeldRun run_;
};

}  // namespace

HeldRun follow_held(const Study& study, const InitialState& start, const TransientSettings& settings,
                    const StopFlag* stop) {
  if (study.parameters.tilts()) return HeldFollower<true>(study, start, settings, stop).run();
  return HeldFollower<false>(study, start, settings, stop).run();
}

void take_balls_off(Study& study, InitialState& start) {
  const model::Parameters with = study.parameters;
  study.parameters.mass = {};
  const double psi = start.psi, speed = study.drive().speed;
  const std::array<double, 2> before = model::rest_position(with, psi),
                              after = model::rest_position(study.parameters, psi);
  const double x = after[0] - before[0], y = after[1] - before[1];
  start.x += x;
  start.y += y;
  // The velocity in fixed axes stays.
  start.x_dot += speed * y;
  start.y_dot -= speed * x;
  const double slope = model::static_slope(study.parameters) - model::static_slope(with);
  const double tilt_x = slope * std::sin(psi), tilt_y = slope * std::cos(psi);
  start.tilt_x += tilt_x;
  start.tilt_y += tilt_y;
  start.tilt_x_dot += speed * tilt_y;
  start.tilt_y_dot -= speed * tilt_x;
}

}  // namespace equipoise
