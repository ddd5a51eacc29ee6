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
#include "equipoise/machine/model/tilt-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// A ball that rolls resists accelerations as two masses do: 2/7 of it fixed to the race's surface, where they touch,
// and 5/7 that slides (docs/explanation/equations.md, "Balls that roll"). The race's centre feels the centrifugal force
// of the whole.
template <class T, int room, Terms terms>
class BalancerConstants {
 public:
  // `tilt`: the place of sx in the state of a rotor that tilts.
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
