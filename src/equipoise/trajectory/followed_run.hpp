// One trajectory followed as far as it is asked for, again and again: for those who watch it.
#pragma once

#include <memory>

#include "equipoise/results/trajectory.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/status.hpp"

namespace equipoise {

/// The motion that simulate() samples, with its equations, events and tolerance. A step of the integrator ends wherever
/// it is asked to, so that how often it is asked moves it within the tolerance.
class FollowedRun {
 public:
  /// From the study's [initial], or from `start` instead. Throws InputError for invalid studies, and for balls that
  /// overlap.
  explicit FollowedRun(const Study& study);
  FollowedRun(const Study& study, const InitialState& start);
  ~FollowedRun();
  FollowedRun(const FollowedRun&) = delete;
  FollowedRun& operator=(const FollowedRun&) = delete;

  double time() const;
  /// Goes on to `until`, or stays where it is if that is past.
  IntegrationStatus advance(double until);
  /// Appends the present state.
  void record(Trajectory& out) const;
  /// Whether the balls are clamped.
  bool held() const;
  const Study& study() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace equipoise
