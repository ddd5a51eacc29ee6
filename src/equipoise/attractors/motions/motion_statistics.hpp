// What a trajectory does over a stretch of time: extremes and means of r, how far each ball turned, how the angles
// between balls moved, and whether a ball drifts, however slowly, or is captured.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/ball_events.hpp"
#include "equipoise/results/types/status.hpp"

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

/// The history of one unwrapped angle: how far from 0 it went (modulo whole turns) and how often it passed pi.
struct AngleHistory {
  double farthest = 0.0;  ///< largest |angle modulo 2 pi|, as sampled
  long passed_pi = 0;     ///< times it passed pi, modulo whole turns

  void begin(double angle) { add_distance(last_ = angle); }
  void add(double angle);

 private:
  void add_distance(double angle);
  double last_ = 0.0;
};

/// psi' of a driven rotor, and the output of its motor.
struct DriveStatistics {
  double speed_min = std::numeric_limits<double>::infinity(), speed_max = -speed_min;
  double speed_integral = 0.0, torque_integral = 0.0;  ///< of psi' and of the motor's torque over time
  double work = 0.0, support_work = 0.0;               ///< by the motor, and on the supports' dampers
};

struct MotionStatistics {
  double duration = 0.0;
  double spacing = 0.0;  ///< of the times at which extremes are looked for, the same throughout
  double r_min = std::numeric_limits<double>::infinity(), r_max = 0.0;
  double r_integral = 0.0;                                                ///< of r over time
  std::array<double, model::max_balls> turned{}, rate_min{}, rate_max{};  ///< change of phi_i; extremes of phi_i'
  std::array<AngleRecord, model::max_balls> angle;                        ///< phi_i
  long recorded = 0;                                                      ///< values that `angle` took
  std::array<std::array<AngleHistory, model::max_balls>, model::max_balls> pair;  ///< phi_i - phi_j for i < j

  DriveStatistics drive;  ///< of driven rotors

  double r_mean() const { return r_integral / duration; }
  double speed_mean() const { return drive.speed_integral / duration; }
};

/// Whether two stretches show one motion. Largest, smallest and mean r and the extremes of all balls' rates must agree
/// to `share_of_extremes`, mean r and the mean of all rates to `share_of_means`, each of the largest; also psi' and
/// its mean.
bool similar(const MotionStatistics& a, const MotionStatistics& b, int balls, double share_of_extremes,
             double share_of_means);

/// Takes `state` along its trajectory for `duration`; unless it returns `done`, `state` is where it was lost. Outputs
/// that are not requested cost nothing. `statistics`: the stretch is added; angles must go on from the end of the last
/// call. Extremes are found to about 1e-8 of their size, from the signs of derivatives at times at most
/// sample_spacing() of the first state apart. `samples` receives the states at times k sample_spacing(), k = 0, 1, ...
/// On a stroboscopic section the rotor's angle is 0 at the beginning. Under gravity r is measured from the sag. Soon
/// after `stop` is set it returns `failed`.
IntegrationStatus follow(const model::System& system, Eigen::VectorXd& state, double duration, double tolerance,
                         MotionStatistics* statistics = nullptr, std::vector<Eigen::VectorXd>* samples = nullptr,
                         const StopFlag* stop = nullptr);

/// What the balls of a system with events did on the way.
struct EventLog {
  std::vector<BallEvent> events;  ///< the first thousand
  long count = 0;                 ///< all events, and changes without a name
  model::BallMode begin, end;     ///< modes
  bool reverses = false;          ///< some free ball's rate changed sign
};

/// The same for a system with events, which follow() also accepts; sets `log`.
IntegrationStatus follow_events(const model::System& system, Eigen::VectorXd& state, double duration, double tolerance,
                                EventLog& log, MotionStatistics* statistics = nullptr,
                                std::vector<Eigen::VectorXd>* samples = nullptr, const StopFlag* stop = nullptr);

/// Time between samples: a ball that the rotor leaves behind turns by 0.2 rad in it. Values of MotionStatistics::angle
/// are four times as far apart.
double sample_spacing(const model::System& system, const Eigen::VectorXd& state);

}  // namespace equipoise
