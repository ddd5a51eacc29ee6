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

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {
namespace dop853 {

// The tableau of DOP853: Dormand and Prince's explicit Runge-Kutta pair of order 8 with error estimates of orders 5
// and 3, and its dense output of order 7.
// Numbers: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), II.5 and
// II.6, with the coefficients of their code DOP853. Stages are numbered from 0; stage 12 is f at the step's end (the
// next step's stage 0), stages 13 to 15 serve the dense output alone.
namespace tableau {

inline constexpr int stages = 12;
inline constexpr int dense_stages = 16;
inline constexpr int order = 8;

inline constexpr double c[dense_stages] = {0,
                                           0.05260015195876773,
                                           0.0789002279381516,
                                           0.1183503419072274,
                                           0.2816496580927726,
                                           0.3333333333333333,
                                           0.25,
                                           0.3076923076923077,
                                           0.6512820512820513,
                                           0.6,
                                           0.8571428571428571,
                                           1.0,
                                           1.0,
                                           0.1,
                                           0.2,
                                           0.7777777777777778};

// Row i: weights of stages 0 to i - 1 in the state at which stage i is evaluated; row 12 is the solution of order 8.
inline constexpr double a[dense_stages][dense_stages] = {
    {0},
    {0.05260015195876773},
    {0.0197250569845379, 0.0591751709536137},
    {0.02958758547680685, 0, 0.08876275643042054},
    {0.2413651341592667, 0, -0.8845494793282861, 0.924834003261792},
    {0.037037037037037035, 0, 0, 0.17082860872947386, 0.12546768756682242},
    {0.037109375, 0, 0, 0.17025221101954405, 0.06021653898045596, -0.017578125},
    {0.03709200011850479, 0, 0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402, 0.008273789163814023},
    {0.6241109587160757, 0, 0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894,
     -43.48988418106996},
    {0.47766253643826434, 0, 0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423,
     -33.28821096898486, -0.020331201708508627},
    {-0.9371424300859873, 0, 0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696,
     22.739487099350505, 2.4936055526796523, -3.0467644718982196},
    {2.273310147516538, 0, 0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996,
     -2.8589982771350235, -8.87285693353063, 12.360567175794303, 0.6433927460157636},
    {0.054293734116568765, 0, 0, 0, 0, 4.450312892752409, 1.8915178993145003, -5.801203960010585, 0.3111643669578199,
     -0.1521609496625161, 0.20136540080403034, 0.04471061572777259},
    {0.056167502283047954, 0, 0, 0, 0, 0, 0.25350021021662483, -0.2462390374708025, -0.12419142326381637,
     0.15329179827876568, 0.00820105229563469, 0.007567897660545699, -0.008298},
    {0.03183464816350214, 0, 0, 0, 0, 0.028300909672366776, 0.053541988307438566, -0.05492374857139099, 0, 0,
     -0.00010834732869724932, 0.0003825710908356584, -0.00034046500868740456, 0.1413124436746325},
    {-0.42889630158379194, 0, 0, 0, 0, -4.697621415361164, 7.683421196062599, 4.06898981839711, 0.3567271874552811, 0,
     0, 0, -0.0013990241651590145, 2.9475147891527724, -9.15095847217987}};

// Solution of order 8 minus embedded ones of orders 5 and 3: weights of stages 0 to 11.
inline constexpr double error5[stages] = {0.01312004499419488,
                                          0,
                                          0,
                                          0,
                                          0,
                                          -1.2251564463762044,
                                          -0.4957589496572502,
                                          1.6643771824549864,
                                          -0.35032884874997366,
                                          0.3341791187130175,
                                          0.08192320648511571,
                                          -0.022355307863886294};
inline constexpr double error3[stages] = {-0.18980075407240762,
                                          0,
                                          0,
                                          0,
                                          0,
                                          4.450312892752409,
                                          1.8915178993145003,
                                          -5.801203960010585,
                                          -0.4226823213237919,
                                          -0.1521609496625161,
                                          0.20136540080403034,
                                          0.02265179219836082};

// Highest four of the seven coefficients of the dense output: weights of stages 0 to 15.
inline constexpr double dense[4][dense_stages] = {
    {-8.428938276109013, 0, 0, 0, 0, 0.5667149535193777, -3.0689499459498917, 2.38466765651207, 2.117034582445028,
     -0.871391583777973, 2.2404374302607883, 0.6315787787694688, -0.08899033645133331, 18.148505520854727,
     -9.194632392478356, -4.436036387594894},
    {10.427508642579134, 0, 0, 0, 0, 242.28349177525817, 165.20045171727028, -374.5467547226902, -22.113666853125306,
     7.733432668472264, -30.674084731089398, -9.332130526430229, 15.697238121770845, -31.139403219565178,
     -9.35292435884448, 35.81684148639408},
    {19.985053242002433, 0, 0, 0, 0, -387.0373087493518, -189.17813819516758, 527.8081592054236, -11.57390253995963,
     6.8812326946963, -1.0006050966910838, 0.7777137798053443, -2.778205752353508, -60.19669523126412,
     84.32040550667716, 11.99229113618279},
    {-25.69393346270375, 0, 0, 0, 0, -154.18974869023643, -231.5293791760455, 357.6391179106141, 93.40532418362432,
     -37.45832313645163, 104.0996495089623, 29.8402934266605, -43.53345659001114, 96.32455395918828, -39.17726167561544,
     -149.72683625798564}};

}  // namespace tableau

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
