// One level set and the inequalities that prove, box by box, that V decreases on it (docs/numerics.md, "The proof").
#pragma once

#include <array>
#include <string>

#include "equipoise/math/affine_form.hpp"
#include "equipoise/math/expansion.hpp"
#include "equipoise/math/gradient.hpp"
#include "equipoise/math/interval.hpp"
#include "equipoise/math/s_lemma.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/proof/certificate.hpp"

namespace equipoise {

/// Everything about a certificate with n balls, which roll or slide, that does not depend on a box, computed once.
///
/// The deviation from the exact balanced state is d = D (eta; tau), D the frame. Ball angles deviate by delta, which
/// depends on tau alone; w is the rest of d. With q_i^2 read as theta_i q_i, theta_i anywhere in the range of q_i,
/// rates are f = J d + sum_i theta_i b_i q_i + terms that vanish with delta, linear in w where delta is fixed. Half of
/// dV/dt over the level is (eta; tau)^T G f with G = D^T P / level.
template <int n, bool rolls>
class LevelProof {
 public:
  using Box = Certificate::Box;
  static constexpr int etas = 4 + n;       ///< components of w: x, y, u, v, q_i
  static constexpr int size = etas + n;    ///< components of a state
  static constexpr int vertices = 1 << n;  ///< of a box in tau or theta

  /// Encloses the balanced state, checks frame and form. If fault() is not empty, nothing else may be asked.
  explicit LevelProof(const Certificate& certificate);
  const std::string& fault() const { return fault_; }

  /// No point of V <= level has its tau in the box.
  bool outside(const Box& box) const;
  /// Proves dV/dt < 0 wherever V <= level and tau is in the box, except at the balanced state, with its multipliers.
  bool holds(const Box& box) const;
  /// The same, changing multipliers until they prove it, with a little to spare: another compiler's rounding must not
  /// refute what is found here.
  bool find(Box& box) const;

 private:
  using Affine = AffineForm<n>;
  using Slope = Gradient<Interval, n>;
  template <class T>
  using Flow =
      HWY_NAMESPACE::FreeFlow<Expansion<T, n>, n, HWY_NAMESPACE::Terms{false, false, false, false, false, rolls}>;
  template <class T>
  using Rates = std::array<Expansion<T, n>, size>;
  template <class T, int columns>
  using Rows = std::array<std::array<T, columns>, size>;

  // A symmetric matrix over (eta, 1); only the lower triangle is used.
  static constexpr int side = etas + 1, one = etas;
  template <class T>
  using Square = std::array<std::array<T, side>, side>;

  // dV/dt over one box as a form in (eta, 1): base + sum_i theta_i part[i], all affine in tau.
  struct Slice {
    Square<Affine> base;
    std::array<Square<Affine>, n> part;
    std::array<double, n> middle, half;  // of the box
    std::array<Interval, n> theta;
  };
  // The same at a corner of the box and a vertex of theta, remainders added.
  using Corner = QuadraticOnBall<side>;

  bool enclose_balance(const Certificate& certificate);
  bool check_frame(const Certificate& certificate);
  void linearise();
  static bool central(const Box& box);
  bool holds_around_centre(const Box& box, double spare) const;
  Slice slice(const Box& box) const;
  std::array<Corner, vertices> corners(const Slice& s, int vertex, double spare) const;

  std::array<Interval, n> deviation(const Box& box) const;
  std::array<Interval, n> ball_speeds(const Box& box) const;
  template <class T>
  Rates<T> rates(const Flow<T>& flow, const std::array<T, n>& angles) const;
  static constexpr int row_of(int variable) { return variable < 4 ? variable : variable + n; }

  Flow<Affine> affine_flow_;
  Flow<Slope> slope_flow_;
  Rows<double, size> frame_{};                      // D
  Rows<Interval, size> gradient_{};                 // G
  std::array<Interval, n> balance_{};               // ball angles of the exact balanced state
  Rows<Interval, size> jacobian_{};                 // J
  Rows<Interval, n> square_{};                      // b_i
  Rows<Interval, size> linear_{};                   // G J D
  std::array<Rows<Interval, size>, n> bilinear_{};  // G b_i (row of q_i in D)
  Rows<Constant, size> gradient_constant_{}, jacobian_constant_{};
  Rows<Constant, n> square_constant_{};
  double disc_ = 0.0;  // |eta|^2 + |tau|^2 is below this on V <= level
  std::string fault_;
};

extern template class LevelProof<1, false>;
extern template class LevelProof<1, true>;
extern template class LevelProof<2, false>;
extern template class LevelProof<2, true>;

}  // namespace equipoise
