// Events of balls that collide or stick: impacts, joining and parting, stops and starts. One trajectory and lanes both
// use them. Included once per CPU target.
#if defined(EQUIPOISE_INTEGRATE_BALL_EVENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_BALL_EVENTS_INL
#undef EQUIPOISE_INTEGRATE_BALL_EVENTS_INL
#else
#define EQUIPOISE_INTEGRATE_BALL_EVENTS_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/integrate/ball_rest-inl.hpp"
#include "equipoise/simulation/integrate/first_time.hpp"
#include "equipoise/machine/model/hybrid_flow-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Detects series of events at one time that never end.
class EventCount {
 public:
  // Counts an event at `time`. False after too many at one time: no sequence of events then describes the balls, and
  // the trajectory is given up.
  bool add(double time) {
    at_once_ = time - last_ > 1e-12 * std::max(1.0, time) ? 0 : at_once_ + 1;
    last_ = time;
    return at_once_ <= most_at_once;
  }

  // Factor on friction's limit: 1, but less by rounding where friction holds and lets go by turns at one time.
  double hold() const { return at_once_ == 0 ? 1.0 : 1.0 - std::ldexp(1e-14, std::min(at_once_, 20)); }

 private:
  static constexpr int most_at_once = 200;
  double last_ = -1.0;
  int at_once_ = 0;
};

// The events found at a state.
template <int room>
struct Happened {
  std::array<bool, room> pair{};  // meets, or is joined and pulls
  std::array<bool, room> ball{};  // has stopped
  bool any = false;               // one of these, or friction no longer holds a ball
};

// Events of one trajectory in doubles. Pair k: the ball in place k around the race and the next one. Its gap is the
// angle between them beyond touching. The mode, a function of the state, is found by enter() and holds between events.
template <int room, bool tilt = false>
class BallEvents {
 public:
  using Flow = HybridFlow<double, room, tilt>;
  using Modes = ModeTable<double, room>;
  static constexpr int dimension = Flow::dimension;

  // `flow` reads `modes`, which this class keeps equal to its own mode.
  BallEvents(const model::Parameters& p, Flow& flow, Modes& modes)
      : n(p.balls), pairs_(p.balls_collide() && n > 1 ? n : 0), p_(p), flow_(flow), modes_(modes) {}

  const model::BallMode& mode() const { return mode_; }
  void set_mode(const model::BallMode& mode) {
    mode_ = mode;
    modes_.set(mode_);
  }

  // All balls held by the clamp.
  void clamp(const double* z) {
    put_in_order(z);
    for (int i = 0; i < n; ++i) mode_.held[i] = true;
    modes_.set(mode_);
  }

  // Finds the mode at a state, and makes rates equal that differ only by rounding.
  void enter(double t, double* z) {
    put_in_order(z);
    for (int k = 0; k < pairs_; ++k) mode_.joined[k] = touches(k, z) && std::fabs(gap_rate(k, z)) < joined_rate;
    settle_all(t, z, 1.0);
  }

  double gap(int k, const double* z) const {
    return z[4 + ahead(k)] - z[4 + mode_.order[k]] + mode_.turns[k] - p_.contact_angle;
  }
  double gap_rate(int k, const double* z) const { return z[4 + n + ahead(k)] - z[4 + n + mode_.order[k]]; }

  // Whether pairs may meet, or joined ones part, in a step between two states. A pair cannot meet if its gap exceeds
  // what both rates allow, with a factor of three for rates in between.
  bool may_meet(double h, const double* from, const double* to) const {
    for (int k = 0; k < pairs_; ++k) {
      const double rates = std::fabs(gap_rate(k, from)) + std::fabs(gap_rate(k, to));
      if (mode_.joined[k] || std::min(gap(k, from), gap(k, to)) < 3.0 * h * rates + 0.1 * h * h) return true;
    }
    return false;
  }

  // The time of the first event in a step; empty if there is none. Times count from `origin`. `by_forces`: whether
  // forces can also cause events, not only gaps and rates. `share`: see first_time().
  template <class StateAt>
  std::optional<double> first(double from, double to, StateAt&& state_at, bool by_forces = true, double origin = 0.0,
                              double share = 0.0) {
    double z[dimension];
    return first_time(
        from, to,
        [&](double t) {
          state_at(t, z);
          const Happened<room> now = look(origin + t, z, by_forces);
          if (now.any) happened_ = now;
          return now.any;
        },
        [&](double low, double high) { return nearest(low, high, state_at, share * (to - from)); }, share);
  }
  const Happened<room>& happened() const { return happened_; }

  // For first(): the share by which friction holds balls at rest beyond its limit.
  void hold_on(double share) { hold_on_ = share; }

  // Carries out at `z` the event that first() found. `hold`: factor on friction's limit, other than 1 if friction would
  // hold and release for ever. False if nothing has changed: it was an event due to rounding alone.
  bool pass(double t, double* z, const Happened<room>& now, double hold = 1.0) {
    const model::BallMode before = mode_;
    std::array<bool, room> touching{};
    for (int i = 0; i < n; ++i)
      if (now.ball[i]) stop(i, z);
    for (int k = 0; k < pairs_; ++k) {
      if (now.pair[k] && mode_.joined[k])
        mode_.joined[k] = false;
      else
        touching[k] = now.pair[k] || mode_.joined[k] || touches(k, z);
    }
    const bool struck = collide(t, touching, z);
    for (int k = 0; k < pairs_; ++k) mode_.joined[k] = touching[k] && std::fabs(gap_rate(k, z)) < joined_rate;
    settle_all(t, z, hold);
    return struck || !(mode_ == before);
  }

 private:
  // A rebound slower than this, in omega_c, ends a series of ever shorter ones: the balls stay together. They would
  // part by less than 1e-10 rad.
  static constexpr double joining_rate = 1e-6;
  static constexpr double joined_rate = 1e-9, touching_gap = 1e-9;

  int ahead(int k) const { return mode_.order[(k + 1) % n]; }
  bool touches(int k, const double* z) const { return std::fabs(gap(k, z)) < touching_gap; }
  bool rests(int i, const double* z) const { return z[4 + n + i] == 0.0; }

  void put_in_order(const double* z) {
    mode_ = {};
    std::array<double, room> angle;
    for (int i = 0; i < n; ++i) {
      angle[i] = wrapped_positive(z[4 + i]);
      mode_.order[i] = i;
    }
    std::sort(mode_.order.begin(), mode_.order.begin() + n, [&](int a, int b) { return angle[a] < angle[b]; });
    for (int k = 0; k < pairs_; ++k) {
      const int a = mode_.order[k], b = ahead(k);
      const double away = angle[b] - angle[a] + (k == n - 1 ? two_pi : 0.0);
      mode_.turns[k] = std::round((away - (z[4 + b] - z[4 + a])) / two_pi) * two_pi;
    }
  }

  // Marks pairs that touch, joined ones that pull instead of press, balls that have stopped.
  Happened<room> look(double t, const double* z, bool by_forces) const {
    Happened<room> now;
    for (int k = 0; k < pairs_; ++k) {
      now.pair[k] = !mode_.joined[k] && gap(k, z) < 0.0 && gap_rate(k, z) < 0.0;
      now.any = now.any || now.pair[k];
    }
    for (int i = 0; i < n && p_.balls_stick(); ++i) {
      now.ball[i] = !mode_.held[i] && mode_.sense[i] * z[4 + n + i] < 0.0;
      now.any = now.any || now.ball[i];
    }
    if (!now.any && by_forces) look_at_forces(t, z, now);
    return now;
  }

  void look_at_forces(double t, const double* z, Happened<room>& now) const {
    if (!modes_.any_joined() && !(p_.balls_stick() && modes_.any_held())) return;
    double dz[dimension];
    BallForces<double, room> forces;
    flow_.evaluate(t, z, dz, forces);
    for (int k = 0; k < pairs_; ++k) {
      const int i = mode_.order[k];
      now.pair[k] = mode_.joined[k] && !mode_.held[i] && flow_.pressure(i, forces) < 0.0;
      now.any = now.any || now.pair[k];
    }
    if (p_.balls_stick() && modes_.any_held())
      each_row([&](const std::array<int, room>& balls, int size) {
        const RestingRow<room> row = resting_row(balls, size, forces, 1.0 + hold_on_);
        for (int g = 0; g < row.groups(); ++g) now.any = now.any || row.group(g).goes() != 0.0;
      });
  }

  // The time between two at which an approaching pair turns back, if it overlaps there.
  template <class StateAt>
  std::optional<double> nearest(double low, double high, StateAt& state_at, double width) const {
    double from[dimension], to[dimension], z[dimension];
    if (pairs_ == 0) return std::nullopt;
    state_at(low, from);
    state_at(high, to);
    std::optional<double> first;
    for (int k = 0; k < pairs_; ++k) {
      if (mode_.joined[k] || !(gap_rate(k, from) < 0.0 && gap_rate(k, to) > 0.0)) continue;
      double before = low, after = high;
      for (;;) {
        const double middle = 0.5 * (before + after);
        if (!(before < middle && middle < after) || after - before < width) break;
        state_at(middle, z);
        (gap_rate(k, z) < 0.0 ? before : after) = middle;
      }
      state_at(before, z);
      if (gap(k, z) < 0.0 && before > low && (!first || before < *first)) first = before;
    }
    return first;
  }

  // Stops ball i and those that move as one with it.
  void stop(int i, double* z) const {
    z[4 + n + i] = 0.0;
    for (int j = 0; j < n; ++j)
      if (modes_.together[i][j] != 0.0) z[4 + n + j] = 0.0;
  }

  // Impacts run through a row of touching balls. Each loses energy; late ones count as plastic. False without any.
  bool collide(double t, const std::array<bool, room>& touching, double* z) const {
    const int most_impacts = 64 * n;
    for (int impact = 0; impact < 2 * most_impacts; ++impact) {
      int worst = -1;
      double fastest = -1e-14;
      for (int k = 0; k < pairs_; ++k)
        if (touching[k] && gap_rate(k, z) < fastest) fastest = gap_rate(k, z), worst = k;
      if (worst < 0) return impact > 0;
      const bool slow = p_.restitution * -fastest < joining_rate;
      strike(t, worst, slow || impact > most_impacts ? 0.0 : p_.restitution, z);
    }
    return true;
  }

  // Newton's law of impact on pair k: the rate of the gap changes sign and shrinks to `restitution` of itself.
  void strike(double t, int k, double restitution, double* z) const {
    double change[dimension];
    flow_.impulse_response(t, z, mode_.order[k], ahead(k), change);
    const double impulse = -(1.0 + restitution) * gap_rate(k, z) / gap_rate(k, change);
    for (int i = 0; i < flow_.size(); ++i) z[i] += impulse * change[i];
    if (restitution == 0.0) z[4 + n + ahead(k)] = z[4 + n + mode_.order[k]];  // exactly, not only to rounding
  }

  // Finds from rates and contacts which balls are held and which move as one.
  void settle_all(double t, double* z, double hold) {
    for (int k = 0; k < pairs_; ++k)  // a resting and a moving ball are never joined
      mode_.joined[k] = mode_.joined[k] && (!p_.balls_stick() || rests(mode_.order[k], z) == rests(ahead(k), z));
    put_together(z);
    for (int i = 0; i < n; ++i) {
      const double rate = z[4 + n + i];
      mode_.sense[i] = (rate > 0.0) - (rate < 0.0);
      mode_.held[i] = p_.balls_stick() && rate == 0.0;
    }
    modes_.set(mode_);
    for (int round = 0; round < n && modes_.any_held(); ++round)
      if (!let_go(t, z, hold)) break;
    part_those_that_pull(t, z);
  }

  // Gives joined balls one rate and makes them touch.
  void put_together(double* z) const {
    for (int first = 0; first < pairs_; ++first) {
      if (!mode_.joined[first] || mode_.joined[(first + n - 1) % n]) continue;
      std::array<double, room> away{};  // of each ball from its place in a row that touches
      double mass = 0.0, rate = 0.0, shift = 0.0;
      int size = 0;
      for (int k = first;; k = (k + 1) % n) {
        const int i = mode_.order[k];
        mass += p_.mass[i];
        rate += p_.mass[i] * z[4 + n + i];
        shift += p_.mass[i] * away[size];
        ++size;
        if (!mode_.joined[k]) break;
        away[size] = away[size - 1] + gap(k, z);
      }
      for (int a = 0; a < size; ++a) {
        const int i = mode_.order[(first + a) % n];
        z[4 + i] += shift / mass - away[a];
        z[4 + n + i] = rate / mass;
      }
    }
  }

  // Calls f with every row of held touching balls, the rearmost ball first.
  template <class F>
  void each_row(F&& f) const {
    const auto linked = [&](int k) { return pairs_ > 0 && mode_.joined[k] && mode_.held[mode_.order[k]]; };
    for (int first = 0; first < n; ++first) {
      if (!mode_.held[mode_.order[first]] || linked((first + n - 1) % n)) continue;
      std::array<int, room> places;
      int size = 0;
      for (int k = first;; k = (k + 1) % n) {
        places[size++] = k;
        if (!linked(k)) break;
      }
      f(places, size);
    }
  }

  RestingRow<room> resting_row(const std::array<int, room>& places, int size, const BallForces<double, room>& forces,
                               double hold) const {
    RestingRow<room> row;
    for (int a = 0; a < size; ++a) {
      const int i = mode_.order[places[a]];
      const double most = hold * p_.mass[i] * p_.stiction[i] * std::fabs(forces.normal[i]);
      row.add(p_.mass[i] * forces.tangential[i], most, p_.mass[i]);
    }
    return row;
  }

  // Lets balls go that friction does not hold, which changes the forces on the rest. False if there are none.
  bool let_go(double t, const double* z, double hold) {
    double dz[dimension];
    BallForces<double, room> forces;
    flow_.evaluate(t, z, dz, forces);
    bool any = false;
    model::BallMode next = mode_;
    each_row([&](const std::array<int, room>& places, int size) {
      const RestingRow<room> row = resting_row(places, size, forces, hold);
      for (int g = 0; g < row.groups(); ++g) {
        const double goes = row.group(g).goes();
        const bool leaves = g + 1 < row.groups() && (goes != 0.0 || row.group(g + 1).goes() != 0.0);
        if (leaves) next.joined[places[row.group(g).last]] = false;
        if (goes == 0.0) continue;
        any = true;
        for (int a = row.group(g).first; a <= row.group(g).last; ++a) {
          next.held[mode_.order[places[a]]] = false;
          next.sense[mode_.order[places[a]]] = goes > 0.0 ? 1 : -1;
        }
      }
    });
    if (any) set_mode(next);
    return any;
  }

  void part_those_that_pull(double t, const double* z) {
    for (int round = 0; round < n && modes_.any_joined(); ++round) {
      double dz[dimension];
      BallForces<double, room> forces;
      flow_.evaluate(t, z, dz, forces);
      int worst = -1;
      double least = 0.0;
      for (int k = 0; k < pairs_; ++k) {
        if (!mode_.joined[k] || mode_.held[mode_.order[k]]) continue;
        const double pressure = flow_.pressure(mode_.order[k], forces);
        if (pressure < least) least = pressure, worst = k;
      }
      if (worst < 0) return;
      mode_.joined[worst] = false;
      modes_.set(mode_);
    }
  }

  const model::BallCount<room> n;
  const int pairs_;
  const model::Parameters& p_;
  Flow& flow_;
  Modes& modes_;
  model::BallMode mode_;
  Happened<room> happened_;
  double hold_on_ = 0.0;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
