// At fixed ball angles, with q_i^2 read as theta_i q_i, the equations are exactly h' = A h. An interval matrix A over a
// box of angles proves what holds all over it.
#include "equipoise/extras/proof/certify.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/expansion.hpp"
#include "equipoise/core/math/interval.hpp"
#include "equipoise/core/math/krawczyk.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/core/math/positive_definite.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/classification/proved_regions/level_proof.hpp"

namespace equipoise {

namespace {

constexpr int most = model::max_balls, most_rows = most + 6;
using Angles = std::array<Interval, most>;
using Matrix = std::array<std::array<Interval, most_rows>, most_rows>;
using E = Expansion<Interval, most>;
using Flow =
    HWY_NAMESPACE::FreeFlow<E, model::any_count, HWY_NAMESPACE::Terms{false, false, false, false, false, true}>;

// Of h, or less where fewer balls than there is room for run.
int rows_of(const model::Parameters& p) { return p.balls + 6; }

double unit(const model::Parameters& p, int row) { return row >= 4 && row < 4 + p.balls ? 1.0 : p.all_unbalances(); }

// A over a box of ball angles, all |q_i| at most `fastest`, in units of h. False if the equations are of another shape.
bool enclose(const model::Parameters& p, double speed, const Angles& phi, double fastest, Matrix& a) {
  const int n = p.balls, rows = rows_of(p), ux = 4 + n, uy = 5 + n;
  const Flow flow(p, model::Segment{0.0, 0.0, 0.0, speed, 0.0, false});
  std::array<E, model::dimension(most)> z, f;
  for (int v = 0; v < 4; ++v) z[v] = E::variable(v);
  for (int i = 0; i < n; ++i) {
    z[model::index::phi(i)] = E(phi[i]);
    z[model::index::q(i, n)] = E::variable(4 + i);
  }
  flow(E(0.0), z.data(), f.data());
  a = {};
  const Interval force = square(Interval(speed)) / Interval(p.stiffness[0]);
  for (int row = 0; row < 4 + n; ++row) {
    const E& rate = f[row < 4 ? row : row + n];
    if (rate.beyond) return false;
    for (int v = 0; v < 4 + n; ++v) a[row][v] = rate.coefficient[1 + v];
    for (int i = 0; i < n; ++i)
      a[row][4 + i] = a[row][4 + i] + rate.coefficient[E::square_of(i)] * Interval(-fastest, fastest);
    if (row < 2) continue;
    a[row][ux] = -(force * rate.coefficient[1]);
    a[row][uy] = -(force * rate.coefficient[2]);
  }
  for (int i = 0; i < n; ++i) {
    Interval s, c;
    sin_cos(phi[i], s, c);
    a[ux][4 + i] = -(Interval(p.mass[i]) * s);
    a[uy][4 + i] = Interval(p.mass[i]) * c;
  }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) a[i][j] = a[i][j] * Interval(unit(p, j)) / Interval(unit(p, i));
  return true;
}

Angles box(const MemberCertificate& c) {
  Angles phi{};
  for (int i = 0; i < c.parameters.balls; ++i) phi[i] = Interval(c.phi[i]) + Interval(-c.radius, c.radius);
  return phi;
}

// Rows beyond those of h are the unit matrix's.
Matrix padded(int rows) {
  Matrix m{};
  for (int i = rows; i < most_rows; ++i) m[i][i] = 1.0;
  return m;
}

// -(P A + A^T P) - 2 rate P is positive definite all over the box.
bool falls(const MemberCertificate& c, double fastest, double spare) {
  const int rows = rows_of(c.parameters);
  Matrix a, fall = padded(rows);
  if (!enclose(c.parameters, c.speed, box(c), fastest, a)) return false;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j <= i; ++j) {
      Interval sum = Interval(2.0) * Interval(c.rate) * Interval(c.form(i, j));
      for (int k = 0; k < rows; ++k) sum = sum + Interval(c.form(i, k)) * a[k][j] + Interval(c.form(j, k)) * a[k][i];
      fall[i][j] = -sum;
    }
  return certainly_positive(fall, spare);
}

// P - least is positive definite.
bool bounded_below(const MemberCertificate& c) {
  const int rows = rows_of(c.parameters);
  Matrix form = padded(rows);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j <= i; ++j) form[i][j] = Interval(c.form(i, j)) - Interval(i == j ? c.least : 0.0);
  return c.least > 0.0 && certainly_positive(form, 0.0);
}

// Whether the box holds a balanced state: all angles but two are as given, and the two that turn the unbalance most
// independently are solved for. So nearby angles leave any small unbalance whatever.
bool holds_balance(const MemberCertificate& c) {
  const model::Parameters& p = c.parameters;
  int first = 0, second = 1;
  const auto area = [&](int i, int k) { return p.mass[i] * p.mass[k] * std::fabs(std::sin(c.phi[i] - c.phi[k])); };
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (area(k, i) > area(first, second)) {
        first = k;
        second = i;
      }
  const auto left = [&](const std::array<PlaneGradient, 2>& two) {
    std::array<PlaneGradient, 2> sum{PlaneGradient(p.eccentricity), PlaneGradient(0.0)};
    for (int i = 0; i < p.balls; ++i) {
      PlaneGradient s, cosine;
      sin_cos(i == first ? two[0] : i == second ? two[1] : PlaneGradient(c.phi[i]), s, cosine);
      sum[0] = sum[0] + PlaneGradient(p.mass[i]) * cosine;
      sum[1] = sum[1] + PlaneGradient(p.mass[i]) * s;
    }
    return sum;
  };
  std::array<Interval, 2> found{};
  return enclose_zero(left, {c.phi[first], c.phi[second]}, c.radius, found);
}

bool escapes(const MemberCertificate& c) {
  const int rows = rows_of(c.parameters);
  if (c.escape.size() != rows) return false;
  Interval v(0.0);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) v = v + Interval(c.form(i, j)) * Interval(c.escape[i]) * Interval(c.escape[j]);
  return v.high < 0.0;
}

CertificateResult verify(const MemberCertificate& c, double spare) {
  const int rows = rows_of(c.parameters);
  if (c.form.rows() != rows || c.form.cols() != rows || !c.form.allFinite() || c.form != c.form.transpose())
    return {false, "the form does not fit the number of balls"};
  if (!(c.radius > 0.0 && c.radius < 1.0)) return {false, "the radius must be greater than 0 and less than 1"};
  if (c.attracts) {
    const Interval fastest = Interval(c.rate) * Interval(0.5 * c.radius);
    if (!(c.rate > 0.0) || !bounded_below(c)) return {false, "V is not positive definite"};
    if (!(c.level > 0.0 && c.level <= (Interval(c.least) * square(fastest)).low))
      return {false, "the level is not what rate and radius allow"};
    return falls(c, fastest.high, spare) ? CertificateResult{true, ""} : CertificateResult{false, no_decrease_in_box};
  }
  if (c.rate != 0.0 || !escapes(c)) return {false, "V is not negative in the direction of escape"};
  if (!holds_balance(c)) return {false, "no balanced state was found in the box"};
  return falls(c, c.radius, spare) ? CertificateResult{true, ""} : CertificateResult{false, no_decrease_in_box};
}

Eigen::MatrixXd middle(const model::Parameters& p, double speed, const double* angles) {
  Angles phi{};
  for (int i = 0; i < p.balls; ++i) phi[i] = angles[i];
  Matrix a;
  const int rows = rows_of(p);
  Eigen::MatrixXd result(rows, rows);
  enclose(p, speed, phi, 0.0, a);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) result(i, j) = a[i][j].middle();
  return result;
}

// The largest radius of a falling series that proves it.
MemberCertificate with_radius(MemberCertificate c, double largest, double smallest) {
  for (c.radius = largest; c.radius >= smallest; c.radius *= 0.5) {
    const double fastest = 0.5 * c.rate * c.radius;
    c.level = c.attracts ? c.least * fastest * fastest * (1.0 - 1e-12) : 0.0;
    if (verify(c, spare_in_search).proved) return c;
  }
  c.radius = c.level = 0.0;
  return c;
}

std::string refusal(const model::Parameters& p, double speed) {
  if (p.balls < 3 || p.balls > most) return "proofs about a continuum are for three balls or more";
  if (!p.isotropic()) return "proofs need supports that are equal in x and y";
  if (p.gravity != 0.0) return "proofs need gravity 0";
  if (!p.race_is_centred()) return "proofs about a continuum need a centred race";
  if (p.balls_collide() || p.balls_stick()) return "proofs need balls that pass each other freely and do not stick";
  if (!std::isfinite(speed)) return speed_is_finite;
  return "";
}

}  // namespace

MemberCertificate prove_member(const model::Parameters& p, double speed, const double* phi) {
  constexpr double share_of_rate = 0.5, slowest = 1e-6;
  MemberCertificate c;
  c.parameters = p;
  c.speed = speed;
  std::copy(phi, phi + p.balls, c.phi.begin());
  if (!refusal(p, speed).empty()) return c;
  const Eigen::MatrixXd a = middle(p, speed, phi);
  const double growth = dense::largest_real_part(a);
  if (!a.allFinite() || std::fabs(growth) < slowest) return c;
  const auto one = Eigen::MatrixXd::Identity(a.rows(), a.cols());
  if (growth < 0.0) {
    c.rate = -share_of_rate * growth;
    const Eigen::MatrixXd form = solve_lyapunov(a + c.rate * one, one);
    c.form = 0.5 * (form + form.transpose());
    c.least = 0.99 * dense::symmetric_eigenvalues(c.form).minCoeff();
    return with_radius(c, 0.25, 1e-7);
  }
  c.attracts = false;
  const Modes modes = left_modes(a);
  Eigen::VectorXd weights(a.rows());
  for (Eigen::Index k = 0; k < a.rows(); ++k) weights[k] = modes.rates[k].real() < 0.0 ? 1.0 : -1.0;
  const Eigen::MatrixXd form = modal_form(modes, weights);
  c.form = 0.5 * (form + form.transpose());
  c.escape = dense::symmetric_eigenvectors(c.form).col(0);
  return with_radius(c, 1e-3, 1e-10);
}

double across_continuum(const model::Parameters& p, double speed, const double* phi) {
  return dense::largest_real_part(middle(p, speed, phi));
}

CertificateResult check_member(const MemberCertificate& c) {
  if (std::string reason = refusal(c.parameters, c.speed); !reason.empty()) return {false, reason};
  return verify(c, 0.0);
}

}  // namespace equipoise
