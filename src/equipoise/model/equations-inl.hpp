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

#include "equipoise/base/pack-inl.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/parameters.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Terms beyond the isotropic horizontal rotor at constant speed. A term that is off leaves no operation behind.
struct Terms {
  bool acceleration = true;
  bool anisotropy = true;
  bool gravity = true;
  bool machine = false;  // a motor, an off-centre race, balls that are held, resist rolling or push each other
};

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

// What acts on the balls of a machine at one instant.
template <class T, int room>
struct BallActions {
  bool held[room] = {};     // turns with the rotor: clamped, or at rest by stiction
  T resistance[room] = {};  // rolling resistance over normal force, with the sign of the ball's rate
  T push[room] = {};        // along phi_i, from other balls: mu_i phi_i'' for a ball alone; they sum to 0
};

// What a machine's equations are solved for besides rates.
template <class T>
struct MachineResult {
  Vector2<T> race;  // acceleration of the race's centre, plus gravity
  T acceleration;   // psi''
  T torque;         // on the rotor: the motor's, or the one that the prescribed motion needs
};

// n balls: as many as there is room for, or with room for any_count those of the parameters (model/ball_count.hpp).
template <class T, int room, Terms terms>
class BallBalancer {
 public:
  static constexpr int dimension = model::dimension(room);

  explicit BallBalancer(const model::Parameters& p)
      : n(p.balls),
        lambda_(p.eccentricity),
        zeta_mean_(0.5 * (p.damping[0] + p.damping[1])),
        zeta_half_(0.5 * (p.damping[0] - p.damping[1])),
        kappa_mean_(0.5 * (p.stiffness[0] + p.stiffness[1])),
        kappa_half_(0.5 * (p.stiffness[0] - p.stiffness[1])),
        gravity_(p.gravity) {
    // Sums and products of parameters are formed in T: where T is an interval they are bounded like all that follows,
    // where it is a double they have the same bits as ever. The means above are exact where supports are isotropic.
    if constexpr (terms.machine) {
      offset_ = {T(p.race_offset[0]), T(p.race_offset[1])};
      inertia_ = p.inertia;
    }
    T mass(0.0);
    for (int i = 0; i < n; ++i) {
      mu_[i] = T(p.mass[i]);
      beta_[i] = T(p.drag[i]);
      drag_force_[i] = mu_[i] * beta_[i];
    }
    // Of all balls: clamped ones are told to the equations by their sum alone (n = 1).
    for (int i = 0; i < p.balls; ++i) mass = mass + T(p.mass[i]);
    total_inertia_ = T(1.0) + mass;
    inertia_sum_ = T(2.0) + mass;
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

  // dz/dt with the balls free. `acceleration_of_centre`, if given, receives (Ax, Ay): acceleration of O plus gravity.
  HWY_INLINE void free_derivative(const RotorMotion<T>& rotor, const T* z, T* dz,
                                  Vector2<T>* acceleration_of_centre = nullptr) const {
    static_assert(!terms.machine);
    const Vector2<T> f = bearing_force(rotor, z);
    BallSums sums{};
    sums.force_x = lambda_ * (rotor.speed * rotor.speed) - f.x;
    sums.resisting_y = f.y;
    if constexpr (terms.acceleration) sums.resisting_y = sums.resisting_y + lambda_ * rotor.acceleration;
    sums.inertia_y = T(1.0);
    for (int i = 0; i < n; ++i) add_ball(i, rotor, z, mu_[i], drag_force_[i], sums);
    // [inertia_x, coupling; coupling, inertia_y] (Ax, Ay) = (Fx, Fy): symmetric positive definite. The solution is
    // left as (solved_x, solved_y) inverse, so that all that can be done without the quotient need not wait for it.
    const T inertia_x = inertia_sum_ - sums.inertia_y;
    const T inverse = T(1.0) / (inertia_x * sums.inertia_y - sums.coupling * sums.coupling);
    const Vector2<T> solved{sums.inertia_y * sums.force_x - sums.coupling * sums.force_y,
                            inertia_x * sums.force_y - sums.coupling * sums.force_x};
    for (int i = 0; i < n; ++i) ball_rates(i, rotor.acceleration, z, sums, solved, inverse, dz);
    if (acceleration_of_centre) *acceleration_of_centre = {solved.x * inverse, solved.y * inverse};
    move_centre(rotor, z, solved, inverse, T(gravity_), dz);
  }

  // dz/dt of a machine. `driven`: rotor.acceleration is not read but solved for, under the motor's `torque`. Moments
  // are taken about the race's centre O', so that a ball's normal force has none: the rotor is a body whose centre of
  // mass lies at lambda - e from there and on which the supports act at -e; held balls belong to it.
  HWY_INLINE MachineResult<T> machine_derivative(const RotorMotion<T>& rotor, const BallActions<T, room>& actions,
                                                 bool driven, const T& torque, const T* z, T* dz) const {
    static_assert(terms.machine && terms.acceleration);
    const T w2 = rotor.speed * rotor.speed;
    const Vector2<T> f = bearing_force(rotor, z);
    Vector2<T> body{lambda_ - offset_.x, -offset_.y};  // its unbalance, mass and moment of inertia about O'
    T body_mass(1.0);
    T body_inertia = inertia_ + body.x * body.x + body.y * body.y;
    BallSums sums{};
    T free_mass(0.0), drag_torque(0.0);
    for (int i = 0; i < n; ++i) {
      add_ball(i, rotor, z, actions.held[i] ? T(0.0) : mu_[i], actions.held[i] ? T(0.0) : drag_force_[i], sums);
      if (!actions.held[i]) {
        free_mass = free_mass + mu_[i];
        drag_torque = drag_torque + drag_force_[i] * z[4 + n + i];
        continue;
      }
      body.x = body.x + mu_[i] * sums.c[i];
      body.y = body.y + mu_[i] * sums.s[i];
      body_mass = body_mass + mu_[i];
      body_inertia = body_inertia + mu_[i];
    }
    sums.inertia_y = sums.inertia_y + body_mass;
    Vector2<T> force{sums.force_x + body.x * w2 - f.x, sums.force_y + body.y * w2 - f.y};
    T m_xx = T(2.0) * body_mass + free_mass - sums.inertia_y, m_xy = sums.coupling, m_yx = sums.coupling;
    T m_yy = sums.inertia_y;
    Vector2<T> grip{T(0.0), T(0.0)};  // sum of resistance times radial direction: what A takes from the drag torque
    for (int i = 0; i < n; ++i) {
      const T s = sums.s[i], c = sums.c[i];
      force.x = force.x + actions.push[i] * s;
      force.y = force.y - actions.push[i] * c;
      // Rolling resistance pulls the race along (-s, c) by k times the normal force mu (total^2 - Ax c - Ay s).
      const T k = mu_[i] * actions.resistance[i];
      const T total = rotor.speed + z[4 + n + i];
      force.x = force.x - k * total * total * s;
      force.y = force.y + k * total * total * c;
      m_xx = m_xx - k * s * c;
      m_xy = m_xy - k * s * s;
      m_yx = m_yx + k * c * c;
      m_yy = m_yy + k * c * s;
      grip.x = grip.x + k * c;
      grip.y = grip.y + k * s;
      drag_torque = drag_torque + k * total * total;
    }
    // M A + arm psi'' = F; (arm + grip) A + J psi'' = torque + drag + e x f.
    const T inverse = T(1.0) / (m_xx * m_yy - m_xy * m_yx);
    const auto solve = [&](const Vector2<T>& right) {
      return Vector2<T>{(m_yy * right.x - m_xy * right.y) * inverse, (m_xx * right.y - m_yx * right.x) * inverse};
    };
    const Vector2<T> arm{-body.y, body.x};
    const Vector2<T> still = solve(force), per_acceleration = solve(arm);
    const Vector2<T> row{arm.x + grip.x, arm.y + grip.y};
    const T moment = drag_torque + offset_.x * f.y - offset_.y * f.x - row.x * still.x - row.y * still.y;
    const T reduced_inertia = body_inertia - row.x * per_acceleration.x - row.y * per_acceleration.y;
    const T a = driven ? (torque + moment) / reduced_inertia : rotor.acceleration;
    const Vector2<T> race{still.x - a * per_acceleration.x, still.y - a * per_acceleration.y};
    for (int i = 0; i < n; ++i) {
      ball_rates(i, a, z, sums, race, T(1.0), dz);
      const T total = rotor.speed + z[4 + n + i];
      const T normal = total * total - race.x * sums.c[i] - race.y * sums.s[i];
      dz[4 + n + i] = dz[4 + n + i] + actions.push[i] / mu_[i] - actions.resistance[i] * normal;
      if (actions.held[i]) dz[4 + i] = dz[4 + n + i] = T(0.0);
    }
    const Vector2<T> centre{race.x + w2 * offset_.x + a * offset_.y, race.y + w2 * offset_.y - a * offset_.x};
    move_centre(rotor, z, centre, T(1.0), T(gravity_), dz);
    return {race, a, driven ? torque : reduced_inertia * a - moment};
  }

  // d/dt of (x, y, u, v) with the balls held at unbalance U = lambda + sum mu_i e^{i phi_i}, under `gravity`: linear
  // in the state, U and gravity, so solutions superpose.
  HWY_INLINE void clamped_derivative(const RotorMotion<T>& rotor, const Vector2<T>& unbalance, const T& gravity,
                                     const T* z, T* dz, Vector2<T>* acceleration_of_centre = nullptr) const {
    const T w2 = rotor.speed * rotor.speed;
    const T a = rotor.acceleration;
    const Vector2<T> f = bearing_force(rotor, z);
    const T inverse = T(1.0) / total_inertia_;
    const T ax = (unbalance.x * w2 + unbalance.y * a - f.x) * inverse;
    const T ay = (unbalance.y * w2 - unbalance.x * a - f.y) * inverse;
    if (acceleration_of_centre) *acceleration_of_centre = {ax, ay};
    move_centre(rotor, z, {ax, ay}, T(1.0), gravity, dz);
  }

 private:
  // What the balls contribute to the equations of the race's centre.
  struct BallSums {
    T s[room], c[room];     // of phi_i
    T force_x, force_y;     // Fx, Fy
    T resisting_y;          // taken from Fy with the first ball
    T inertia_y, coupling;  // sum mu_i sin^2 phi_i, sum mu_i sin phi_i cos phi_i
  };

  // A free ball of mass mu and drag force drag_force q.
  HWY_INLINE void add_ball(int i, const RotorMotion<T>& rotor, const T* z, const T& mu, const T& drag_force,
                           BallSums& sums) const {
    const T q = z[4 + n + i];
    sin_cos(z[4 + i], sums.s[i], sums.c[i]);
    const T s = sums.s[i], c = sums.c[i];
    const T total = rotor.speed + q;
    const T centrifugal = mu * total * total;
    const T drag = drag_force * q;
    const T mass_sine = mu * s;
    sums.force_x = sums.force_x + centrifugal * c - drag * s;
    sums.force_y = centrifugal * s + (i == 0 ? drag * c - sums.resisting_y : drag * c + sums.force_y);
    sums.inertia_y = sums.inertia_y + mass_sine * s;
    sums.coupling = sums.coupling + mass_sine * c;
  }

  // Rates of ball i where the race's centre accelerates by (solved) inverse.
  HWY_INLINE void ball_rates(int i, const T& acceleration, const T* z, const BallSums& sums, const Vector2<T>& solved,
                             const T& inverse, T* dz) const {
    const T q = z[4 + n + i];
    T resisting = beta_[i] * q;
    if constexpr (terms.acceleration) resisting = resisting + acceleration;
    dz[4 + i] = q;
    dz[4 + n + i] = (solved.x * sums.s[i] - solved.y * sums.c[i]) * inverse - resisting;
  }

  // d/dt of (x, y, u, v) where O accelerates by a factor, less gravity.
  HWY_INLINE void move_centre(const RotorMotion<T>& rotor, const T* z, const Vector2<T>& a, const T& factor,
                              const T& gravity, T* dz) const {
    const T w = rotor.speed;
    dz[0] = z[2] + w * z[1];
    dz[1] = z[3] - w * z[0];
    dz[2] = a.x * factor + w * z[3];
    dz[3] = a.y * factor - w * z[2];
    if constexpr (terms.gravity) {  // acts only through A = acceleration + (g sin psi, g cos psi)
      dz[2] = dz[2] - gravity * rotor.sin_psi;
      dz[3] = dz[3] - gravity * rotor.cos_psi;
    }
  }

  const model::BallCount<room> n;  // named as in the equations
  T lambda_, zeta_mean_, zeta_half_, kappa_mean_, kappa_half_, gravity_, total_inertia_, inertia_sum_;
  T mu_[room], beta_[room], drag_force_[room];
  Vector2<T> offset_{};  // machines only
  T inertia_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
