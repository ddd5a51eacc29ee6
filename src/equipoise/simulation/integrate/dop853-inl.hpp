// The arithmetic of one DOP853 step, for any number type: stage states, solution, error estimate, dense output.
// Included once per CPU target.
#if defined(EQUIPOISE_INTEGRATE_DOP853_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_DOP853_INL
#undef EQUIPOISE_INTEGRATE_DOP853_INL
#else
#define EQUIPOISE_INTEGRATE_DOP853_INL
#endif

#include <type_traits>

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/simulation/integrate/dop853_tableau.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {
namespace dop853 {

namespace tableau = ::equipoise::dop853;

// Stages 1 to 4 carry no weight in the solution, its error estimates and the dense output.
inline constexpr int first_of_solution = 5;

// The rows of the tableau without their zeros, as data: one short loop walks a row, so that all stages share one copy
// of the code. (With the equations unrolled into every stage the code no longer fits the processor's cache of decoded
// instructions: 1.4 times slower where this was measured.)
struct SparseRows {
  static constexpr int rows = tableau::dense_stages;
  int begin[rows + 1] = {};
  int stage[rows * rows] = {};
  double weight[rows * rows] = {};

  constexpr SparseRows() {
    int at = 0;
    for (int row = 0; row < rows; ++row) {
      begin[row] = at;
      for (int j = 0; j < row; ++j) {
        if (tableau::a[row][j] == 0.0) continue;
        stage[at] = j;
        weight[at] = tableau::a[row][j];
        ++at;
      }
    }
    begin[rows] = at;
  }
};
inline constexpr SparseRows sparse_rows;

// The largest divisor of `size` up to `most`: components whose sums stay in registers.
constexpr int components_at_a_time(int size, int most) {
  while (size % most != 0) --most;
  return most;
}

// Arrays have room for `room` components, of which the first `size` are used: by default all, as a constant.
template <int room>
using Full = std::integral_constant<int, room>;

// Calls block(count, from) for the components from `from` on, `count` (a constant) at a time.
template <int most, class Size, class Block>
HWY_INLINE void by_blocks(Size size, Block&& block) {
  if constexpr (std::is_same_v<Size, int>) {
    int from = 0;
    for (; from + 8 <= size; from += 8) block(Full<8>{}, from);
    for (; from + 4 <= size; from += 4) block(Full<4>{}, from);
    for (; from < size; ++from) block(Full<1>{}, from);
  } else {
    constexpr int count = components_at_a_time(Size::value, most);
#pragma GCC unroll 1
    for (int from = 0; from < Size::value; from += count) block(Full<count>{}, from);
  }
}

// out = y + h sum_j a[row][j] k[j]: the state at which stage `row` >= 1 is evaluated (row 12: the step's end). Stage by
// stage, so that each weight is loaded once and the chains of additions, one per component, run side by side.
template <class T, int room, class Size = Full<room>>
HWY_INLINE void stage_state(int row, const T& h, const T* y, const T (*k)[room], T* out, Size size = {}) {
  const int begin = sparse_rows.begin[row], end = sparse_rows.begin[row + 1];
  by_blocks<14>(size, [&](auto count, int from) HWY_ATTR {
    constexpr int block = count;
    T sum[block];
    const T first(sparse_rows.weight[begin]);  // every row has a weight for stage 0
    for (int i = 0; i < block; ++i) sum[i] = first * k[0][from + i];
#pragma GCC unroll 1
    for (int at = begin + 1; at < end; ++at) {
      const T weight(sparse_rows.weight[at]);
      const T* stage = k[sparse_rows.stage[at]] + from;
      for (int i = 0; i < block; ++i) sum[i] = multiply_add(weight, stage[i], sum[i]);
    }
    for (int i = 0; i < block; ++i) out[from + i] = multiply_add(h, sum[i], y[from + i]);
  });
}

// Evaluates stages 1 to 11. k[0] = f(t, y) must be set.
template <class System, class T, int room, class Size = Full<room>>
HWY_INLINE void evaluate_stages(const System& f, const T& t, const T& h, const T* y, T (*k)[room], Size size = {}) {
  T state[room];
#pragma GCC unroll 1
  for (int row = 1; row < tableau::stages; ++row) {
    stage_state<T, room>(row, h, y, k, state, size);
    f(multiply_add(T(tableau::c[row]), h, t), static_cast<const T*>(state), k[row]);
  }
}

// From stages 0 to 11: the state at the step's end, and over h its differences from the embedded solutions of orders 5
// and 3. The latter differs from the solution in the weights of three stages only.
template <class T, int room, class Size = Full<room>>
HWY_INLINE void step_end(const T& h, const T* y, const T (*k)[room], T* end, T* error5, T* error3, Size size = {}) {
  constexpr int last = tableau::stages;
  const auto embedded3 = [](int j) { return tableau::a[last][j] - tableau::error3[j]; };
  by_blocks<5>(size, [&](auto count, int from) HWY_ATTR {  // two sums each
    constexpr int block = count;
    T sum[block], e5[block];
    const T b0(tableau::a[last][0]), d0(tableau::error5[0]);
    for (int i = 0; i < block; ++i) {
      sum[i] = b0 * k[0][from + i];
      e5[i] = d0 * k[0][from + i];
    }
    // The same stages carry weight in both.
#pragma GCC unroll 1
    for (int j = first_of_solution; j < last; ++j) {
      const T b(tableau::a[last][j]), d(tableau::error5[j]);
      for (int i = 0; i < block; ++i) {
        sum[i] = multiply_add(b, k[j][from + i], sum[i]);
        e5[i] = multiply_add(d, k[j][from + i], e5[i]);
      }
    }
    const T w0(-embedded3(0)), w8(-embedded3(8)), w11(-embedded3(11));
    for (int i = 0; i < block; ++i) {
      const int c = from + i;
      end[c] = multiply_add(h, sum[i], y[c]);
      error5[c] = e5[i];
      error3[c] = multiply_add(w0, k[0][c], multiply_add(w8, k[8][c], multiply_add(w11, k[11][c], sum[i])));
    }
  });
}

// The square of the error norm of Hairer and others, h^2 e5^4/(e5^2 + e3^2/100) per component: at most 1 is accepted.
// `inverse_scale[i]` is one over the error allowed in component i.
template <class T, int room, class Size = Full<room>>
HWY_INLINE T squared_error(const T& h, const T* error5, const T* error3, const T* inverse_scale, Size size = {}) {
  T sum5(0.0), sum3(0.0);
  for (int i = 0; i < size; ++i) {
    const T e5 = error5[i] * inverse_scale[i], e3 = error3[i] * inverse_scale[i];
    sum5 = multiply_add(e5, e5, sum5);
    sum3 = multiply_add(e3, e3, sum3);
  }
  // The tiny number avoids 0/0 where both estimates vanish (a rotor at rest).
  const T denominator = T(double(size)) * multiply_add(T(0.01), sum3, sum5) + T(1e-300);
  return h * h * sum5 * sum5 / denominator;
}

// sum_j dense[row][j] k[j] of one component.
template <class T, int room>
HWY_INLINE T dense_sum(int row, const T (*k)[room], int component) {
  T sum = T(tableau::dense[row][0]) * k[0][component];
  for (int j = first_of_solution; j < tableau::dense_stages; ++j)
    sum = multiply_add(T(tableau::dense[row][j]), k[j][component], sum);
  return sum;
}

// The seven coefficient rows of the dense output, from all stages of k, 12 to 15 included.
template <class T, int room, class Size = Full<room>>
HWY_INLINE void dense_coefficients(const T& h, const T* y, const T* end, const T (*k)[room], T (*rows)[room],
                                   Size size = {}) {
  for (int i = 0; i < size; ++i) {
    const T change = end[i] - y[i];
    rows[0][i] = change;
    rows[1][i] = h * k[0][i] - change;
    rows[2][i] = change + change - h * (k[12][i] + k[0][i]);
    rows[3][i] = h * dense_sum<T, room>(0, k, i);
    rows[4][i] = h * dense_sum<T, room>(1, k, i);
    rows[5][i] = h * dense_sum<T, room>(2, k, i);
    rows[6][i] = h * dense_sum<T, room>(3, k, i);
  }
}

// The same for a step from (t, y) of which stages 0 to 12 are set: evaluates the others.
template <class T, int room, class System, class Size = Full<room>>
HWY_INLINE void prepare_dense(const System& f, const T& t, const T& h, const T* y, const T* end, T (*k)[room],
                              T (*rows)[room], Size size = {}) {
  T state[room];
  for (int row = tableau::stages + 1; row < tableau::dense_stages; ++row) {
    stage_state<T, room>(row, h, y, k, state, size);
    f(t + T(tableau::c[row]) * h, static_cast<const T*>(state), k[row]);
  }
  dense_coefficients<T, room>(h, y, end, k, rows, size);
}

// The state at the fraction `s` of the step, 0 <= s <= 1.
template <class T, int room, class Size = Full<room>>
HWY_INLINE void dense_state(const T& s, const T* y, const T (*rows)[room], T* out, Size size = {}) {
  const T r = T(1.0) - s;
  for (int i = 0; i < size; ++i) {
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
