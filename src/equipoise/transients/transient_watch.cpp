// The statistics of transients without lanes, and the figures that sums come to.
#include "equipoise/transients/transient_watch.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/transients/transient_step-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE::transient;
static_assert(TransientWatch::nodes[0] == kernels::node1 && TransientWatch::nodes[1] == kernels::node2);

constexpr float unknown = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();

double root(double square) { return std::sqrt(std::max(square, 0.0)); }
}  // namespace

TransientWatch::TransientWatch(const TransientSettings& settings, const TransientSums& sums)
    : settings_(settings), sums_(sums) {}

void TransientWatch::begin(const TransientSample& first, bool free) {
  free_ = free;
  last_ = first;
  double& peak = free ? sums_.free_peak : sums_.clamped_peak;
  peak = std::max(peak, first.r2);
  sums_.force_peak = std::max(sums_.force_peak, first.force2);
  sums_.end = first.t;
  if (!begun_) open_window();
  begun_ = true;
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
  sums_.force_peak = kernels::raised(sums_.force_peak, force2);
  kernels::raise(free_ ? sums_.free_peak : sums_.clamped_peak, open_.peak, r2);
  double unused = 0.0;
  if (std::isfinite(settings_.displacement))
    kernels::time_above(r2, settings_.displacement * settings_.displacement, begin, h, sums_.time_above, unused);
  if (free_ && settings_.watches_settling())
    kernels::time_above(r2, settings_.settled * settings_.settled, begin, h, unused, sums_.last_above);
  open_.force += h * force2.integral();
  open_.velocity += h * kernels::Cubic<double>::through(s.velocity2).integral();
  open_.unbalance += 0.5 * h * (last_.unbalance + samples[2].unbalance);
  last_ = samples[2];
  sums_.end = last_.t;
  open_.length = last_.t - opened_;
  if (open_.length < settings_.window) return;
  ++windows_;
  may_leave_ = decided_ && seen_enough(settings_, end_, closed_, open_, windows_, sums_.free_peak);
  closed_ = {open_, closed_[0]};
  open_window();
}

void TransientWatch::decided(const KnownEnd& end) {
  decided_ = true;
  end_ = end;
  windows_ = 0;
  open_window();
  closed_ = {};  // what went before is not of the end
}

void TransientWatch::open_window() {
  open_ = {};
  opened_ = last_.t;
  open_.peak = last_.r2;
}

void TransientWatch::finish() {
  TransientWindow& window = sums_.window = last_windows(closed_[0], open_);
  if (window.length > 0.0) return;
  window = {1.0, last_.r2, last_.force2, last_.velocity2, last_.unbalance};  // ended where it began
}

TransientRow transient_row(const TransientSettings& settings, const TransientSums& sums, bool lost,
                           const std::optional<MotionFigures>& end) {
  TransientRow row;
  if (lost) {
    for (const TransientColumn& column : transient_columns) row.*column.value = unknown;
    return row;
  }
  const TransientWindow& w = sums.window;
  const MotionFigures last = end ? *end
                                 : MotionFigures{root(w.peak), 0.0, root(w.force / w.length),
                                                 root(w.velocity / w.length), w.unbalance / w.length};
  const double after_release = std::max(root(sums.free_peak), last.radial);
  row.peak_radial = static_cast<float>(std::max(root(sums.clamped_peak), after_release));
  row.peak_radial_after_release = static_cast<float>(after_release);
  row.peak_radial_at_end = static_cast<float>(last.radial);
  row.peak_force = static_cast<float>(std::max(root(sums.force_peak), last.peak_force));
  row.rms_force = static_cast<float>(last.rms_force);
  row.rms_velocity = static_cast<float>(last.rms_velocity);
  row.residual_unbalance = static_cast<float>(last.unbalance);
  // For good below a limit: the motion at the end is, and the trajectory was when last seen.
  const auto below = [&](double limit) { return last.radial <= limit && root(w.peak) <= limit; };
  row.time_above = below(settings.displacement) ? static_cast<float>(sums.time_above) : endless;
  row.settling_time = settings.watches_settling() && below(settings.settled)
                          ? static_cast<float>(std::max(0.0, sums.last_above - settings.release))
                          : endless;
  row.followed_until = static_cast<float>(sums.end);
  return row;
}

}  // namespace equipoise
