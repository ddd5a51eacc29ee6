// The characteristic polynomial, and the signs of the first column of Routh's array.
#include "equipoise/extras/proof/balance_boxes.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace equipoise {

namespace {

using BoxPolynomial = std::vector<BoxNumber>;  // lowest power first

bool certainly_positive(const BoxNumber& a) { return a.centre > a.reach(); }
bool certainly_negative(const BoxNumber& a) { return -a.centre > a.reach(); }

BoxPolynomial product(const BoxPolynomial& a, const BoxPolynomial& b) {
  BoxPolynomial r(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) r[i + k] = r[i + k] + a[i] * b[k];
  return r;
}

BoxPolynomial sum(const BoxPolynomial& a, const BoxPolynomial& b) {
  BoxPolynomial r(std::max(a.size(), b.size()));
  for (std::size_t k = 0; k < r.size(); ++k) {
    if (k < a.size()) r[k] = r[k] + a[k];
    if (k < b.size()) r[k] = r[k] + b[k];
  }
  return r;
}

BoxPolynomial times(BoxPolynomial a, const BoxNumber& b) {
  for (BoxNumber& v : a) v = v * b;
  return a;
}

// lambda^2 - (mu_1 - mu_2)^2 and (mu_1 + mu_2)^2 - lambda^2: balanced states exist where neither is negative.
std::array<BoxNumber, 2> triangle_factors(const BoxRotor& r) {
  const BoxNumber sum_of_masses = r.mass[0] + r.mass[1], difference = r.mass[0] - r.mass[1];
  return {(r.eccentricity - difference) * (r.eccentricity + difference),
          (sum_of_masses - r.eccentricity) * (sum_of_masses + r.eccentricity)};
}

}  // namespace

// With sigma the eigenvalue over the speed, b, z, k drag, damping and stiffness over the speed (k: its square), N the
// masses' sum and S = mu_1 mu_2 sin^2(phi_1 - phi_2):
//   a = sigma (sigma + b) ((1 + N)(sigma^2 - 1) + z sigma + k),  c = sigma (sigma + b) (2 (1 + N) sigma + z),
//   a^2 + c^2 - N (a ((sigma^2 - 1)^2 - 4 sigma^2) + 4 c sigma (sigma^2 - 1)) + S (sigma^2 + 1)^4.
std::array<BoxNumber, 9> balance_polynomial(const BoxRotor& r) {
  const BoxNumber one(1.0), total = r.mass[0] + r.mass[1], whole = one + total;
  const BoxNumber b = r.drag / r.speed, z = r.damping / r.speed, k = r.stiffness / r.speed / r.speed;
  const std::array<BoxNumber, 2> factors = triangle_factors(r);
  const BoxNumber spread = factors[0] * factors[1] / (r.mass[0] * r.mass[1] * Constant(4.0));
  const BoxPolynomial ball{BoxNumber(0.0), b, one};
  const BoxPolynomial a = product(ball, {k - whole, z, whole});
  const BoxPolynomial c = product(ball, {z, whole * Constant(2.0)});
  const BoxPolynomial d{one, BoxNumber(0.0), BoxNumber(-6.0), BoxNumber(0.0), one};        // (u^2 - 4 sigma^2)
  const BoxPolynomial e{BoxNumber(0.0), BoxNumber(-4.0), BoxNumber(0.0), BoxNumber(4.0)};  // 4 sigma u
  const BoxPolynomial squared{one, BoxNumber(0.0), one};
  const BoxPolynomial fourth = product(product(squared, squared), product(squared, squared));
  const BoxPolynomial all = sum(
      sum(sum(product(a, a), product(c, c)), times(sum(product(a, d), product(c, e)), -total)), times(fourth, spread));
  std::array<BoxNumber, 9> result;
  std::copy_n(all.begin(), result.size(), result.begin());
  return result;
}

BalanceKind judge_box(const BoxRotor& r) {
  for (const BoxNumber& factor : triangle_factors(r))
    if (certainly_negative(factor)) return BalanceKind::none;
  for (const BoxNumber& factor : triangle_factors(r))
    if (!certainly_positive(factor)) return BalanceKind::open;
  for (const BoxNumber& positive : {r.speed, r.mass[0], r.mass[1]})
    if (!certainly_positive(positive)) return BalanceKind::open;
  const std::array<BoxNumber, 9> coefficient = balance_polynomial(r);
  BoxPolynomial above, row;
  for (int k = 8; k >= 0; k -= 2) above.push_back(coefficient[static_cast<std::size_t>(k)]);
  for (int k = 7; k >= 0; k -= 2) row.push_back(coefficient[static_cast<std::size_t>(k)]);
  if (!certainly_positive(above.front())) return BalanceKind::open;
  // All zeros have negative real parts if the first column is positive. If none had a positive one, no entry after
  // positive ones could be negative: it is a quotient of Hurwitz determinants, which are then 0 or more.
  for (int rows = 0; rows < 8; ++rows) {  // a sign for each power below the highest
    if (certainly_negative(row.front())) return BalanceKind::unstable;
    if (!certainly_positive(row.front())) return BalanceKind::open;
    const BoxNumber ratio = above.front() / row.front();
    BoxPolynomial below;
    for (std::size_t k = 1; k < above.size(); ++k)
      below.push_back(k < row.size() ? above[k] - ratio * row[k] : above[k]);
    above = row;
    row = below;
  }
  return BalanceKind::stable;
}

}  // namespace equipoise
