// The equations of motion, once, for every number type: n balls, prescribed or driven rotor, rotating frame.
//
// Rows are those of docs/explanation/equations.md ("Equations of motion"), which derives them and lists the misprints
// of Wright and Peng (2019) that they correct. State: machine/model/parameters.hpp. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_EQUATIONS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_EQUATIONS_INL
#undef EQUIPOISE_MODEL_EQUATIONS_INL
#else
#define EQUIPOISE_MODEL_EQUATIONS_INL
#endif

#include <type_traits>

#include "equipoise/machine/model/equation_constants-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// n balls: as many as there is room for, or with room for any_count those of the parameters
// (machine/model/ball_count.hpp). With no room no ball runs free.
//
// One balance of forces holds for all of them: M A + arm psi'' = F at the race's centre O', summed over a body and the
// balls that are free to run around it. Rotor and free balls, rotor and balls as one body, bodies that a motor turns:
// they differ in what the sums run over.
template <class T, int room, Terms terms>
class BallBalancer : public BalancerConstants<T, room, terms> {
  using Constants = BalancerConstants<T, room, terms>;

 public:
  static constexpr int dimension = model::dimension(room);

  using Constants::Constants;

  // What springs and dampers exert on the support for the centre's motion, in rotating components (fx, fy).
  HWY_INLINE Vector2<T> bearing_force(const RotorMotion<T>& rotor, const T* z) const {
    const T x = z[0], y = z[1], u = z[2], v = z[3];
    Vector2<T> f{zeta_mean_ * u + kappa_mean_ * x, zeta_mean_ * v + kappa_mean_ * y};
    if constexpr (terms.anisotropy) {
      const T s2 = T(2.0) * rotor.sin_psi * rotor.cos_psi;
      const T c2 = rotor.cos_psi * rotor.cos_psi - rotor.sin_psi * rotor.sin_psi;
      f.x = f.x + zeta_half_ * (c2 * u - s2 * v) + kappa_half_ * (c2 * x - s2 * y);
      f.y = f.y - zeta_half_ * (s2 * u + c2 * v) - kappa_half_ * (s2 * x + c2 * y);
    }
    return f;
  }

  // dz/dt with all balls free, the race centred and psi'' prescribed.
  HWY_INLINE void free_derivative(const RotorMotion<T>& rotor, const T* z, T* dz) const {
    static_assert(!terms.body && !terms.actions);
    Sums sums{};
    balance(rotor, rotor_, nullptr, nullptr, z, sums, dz);
  }

  // dz/dt with any body in the rotor's place, all balls free. `torque`: the motor's, under which psi'' is solved for;
  // null where psi'' is prescribed.
  HWY_INLINE BodyResult<T> body_derivative(const RotorMotion<T>& rotor, const Body<T>& body, const T* torque,
                                           const T* z, T* dz) const {
    static_assert(terms.body && !terms.actions);
    Sums sums{};
    return balance(without_solved(rotor, torque), body, nullptr, torque, z, sums, dz);
  }
  HWY_INLINE BodyResult<T> body_derivative(const RotorMotion<T>& rotor, const T* torque, const T* z, T* dz) const {
    return body_derivative(rotor, rotor_, torque, z, dz);
  }

  // The same, with given actions on the balls.
  HWY_INLINE BodyResult<T> full_derivative(const RotorMotion<T>& rotor, const BallActions<T, room>& actions,
                                           const T* torque, const T* z, T* dz) const {
    static_assert(terms.body && terms.actions);
    Sums sums{};
    const Body<T> body = with_held_balls(actions, z, sums);
    return balance(without_solved(rotor, torque), body, &actions, torque, z, sums, dz);
  }

 private:
  using Constants::n, Constants::places, Constants::rotor_, Constants::zeta_mean_, Constants::zeta_half_,
      Constants::kappa_mean_, Constants::kappa_half_, Constants::gravity_, Constants::inertia_sum_, Constants::mu_,
      Constants::beta_, Constants::drag_force_, Constants::offset_, Constants::carried_, Constants::effective_arm_,
      Constants::euler_factor_, Constants::inertia_along_, Constants::inverse_inertia_, Constants::sizes_differ_,
      Constants::sliding_mass, Constants::along_race, Constants::times_arm, Constants::tilt_;
  // What is done for one lane and not for another is done for both and distinguished afterwards.
  static constexpr bool masked = terms.actions && !std::is_same_v<MaskOf<T>, bool>;

  static HWY_INLINE bool is_held(const BallActions<T, room>* actions, int i) {
    if constexpr (terms.actions && !masked)
      return actions->held[i];
    else
      return false;
  }
  // Nothing where a ball is held.
  static HWY_INLINE T if_free([[maybe_unused]] const BallActions<T, room>* actions, [[maybe_unused]] int i,
                              const T& v) {
    if constexpr (masked)
      return select(actions->held[i], T(0.0), v);
    else
      return v;
  }

  // What acts on O', and what it has to move.
  struct Sums {
    T s[places], c[places];  // of phi_i
    T force_x, force_y;      // Fx, Fy
    T resisting_y;           // taken from Fy with the first ball
    T inertia_y, coupling;   // of M: yy, and xy = yx
    // Of bodies.
    T inertia_sum;            // xx + yy
    T moment;                 // about O', of balls and supports on the body
    Vector2<T> friction_arm;  // sum of resistance times radial direction: what A takes from the moment
    Vector2<T> carried;       // unbalance of what free balls have fixed to the race
    T joined_inertia;         // what joined balls of different size add to the body's
    [[no_unique_address]] std::conditional_t<terms.tilt, TiltSums<T>, NoTilt> tilt;
  };

  // M's inverse is times_divisor() over divisor(); where no ball is free M is the body's mass.
  static HWY_INLINE T divisor(const Matrix2<T>& m) {
    if constexpr (room == 0)
      return m.yy;
    else
      return m.determinant();
  }
  static HWY_INLINE Vector2<T> times_divisor(const Matrix2<T>& m, const Vector2<T>& v) {
    if constexpr (room == 0)
      return v;
    else
      return m.adjugate(v);
  }

  // psi'' enters forces in proportion: those without it come first where it is solved for.
  static HWY_INLINE RotorMotion<T> without_solved(RotorMotion<T> rotor, const T* torque) {
    if (torque) rotor.acceleration = T(0.0);
    return rotor;
  }

  // dz/dt from M A + arm psi'' = F and, of bodies, (arm + friction_arm) A + J psi'' = torque + moment. Moments are
  // about O', so that the normal force of a ball has none.
  HWY_INLINE auto balance(const RotorMotion<T>& rotor, const Body<T>& body, const BallActions<T, room>* actions,
                          const T* torque, const T* z, Sums& sums, T* dz) const {
    const Vector2<T> f = bearing_force(rotor, z);
    add_body(rotor, body, f, sums);
    if constexpr (terms.tilt) tilt_.add_body(rotor, z, sums.force_x, sums.force_y, sums.tilt);
    for (int i = 0; i < n; ++i)
      if (masked || !terms.actions || !is_held(actions, i)) add_ball(i, rotor, actions, z, sums);
    const T& inertia_sum = terms.body ? sums.inertia_sum : inertia_sum_;
    Matrix2<T> m{inertia_sum - sums.inertia_y, sums.coupling, sums.coupling, sums.inertia_y};
    if constexpr (terms.actions)
      for (int i = 0; i < n && actions->acted_on; ++i) add_actions(i, rotor, *actions, z, sums, m);
    if constexpr (terms.actions)
      if (actions->together) join(rotor, *actions, z, sums, m);
    if constexpr (terms.tilt) return balance_tilt(rotor, body, actions, torque, z, sums, m, dz);
    // Symmetric positive definite, but for rolling resistance. The solution is left as solved times inverse, so that
    // all that can be done without the quotient need not wait for it.
    const T inverse = T(1.0) / divisor(m);
    Vector2<T> solved = times_divisor(m, {sums.force_x, sums.force_y});
    if constexpr (terms.body) {
      const BodyResult<T> result = solve_rotation(rotor, body, torque, sums, m, inverse, solved);
      const T w2 = rotor.speed * rotor.speed, a = result.acceleration;
      const T along = along_race(inverse);
      for (int i = 0; i < n; ++i) ball_rates(i, a, z, sums, solved, along, dz);
      if constexpr (terms.actions)
        for (int i = 0; i < n; ++i) apply_contact_and_friction(i, rotor, *actions, result, z, sums, dz);
      if constexpr (terms.actions)
        if (actions->together) move_together(*actions, dz);
      move_centre(rotor, z,
                  {result.race.x + w2 * offset_.x + a * offset_.y, result.race.y + w2 * offset_.y - a * offset_.x},
                  T(1.0), dz);
      return result;
    } else {
      const T along = along_race(inverse);
      for (int i = 0; i < n; ++i) ball_rates(i, rotor.acceleration, z, sums, solved, along, dz);
      move_centre(rotor, z, solved, inverse, dz);
    }
  }

  // The same where A and the acceleration of the slope depend on each other.
  HWY_INLINE BodyResult<T> balance_tilt(const RotorMotion<T>& rotor, const Body<T>& body,
                                        const BallActions<T, room>* actions, const T* torque, const T* z,
                                        const Sums& sums, const Matrix2<T>& m, T* dz) const {
    static_assert(terms.body && !terms.rolls);
    Wrench<T> solved{{sums.force_x, sums.force_y}, sums.tilt.moment};
    const BodyResult<T> result = solve_tilt(m, sums.tilt, body, rotor.acceleration, torque, sums.moment, solved);
    for (int i = 0; i < n; ++i) {
      ball_rates(i, result.acceleration, z, sums, tilt_.in_plane(i, solved), T(1.0), dz);
      if constexpr (terms.actions) apply_contact_and_friction(i, rotor, *actions, result, z, sums, dz);
    }
    move_centre(rotor, z, solved.centre, T(1.0), dz);
    tilt_.move(rotor, z, solved.tilt, dz);
    return result;
  }

  HWY_INLINE void add_body(const RotorMotion<T>& rotor, const Body<T>& body, const Vector2<T>& f, Sums& sums) const {
    const T w2 = rotor.speed * rotor.speed;
    sums.inertia_y = body.mass;
    if constexpr (terms.body) {
      static_assert(terms.acceleration);
      const T a = rotor.acceleration;
      sums.force_x = body.unbalance.x * w2 + body.unbalance.y * a - f.x;
      sums.force_y = body.unbalance.y * w2 - body.unbalance.x * a - f.y;
      sums.inertia_sum = T(2.0) * body.mass;
      sums.moment = offset_.x * f.y - offset_.y * f.x;  // supports act at -e from O'
    } else {
      sums.force_x = body.unbalance.x * w2 - f.x;
      sums.resisting_y = f.y;
      if constexpr (terms.acceleration) sums.resisting_y = sums.resisting_y + body.unbalance.x * rotor.acceleration;
    }
  }

  // A free ball.
  HWY_INLINE void add_ball(int i, const RotorMotion<T>& rotor, const BallActions<T, room>* actions, const T* z,
                           Sums& sums) const {
    const T q = z[4 + n + i];
    if constexpr (!terms.actions) sin_cos(z[4 + i], sums.s[i], sums.c[i]);
    const T s = sums.s[i], c = sums.c[i];
    const T total = rotor.speed + q;
    const T centrifugal = if_free(actions, i, mu_[i]) * total * total;
    const T sliding = if_free(actions, i, sliding_mass(i));
    const T mass_sine = sliding * s;
    const T drag = drag_force_[i] * q;
    T pull = drag;  // along the race
    if constexpr (terms.rolls && terms.acceleration)
      pull = drag - if_free(actions, i, carried_[i]) * rotor.acceleration;
    sums.force_x = sums.force_x + centrifugal * c - pull * s;
    const bool first = !terms.body && i == 0;
    sums.force_y = centrifugal * s + (first ? pull * c - sums.resisting_y : pull * c + sums.force_y);
    sums.inertia_y = sums.inertia_y + mass_sine * s;
    sums.coupling = sums.coupling + mass_sine * c;
    if constexpr (terms.tilt) tilt_.add_ball(i, centrifugal, pull, sliding, s, c, sums.tilt);
    if constexpr (terms.body) {
      sums.inertia_sum = sums.inertia_sum + sliding;
      sums.moment = sums.moment + times_arm(i, drag);
      if constexpr (terms.rolls) {
        const T carried = if_free(actions, i, carried_[i]);
        sums.carried = {sums.carried.x + carried * c, sums.carried.y + carried * s};
      }
    }
  }

  // The rotor and what it holds; sums receive sin and cos of all balls' angles.
  HWY_INLINE Body<T> with_held_balls(const BallActions<T, room>& actions, const T* z, Sums& sums) const {
    Body<T> body = rotor_;
    for (int i = 0; i < n; ++i) {
      sin_cos(z[4 + i], sums.s[i], sums.c[i]);
      if (!any(actions.held[i])) continue;
      const T mass = select(actions.held[i], mu_[i], T(0.0)),
              sliding = select(actions.held[i], sliding_mass(i), T(0.0));
      body.unbalance.x = body.unbalance.x + mass * sums.c[i];
      body.unbalance.y = body.unbalance.y + mass * sums.s[i];
      body.mass = body.mass + sliding;
      body.inertia = body.inertia + times_arm(i, times_arm(i, sliding));
      if constexpr (terms.tilt) tilt_.add_held(i, mass, sums.s[i], sums.c[i], sums.tilt);
    }
    return body;
  }

  // Pushes on a ball, and rolling resistance, which pulls the race along (-s, c) by k times the normal force
  // mu (total^2 - Ax c - Ay s).
  HWY_INLINE void add_actions(int i, const RotorMotion<T>& rotor, const BallActions<T, room>& actions, const T* z,
                              Sums& sums, Matrix2<T>& m) const {
    const T s = sums.s[i], c = sums.c[i];
    const T k = mu_[i] * actions.resistance[i];
    const T total = rotor.speed + z[4 + n + i];
    const T pull = k * total * total;
    const T along = along_race(actions.push[i] - pull), tilt = along_race(k), friction_arm = times_arm(i, tilt);
    sums.force_x = sums.force_x + along * s;
    sums.force_y = sums.force_y - along * c;
    sums.moment = sums.moment + times_arm(i, along_race(pull));
    m.xx = m.xx - tilt * s * c;
    m.xy = m.xy - tilt * s * s;
    m.yx = m.yx + tilt * c * c;
    m.yy = m.yy + tilt * c * s;
    sums.friction_arm.x = sums.friction_arm.x + friction_arm * c;
    sums.friction_arm.y = sums.friction_arm.y + friction_arm * s;
    // Pushes sum to 0, and have a moment only where balls of different size spin them away.
    if constexpr (terms.rolls) sums.moment = sums.moment + actions.push[i] * (T(1.0) - euler_factor_[i]);
  }

  // Balls joined to others push each other until their rates are equal: ball i feels mu_i d_i, where d_i is the mean of
  // its group's q' without pushes, by mass, less its own. Those rates are rest + g A - (Euler factor) psi''; what of
  // d_i is known goes to the forces, what A and psi'' make of it to their factors.
  HWY_INLINE void join(const RotorMotion<T>& rotor, const BallActions<T, room>& actions, const T* z, Sums& sums,
                       Matrix2<T>& m) const {
    T rest[places], gx[places], gy[places];
    for (int i = 0; i < n; ++i) {
      const T s = sums.s[i], c = sums.c[i], k = actions.resistance[i];
      const T q = z[4 + n + i], total = rotor.speed + q;
      rest[i] = actions.push[i] * inverse_inertia_[i] - along_race(k * total * total) - beta_[i] * q -
                euler_factor_[i] * rotor.acceleration;
      gx[i] = along_race(s + k * c);
      gy[i] = along_race(k * s - c);
    }
    for (int i = 0; i < n; ++i) {
      const T* share = actions.together[i];
      const T d = group_mean(share, rest) - rest[i], dx = group_mean(share, gx) - gx[i],
              dy = group_mean(share, gy) - gy[i];
      const T mass_sine = mu_[i] * sums.s[i], mass_cosine = mu_[i] * sums.c[i];
      sums.force_x = sums.force_x + mass_sine * d;
      sums.force_y = sums.force_y - mass_cosine * d;
      m.xx = m.xx - mass_sine * dx;
      m.xy = m.xy - mass_sine * dy;
      m.yx = m.yx + mass_cosine * dx;
      m.yy = m.yy + mass_cosine * dy;
      if (!sizes_differ_) continue;
      // Their spins take part of what they are pushed by, and the rotor feels the difference.
      const T euler = group_mean(share, euler_factor_) - euler_factor_[i],
              spin = inertia_along_[i] * (T(1.0) - euler_factor_[i]);
      sums.moment = sums.moment + spin * (d + euler * rotor.acceleration);  // what is of psi'' is in joined_inertia
      sums.joined_inertia = sums.joined_inertia + spin * euler;
      sums.carried = {sums.carried.x - mass_cosine * euler, sums.carried.y - mass_sine * euler};
      sums.friction_arm = {sums.friction_arm.x - spin * dx - mass_sine * euler,
                           sums.friction_arm.y - spin * dy + mass_cosine * euler};
    }
  }

  HWY_INLINE T group_mean(const T* share, const T* values) const {
    T sum = share[0] * values[0];
    for (int j = 1; j < n; ++j) sum = sum + share[j] * values[j];
    return sum;
  }

  HWY_INLINE void move_together(const BallActions<T, room>& actions, T* dz) const {
    T own[places];
    for (int i = 0; i < n; ++i) own[i] = dz[4 + n + i];
    for (int i = 0; i < n; ++i) {
      dz[4 + n + i] = group_mean(actions.together[i], own);
      if (actions.forces) actions.forces->push[i] = dz[4 + n + i] - own[i];
    }
  }

  // psi'' under a torque, or the torque that the prescribed one needs. `solved` was without psi'' where it is solved
  // for, and is with it afterwards.
  HWY_INLINE BodyResult<T> solve_rotation(const RotorMotion<T>& rotor, const Body<T>& body, const T* torque,
                                          const Sums& sums, const Matrix2<T>& m, const T& inverse,
                                          Vector2<T>& solved) const {
    const Vector2<T> arm{-(body.unbalance.y + sums.carried.y), body.unbalance.x + sums.carried.x};
    const auto row = [&](const Vector2<T>& v) {
      return ((arm.x + sums.friction_arm.x) * v.x + (arm.y + sums.friction_arm.y) * v.y) * inverse;
    };
    T a = rotor.acceleration, inertia = body.inertia;
    if constexpr (terms.actions) inertia = inertia + sums.joined_inertia;
    if (torque) {
      const Vector2<T> response = times_divisor(m, arm);
      a = (*torque + sums.moment - row(solved)) / (inertia - row(response));
      solved = {solved.x - a * response.x, solved.y - a * response.y};
    }
    return {{solved.x * inverse, solved.y * inverse}, a, torque ? *torque : inertia * a + row(solved) - sums.moment};
  }

  // Rates of ball i where the race's centre accelerates by (solved) inverse; `along`: along_race(inverse).
  HWY_INLINE void ball_rates(int i, const T& acceleration, const T* z, const Sums& sums, const Vector2<T>& solved,
                             const T& along, T* dz) const {
    const T q = z[4 + n + i];
    T resisting = beta_[i] * q;
    if constexpr (terms.acceleration && terms.rolls)
      resisting = resisting + acceleration * euler_factor_[i];
    else if constexpr (terms.acceleration)
      resisting = resisting + acceleration;
    dz[4 + i] = q;
    dz[4 + n + i] = (solved.x * sums.s[i] - solved.y * sums.c[i]) * along - resisting;
  }

  // What actions change in the rates of ball i.
  HWY_INLINE void apply_contact_and_friction(int i, const RotorMotion<T>& rotor, const BallActions<T, room>& actions,
                                             const BodyResult<T>& result, const T* z, const Sums& sums, T* dz) const {
    const Vector2<T>& race = result.race;
    const T total = rotor.speed + z[4 + n + i];
    const T normal = total * total - race.x * sums.c[i] - race.y * sums.s[i];
    if (actions.acted_on)
      dz[4 + n + i] =
          dz[4 + n + i] + actions.push[i] * inverse_inertia_[i] - along_race(actions.resistance[i] * normal);
    if (any(actions.held[i])) {
      dz[4 + i] = select(actions.held[i], T(0.0), dz[4 + i]);
      dz[4 + n + i] = select(actions.held[i], T(0.0), dz[4 + n + i]);
    }
    if (!actions.forces) return;
    actions.forces->normal[i] = normal;
    actions.forces->tangential[i] = race.x * sums.s[i] - race.y * sums.c[i] - effective_arm_[i] * result.acceleration;
    actions.forces->push[i] = T(0.0);
  }

  // d/dt of (x, y, u, v) where O accelerates by a factor, less gravity.
  HWY_INLINE void move_centre(const RotorMotion<T>& rotor, const T* z, const Vector2<T>& a, const T& factor,
                              T* dz) const {
    const T w = rotor.speed;
    dz[0] = z[2] + w * z[1];
    dz[1] = z[3] - w * z[0];
    dz[2] = a.x * factor + w * z[3];
    dz[3] = a.y * factor - w * z[2];
    if constexpr (terms.gravity) {  // acts only through A = acceleration + (g sin psi, g cos psi)
      dz[2] = dz[2] - gravity_ * rotor.sin_psi;
      dz[3] = dz[3] - gravity_ * rotor.cos_psi;
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
