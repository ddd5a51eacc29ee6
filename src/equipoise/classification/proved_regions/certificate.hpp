// A proof, checkable by machine, that a level set around a balanced state leads nowhere else.
// This room: level sets around balance, proved with interval arithmetic.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/drives/motor.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// The statement: with V(d) = d^T P d, d the deviation from the balanced state nearest to `phi` (angles modulo 2 pi),
/// dV/dt < 0 along the full nonlinear flow wherever 0 < V <= level (1 + level_slack); so every trajectory that enters
/// V <= level converges to that state. The rest is what makes the proof checkable without search.
struct Certificate {
  model::Parameters parameters;
  double speed = 0.0;                          ///< psi' in balance: as prescribed, of a motor approximate
  std::optional<model::DriveSegment> motor;    ///< drives the rotor; empty: its speed is prescribed
  std::array<double, model::max_balls> phi{};  ///< approximate ball angles; the proof encloses the exact ones
  Eigen::MatrixXd form;                        ///< P
  double level = 0.0;                          ///< c; 0 if nothing is proved
  /// Columns span coordinates (eta, tau) of the deviation, d = frame (eta; tau), in which V <= c is the unit ball. The
  /// last columns, one per ball, are tau: the ball angles depend on tau alone.
  Eigen::MatrixXd frame;
  /// A box in tau. Where its closure holds 0 one bound on the flow's slope proves decrease; elsewhere a multiplier of
  /// the S-lemma does, one for each choice of the smallest or largest ball speeds (bit i: largest for ball i) and,
  /// under a motor, deviations of the rotor's speed (the bit after those).
  struct Box {
    std::array<double, 2> low{}, high{};
    std::array<double, 8> multiplier{};
  };
  /// Cover the unit disc of tau, the projection of V <= c on the ball angles. For a tilting rotor: none, and `frame`
  /// is any in which V <= c is the unit ball.
  std::vector<Box> boxes;

  model::System system() const;
};

/// The proof covers this much more than `level`, relatively: rounding in a program's test V < level is far below it.
inline constexpr double level_slack = 1e-9;

/// Relative margin by which a search must succeed: far above rounding, so that another compiler's does not refute it,
/// and far below what decides the share proved.
inline constexpr double spare_in_search = 1e-11;

/// Boxes tried for one level.
inline constexpr long default_budget = 20000;

/// Why a proof is not tried or fails.
inline constexpr char speed_is_finite[] = "the speed must be a finite number";
inline constexpr char stopped_before_proof[] = "stopped before it was proved";
inline constexpr char no_decrease_in_box[] = "V does not decrease all over the box";

struct CertificateResult {
  bool proved = false;
  std::string reason;  ///< why not, in one sentence
};

/// Tries to prove the given level around the balanced state at ball angles `phi`; on success completes `certificate`.
/// For one or two balls, or where the rotor tilts two in each of two planes, with isolated, linearly stable balanced
/// states, isotropic supports, no gravity, at a prescribed speed or under a motor below its limit all over the level
/// set; refuses else, with the reason. `budget`: most boxes
/// to try. A stopped search proves nothing.
CertificateResult prove_level(const model::System& system, const double* phi, const Eigen::MatrixXd& form, double level,
                              Certificate& certificate, long budget = default_budget, const StopFlag* stop = nullptr);

/// Verifies a certificate from its own data alone, with outward rounding. A stopped check proves nothing.
CertificateResult check_certificate(const Certificate& certificate, const StopFlag* stop = nullptr);

/// The largest provable share of `critical` (the sampled critical level, or of the level at which a motor reaches its
/// limit if that is lower), by bisection between shares; `reason`, if given, receives why there is none, in which case
/// the level is 0. A stopped search returns what it has proved so far.
Certificate largest_certificate(const model::System& system, const double* phi, const Eigen::MatrixXd& form,
                                double critical, std::string* reason = nullptr, const StopFlag* stop = nullptr);

}  // namespace equipoise
