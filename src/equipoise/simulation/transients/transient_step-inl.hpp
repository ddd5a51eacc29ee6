// Samples of a motion; peaks, integrals and times above a limit within one step, for SIMD lanes and for double.
// Included once per CPU target.
//
// r^2 is known with its slope at the step's ends and at two places between: a cubic on each of three pieces. The
// squares of force and velocity are known at the same four places: one cubic over the step.
#if defined(EQUIPOISE_TRANSIENTS_TRANSIENT_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_TRANSIENTS_TRANSIENT_STEP_INL
#undef EQUIPOISE_TRANSIENTS_TRANSIENT_STEP_INL
#else
#define EQUIPOISE_TRANSIENTS_TRANSIENT_STEP_INL
#endif

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/machine/model/equations-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {
namespace transient {

HWY_INLINE Pack choose(Mask m, Pack yes, Pack no) { return select(m, yes, no); }
HWY_INLINE double choose(bool m, double yes, double no) { return m ? yes : no; }
HWY_INLINE bool any_of(Mask m) { return any(m); }
HWY_INLINE bool any_of(bool m) { return m; }
HWY_INLINE Mask both(Mask a, Mask b) { return a & b; }
HWY_INLINE bool both(bool a, bool b) { return a && b; }

template <class T>
inline constexpr int lane_count = 1;
template <>
inline constexpr int lane_count<Pack> = static_cast<int>(pack_lanes);

using HWY_NAMESPACE::element;  // of packs
HWY_INLINE double& element(double& a, int) { return a; }
HWY_INLINE double element(const double& a, int) { return a; }
HWY_INLINE unsigned bits_of(Mask m) { return lane_bits(m); }
HWY_INLINE unsigned bits_of(bool m) { return m ? 1u : 0u; }

// Where samples lie in a step from 0 to 1: stages of DOP853 sit at the inner two
// (simulation/batch/batch_watch-inl.hpp).
inline constexpr double node1 = 1.0 / 3, node2 = 0.6;
inline constexpr double piece_length[3] = {node1, node2 - node1, 1.0 - node2};

// The motion at one time. Frame invariant: rotating and fixed components give the same.
template <class T>
struct Sample {
  T r2, slope;           // squared distance of O from its place of rest under weight, and its derivative
  T force2, velocity2;   // |f|^2 of the bearing force, u^2 + v^2
  T dynamic2, upright2;  // |f - f at rest|^2, the squared velocity along Y
  T power;               // its integral, with the change of `stored`, is the work of the drive
  T stored;              // read only at the ends of steps
  T speed;               // psi', also
};

// Without weight on supports alike in X and Y. The slope needs no derivative of the state: the frame's rotation drops
// out.
template <class T>
HWY_INLINE Sample<T> sample_of(const Vector2<T>& force, const T* z) {
  using namespace model::index;
  const T force2 = force.x * force.x + force.y * force.y, velocity2 = z[u] * z[u] + z[v] * z[v];
  return {z[x] * z[x] + z[y] * z[y],
          T(2.0) * (z[x] * z[u] + z[y] * z[v]),
          force2,
          velocity2,
          force2,
          T(0.5) * velocity2,
          T(0.0),
          T(0.0),
          T(0.0)};
}

// `up`: the direction of Y, along which the rotor rests at `rest` under its weight, with the force `at_rest`.
template <class T>
HWY_INLINE Sample<T> sample_of(const Vector2<T>& up, const T& rest, const Vector2<T>& at_rest, const Vector2<T>& force,
                               const T* z) {
  using namespace model::index;
  const T rx = z[x] - rest * up.x, ry = z[y] - rest * up.y;
  const T fx = force.x - at_rest.x, fy = force.y - at_rest.y;
  const T upright = z[u] * up.x + z[v] * up.y;
  return {rx * rx + ry * ry,
          T(2.0) * (rx * z[u] + ry * z[v]),
          force.x * force.x + force.y * force.y,
          z[u] * z[u] + z[v] * z[v],
          fx * fx + fy * fy,
          upright * upright,
          T(0.0),
          T(0.0),
          T(0.0)};
}

// At the step's beginning, at node1, at node2 and at its end.
template <class T>
struct StepSamples {
  T r2[4], slope[4], force2[4], velocity2[4], dynamic2[4], upright2[4], power[4];
};

// A cubic in s from 0 to 1.
template <class T>
struct Cubic {
  T c0, c1, c2, c3;
  T to;  // its value at 1

  // Values and, in units of the interval's length, slopes at both ends.
  static HWY_INLINE Cubic hermite(T from, T slope_from, T to, T slope_to) {
    const T rise = to - from;
    return {from, slope_from, T(3.0) * rise - T(2.0) * slope_from - slope_to, slope_from + slope_to - T(2.0) * rise,
            to};
  }

  // Values at 0, node1, node2 and 1 (Newton's divided differences).
  static HWY_INLINE Cubic through(const T* f) {
    const T d01 = (f[1] - f[0]) * T(1.0 / node1);
    const T d12 = (f[2] - f[1]) * T(1.0 / (node2 - node1));
    const T d23 = (f[3] - f[2]) * T(1.0 / (1.0 - node2));
    const T d012 = (d12 - d01) * T(1.0 / node2);
    const T d0123 = (d23 - d12) * T(1.0 / (1.0 - node1)) - d012;
    return {f[0], d01 - T(node1) * d012 + T(node1 * node2) * d0123, d012 - T(node1 + node2) * d0123, d0123, f[3]};
  }

  HWY_INLINE T at(const T& s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  HWY_INLINE T integral() const { return c0 + T(0.5) * c1 + T(1.0 / 3) * c2 + T(0.25) * c3; }

  // Bernstein coefficients: the cubic lies between the least and the largest of them.
  HWY_INLINE T upper() const {
    const T b1 = c0 + T(1.0 / 3) * c1, b2 = c0 + T(1.0 / 3) * (T(2.0) * c1 + c2);
    return maximum(maximum(c0, to), maximum(b1, b2));
  }
  HWY_INLINE T lower() const {
    const T b1 = c0 + T(1.0 / 3) * c1, b2 = c0 + T(1.0 / 3) * (T(2.0) * c1 + c2);
    return minimum(minimum(c0, to), minimum(b1, b2));
  }

  // Its largest value, and in `where` a place that has it.
  HWY_INLINE T largest(T& where) const {
    const T ends = maximum(c0, to);
    const T discriminant = c2 * c2 - T(3.0) * c3 * c1;
    // The root of the slope where the curvature is negative.
    const T s = c1 / (square_root(maximum(discriminant, T(0.0))) - c2);
    const auto inside = both(T(0.0) < discriminant, both(T(0.0) < s, s < T(1.0)));
    const T value = at(s);
    const auto within = both(inside, ends < value);
    where = choose(within, s, choose(c0 < to, T(1.0), T(0.0)));
    return choose(within, value, ends);
  }
};

// The fraction of a stretch above a limit, if the excess is linear.
template <class T>
HWY_INLINE T share_above(T from, T to) {
  const T size = absolute(from) + absolute(to) + T(1e-300);
  return (maximum(from, T(0.0)) + maximum(to, T(0.0))) / size;
}

template <class T>
class SquaredRadiusOfStep {
 public:
  HWY_INLINE SquaredRadiusOfStep(const StepSamples<T>& s, T h) {
    for (int k = 0; k < 3; ++k) {
      const T length = h * T(piece_length[k]);
      piece_[k] = Cubic<T>::hermite(s.r2[k], length * s.slope[k], s.r2[k + 1], length * s.slope[k + 1]);
    }
    upper_ = maximum(maximum(piece_[0].upper(), piece_[1].upper()), piece_[2].upper());
    lower_ = minimum(minimum(piece_[0].lower(), piece_[1].lower()), piece_[2].lower());
  }

  HWY_INLINE T upper() const { return upper_; }
  HWY_INLINE T lower() const { return lower_; }
  HWY_INLINE T largest(T& where) const {
    T most = piece_[0].largest(where);
    where = T(node1) * where;
    for (int k = 1; k < 3; ++k) {
      T place;
      const T value = piece_[k].largest(place);
      where = choose(most < value, T(k == 1 ? node1 : node2) + T(piece_length[k]) * place, where);
      most = maximum(most, value);
    }
    return most;
  }

  // At the step's beginning, and at the middle and the end of piece k.
  HWY_INLINE T begin() const { return piece_[0].c0; }
  HWY_INLINE T middle(int k) const { return piece_[k].at(T(0.5)); }
  HWY_INLINE T to(int k) const { return piece_[k].to; }

 private:
  Cubic<T> piece_[3];
  T upper_, lower_;
};

// The larger of the squares at two places, for times above a limit.
template <class T>
struct LargerOfStep {
  const SquaredRadiusOfStep<T>&one, &other;

  HWY_INLINE T upper() const { return maximum(one.upper(), other.upper()); }
  HWY_INLINE T lower() const { return maximum(one.lower(), other.lower()); }
  HWY_INLINE T begin() const { return maximum(one.begin(), other.begin()); }
  HWY_INLINE T middle(int k) const { return maximum(one.middle(k), other.middle(k)); }
  HWY_INLINE T to(int k) const { return maximum(one.to(k), other.to(k)); }
};

// The fraction of the step with r^2 > limit, and the last place where it held (0: nowhere), with r^2 linear between the
// ends and the middles of the pieces.
template <class T, class Curve>
HWY_INLINE void find_above(const Curve& r2, T limit, T& fraction, T& last) {
  fraction = last = T(0.0);
  T from = r2.begin() - limit;
  double place = 0.0;
  for (int k = 0; k < 3; ++k) {
    const T middle = r2.middle(k);
    const double half = 0.5 * piece_length[k];
    for (const T value : {middle, r2.to(k)}) {
      const T to = value - limit;
      const T share = share_above(from, to);
      fraction = fraction + T(half) * share;
      last = choose(T(0.0) < from, T(place) + T(half) * share, last);
      place += half;
      last = choose(T(0.0) < to, T(place), last);
      from = to;
    }
  }
}

// The larger of `peak` and the largest value of `curve`. Lanes whose upper bound is not above `peak` keep it, so that
// no lane depends on whether another one needed the work.
template <class T, class Curve>
HWY_INLINE T raised(T peak, const Curve& curve) {
  const auto higher = peak < curve.upper();
  if (!any_of(higher)) return peak;
  T unused;
  return choose(higher, maximum(peak, curve.largest(unused)), peak);
}

// raised(), for two peaks of one curve; `where` it is largest, in parts of the step, if that was needed.
template <class T, class Curve>
HWY_INLINE void raise(T& peak, T& other, const Curve& curve, T& where) {
  const auto higher = peak < curve.upper(), other_higher = other < curve.upper();
  if (!any_of(higher) && !any_of(other_higher)) return;
  const T largest = curve.largest(where);
  peak = choose(higher, maximum(peak, largest), peak);
  other = choose(other_higher, maximum(other, largest), other);
}

// Adds the time of a step with r^2 > limit, and moves `last` to the last time when that held, if it did.
template <class T, class Curve>
HWY_INLINE void time_above(const Curve& r2, T limit, T t, T h, T& total, T& last) {
  const auto some = limit < r2.upper(), mixed = both(some, r2.lower() <= limit);
  if (!any_of(some)) return;
  T fraction(1.0), until(1.0);
  if (any_of(mixed)) {
    T mixed_fraction, mixed_until;
    find_above(r2, limit, mixed_fraction, mixed_until);
    fraction = choose(mixed, mixed_fraction, fraction);
    until = choose(mixed, mixed_until, until);
  }
  total = choose(some, multiply_add(h, fraction, total), total);
  last = choose(both(some, T(0.0) < until), multiply_add(h, until, t), last);
}

}  // namespace transient
}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
