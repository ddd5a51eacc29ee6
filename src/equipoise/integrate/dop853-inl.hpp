// The arithmetic of one DOP853 step, for any number type: stage states, solution, error estimate, dense output.
// Zero entries of the tableau leave no operation behind. Included once per CPU target.
#if defined(EQUIPOISE_INTEGRATE_DOP853_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_DOP853_INL
#undef EQUIPOISE_INTEGRATE_DOP853_INL
#else
#define EQUIPOISE_INTEGRATE_DOP853_INL
#endif

#include "equipoise/base/pack-inl.hpp"
#include "equipoise/integrate/dop853_tableau.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {
namespace dop853 {

namespace tableau = ::equipoise::dop853;

// The weights a sum runs over; at(j) is the weight of stage j, count how many stages may enter.
template <int row>
struct StageWeights {
  static constexpr int count = row;
  static constexpr double at(int j) { return tableau::a[row][j]; }
};
struct Error5Weights {
  static constexpr int count = tableau::stages;
  static constexpr double at(int j) { return tableau::error5[j]; }
};
struct Error3Weights {
  static constexpr int count = tableau::stages;
  static constexpr double at(int j) { return tableau::error3[j]; }
};
template <int row>
struct DenseWeights {
  static constexpr int count = tableau::dense_stages;
  static constexpr double at(int j) { return tableau::dense[row][j]; }
};

// sum + sum over j >= `from` of weight_j k[j][component].
template <class Weights, int from, class T, int dimension>
HWY_INLINE T add_stages(const T (*k)[dimension], int component, T sum) {
  if constexpr (from == Weights::count) {
    return sum;
  } else if constexpr (Weights::at(from) == 0.0) {
    return add_stages<Weights, from + 1, T, dimension>(k, component, sum);
  } else {
    return add_stages<Weights, from + 1, T, dimension>(k, component,
                                                       multiply_add(T(Weights::at(from)), k[from][component], sum));
  }
}

template <class Weights, class T, int dimension>
HWY_INLINE T weighted_sum(const T (*k)[dimension], int component) {
  return add_stages<Weights, 1, T, dimension>(k, component, T(Weights::at(0)) * k[0][component]);
}

// out = y + h sum_j a[row][j] k[j]: the state at which stage `row` is evaluated (row 12: the step's end).
template <int row, class T, int dimension>
HWY_INLINE void stage_state(const T& h, const T* y, const T (*k)[dimension], T* out) {
  for (int i = 0; i < dimension; ++i) out[i] = multiply_add(h, weighted_sum<StageWeights<row>>(k, i), y[i]);
}

// Evaluates stages `row` to 11, then writes the step's end to `end`. k[0] = f(t, y) must be there.
template <int row = 1, class System, class T, int dimension>
HWY_INLINE void evaluate_stages(const System& f, const T& t, const T& h, const T* y, T (*k)[dimension], T* end) {
  stage_state<row, T, dimension>(h, y, k, end);
  if constexpr (row < tableau::stages) {
    f(multiply_add(T(tableau::c[row]), h, t), static_cast<const T*>(end), k[row]);
    evaluate_stages<row + 1>(f, t, h, y, k, end);
  }
}

// The square of the error norm of Hairer and others, h^2 e5^4/(e5^2 + e3^2/100) per component: at most 1 is accepted.
// `inverse_scale[i]` is one over the error allowed in component i.
template <class T, int dimension>
HWY_INLINE T squared_error(const T& h, const T (*k)[dimension], const T* inverse_scale) {
  T sum5(0.0), sum3(0.0);
  for (int i = 0; i < dimension; ++i) {
    const T e5 = weighted_sum<Error5Weights>(k, i) * inverse_scale[i];
    const T e3 = weighted_sum<Error3Weights>(k, i) * inverse_scale[i];
    sum5 = multiply_add(e5, e5, sum5);
    sum3 = multiply_add(e3, e3, sum3);
  }
  // The tiny number keeps 0/0 away where both estimates vanish (a rotor at rest).
  const T denominator = T(double(dimension)) * multiply_add(T(0.01), sum3, sum5) + T(1e-300);
  return h * h * sum5 * sum5 / denominator;
}

// The seven coefficient rows of the dense output; stages 12 to 15 of k are needed.
template <class T, int dimension>
HWY_INLINE void dense_coefficients(const T& h, const T* y, const T* end, const T (*k)[dimension],
                                   T (*rows)[dimension]) {
  for (int i = 0; i < dimension; ++i) {
    const T change = end[i] - y[i];
    rows[0][i] = change;
    rows[1][i] = h * k[0][i] - change;
    rows[2][i] = change + change - h * (k[12][i] + k[0][i]);
    rows[3][i] = h * weighted_sum<DenseWeights<0>>(k, i);
    rows[4][i] = h * weighted_sum<DenseWeights<1>>(k, i);
    rows[5][i] = h * weighted_sum<DenseWeights<2>>(k, i);
    rows[6][i] = h * weighted_sum<DenseWeights<3>>(k, i);
  }
}

// The state at the fraction `s` of the step, 0 <= s <= 1.
template <class T, int dimension>
HWY_INLINE void dense_state(const T& s, const T* y, const T (*rows)[dimension], T* out) {
  const T r = T(1.0) - s;
  for (int i = 0; i < dimension; ++i) {
    T sum = rows[6][i];
    sum = rows[5][i] + s * sum;
    sum = rows[4][i] + r * sum;
    sum = rows[3][i] + s * sum;
    sum = rows[2][i] + r * sum;
    sum = rows[1][i] + s * sum;
    sum = rows[0][i] + r * sum;
    out[i] = y[i] + s * sum;
  }
}

}  // namespace dop853
}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
