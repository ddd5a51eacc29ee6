// The states of starts at a prescribed final speed.
#include "equipoise/simulation/spin_up/start_source.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/integrate/event_trajectory-inl.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/transients/transient_watch.hpp"
#include "equipoise/study/echo/given_value.hpp"

namespace equipoise {

namespace {

[[noreturn]] void clamped_failed(const Study& study) {
  const study::StatedValue stated = study::stated_release(study);
  throw RunError(
      fmt::format("the rotor could not be followed until the balls are released, by {} = {}; rotor.stiffness or "
                  "rotor.damping may be too large, or [initial] too far from rest",
                  stated.key, stated.text));
}

}  // namespace

SpinUp::SpinUp(const Study& study, const StopFlag* stop) : study_(study), sampler_(sampler_of(study)), stop_(stop) {}

bool SpinUp::make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
                  TransientTable* transients) const {
  return follow(starts_of(study_, sampler_, seed, first, count), starts, transients);
}

StartSource::StartSource(const Study& study, const StopFlag* stop)
    : StartSource(study, model::segments(study.speed_profile(), study.release_time()), stop) {}

StartSource::StartSource(const Study& study, std::vector<model::Segment> segments, const StopFlag* stop)
    : SpinUp(study, stop),
      segments_(std::move(segments)),
      tolerance_(study.numerics.tolerance.value_or(default_basin_tolerance)) {
  for (const model::DrivePiece& piece : model::prescribed_drive(segments_).pieces)
    systems_.emplace_back(study.parameters, piece);
  while (segments_[first_free_].clamped) ++first_free_;
  if (first_free_ == 0 || study.parameters.tilts()) return;
  // All starts share the spin-up, so a tight tolerance costs nothing.
  const auto status = integrate_clamped(study.parameters, segments_, origin(), default_simulate_tolerance, basis_, {},
                                        {}, std::numeric_limits<double>::infinity(), stop);
  if (status != IntegrationStatus::done) clamped_failed(study);
}

std::array<double, 4> StartSource::origin() const {
  double z[max_dimension];
  initial_state(study_.initial, study_.parameters.balls, segments_.front().speed, z);
  return {z[0], z[1], z[2], z[3]};
}

model::StateLayout StartSource::layout() const {
  return model::StateLayout::of(study_.parameters.balls, false, false, false, study_.parameters.tilts());
}

void StartSource::watch(const TransientSettings& settings) {
  watched_ = settings;
  if (first_free_ == 0 || study_.parameters.tilts()) return;
  clamped_ = ClampedTransients(study_.parameters, segments_, origin(), default_simulate_tolerance, settings, stop_);
}

namespace {

// Watches a tilting rotor through the segments that hold its balls.
class TiltingWatch {
 public:
  TiltingWatch(const model::Parameters& p, const std::vector<model::Segment>& segments,
               const TransientSettings& settings)
      : p_(p), layout_(model::machine_layout(p)), segments_(segments), settings_(settings), watch_(settings) {}

  template <class StateAt>
  void step(double from, double to, StateAt&& state_at) {
    double z[model::largest_state + 1];
    const auto sample = [&](double t) {
      state_at(t, z);
      return at(t, z);
    };
    enter(from, sample);
    watch_.step_to(to, sample);
  }
  TransientSums sums() const { return watch_.sums(); }

 private:
  TransientSample at(double t, const double* z) const {
    TransientSample here = transient_sample(p_, settings_.shaft, z[layout_.psi], t, z, z + layout_.tilt);
    for (auto& place : here.places) place.speed = z[layout_.speed];
    if (settings_.work == WorkSource::none) return here;
    here.places[0].power = model::tilting_powers(p_, 0.0, true, z).supports;
    here.places[0].stored = model::full_energy(p_, z);
    return here;
  }
  // Where a segment begins psi' may jump, and with it u and v.
  template <class Sampled>
  void enter(double from, Sampled&& sample) {
    const bool over = begun_ && from >= segments_[k_].end;
    if (begun_ && !over) return;
    if (over && segments_[k_].acceleration != segments_[k_ + 1].acceleration) watch_.end_piece();
    k_ += over ? 1 : 0;
    watch_.begin(sample(from), false);
    begun_ = true;
  }

  const model::Parameters& p_;
  const model::StateLayout layout_;
  const std::vector<model::Segment>& segments_;
  const TransientSettings& settings_;
  TransientWatch watch_;
  std::size_t k_ = 0;
  bool begun_ = false;
};

}  // namespace

// Clamped balls also load a tilting rotor by a couple, so each start is followed separately.
void StartSource::place_tilting(const InitialState& start, double* state, TransientSums* sums) const {
  using Machine = HWY_NAMESPACE::EventTrajectory<model::any_count, true>;
  const model::Parameters& p = study_.parameters;
  initial_state(start, p.balls, segments_.front().speed, state, model::dimension(p.balls));
  if (first_free_ == 0) return;
  const auto scale = HWY_NAMESPACE::machine_scale<Machine::dimension>(p, default_simulate_tolerance);
  const model::Drive drive = model::prescribed_drive(segments_);
  Machine machine(p, drive, scale, state);
  TiltingWatch watch(p, segments_, watched_);
  const auto observe = [&](double from, double to, auto&& state_at) {
    if (sums) watch.step(from, to, state_at);
    return false;
  };
  if (machine.advance(drive.release_time, observe, stop_) != IntegrationStatus::done) clamped_failed(study_);
  if (sums) *sums = watch.sums();
  machine.enter();
  model::copy_state(model::machine_layout(p), machine.state(), systems_.front().layout(), state);
}

void StartSource::place(const InitialState& start, double* state, TransientSums* sums) const {
  if (study_.parameters.tilts()) return place_tilting(start, state, sums);
  initial_state(start, study_.parameters.balls, segments_.front().speed, state);
  if (first_free_ > 0) basis_.centre(study_.parameters, start.phi.data(), state);
  if (sums) *sums = clamped_.sums(study_.parameters, start.phi.data());
}

bool StartSource::follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients) const {
  const std::size_t size = this->size();
  starts = {};
  if (transients) transients->rows.clear();
  starts.states.resize(given.size() * size);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (is_set(stop_)) return false;  // a start may take a million sums
    const double* phi = given[i].phi.data();
    starts.phi.insert(starts.phi.end(), phi, phi + study_.parameters.balls);
    place(given[i], &starts.states[i * size], transients ? &transients->rows.emplace_back() : nullptr);
  }
  if (transients && first_free_ > 0) end_piece(first_free_ - 1, *transients);
  starts.outcomes.resize(given.size());
  for (std::size_t k = first_free_; k + 1 < segments_.size(); ++k) {
    BatchTask branch = task(k, starts.states);
    branch.transients = transients;
    if (!advance_batch(branch, starts.outcomes)) return false;
    cross(k, starts.states);
    if (transients) end_piece(k, *transients);
  }
  return true;
}

void StartSource::end_piece(std::size_t k, TransientTable& transients) const {
  if (segments_[k].acceleration == segments_[k + 1].acceleration) return;  // the release alone separates them
  for (TransientSums& row : transients.rows) row.work.end_piece();
}

BatchTask StartSource::last_task() const {
  std::vector<double> none;
  return task(segments_.size() - 1, none);
}

void StartSource::release(std::span<const InitialState> given, std::vector<double>& states) const {
  states.assign(given.size() * size(), 0.0);
  for (std::size_t i = 0; i < given.size(); ++i) place(given[i], &states[i * size()]);
}

BatchTask StartSource::task(std::size_t k, std::vector<double>& states) const {
  BatchTask task = batch_task(systems_[k]);
  task.segment = segments_[k];
  task.end = segments_[k].end;
  task.tolerance = tolerance_;
  task.stop = stop_;
  task.take(states, {}, {});
  return task;
}

void StartSource::cross(std::size_t k, std::vector<double>& states) const {
  const double jump = segments_[k + 1].speed - segments_[k].speed_at(segments_[k].end);
  const model::StateLayout layout = this->layout();
  for (std::size_t at = 0; at < states.size(); at += size()) model::apply_speed_jump(jump, &states[at], layout.tilt);
}

}  // namespace equipoise
