// From a start's index to its state when the final speed is reached: spin-up, release, remaining branches.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/attractors/fate.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/integrate/clamped.hpp"
#include "equipoise/model/speed.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Makes states of starts. Thread-safe once made.
class StartSource {
 public:
  /// Integrates the clamped spin-up, which all starts share.
  StartSource(const Study& study, const StopFlag* stop);

  /// Starts first .. first + count - 1 of `seed`: ball angles into `phi`, states at settled() into `states`, both
  /// row-major; fates[i] says which were lost on the way. False if stopped early.
  bool make(std::uint64_t seed, std::uint64_t first, std::size_t count, std::vector<double>& phi,
            std::vector<double>& states, std::vector<Fate>& fates) const;
  /// The same for given ball angles, all else as in [initial]: phi.size() / balls starts.
  bool follow(const std::vector<double>& phi, std::vector<double>& states, std::vector<Fate>& fates) const;

  /// When the last branch has begun and the balls are free.
  double settled() const { return segments_.back().begin; }
  const model::Segment& last_segment() const { return segments_.back(); }
  double tolerance() const { return tolerance_; }

 private:
  void place(const InitialState& start, double* state) const;
  bool advance(std::vector<double>& states, std::vector<Fate>& fates) const;

  Study study_;
  const StopFlag* stop_;
  std::vector<model::Segment> segments_;
  std::size_t first_free_ = 0;
  ClampedBasis basis_;
  double tolerance_;
};

}  // namespace equipoise
