// The mean rate of an angle over a motion, with its error: does a ball drift, however slowly, or is it captured?
#pragma once

#include <cstddef>
#include <vector>

namespace equipoise {

/// An angle, unwrapped, at equally spaced times. Holds at most 2^16 values: of longer histories every second, fourth,
/// ... one is kept.
class AngleRecord {
 public:
  /// `spacing`: of the times at which add() is called.
  explicit AngleRecord(double spacing = 1.0) : spacing_(spacing) {}
  void add(double angle);

  std::size_t size() const { return angles_.size(); }
  double operator[](std::size_t k) const { return angles_[k]; }
  double spacing() const { return spacing_; }
  double duration() const { return angles_.empty() ? 0.0 : spacing_ * static_cast<double>(angles_.size() - 1); }
  /// Of two records of the same times.
  friend AngleRecord operator-(const AngleRecord& a, const AngleRecord& b);

 private:
  double spacing_;
  std::size_t skip_ = 0, stride_ = 1;  // of the calls of add(), skip_ more are left out
  std::vector<double> angles_;
};

struct MeanRate {
  double rate = 0.0;
  double error = 0.0;   ///< three standard deviations (irregular), or what parts of the record say otherwise (regular)
  double turned = 0.0;  ///< over the record
};

/// `regular`: periodic or quasi-periodic motion, whose mean is taken with weights that fall smoothly to zero at both
/// ends and so converges faster than any power of the duration (Das, Saiki, Sander, Yorke 2017); else the plain mean,
/// its error from sixteen blocks.
MeanRate mean_rate(const AngleRecord& record, bool regular);

/// Whether the angle comes and goes and does not drift. `matters`: a drift of chaotic motion that must be told from
/// none.
enum class Drift { none, some, unknown };
Drift drift_of(const MeanRate& mean, bool regular, double matters);

}  // namespace equipoise
