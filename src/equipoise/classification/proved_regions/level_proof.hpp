// One level set and the inequalities that prove, box by box, that V decreases on it (docs/explanation/proof.md).
#pragma once

#include <array>
#include <string>
#include <type_traits>

#include "equipoise/core/math/affine_form.hpp"
#include "equipoise/core/math/expansion.hpp"
#include "equipoise/core/math/gradient.hpp"
#include "equipoise/core/math/interval.hpp"
#include "equipoise/core/math/s_lemma.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/classification/proved_regions/certificate.hpp"

namespace equipoise {

/// What a proof is compiled for. Without `body` the speed is prescribed and the race centred; `rolls` is then whether
/// the balls roll, else that is looked up.
struct ProofKind {
  int balls;
  bool rolls = false;
  bool body = false;
  bool driven = false, integral = false;  ///< by a motor, whose control has an integral part

  /// What is more to a state than angles, place and velocities.
  constexpr int more() const { return driven ? (integral ? 2 : 1) : 0; }
};

/// Everything about a certificate that does not depend on a box, computed once.
///
/// The deviation from the exact balanced state is d = D (eta; tau), D the frame. Ball angles deviate by delta, which
/// depends on tau alone; w is the rest of d. With q_i^2 read as theta_i q_i, theta_i anywhere in the range of q_i,
/// rates are f = J d + sum_i theta_i b_i q_i + terms that vanish with delta, linear in w where delta is fixed. Of a
/// driven rotor products of its speed's deviation with w are read also, as theta C w. Half of dV/dt over the level
/// is (eta; tau)^T G f with G = D^T P / level.
template <ProofKind kind>
class LevelProof {
 public:
  using Box = Certificate::Box;
  static constexpr int n = kind.balls;
  static constexpr int etas = 4 + n + kind.more();                ///< components of w: x, y, u, v, q_i, speed, integral
  static constexpr int size = etas + n;                           ///< components of a state
  static constexpr int thetas = n + (kind.driven ? 1 : 0);        ///< of balls, of the speed
  static constexpr int vertices = 1 << thetas, corners = 1 << n;  ///< of a box in theta, in tau

  /// Encloses the balanced state, checks frame and form. If fault() is not empty, nothing else may be asked.
  explicit LevelProof(const Certificate& certificate);
  const std::string& fault() const { return fault_; }

  /// No point of V <= level has its tau in the box.
  bool outside(const Box& box) const;
  /// Proves dV/dt < 0 wherever V <= level and tau is in the box, except at the balanced state, with its multipliers.
  bool holds(const Box& box) const;
  /// The same, searching for multipliers, with a margin for another compiler's rounding.
  bool find(Box& box) const;

 private:
  using Affine = AffineForm<n>;
  using Slope = Gradient<Interval, n>;
  template <class T>
  using Motion = Expansion<T, n, kind.more()>;
  template <class T>
  using Flow = std::conditional_t<
      kind.body, HWY_NAMESPACE::SmoothFlow<Motion<T>, n>,
      HWY_NAMESPACE::FreeFlow<Motion<T>, n, HWY_NAMESPACE::Terms{false, false, false, false, false, kind.rolls}>>;
  template <class T>
  using Rates = std::array<Motion<T>, size>;
  template <class T, int columns>
  using Rows = std::array<std::array<T, columns>, size>;

  // A symmetric matrix over (eta, 1); only the lower triangle is used.
  static constexpr int side = etas + 1, one = etas;
  template <class T>
  using Square = std::array<std::array<T, side>, side>;

  // dV/dt over one box as a form in (eta, 1): base + sum_i theta_i part[i], all affine in tau.
  struct Slice {
    Square<Affine> base;
    std::array<Square<Affine>, thetas> part;
    std::array<double, n> middle, half;  // of the box
    std::array<Interval, thetas> theta;
  };
  // The same at a corner of the box and a vertex of theta, remainders added.
  using Corner = QuadraticOnBall<side>;

  bool enclose_speed(const Certificate& certificate);
  bool enclose_balance(const Certificate& certificate);
  bool check_frame(const Certificate& certificate);
  bool check_centre(const Certificate& certificate);
  bool check_limit(const Certificate& certificate);
  void linearise();
  static bool central(const Box& box);
  bool holds_around_centre(const Box& box, double spare) const;
  Slice slice(const Box& box) const;
  std::array<Corner, corners> at_corners(const Slice& s, int vertex, double spare) const;

  std::array<Interval, n> deviation(const Box& box) const;
  std::array<Interval, thetas> speeds(const Box& box) const;
  template <class T>
  Rates<T> rates(const Flow<T>& flow, const std::array<T, n>& angles) const;
  static constexpr int row_of(int variable) { return variable < 4 ? variable : variable + n; }
  // Of what theta stands for: q_i, then the speed.
  static constexpr int row_of_theta(int theta) { return model::index::q(theta, n); }

  Flow<Affine> affine_flow_;
  Flow<Slope> slope_flow_;
  Rows<double, size> frame_{};                           // D
  Rows<Interval, size> gradient_{};                      // G
  std::array<Interval, n> balance_{};                    // ball angles of the exact balanced state
  std::array<Interval, etas> rest_{};                    // its other components
  Rows<Interval, size> jacobian_{};                      // J
  Rows<Interval, n> square_{};                           // b_i
  Rows<Interval, etas> by_speed_{};                      // C
  Rows<Interval, size> linear_{};                        // G J D
  std::array<Rows<Interval, size>, thetas> bilinear_{};  // G b_i (row of q_i in D); G C (rows of w in D)
  double disc_ = 0.0;                                    // |eta|^2 + |tau|^2 is below this on V <= level
  std::string fault_;
};

// The equations as proofs run them: on polynomials in what is not a ball's angle.

// A number known to lie in an interval.
template <int k>
AffineForm<k> number(const Interval& a, const AffineForm<k>&) {
  return AffineForm<k>(Constant(a));
}
template <int k>
Gradient<Interval, k> number(const Interval& a, const Gradient<Interval, k>&) {
  Gradient<Interval, k> r;
  r.value = a;
  return r;
}

// The torque of a motor below its limit, which check_limit() proves it to be, and the rate of its control's integral.
template <class T, int n, int more>
HWY_NAMESPACE::MotorState<Expansion<T, n, more>> motor_state(const model::DriveSegment& motor,
                                                             const Expansion<T, n, more>&,
                                                             const Expansion<T, n, more>& speed,
                                                             const Expansion<T, n, more>& error) {
  using E = Expansion<T, n, more>;
  E torque = E(motor.constant) + E(motor.slope) * speed;
  if constexpr (more > 1) torque = torque + E(motor.integral) * error;
  return {torque, E(motor.aim) - speed};
}

template <ProofKind kind>
template <class T>
typename LevelProof<kind>::template Rates<T> LevelProof<kind>::rates(const Flow<T>& flow,
                                                                     const std::array<T, n>& angles) const {
  using E = Motion<T>;
  E z[size];
  for (int v = 0; v < etas; ++v) {
    z[row_of(v)] = E::variable(v);
    if constexpr (kind.body) z[row_of(v)] = z[row_of(v)] + E(number(rest_[v], T()));
  }
  for (int i = 0; i < n; ++i) z[model::index::phi(i)] = E(angles[i]);
  Rates<T> result;
  flow(E(0.0), z, result.data());
  return result;
}

/// Calls `f` with the kind of a system as a constant: one or two balls.
template <class F>
decltype(auto) with_proof_kind(const model::System& system, F&& f) {
  const auto of = [&]<int n>(std::integral_constant<int, n>) {
    const bool integral = system.layout().error >= 0;
    if (system.plain()) {
      if (system.parameters().rolls) return f(std::integral_constant<ProofKind, ProofKind{n, true}>{});
      return f(std::integral_constant<ProofKind, ProofKind{n}>{});
    }
    if (system.prescribed()) return f(std::integral_constant<ProofKind, ProofKind{n, true, true}>{});
    if (!integral) return f(std::integral_constant<ProofKind, ProofKind{n, true, true, true}>{});
    return f(std::integral_constant<ProofKind, ProofKind{n, true, true, true, true}>{});
  };
  return system.balls() == 1 ? of(std::integral_constant<int, 1>{}) : of(std::integral_constant<int, 2>{});
}

}  // namespace equipoise
