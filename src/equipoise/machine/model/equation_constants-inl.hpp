// A rotor and its balls as the equations of motion have them: masses, drag, supports, what of a ball rolls. Included
// once per CPU target.
#if defined(EQUIPOISE_MODEL_EQUATION_CONSTANTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_EQUATION_CONSTANTS_INL
#undef EQUIPOISE_MODEL_EQUATION_CONSTANTS_INL
#else
#define EQUIPOISE_MODEL_EQUATION_CONSTANTS_INL
#endif

#include <type_traits>

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/equation_terms-inl.hpp"
#include "equipoise/machine/model/parameters.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// What a tilting rotor adds to the equations of motion: the supports' moments, its gyroscopic moment, and the
// balance of moments, whose unknown is the inertial acceleration B of the shaft's slope next to that of its centre, A
// (docs/explanation/equations.md, "A tilting rotor").

// Sums over rotor and balls next to those of the plane rotor: what acts on the slope, and what it has to move.
template <class T>
struct TiltSums {
  Vector2<T> couple;           // of the body: its couple unbalance, held balls included
  Vector2<T> moment;           // H, without what springs, dampers and psi'' do
  Matrix2<T> between, second;  // of the inertia: sums of mass times place along the shaft, and times its square
};

// A force in the plane of the centre and a moment, or a centre's and a slope's motion.
template <class T>
struct Wrench {
  Vector2<T> centre, tilt;
};

// The 4 x 4 symmetric positive definite inertia of the centre and the slope, solved block by block. With all balls at
// the centre of mass the centre's half is the plane rotor's.
template <class T>
class TiltInertia {
 public:
  // Every member is made from others: compilers give a member's implicit constructor no CPU target.
  HWY_INLINE TiltInertia(const Matrix2<T>& centre, const Matrix2<T>& between, const Matrix2<T>& second)
      : centre_(centre),
        inverse_(T(1.0) / centre.determinant()),
        share_(share(centre, between, inverse_)),
        left_{second.xx - between.xx * share_.xx - between.xy * share_.yx,
              second.xy - between.xx * share_.xy - between.xy * share_.yy,
              second.yx - between.yx * share_.xx - between.yy * share_.yx,
              second.yy - between.yx * share_.xy - between.yy * share_.yy},
        left_inverse_(T(1.0) / left_.determinant()) {}

  HWY_INLINE Wrench<T> solve(const Wrench<T>& f) const {
    const Vector2<T> rest{f.tilt.x - share_.xx * f.centre.x - share_.yx * f.centre.y,
                          f.tilt.y - share_.xy * f.centre.x - share_.yy * f.centre.y};
    const Vector2<T> b = left_.adjugate(rest), a = centre_.adjugate(f.centre);
    const Vector2<T> tilt{b.x * left_inverse_, b.y * left_inverse_};
    return {{a.x * inverse_ - share_.xx * tilt.x - share_.xy * tilt.y,
             a.y * inverse_ - share_.yx * tilt.x - share_.yy * tilt.y},
            tilt};
  }

 private:
  static HWY_INLINE Matrix2<T> share(const Matrix2<T>& centre, const Matrix2<T>& between, const T& inverse) {
    const Vector2<T> x = centre.adjugate({between.xx, between.yx}), y = centre.adjugate({between.xy, between.yy});
    return {x.x * inverse, y.x * inverse, x.y * inverse, y.y * inverse};
  }

  Matrix2<T> centre_;
  T inverse_;
  Matrix2<T> share_, left_;  // centre's inverse times between; what is left of second
  T left_inverse_;
};

// psi'' under a torque, or the torque that the prescribed one needs. `solved` has force and moment, and gets A and B;
// `taken`: the moment of the balls about the axis. As of the plane rotor: BallBalancer::solve_rotation().
template <class T>
HWY_INLINE BodyResult<T> solve_tilt(const Matrix2<T>& centre, const TiltSums<T>& sums, const Body<T>& body, T a,
                                    const T* torque, const T& taken, Wrench<T>& solved) {
  const TiltInertia<T> inertia(centre, sums.between, sums.second);
  const Wrench<T> arm{{-body.unbalance.y, body.unbalance.x}, {-sums.couple.y, sums.couple.x}};
  const auto row = [&](const Wrench<T>& v) {
    return arm.centre.x * v.centre.x + arm.centre.y * v.centre.y + arm.tilt.x * v.tilt.x + arm.tilt.y * v.tilt.y;
  };
  solved = inertia.solve(solved);
  if (torque) {
    const Wrench<T> response = inertia.solve(arm);
    a = (*torque + taken - row(solved)) / (body.inertia - row(response));
    solved = {{solved.centre.x - a * response.centre.x, solved.centre.y - a * response.centre.y},
              {solved.tilt.x - a * response.tilt.x, solved.tilt.y - a * response.tilt.y}};
  }
  return {solved.centre, a, torque ? *torque : body.inertia * a + row(solved) - taken};
}

// Of one rotor. `place`: of sx in the state.
template <class T, int places>
class TiltConstants {
 public:
  TiltConstants(const model::Parameters& p, int place)
      : place_(place),
        transverse_(p.tilt.transverse_inertia),
        polar_(p.tilt.polar_inertia),
        couple_(T(p.tilt.misalignment) * (transverse_ - polar_)) {
    const auto& [stiff_x, stiff_y] = p.tilt.stiffness;
    const auto& [damping_x, damping_y] = p.tilt.damping;
    for (int k = 0; k < 2; ++k)
      exerted_[k] = BearingForce<T>({0.0, {stiff_x[k], stiff_y[k]}, {damping_x[k], damping_y[k]}});
    for (int i = 0; i < places; ++i) plane_[i] = T(p.tilt.plane[i]);
  }

  void take_lane(const TiltConstants& from, int lane) {
    using C = TiltConstants;
    take_lane_of(*this, from, lane, &C::transverse_, &C::polar_, &C::couple_, &C::plane_);
    for (int k = 0; k < 2; ++k) exerted_[k].take_lane(from.exerted_[k], lane);
  }

  HWY_INLINE const T& plane(int i) const { return plane_[i]; }

  // What springs and dampers exert on the supports: `force` has what the centre's motion alone gives, and gets the
  // tilt's share; returns the moment.
  HWY_INLINE Vector2<T> add_supports(const RotorMotion<T>& rotor, const T* z, Vector2<T>& force) const {
    const T* s = z + place_;
    const Vector2<T> by_tilt = exerted_[0].of(rotor, s), across = exerted_[0].of(rotor, z),
                     own = exerted_[1].of(rotor, s);
    force = {force.x + by_tilt.x, force.y + by_tilt.y};
    return {across.x + own.x, across.y + own.y};
  }

  // The rotor at psi'': its supports, of which `force_x` and `force_y` lack the tilt's share, its couple unbalance and
  // its gyroscopic moment.
  HWY_INLINE void add_body(const RotorMotion<T>& rotor, const T* z, T& force_x, T& force_y, TiltSums<T>& sums) const {
    Vector2<T> force{T(0.0), T(0.0)};
    const Vector2<T> moment = add_supports(rotor, z, force);
    force_x = force_x - force.x;
    force_y = force_y - force.y;
    const T w2 = rotor.speed * rotor.speed, a = rotor.acceleration, spin = polar_ * rotor.speed;
    sums.couple.x = sums.couple.x + couple_;
    sums.moment = {sums.couple.x * w2 + sums.couple.y * a - moment.x - spin * z[place_ + 3],
                   sums.couple.y * w2 - sums.couple.x * a - moment.y + spin * z[place_ + 2]};
    sums.second.xx = sums.second.xx + transverse_;
    sums.second.yy = sums.second.yy + transverse_;
  }

  // Ball i at (c, s), which pushes its race outward and along it, and resists outward with `mass`.
  HWY_INLINE void add_ball(int i, const T& outward, const T& along, const T& mass, const T& s, const T& c,
                           TiltSums<T>& sums) const {
    const T& z = plane_[i];
    sums.moment = {sums.moment.x + z * (outward * c - along * s), sums.moment.y + z * (outward * s + along * c)};
    const T first = z * mass, second = z * first;
    const T cc = c * c, sc = s * c, ss = s * s;
    add(sums.between, first * cc, first * sc, first * ss);
    add(sums.second, second * cc, second * sc, second * ss);
  }

  // Ball i, held: a part of the body, with `mass` at (c, s).
  HWY_INLINE void add_held(int i, const T& mass, const T& s, const T& c, TiltSums<T>& sums) const {
    const T first = plane_[i] * mass, second = plane_[i] * first;
    sums.couple = {sums.couple.x + first * c, sums.couple.y + first * s};
    add(sums.between, first, T(0.0), first);
    add(sums.second, second, T(0.0), second);
  }

  // What acceleration ball i's race has, less the Euler and centrifugal parts.
  HWY_INLINE Vector2<T> in_plane(int i, const Wrench<T>& motion) const {
    return {motion.centre.x + plane_[i] * motion.tilt.x, motion.centre.y + plane_[i] * motion.tilt.y};
  }

  // d/dt of (sx, sy, us, vs).
  HWY_INLINE void move(const RotorMotion<T>& rotor, const T* z, const Vector2<T>& b, T* dz) const {
    const T w = rotor.speed;
    const T* s = z + place_;
    T* ds = dz + place_;
    ds[0] = s[2] + w * s[1];
    ds[1] = s[3] - w * s[0];
    ds[2] = b.x + w * s[3];
    ds[3] = b.y - w * s[2];
  }

 private:
  static HWY_INLINE void add(Matrix2<T>& m, const T& xx, const T& xy, const T& yy) {
    m = {m.xx + xx, m.xy + xy, m.yx + xy, m.yy + yy};
  }

  int place_;
  T transverse_, polar_, couple_;
  BearingForce<T> exerted_[2];  // by k12 and c12, by k22 and c22
  T plane_[places]{};
};

// Stands where a rotor that does not tilt has nothing.
struct NoTilt {};

// A ball that rolls resists accelerations as two masses do: 2/7 of it fixed to the race's surface, where they touch,
// and 5/7 that slides (docs/explanation/equations.md, "Rolling balls"). The race's centre feels the centrifugal force
// of the whole.
template <class T, int room, Terms terms>
class BalancerConstants {
 public:
  // `tilt`: the place of sx in the state of a tilting rotor.
  explicit BalancerConstants(const model::Parameters& p, [[maybe_unused]] int tilt = -1)
      : n(p.balls),
        zeta_mean_(0.5 * (p.damping[0] + p.damping[1])),
        zeta_half_(0.5 * (p.damping[0] - p.damping[1])),
        kappa_mean_(0.5 * (p.stiffness[0] + p.stiffness[1])),
        kappa_half_(0.5 * (p.stiffness[0] - p.stiffness[1])),
        gravity_(p.gravity),
        tilt_(tilt_of(p, tilt)) {
    // Sums and products of parameters are formed in T: where T is an interval they are bounded like all that follows,
    // where it is a double they have the same bits as ever. The means above are exact where supports are isotropic.
    rotor_.unbalance.x = T(p.eccentricity);
    rotor_.mass = T(1.0);
    if constexpr (terms.body) {
      offset_ = {T(p.race_offset[0]), T(p.race_offset[1])};
      rotor_.unbalance = {rotor_.unbalance.x - offset_.x, -offset_.y};
      rotor_.inertia = T(p.inertia) + rotor_.unbalance.x * rotor_.unbalance.x + rotor_.unbalance.y * rotor_.unbalance.y;
    }
    if constexpr (terms.tilt) {
      T sine, cosine;
      sin_cos(T(p.eccentricity_angle), sine, cosine);
      rotor_.unbalance = {T(p.eccentricity) * cosine, T(p.eccentricity) * sine};
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
  void take_lane(const BalancerConstants& from, int lane) {
    using B = BalancerConstants;
    take_lane_of(*this, from, lane, &B::rotor_, &B::zeta_mean_, &B::zeta_half_, &B::kappa_mean_, &B::kappa_half_,
                 &B::gravity_, &B::inertia_sum_, &B::mu_, &B::beta_, &B::drag_force_, &B::offset_, &B::share_,
                 &B::sliding_mass_, &B::carried_, &B::effective_arm_, &B::euler_factor_, &B::inertia_along_,
                 &B::inverse_inertia_);
    if constexpr (terms.tilt) tilt_.take_lane(from.tilt_, lane);
    sizes_differ_ = sizes_differ_ || from.sizes_differ_;
  }

 protected:
  static constexpr int places = room > 0 ? room : 1;  // arrays are never empty
  using Tilt = std::conditional_t<terms.tilt, TiltConstants<T, places>, NoTilt>;
  static Tilt tilt_of([[maybe_unused]] const model::Parameters& p, [[maybe_unused]] int place) {
    if constexpr (terms.tilt)
      return {p, place};
    else
      return {};
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
  [[no_unique_address]] Tilt tilt_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
