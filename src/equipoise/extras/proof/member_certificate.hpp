// Proofs that a member of a continuum of balanced states (three balls or more) attracts or is unstable.
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise {

/// h = (x, y, u, v, q_1..q_n, U_x, U_y), U the unbalance lambda + sum mu_i e^{i phi_i}: it vanishes on the whole
/// continuum and nowhere else at rest. V = h^T P h, h in units of lambda + sum mu_i but for the q_i.
///
/// Attracts: wherever every ball's angle is within `radius` of phi and |q_i| <= rate radius / 2, dV/dt <= -2 rate V,
/// and V >= least |h|^2. So a trajectory from where all angles are within half that radius (modulo 2 pi) and V <= level
/// = least (rate radius / 2)^2 never leaves those bounds, for balls move by the integral of |q_i| at most; it converges
/// to a balanced state among them.
///
/// Else: a balanced state lies within `radius` of phi, dV/dt < 0 wherever, within those bounds on angles, |q_i| <=
/// radius and h is not 0, and V < 0 at `escape`: arbitrarily near to that state there are others from which V falls
/// ever faster, and |h| grows, until a ball has left those bounds.
struct MemberCertificate {
  model::Parameters parameters;
  double speed = 0.0;
  std::array<double, model::max_balls> phi{};
  bool attracts = true;
  double radius = 0.0;  ///< 0: nothing is proved
  double rate = 0.0, least = 0.0, level = 0.0;
  Eigen::MatrixXd form;  ///< P
  Eigen::VectorXd escape;
};

/// Proves one or the other near ball angles `phi`; radius 0 if neither succeeds. Needs a prescribed speed, a centred
/// race, equal supports, no gravity.
MemberCertificate prove_member(const model::Parameters& p, double speed, const double* phi);

/// The largest real part of a rate across the continuum at its member, by linear theory in doubles.
double across_continuum(const model::Parameters& p, double speed, const double* phi);

/// Verifies a certificate from its own data alone, with outward rounding.
CertificateResult check_member(const MemberCertificate& certificate);

}  // namespace equipoise
