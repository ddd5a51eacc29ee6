// The Lyapunov functions of trapping regions at a state, for any number type. Included once per CPU target.
#if defined(EQUIPOISE_CLASSIFICATION_REGION_VALUES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_CLASSIFICATION_REGION_VALUES_INL
#undef EQUIPOISE_CLASSIFICATION_REGION_VALUES_INL
#else
#define EQUIPOISE_CLASSIFICATION_REGION_VALUES_INL
#endif

#include <cstddef>
#include <type_traits>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/machine/model/ball_count.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE T shortest_turn(T angle) {
  return angle - T(two_pi) * nearest_integer(angle * T(1.0 / two_pi));
}

// Room for a state of type `Size`: a constant size is that of rotor and balls alone; otherwise any system fits.
template <int room, class Size>
inline constexpr int largest_state = model::dimension(room) + (std::is_same_v<Size, int> ? 7 : 0);

// V of a balanced trapping region at state z of n balls and `dimension` components. `place`: the region's centre;
// `factor`: F.
template <int room, class T, class Number, class Size>
HWY_INLINE T balanced_region_value(const Number* place, const Number* factor, model::BallCount<room> n, Size dimension,
                                   const T* z) {
  T d[largest_state<room, Size>];
  for (int i = 0; i < dimension; ++i) d[i] = z[i] - T(place[i]);
  for (int i = 0; i < n; ++i) d[4 + i] = shortest_turn(d[4 + i]);
  T v(0.0);
  for (int row = 0; row < dimension; ++row) {
    T sum(0.0);
    for (int column = row; column < dimension; ++column)
      sum = multiply_add(T(factor[row * dimension + column]), d[column], sum);
    v = multiply_add(sum, sum, v);
  }
  return v;
}

// F d|^2 of an orbit's region at state z: the least over the turns that the clock's angle may belong to.
template <int room, class T, class Size>
HWY_INLINE T orbit_region_value(const OrbitRegionTable& region, model::BallCount<room> n, Size dimension, const T* z) {
  const int others = dimension - 1;
  const int columns = cycle_table_columns(dimension);
  T place[largest_state<room, Size> - 1];
  for (int i = 0, k = 0; i < dimension; ++i)
    if (i != 4 + region.clock) place[k++] = z[i];
  const T turn = z[4 + region.clock] * T(1.0 / two_pi);
  // In cells, from 0 to region.cells. The last cell also takes angles that round to a whole turn.
  const T along = (turn - nearest_integer(turn - T(0.5))) * T(double(region.cells));
  const T cell = minimum(maximum(nearest_integer(along - T(0.5)), T(0.0)), T(double(region.cells - 1)));
  const T fraction = along - cell;
  T least(1e300);
  for (int branch = 0; branch < region.turns; ++branch) {
    const double* rows = region.table.data() + static_cast<std::ptrdiff_t>(branch) * region.cells * columns;
    const T at = cell * T(double(columns));
    T d[largest_state<room, Size> - 1];
    for (int k = 0; k < others; ++k) {
      const T here = multiply_add(fraction, gather(rows + others + k, at), gather(rows + k, at));
      d[k] = place[k] - here;
      // Without the clock's angle, n - 1 ball angles follow the rotor's four variables.
      if (k >= 4 && k < 4 + n - 1) d[k] = shortest_turn(d[k]);
    }
    const double* factor = rows + 2 * others;
    T v(0.0);
    for (int row = 0, entry = 0; row < others; ++row) {
      T sum(0.0);
      for (int column = row; column < others; ++column, ++entry)
        sum = multiply_add(gather(factor + entry, at), d[column], sum);
      v = multiply_add(sum, sum, v);
    }
    least = minimum(least, v);
  }
  return least;
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
