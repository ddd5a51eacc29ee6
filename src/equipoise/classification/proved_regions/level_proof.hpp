// One level set and the inequalities that prove, box by box, that V decreases on it (docs/explanation/proof.md).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>

#include "equipoise/core/math/affine_form.hpp"
#include "equipoise/core/math/expansion.hpp"
#include "equipoise/core/math/gradient.hpp"
#include "equipoise/core/math/interval.hpp"
#include "equipoise/core/math/positive_definite.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/classification/proved_regions/certificate.hpp"

namespace equipoise {

// The S-lemma: a quadratic function is negative on a ball if some multiple of (squared radius - |eta|^2) can be added
// and leaves it negative everywhere (Yakubovich, 1971; Polik and Terlaky, "A survey of the S-lemma", SIAM Rev. 49
// (2007) 371). One multiplier serves several functions: here one for each corner of a box.

/// (eta, 1)^T form (eta, 1), lower triangle with 1 last; it should be negative where |eta|^2 <= room.
template <std::size_t side>
struct QuadraticOnBall {
  std::array<std::array<double, side>, side> form;
  double room;
};

enum class Multiplier { proves, too_small, too_large };

/// Whether `multiplier` >= 0 proves it, rounding included. If not, any multiplier that does lies beyond `bound`. There
/// the tangent at 1 of the form's Schur complement, convex in the multiplier, vanishes; it guides the search.
template <std::size_t side>
Multiplier judge(const QuadraticOnBall<side>& f, double multiplier, double& bound) {
  constexpr std::size_t one = side - 1;
  std::array<std::array<double, side>, side> a;
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t j = 0; j <= i; ++j) a[i][j] = -f.form[i][j];
  for (std::size_t j = 0; j < one; ++j) a[j][j] = rounded_down(a[j][j] + multiplier);
  a[one][one] = rounded_down(a[one][one] - rounded_up(multiplier * f.room));
  const double slack = trace_slack(a);
  for (std::size_t j = 0; j < side; ++j) a[j][j] -= slack;
  bound = multiplier;
  if (!factorise(a, one)) return Multiplier::too_small;
  double complement = a[one][one];
  for (std::size_t k = 0; k < one; ++k) complement -= a[one][k] * a[one][k];
  if (complement > 0.0) return Multiplier::proves;
  std::array<double, one> eta;  // where the function is largest
  double length = 0.0;
  for (std::size_t i = one; i-- > 0;) {
    eta[i] = a[one][i];
    for (std::size_t k = i + 1; k < one; ++k) eta[i] -= a[k][i] * eta[k];
    eta[i] /= a[i][i];
    length += eta[i] * eta[i];
  }
  const double slope = f.room - length;
  bound = multiplier + complement / slope;
  return slope < 0.0 ? Multiplier::too_small : Multiplier::too_large;
}

/// Searches from the given multiplier for one that proves all functions. Each function admits an interval of
/// multipliers; [low, high] shrinks to their intersection, and is empty once two functions or tangents disagree.
template <std::size_t side, std::size_t count>
bool find_multiplier(const std::array<QuadraticOnBall<side>, count>& functions, double& multiplier) {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 60; ++attempt) {
    bool proved = true;
    for (const auto& f : functions) {
      double bound;
      const Multiplier found = judge(f, multiplier, bound);
      if (found == Multiplier::proves) continue;
      proved = false;
      if (!std::isfinite(bound)) return false;
      if (found == Multiplier::too_small)
        low = std::max(low, bound);
      else
        high = std::min(high, bound);
    }
    if (proved) return true;
    if (!(low < high)) return false;
    if (std::isinf(high))
      multiplier = std::max(2.0 * low, 1e-6);
    else if (low == 0.0)
      multiplier = high > 1e-9 ? 0.25 * high : 0.0;
    else
      multiplier = std::sqrt(low * high);
  }
  return false;
}

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
