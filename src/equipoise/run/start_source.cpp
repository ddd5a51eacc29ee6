// States of starts at the final speed.
#include "equipoise/run/start_source.hpp"

#include <utility>

#include "equipoise/ensemble/starts.hpp"
#include "equipoise/run/initial_state.hpp"
#include "equipoise/run/lane_kernels.hpp"

namespace equipoise {

StartSource::StartSource(const Study& study, const StopFlag* stop)
    : StartSource(study, model::segments(study.speed_profile(), study.release_time()), stop) {}

StartSource::StartSource(const Study& study, std::vector<model::Segment> segments, const StopFlag* stop)
    : study_(study),
      stop_(stop),
      segments_(std::move(segments)),
      tolerance_(study.numerics.tolerance.value_or(default_basin_tolerance)) {
  while (segments_[first_free_].clamped) ++first_free_;
  if (first_free_ == 0) return;
  double z[max_dimension];
  initial_state(study, segments_.front().speed, study.initial.phi.data(), z);
  // The spin-up is shared by all starts, so its accuracy costs nothing: as tight as a single trajectory's.
  const auto status =
      integrate_clamped(study.parameters, segments_, {z[0], z[1], z[2], z[3]}, default_simulate_tolerance, basis_);
  if (status != IntegrationStatus::done) throw RunError("the clamped spin-up could not be integrated");
}

bool StartSource::make(std::uint64_t seed, std::uint64_t first, std::size_t count, std::vector<double>& phi,
                       std::vector<double>& states, std::vector<Fate>& fates) const {
  const std::size_t n = static_cast<std::size_t>(study_.parameters.balls);
  phi.resize(count * n);
  for (std::size_t i = 0; i < count; ++i) start_angles(seed, first + i, study_.parameters.balls, &phi[i * n]);
  return follow(phi, states, fates);
}

void StartSource::release(const std::vector<double>& phi, std::vector<double>& states) const {
  const model::Parameters& p = study_.parameters;
  const std::size_t n = static_cast<std::size_t>(p.balls), size = model::dimension(p.balls), count = phi.size() / n;
  states.assign(count * size, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    initial_state(study_, segments_.front().speed, &phi[i * n], &states[i * size]);
    if (first_free_ > 0) basis_.centre(p, &phi[i * n], &states[i * size]);
  }
}

LaneTask StartSource::task(std::size_t k, std::vector<double>& states) const {
  LaneTask task;
  task.parameters = &study_.parameters;
  task.segment = segments_[k];
  task.end = segments_[k].end;
  task.tolerance = tolerance_;
  task.count = states.size() / model::dimension(study_.parameters.balls);
  task.states = states.data();
  task.stop = stop_;
  return task;
}

void StartSource::cross(std::size_t k, std::vector<double>& states) const {
  const double jump = segments_[k + 1].speed - segments_[k].speed_at(segments_[k].end);
  const std::size_t size = model::dimension(study_.parameters.balls);
  for (std::size_t at = 0; at < states.size(); at += size) apply_speed_jump(jump, &states[at]);
}

bool StartSource::follow(const std::vector<double>& phi, std::vector<double>& states, std::vector<Fate>& fates) const {
  release(phi, states);
  fates.assign(phi.size() / static_cast<std::size_t>(study_.parameters.balls), Fate{});
  for (std::size_t k = first_free_; k + 1 < segments_.size(); ++k) {
    if (!advance_lanes(task(k, states), fates)) return false;
    cross(k, states);
  }
  return true;
}

}  // namespace equipoise
