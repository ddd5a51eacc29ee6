// The equations of motion, once, for every number type: n balls, prescribed or driven rotor, rotating frame.
//
// Rows are those of docs/equations.md ("Equations of motion"), which derives them and lists the misprints of
// Wright and Peng (2019) that they correct. State: model/parameters.hpp. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_EQUATIONS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_EQUATIONS_INL
#undef EQUIPOISE_MODEL_EQUATIONS_INL
#else
#define EQUIPOISE_MODEL_EQUATIONS_INL
#endif

#include <type_traits>

#include "equipoise/base/pack-inl.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/parameters.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Terms beyond the isotropic horizontal rotor at constant speed with balls that slide. A term that is off leaves no
// operation behind.
struct Terms {
  bool acceleration = true;
  bool anisotropy = true;
  bool gravity = true;
  bool body = false;     // any body in the rotor's place: a race off its centre, balls that are part of it; a motor
  bool actions = false;  // balls may be held, resist rolling or push each other
  bool rolls = true;     // balls roll if the parameters say so
};

// Of the paper's rotor: isotropic and horizontal, its balls slide.
constexpr Terms paper_terms(bool acceleration) {
  return {.acceleration = acceleration, .anisotropy = false, .gravity = false, .rolls = false};
}

// The rotor at one instant: psi' and psi''; sin and cos of psi are read only with anisotropy or gravity.
template <class T>
struct RotorMotion {
  T speed, acceleration, sin_psi, cos_psi;
};

// Components along the rotating axes.
template <class T>
struct Vector2 {
  T x, y;
};

template <class T>
struct Matrix2 {
  T xx, xy, yx, yy;

  HWY_INLINE T determinant() const { return xx * yy - xy * yx; }
  // Determinant times inverse, times v.
  HWY_INLINE Vector2<T> adjugate(const Vector2<T>& v) const { return {yy * v.x - xy * v.y, xx * v.y - yx * v.x}; }
};

// What turns as one with the rotor: itself, and balls that are held.
template <class T>
struct Body {
  Vector2<T> unbalance;  // mass times place of the centre of mass, from the race's centre O'
  T mass, inertia;       // inertia: moment about O'
};

// What balls feel, each over its mass.
template <class T, int room>
struct BallForces {
  T normal[room];      // by which it presses on the race, outward positive
  T tangential[room];  // that would set it moving if it were at rest and alone
  T push[room];        // by which those that it is joined with change its rate; 0 for all others
};

// What acts on the balls of a machine at one instant.
template <class T, int room>
struct BallActions {
  MaskOf<T> held[room] = {};  // turns with the rotor: clamped, or at rest by stiction
  bool acted_on = true;       // else the next two are 0 for all balls
  T resistance[room] = {};    // rolling resistance over normal force, with the sign of the ball's rate
  T push[room] = {};          // along phi_i, from other balls: mu_i phi_i'' for a ball alone; they sum to 0
  // Of balls that touch and move as one; null: none do. Row i: of each ball of the group of ball i its share of the
  // group's mass; of a ball by itself, 1 for itself.
  const T (*together)[room] = nullptr;
  BallForces<T, room>* forces = nullptr;  // receives what balls feel, if given
};

// What a body's equations are solved for besides rates.
template <class T>
struct BodyResult {
  Vector2<T> race;  // acceleration of the race's centre, plus gravity
  T acceleration;   // psi''
  T torque;         // on the rotor: the motor's, or the one that the prescribed motion needs
};

// n balls: as many as there is room for, or with room for any_count those of the parameters (model/ball_count.hpp).
// With no room no ball runs free.
//
// One balance of forces holds for all of them: M A + arm psi'' = F at the race's centre O', summed over a body and the
// balls that are free to run around it. Rotor and free balls, rotor and balls as one body, bodies that a motor turns:
// they differ in what the sums run over.
//
// A ball that rolls resists accelerations as two masses do: 2/7 of it fixed to the race's surface, where they touch,
// and 5/7 that slides (docs/equations.md, "Balls that roll"). The race's centre feels the centrifugal force of the
// whole.
template <class T, int room, Terms terms>
class BallBalancer {
 public:
  static constexpr int dimension = model::dimension(room);

  explicit BallBalancer(const model::Parameters& p)
      : n(p.balls),
        zeta_mean_(0.5 * (p.damping[0] + p.damping[1])),
        zeta_half_(0.5 * (p.damping[0] - p.damping[1])),
        kappa_mean_(0.5 * (p.stiffness[0] + p.stiffness[1])),
        kappa_half_(0.5 * (p.stiffness[0] - p.stiffness[1])),
        gravity_(p.gravity) {
    // Sums and products of parameters are formed in T: where T is an interval they are bounded like all that follows,
    // where it is a double they have the same bits as ever. The means above are exact where supports are isotropic.
    rotor_.unbalance.x = T(p.eccentricity);
    rotor_.mass = T(1.0);
    if constexpr (terms.body) {
      offset_ = {T(p.race_offset[0]), T(p.race_offset[1])};
      rotor_.unbalance = {rotor_.unbalance.x - offset_.x, -offset_.y};
      rotor_.inertia = T(p.inertia) + rotor_.unbalance.x * rotor_.unbalance.x + rotor_.unbalance.y * rotor_.unbalance.y;
    }
    T mass(0.0);
    for (int i = 0; i < n; ++i) {
      mu_[i] = T(p.mass[i]);
      beta_[i] = T(p.drag[i]);
      if constexpr (terms.rolls) split_rolling_ball(i, p);
      drag_force_[i] = mu_[i] * beta_[i];
      mass = mass + sliding_mass(i);
    }
    inertia_sum_ = T(2.0) * rotor_.mass + mass;
  }

  // Lane `lane` gets the rotor of `from`: of like terms, with as many balls.
  void take_lane(const BallBalancer& from, int lane) {
    using B = BallBalancer;
    take_lane_of(*this, from, lane, &B::rotor_, &B::zeta_mean_, &B::zeta_half_, &B::kappa_mean_, &B::kappa_half_,
                 &B::gravity_, &B::inertia_sum_, &B::mu_, &B::beta_, &B::drag_force_, &B::offset_, &B::share_,
                 &B::sliding_mass_, &B::carried_, &B::effective_arm_, &B::euler_factor_, &B::inertia_along_,
                 &B::inverse_inertia_);
    sizes_differ_ = sizes_differ_ || from.sizes_differ_;
  }

  // What springs and dampers exert on the support, in rotating components (fx, fy).
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

  // The same of a rotor whose balls are told what to do.
  HWY_INLINE BodyResult<T> machine_derivative(const RotorMotion<T>& rotor, const BallActions<T, room>& actions,
                                              const T* torque, const T* z, T* dz) const {
    static_assert(terms.body && terms.actions);
    Sums sums{};
    const Body<T> body = with_held_balls(actions, z, sums);
    return balance(without_solved(rotor, torque), body, &actions, torque, z, sums, dz);
  }

 private:
  static constexpr int places = room > 0 ? room : 1;  // arrays are never empty
  // What is done for one lane and not for another is done for both and told apart afterwards.
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

  // A ball into what slides and what is fixed to the race, which is made part of the rotor here. One that does not roll
  // slides as a whole; the numbers that say so are exact.
  void split_rolling_ball(int i, const model::Parameters& p) {
    const T sphere = T(model::sphere_inertia.over) / T(model::sphere_inertia.under);
    const T spin = p.rolls ? sphere : T(0.0), radius(p.ball_radius[i]);
    share_ = T(1.0) / (T(1.0) + spin);
    sliding_mass_[i] = share_ * mu_[i];
    beta_[i] = share_ * beta_[i];
    effective_arm_[i] = T(1.0) - spin * radius;
    euler_factor_[i] = share_ * effective_arm_[i];
    const T fixed_mass = spin * sliding_mass_[i], surface = T(1.0) + radius;
    carried_[i] = fixed_mass * surface;
    inertia_along_[i] = mu_[i] / share_;
    inverse_inertia_[i] = share_ / mu_[i];
    sizes_differ_ = sizes_differ_ || (p.rolls && p.ball_radius[i] != p.ball_radius[0]);
    rotor_.mass = rotor_.mass + fixed_mass;
    rotor_.inertia = rotor_.inertia + carried_[i] * surface;
  }

  HWY_INLINE const T& sliding_mass(int i) const {
    if constexpr (terms.rolls)
      return sliding_mass_[i];
    else
      return mu_[i];
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
    for (int i = 0; i < n; ++i)
      if (masked || !terms.actions || !is_held(actions, i)) add_ball(i, rotor, actions, z, sums);
    const T& inertia_sum = terms.body ? sums.inertia_sum : inertia_sum_;
    Matrix2<T> m{inertia_sum - sums.inertia_y, sums.coupling, sums.coupling, sums.inertia_y};
    if constexpr (terms.actions)
      for (int i = 0; i < n && actions->acted_on; ++i) add_actions(i, rotor, *actions, z, sums, m);
    if constexpr (terms.actions)
      if (actions->together) join(rotor, *actions, z, sums, m);
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
    }
    return body;
  }

  // Of a force along the race, or of what it gives a ball: the share that does not go into spin.
  HWY_INLINE T along_race(const T& v) const {
    if constexpr (terms.rolls)
      return v * share_;
    else
      return v;
  }

  // Of such a share of ball i: what it is to the race's turning.
  HWY_INLINE T times_arm(int i, const T& v) const {
    if constexpr (terms.rolls)
      return v * effective_arm_[i];
    else
      return v;
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

  const model::BallCount<room> n;  // named as in the equations
  Body<T> rotor_{};
  T zeta_mean_, zeta_half_, kappa_mean_, kappa_half_, gravity_, inertia_sum_;
  T mu_[places]{}, beta_[places]{}, drag_force_[places]{};  // beta_i: what it slows a ball by
  Vector2<T> offset_{};                                     // of bodies: O' from O
  // Of balls that may roll; see split_rolling_ball().
  T share_ = T(1.0);
  T sliding_mass_[places]{}, carried_[places]{};           // carried: the fixed mass times its distance from O'
  T effective_arm_[places]{}, euler_factor_[places]{};     // Euler: psi'' times it is what a ball lags behind the race
  T inertia_along_[places]{}, inverse_inertia_[places]{};  // what resists a force along the race, and one over it
  bool sizes_differ_ = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
