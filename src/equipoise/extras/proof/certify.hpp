// Proofs about a study's balanced states, isolated ones and members of a continuum (three balls or more).
// This room: proofs about one study, and stability proved over boxes of parameters.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/types/note.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Proves that a member of a continuum attracts or is unstable.
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

/// One stable balanced state; exchange copies of equal balls share a proof.
struct StateProof {
  Certificate certificate;                    ///< level 0: nothing proved
  int copies = 1;                             ///< balanced states that the proof covers
  double critical = 0.0;                      ///< smallest level at which V was seen not to decrease, by sampling
  std::array<double, max_dimension> reach{};  ///< largest deviation in each variable on the proved level set
  CertificateResult check;                    ///< of the finished certificate, from its own data; or why there is none
  double seconds = 0.0, check_seconds = 0.0;
};

/// One member of a continuum of balanced states.
struct MemberProof {
  MemberCertificate certificate;  ///< radius 0: nothing proved
  CertificateResult check;        ///< of the finished certificate, from its own data; or why there is none
  double growth = 0.0;            ///< largest real part across the continuum, by linear theory in doubles
};

struct CertifyResult {
  Study study;
  double speed = 0.0;                ///< final speed of the study
  std::vector<StateProof> states;    ///< one for each stable state that is no copy
  std::vector<MemberProof> members;  ///< of a continuum, drawn evenly; says nothing of other members
  Note note;                         ///< why there is no state to prove anything about
  bool partial = false;              ///< stopped before every state was tried
  /// Whether there is a stable state and each has a checked proof. For a continuum: whether each member drawn is proved
  /// to attract or not, and some attract.
  bool proved() const;
  /// Members that are proved to attract, or to be unstable.
  int attracting() const { return members_proved(true); }
  int unstable() const { return members_proved(false); }

 private:
  int members_proved(bool attracts) const;
};

/// Certificates read from a file, each with its check.
struct CertificateFile {
  std::string path;
  std::vector<StateProof> states;
  std::vector<MemberProof> members;
  /// Whether all of them are valid.
  bool proved() const;
};

/// Proves as large a level set as it can for each stable balanced state at the final speed, and checks the finished
/// certificate. A failed proof is no error: the result says why. Progress counts balanced states. After a stop the
/// result is partial: states not reached are not proved, and say so. Uses one thread. Throws InputError for anisotropic
/// supports, gravity, and balls that collide or stick.
CertifyResult certify(const Study& study, const RunOptions& options = {});

/// For the terminal.
std::string certify_text(const CertifyResult& result, const TextStyle& style = wide_style);
std::string check_text(const CertificateFile& file, const TextStyle& style = wide_style);

/// One JSON object without the boxes; docs/reference/commands/certify.md lists the keys.
std::string json_text(const CertifyResult& result);
std::string json_text(const CertificateFile& file);

/// What a file of certificates holds.
struct Certificates {
  std::vector<Certificate> states;
  std::vector<MemberCertificate> members;
};

/// One JSON object, readable by certificates_from_json(); docs/reference/commands/certify.md lists its keys.
std::string certificates_json(const Certificates& certificates);

/// Everything that `result` proved; empty if nothing.
std::string certificates_json(const CertifyResult& result);

/// Reads what certificates_json() wrote. Throws InputError, naming `where` and the key, for anything else. Whether a
/// certificate is valid is checked by check_certificate() and check_member(). Once `stop` is set, some may be missing.
Certificates certificates_from_json(const std::string& text, const std::string& where, const StopFlag* stop = nullptr);

/// Reads such a text and checks each certificate from its own data. Throws what certificates_from_json() throws.
/// Once `stop` is set, what has not been read is missing and what has not been checked counts as not proved.
CertificateFile checked_certificates(const std::string& text, const std::string& where, const StopFlag* stop = nullptr);

}  // namespace equipoise
