// The mean rate of an angle over a motion, with its error: does a ball drift, however slowly, or is it captured?
#pragma once

#include <cstddef>
#include <vector>

namespace equipoise {

/// An unwrapped angle at equally spaced times. Holds at most 2^16 values: a longer history keeps every second, fourth,
/// ... one.
class AngleRecord {
 public:
  /// `spacing`: of the times at which add() is called.
  explicit AngleRecord(double spacing = 1.0) : spacing_(spacing) {}
  void add(double angle);

  std::size_t size() const { return angles_.size(); }
  double operator[](std::size_t k) const { return angles_[k]; }
  double spacing() const { return spacing_; }
  double duration() const { return angles_.empty() ? 0.0 : spacing_ * static_cast<double>(angles_.size() - 1); }
  /// Of two records with the same times.
  friend AngleRecord operator-(const AngleRecord& a, const AngleRecord& b);

 private:
  double spacing_;
  std::size_t skip_ = 0, stride_ = 1;  // skip the next skip_ calls of add(), keep one in stride_
  std::vector<double> angles_;
};

struct MeanRate {
  double rate = 0.0;
  double error = 0.0;  ///< three standard errors (irregular), or the disagreement of parts of the record (regular)
  double duration = 0.0, turned = 0.0;  ///< of the record, and over it
};

/// `regular`: for periodic or quasi-periodic motion. Weights then fall smoothly to zero at both ends, so the mean
/// converges faster than any power of the duration (Das, Saiki, Sander, Yorke 2017). Otherwise the plain mean, with its
/// error from sixteen blocks.
MeanRate mean_rate(const AngleRecord& record, bool regular);

/// Whether an angle drifts, or only swings back and forth. `matters`: the least drift of chaotic motion that must be
/// distinguished from none.
enum class Drift { none, some, unknown };
Drift drift_of(const MeanRate& mean, bool regular, double matters);

}  // namespace equipoise
