// The statistics of transients without lanes, and the figures that sums come to.
#include "equipoise/ensemble/transient_watch.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/ensemble/transient_step-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE::transient;
static_assert(TransientWatch::nodes[0] == kernels::node1 && TransientWatch::nodes[1] == kernels::node2);

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

float root(double square) { return static_cast<float>(std::sqrt(std::max(square, 0.0))); }
}  // namespace

TransientWatch::TransientWatch(const TransientSettings& settings, const TransientSums& sums)
    : settings_(settings), sums_(sums) {}

void TransientWatch::begin(const TransientSample& first, bool free) {
  const bool entering = open_.begin == 0.0 && open_.length == 0.0;
  free_ = free;
  last_ = first;
  double& peak = free ? sums_.free_peak : sums_.clamped_peak;
  peak = std::max(peak, first.r2);
  sums_.force_peak = std::max(sums_.force_peak, first.force2);
  sums_.end = first.t;
  if (entering) open_window();
  open_.peak = std::max(open_.peak, first.r2);
}

void TransientWatch::step(const std::array<TransientSample, 3>& samples) {
  const double begin = last_.t, h = samples[2].t - begin;
  kernels::StepSamples<double> s;
  for (int k = 0; k < 4; ++k) {
    const TransientSample& at = k == 0 ? last_ : samples[static_cast<std::size_t>(k) - 1];
    s.r2[k] = at.r2;
    s.slope[k] = at.r2_slope;
    s.force2[k] = at.force2;
    s.velocity2[k] = at.velocity2;
  }
  const kernels::SquaredRadiusOfStep<double> r2(s, h);
  const auto force2 = kernels::Cubic<double>::through(s.force2);
  sums_.force_integral += h * force2.integral();
  sums_.force_peak = kernels::raised(sums_.force_peak, force2);
  kernels::raise(free_ ? sums_.free_peak : sums_.clamped_peak, open_.peak, r2);
  double unused = 0.0;
  if (std::isfinite(settings_.displacement))
    kernels::time_above(r2, settings_.displacement * settings_.displacement, begin, h, sums_.time_above, unused);
  if (free_ && settings_.watches_settling())
    kernels::time_above(r2, settings_.settled * settings_.settled, begin, h, unused, sums_.last_above);
  open_.velocity += h * kernels::Cubic<double>::through(s.velocity2).integral();
  open_.unbalance += 0.5 * h * (last_.unbalance + samples[2].unbalance);
  last_ = samples[2];
  sums_.end = last_.t;
  open_.length = last_.t - open_.begin;
  if (open_.length < settings_.window) return;
  closed_ = open_;
  open_window();
  may_leave_ = decided_ && (!until_settled_ || closed_.peak <= settings_.settled * settings_.settled);
}

void TransientWatch::decided(bool until_settled) {
  decided_ = true;
  until_settled_ = until_settled && settings_.watches_settling();
  open_window();
  closed_ = {};  // what went before is not of the end
}

void TransientWatch::open_window() {
  open_ = {};
  open_.begin = last_.t;
  open_.peak = last_.r2;
}

void TransientWatch::finish() {
  sums_.window_length = closed_.length + open_.length;
  sums_.window_peak = std::max(closed_.peak, open_.peak);
  sums_.window_velocity = closed_.velocity + open_.velocity;
  sums_.window_unbalance = closed_.unbalance + open_.unbalance;
  if (sums_.window_length > 0.0) return;
  sums_.window_length = 1.0;  // ended where it began: the state there is all there is
  sums_.window_velocity = last_.velocity2;
  sums_.window_unbalance = last_.unbalance;
}

TransientRow transient_row(const TransientSettings& settings, const TransientSums& sums, bool lost) {
  TransientRow row;
  if (lost) {
    for (const TransientColumn& column : transient_columns) row.*column.value = unknown;
    return row;
  }
  row.peak_radial = root(std::max(sums.clamped_peak, sums.free_peak));
  row.peak_radial_after_release = root(sums.free_peak);
  row.peak_radial_at_end = root(sums.window_peak);
  row.peak_force = root(sums.force_peak);
  row.rms_force = root(sums.force_integral / sums.end);
  row.rms_velocity = root(sums.window_velocity / sums.window_length);
  row.residual_unbalance = static_cast<float>(sums.window_unbalance / sums.window_length);
  row.time_above = static_cast<float>(sums.time_above);
  const bool settled = settings.watches_settling() && sums.window_peak <= settings.settled * settings.settled;
  row.settling_time = settled ? static_cast<float>(std::max(0.0, sums.last_above - settings.release))
                              : std::numeric_limits<float>::infinity();
  row.followed_until = static_cast<float>(sums.end);
  return row;
}

}  // namespace equipoise
