// The inequalities behind a certificate, box by box, in interval and affine arithmetic.
#include <algorithm>
#include <cmath>

#include "equipoise/classification/proved_regions/level_frame.hpp"
#include "equipoise/classification/proved_regions/level_proof.hpp"
#include "equipoise/core/math/positive_definite.hpp"

namespace equipoise {

template <ProofKind kind>
bool LevelProof<kind>::outside(const Box& box) const {
  Interval distance(0.0);
  for (int k = 0; k < n; ++k) distance = distance + square(Interval(box.low[k], box.high[k]));
  return distance.low > disc_;
}

template <ProofKind kind>
std::array<Interval, LevelProof<kind>::n> LevelProof<kind>::deviation(const Box& box) const {
  std::array<Interval, n> delta{};
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      delta[i] = delta[i] + Interval(frame_[model::index::phi(i)][etas + k]) * Interval(box.low[k], box.high[k]);
  return delta;
}

// On V <= level with tau in the box: the part along tau, and that along eta, |eta|^2 <= disc - |tau|^2.
template <ProofKind kind>
std::array<Interval, LevelProof<kind>::thetas> LevelProof<kind>::speeds(const Box& box) const {
  Interval room(disc_);
  for (int k = 0; k < n; ++k) room = room - Interval(square(Interval(box.low[k], box.high[k])).low);
  std::array<Interval, thetas> q{};
  for (int i = 0; i < thetas; ++i) {
    const auto& row = frame_[row_of_theta(i)];
    Interval length(0.0);
    for (int j = 0; j < etas; ++j) length = length + square(Interval(row[j]));
    const double reach = square_root(length * Interval(std::max(0.0, room.high))).high;
    q[i] = Interval(-reach, reach);
    for (int k = 0; k < n; ++k) q[i] = q[i] + Interval(row[etas + k]) * Interval(box.low[k], box.high[k]);
  }
  return q;
}

// Near the balanced state dV/dt is of second order in d, so bounds on its value prove nothing. But f(d) = S d with a
// slope S enclosed over the box, which holds the ray to each point: the symmetric part of G S D must be negative
// definite.
template <ProofKind kind>
bool LevelProof<kind>::holds_around_centre(const Box& box, double spare) const {
  const auto delta = deviation(box);
  const auto speed = speeds(box);
  std::array<Slope, n> angles;
  for (int i = 0; i < n; ++i) angles[i] = Slope(balance_[i] + delta[i], i);
  const auto f = rates(slope_flow_, angles);
  for (int vertex = 0; vertex < vertices; ++vertex) {
    Rows<Interval, size> change{};
    std::array<Interval, thetas> theta;
    for (int i = 0; i < thetas; ++i) theta[i] = (vertex >> i) & 1 ? speed[i].high : speed[i].low;
    for (int row = 0; row < size; ++row) {
      for (int v = 0; v < etas; ++v)
        change[row][row_of(v)] = f[row].coefficient[1 + v].value - jacobian_[row][row_of(v)];
      for (int i = 0; i < n; ++i) {
        const int phi = model::index::phi(i), q = model::index::q(i, n);
        const Interval bend = f[row].coefficient[Motion<Slope>::square_of(i)].value - square_[row][i];
        change[row][q] = change[row][q] + theta[i] * bend;
        change[row][phi] = f[row].coefficient[0].slope[i] - jacobian_[row][phi];
      }
      if constexpr (kind.driven)
        for (int v = 0; v < etas; ++v) {
          const Interval bend = f[row].coefficient[Motion<Slope>::product_with_speed(v)].value - by_speed_[row][v];
          change[row][row_of(v)] = change[row][row_of(v)] + theta[n] * bend;
        }
    }
    const auto moved = product<size, size, size>(product<size, size, size>(gradient_, change), frame_);
    Rows<Interval, size> fall;
    for (int a = 0; a < size; ++a)
      for (int b = 0; b <= a; ++b) {
        Interval twice = linear_[a][b] + linear_[b][a] + moved[a][b] + moved[b][a];
        for (int i = 0; i < thetas; ++i) twice = twice + theta[i] * (bilinear_[i][a][b] + bilinear_[i][b][a]);
        fall[a][b] = -twice;
      }
    if (!certainly_positive(fall, spare)) return false;
  }
  return true;
}

template <ProofKind kind>
typename LevelProof<kind>::Slice LevelProof<kind>::slice(const Box& box) const {
  Slice s;
  std::array<Affine, n> tau, delta, angles;
  for (int k = 0; k < n; ++k) {
    s.middle[k] = 0.5 * (box.low[k] + box.high[k]);
    s.half[k] = rounded_up(std::max(box.high[k] - s.middle[k], s.middle[k] - box.low[k]));
    tau[k].centre = s.middle[k];
    tau[k].slope[k] = s.half[k];
  }
  s.theta = speeds(box);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) delta[i] = delta[i] + tau[k] * Constant(frame_[model::index::phi(i)][etas + k]);
    angles[i] = Affine(Constant(balance_[i])) + delta[i];
  }
  const auto f = rates(affine_flow_, angles);

  // The remainder of f: still[row] + sum_v moving[row][v] w_v + sum_i theta_i bend[row][i] q_i.
  std::array<Affine, etas> w_of_tau;
  for (int v = 0; v < etas; ++v)
    for (int k = 0; k < n; ++k) w_of_tau[v] = w_of_tau[v] + tau[k] * Constant(frame_[row_of(v)][etas + k]);
  std::array<Affine, size> still;
  Rows<Affine, etas> moving;
  Rows<Affine, n> bend;
  for (int row = 0; row < size; ++row) {
    still[row] = f[row].coefficient[0];
    for (int i = 0; i < n; ++i) {
      still[row] = still[row] - delta[i] * Constant(jacobian_[row][model::index::phi(i)]);
      bend[row][i] = f[row].coefficient[Motion<Affine>::square_of(i)] - Affine(Constant(square_[row][i]));
    }
    for (int v = 0; v < etas; ++v) {
      moving[row][v] = f[row].coefficient[1 + v] - Affine(Constant(jacobian_[row][row_of(v)]));
      still[row] = still[row] + moving[row][v] * w_of_tau[v];
    }
  }

  // G times that, in (eta, tau) instead of w: at_rest[a] + sum_j along[a][j] eta_j, and also for each theta_i.
  std::array<Affine, size> at_rest;
  Rows<Affine, etas> along;
  Rows<Affine, n> bent;
  for (int a = 0; a < size; ++a) {
    std::array<Affine, etas> by_w;
    for (int row = 0; row < size; ++row) {
      const Constant g(gradient_[a][row]);
      at_rest[a] = at_rest[a] + still[row] * g;
      for (int v = 0; v < etas; ++v) by_w[v] = by_w[v] + moving[row][v] * g;
      for (int i = 0; i < n; ++i) bent[a][i] = bent[a][i] + bend[row][i] * g;
    }
    for (int j = 0; j < etas; ++j)
      for (int v = 0; v < etas; ++v) along[a][j] = along[a][j] + by_w[v] * Constant(frame_[row_of(v)][j]);
  }

  // The form in (eta, 1) of (eta; tau)^T (linear (eta; tau) + remainder). Linear terms are affine in tau but for
  // tau^T X tau, which lies below its tangent at the middle if X is negative definite (else see at_corners()).
  const auto fill = [&](Square<Affine>& form, const Rows<Interval, size>& x, const std::array<Affine, size>& rest,
                        const auto& slope) {
    Affine& corner = form[one][one];
    for (int k = 0; k < n; ++k) {
      corner = corner + tau[k] * rest[etas + k];
      for (int j = 0; j < n; ++j) {
        const Interval both = x[etas + k][etas + j] + x[etas + j][etas + k];
        corner = corner + (tau[j] - Affine(0.5 * s.middle[j])) * Constant(both * Interval(s.middle[k]));
      }
    }
    for (int j = 0; j < etas; ++j) {
      Affine sum = rest[j];
      for (int k = 0; k < n; ++k)
        sum = sum + tau[k] * Constant(x[j][etas + k] + x[etas + k][j]) + tau[k] * slope(etas + k, j);
      form[one][j] = sum * Constant(0.5);
      for (int i = j; i < etas; ++i)
        form[i][j] = (Affine(Constant(x[i][j] + x[j][i])) + slope(i, j) + slope(j, i)) * Constant(0.5);
    }
  };
  fill(s.base, linear_, at_rest, [&](int a, int j) { return along[a][j]; });
  for (int i = 0; i < n; ++i) {
    std::array<Affine, size> rest;
    for (int a = 0; a < size; ++a) rest[a] = bent[a][i] * w_of_tau[4 + i];
    const auto& q_row = frame_[model::index::q(i, n)];
    fill(s.part[i], bilinear_[i], rest, [&](int a, int j) { return bent[a][i] * Constant(q_row[j]); });
  }
  if constexpr (kind.driven) {
    Rows<Affine, etas> bend_by_speed, by_eta;
    for (int row = 0; row < size; ++row)
      for (int v = 0; v < etas; ++v)
        bend_by_speed[row][v] =
            f[row].coefficient[Motion<Affine>::product_with_speed(v)] - Affine(Constant(by_speed_[row][v]));
    std::array<Affine, size> rest;
    for (int a = 0; a < size; ++a)
      for (int v = 0; v < etas; ++v) {
        Affine by_w;
        for (int row = 0; row < size; ++row) by_w = by_w + bend_by_speed[row][v] * Constant(gradient_[a][row]);
        rest[a] = rest[a] + by_w * w_of_tau[v];
        for (int j = 0; j < etas; ++j) by_eta[a][j] = by_eta[a][j] + by_w * Constant(frame_[row_of(v)][j]);
      }
    fill(s.part[n], bilinear_[n], rest, [&](int a, int j) { return by_eta[a][j]; });
  }
  return s;
}

template <ProofKind kind>
std::array<typename LevelProof<kind>::Corner, LevelProof<kind>::corners> LevelProof<kind>::at_corners(
    const Slice& s, int vertex, double spare) const {
  std::array<double, thetas> theta;
  for (int i = 0; i < thetas; ++i) theta[i] = (vertex >> i) & 1 ? s.theta[i].high : s.theta[i].low;
  Square<Affine> form = s.base;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k < thetas; ++k) form[i][j] = form[i][j] + s.part[k][i][j] * Constant(theta[k]);

  // rho^T X rho over the box, X the matrix of tau^T X tau.
  Interval x[n][n], excess(0.0);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) {
      x[k][j] = linear_[etas + k][etas + j] + linear_[etas + j][etas + k];
      for (int i = 0; i < thetas; ++i)
        x[k][j] = x[k][j] + Interval(theta[i]) * (bilinear_[i][etas + k][etas + j] + bilinear_[i][etas + j][etas + k]);
    }
  bool falling = x[0][0].high < 0.0;
  if constexpr (n == 2) falling = falling && (x[0][0] * x[1][1] - x[0][1] * x[1][0]).low > 0.0;
  if (!falling)
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        excess = excess + Interval(0.5 * std::max(0.0, k == j ? x[k][j].high : x[k][j].magnitude())) *
                              Interval(s.half[k]) * Interval(s.half[j]);

  // Radii of a row go to its diagonal, as in certainly_positive(); so does the rounding of the sums below.
  std::array<double, side> spread{};
  for (int i = 0; i < side; ++i)
    for (int j = 0; j <= i; ++j) {
      const Affine& entry = form[i][j];
      const double bound = entry.radius + (0x1p-46 + spare) * (std::fabs(entry.centre) + entry.swing());
      spread[i] += bound;
      if (j != i) spread[j] += bound;
    }
  for (double& sum : spread) sum *= Affine::grown;
  spread[one] = rounded_up(spread[one] + excess.high);

  std::array<Corner, corners> result;
  for (int c = 0; c < corners; ++c) {
    Corner& corner = result[c];
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j <= i; ++j) {
        double value = form[i][j].centre;
        for (int k = 0; k < n; ++k) value += (c >> k) & 1 ? form[i][j].slope[k] : -form[i][j].slope[k];
        corner.form[i][j] = value;
      }
      corner.form[i][i] = rounded_up(corner.form[i][i] + spread[i]);
    }
    // disc - |tau|^2 below its tangent at the middle.
    Interval room(disc_);
    for (int k = 0; k < n; ++k) {
      const Interval m(s.middle[k]), h((c >> k) & 1 ? s.half[k] : -s.half[k]);
      room = room - m * (m + Interval(2.0) * h);
    }
    corner.room = room.high;
  }
  return result;
}

template <ProofKind kind>
bool LevelProof<kind>::central(const Box& box) {
  for (int k = 0; k < n; ++k)
    if (!(box.low[k] <= 0.0 && box.high[k] >= 0.0)) return false;
  return true;
}

template <ProofKind kind>
bool LevelProof<kind>::find(Box& box) const {
  if (central(box)) return holds_around_centre(box, spare_in_search);
  const Slice s = slice(box);
  for (int vertex = 0; vertex < vertices; ++vertex)
    if (!find_multiplier(at_corners(s, vertex, spare_in_search), box.multiplier[vertex])) return false;
  return true;
}

template <ProofKind kind>
bool LevelProof<kind>::holds(const Box& box) const {
  if (central(box)) return holds_around_centre(box, 0.0);
  const Slice s = slice(box);
  for (int vertex = 0; vertex < vertices; ++vertex) {
    if (!(box.multiplier[vertex] >= 0.0)) return false;
    double bound;
    for (const Corner& corner : at_corners(s, vertex, 0.0))
      if (judge(corner, box.multiplier[vertex], bound) != Multiplier::proves) return false;
  }
  return true;
}

}  // namespace equipoise

#include "equipoise/classification/proved_regions/level_proof_kinds.inc"
