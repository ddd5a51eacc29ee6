// Polynomials of first degree in (x, y, u, v, q_1..q_n) plus the squares q_i^2, with coefficients of any number type.
// For driven rotors, the speed and the control's error integral are also variables, and products of the speed with any
// variable are terms.
//
// A number type of the equations (requirements: core/base/pack-inl.hpp): run on it, the equations return their own
// coefficients. `beyond` reports a product outside this set; the present equations never form one.
#pragma once

#include <cstdint>

namespace equipoise {

template <class T, int n, int more = 0>
struct Expansion {
  static constexpr int variables = 4 + n + more;  ///< x, y, u, v, then q_i, the rotor's speed, the integral
  static constexpr int speed = 4 + n;             ///< the variable, if more > 0
  /// 1, the variables, the squares of q_i, the products with the rotor's speed.
  static constexpr int terms = 1 + variables + n + (more > 0 ? variables : 0);
  static constexpr int square_of(int ball) { return 1 + variables + ball; }
  static constexpr int product_with_speed(int variable) { return 1 + variables + n + variable; }

  T coefficient[terms]{};
  static_assert(terms <= 64);
  std::uint64_t present = 0;  ///< one bit per term; absent terms are exactly 0
  bool beyond = false;

  Expansion() = default;
  Expansion(double v) : Expansion(T(v)) {}
  explicit Expansion(const T& constant) : present(1) { coefficient[0] = constant; }
  /// Variable number `index`.
  static Expansion variable(int index) {
    Expansion r;
    r.add(1 + index, T(1.0));
    return r;
  }

  bool constant() const { return present <= 1; }

  friend Expansion operator+(const Expansion& a, const Expansion& b) {
    Expansion r = a;
    r.beyond = a.beyond || b.beyond;
    for (int i = 0; i < terms; ++i)
      if (b.has(i)) r.add(i, b.coefficient[i]);
    return r;
  }
  friend Expansion operator-(const Expansion& a) {
    Expansion r = a;
    for (int i = 0; i < terms; ++i)
      if (a.has(i)) r.coefficient[i] = -a.coefficient[i];
    return r;
  }
  friend Expansion operator-(const Expansion& a, const Expansion& b) { return a + (-b); }
  friend Expansion operator*(const Expansion& a, const Expansion& b) {
    Expansion r;
    r.beyond = a.beyond || b.beyond;
    for (int i = 0; i < terms; ++i) {
      if (!a.has(i)) continue;
      for (int j = 0; j < terms; ++j) {
        if (!b.has(j)) continue;
        if (i == 0 || j == 0)
          r.add(i + j, a.coefficient[i] * b.coefficient[j]);
        else if (i == j && i > 4 && i <= 4 + n)
          r.add(square_of(i - 5), a.coefficient[i] * b.coefficient[j]);
        else if (more > 0 && i == 1 + speed && j <= variables)
          r.add(product_with_speed(j - 1), a.coefficient[i] * b.coefficient[j]);
        else if (more > 0 && j == 1 + speed && i <= variables)
          r.add(product_with_speed(i - 1), a.coefficient[i] * b.coefficient[j]);
        else
          r.beyond = true;
      }
    }
    return r;
  }
  friend Expansion operator/(const Expansion& a, const Expansion& b) {
    Expansion r = a;
    r.beyond = a.beyond || b.beyond || !b.constant();
    for (int i = 0; i < terms; ++i)
      if (a.has(i)) r.coefficient[i] = a.coefficient[i] / b.coefficient[0];
    return r;
  }

 private:
  bool has(int term) const { return (present >> term) & 1; }
  void add(int term, const T& value) {
    coefficient[term] = has(term) ? coefficient[term] + value : value;
    present |= std::uint64_t{1} << term;
  }
};

template <class T, int n, int more>
void sin_cos(const Expansion<T, n, more>& a, Expansion<T, n, more>& sine, Expansion<T, n, more>& cosine) {
  T s, c;
  sin_cos(a.coefficient[0], s, c);
  sine = Expansion<T, n, more>(s);
  cosine = Expansion<T, n, more>(c);
  sine.beyond = cosine.beyond = a.beyond || !a.constant();
}

}  // namespace equipoise
