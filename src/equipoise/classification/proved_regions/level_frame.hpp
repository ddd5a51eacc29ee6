// The frame of a level set, checked with intervals; and proofs about balance of a tilting rotor.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/core/math/interval.hpp"

namespace equipoise {

/// What is wrong with a certificate about an isolated balanced state.
inline constexpr char form_frame_level[] = "form, frame or level do not fit the number of balls";
inline constexpr char other_speed[] = "the speed is not that of balance";
inline constexpr char angles_enclose_none[] = "the ball angles do not enclose a balanced state";
inline constexpr char reaches_around[] = "the level set reaches around the race";
inline constexpr char angles_not_close[] = "the ball angles are not close enough to a balanced state";
inline constexpr char motor_reaches_limit[] = "the motor reaches its limit on the level set";

template <int rows, int inner, int columns, class A, class B>
auto product(const A& a, const B& b) {
  std::array<std::array<Interval, columns>, rows> result{};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      for (int k = 0; k < inner; ++k) result[i][j] = result[i][j] + Interval(a[i][k]) * Interval(b[k][j]);
  return result;
}

/// Says what is wrong, or null if the frame D makes the form P the unit one up to `error`. Both are then regular, and
/// the form is positive definite. `gradient`: D^T P / level. `disc`: a bound on |D^-1 d|^2 on V <= level.
template <int size>
const char* enclose_frame(const Certificate& c, double error, std::array<std::array<Interval, size>, size>& gradient,
                          double& disc) {
  std::array<std::array<double, size>, size> form{}, frame{}, transposed{};
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      form[i][j] = c.form(i, j);
      frame[i][j] = transposed[j][i] = c.frame(i, j);
      if (c.form(i, j) != c.form(j, i)) return "the form is not symmetric";
    }
  gradient = product<size, size, size>(transposed, form);
  for (auto& row : gradient)
    for (Interval& entry : row) entry = entry / Interval(c.level);
  const auto unit = product<size, size, size>(gradient, frame);
  for (int i = 0; i < size; ++i) {
    Interval sum(0.0);
    for (int j = 0; j < size; ++j) sum = sum + Interval((unit[i][j] - Interval(i == j ? 1.0 : 0.0)).magnitude());
    if (!(sum.high < error)) return "the frame does not make the level set of the form the unit ball";
  }
  disc = ((Interval(1.0) + Interval(level_slack)) / (Interval(1.0) - Interval(error))).high;
  return nullptr;
}

/// Says whether doubles for the exact balanced state move sqrt V by less than `shift` of its largest value. `away`:
/// bounds on their errors.
template <int size>
bool is_centred(const Certificate& c, const std::array<Interval, size>& away, double shift) {
  Interval moved(0.0);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) moved = moved + away[i] * away[j] * Interval(std::fabs(c.form(i, j)));
  return moved.high < shift * shift * c.level;
}

// Of a tilting rotor: two balls in each of two planes (docs/explanation/proof.md).

inline constexpr char two_planes_of_two[] = "for tilting rotors, only two balls in each of two planes can be proved";
inline constexpr char plane_with_nothing_to_cancel[] =
    "a plane whose balls have nothing to cancel has a continuum of balanced states; proofs are for isolated ones";

/// Why no proof is tried of this tilting rotor; empty if one is.
std::string tilt_refusal(const model::System& system);

/// Verifies a certificate of a tilting rotor, which has no boxes: one bound on the equations' slope over the box
/// around V <= level proves that V decreases. `spare`: as spare_in_search.
CertificateResult check_tilt(const Certificate& certificate, double spare);

}  // namespace equipoise
