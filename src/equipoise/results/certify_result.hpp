// What was proved of a study's balanced states.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/proof/certificate.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// One stable balanced state; exchange copies of equal balls share a proof.
struct StateProof {
  Certificate certificate;                    ///< level 0: nothing proved
  int copies = 1;                             ///< balanced states that the proof covers
  double critical = 0.0;                      ///< smallest level at which V was seen not to decrease, by sampling
  std::array<double, max_dimension> reach{};  ///< largest deviation in each variable on the proved level set
  CertificateResult check;                    ///< of the finished certificate, from its own data; or why there is none
  double seconds = 0.0, check_seconds = 0.0;
};

struct CertifyResult {
  Study study;
  double speed = 0.0;              ///< final speed of the study
  std::vector<StateProof> states;  ///< one for each stable state that is no copy
  std::string note;                ///< why there is no state to prove anything of
  bool partial = false;            ///< stopped before every state was tried
  /// There is a stable state, and each has a proof that was checked.
  bool proved() const;
};

/// Certificates read from a file, and what check_certificate() says of each.
struct CertificateFile {
  std::string path;
  std::vector<Certificate> certificates;
  std::vector<CertificateResult> checks;
  /// All of them hold.
  bool proved() const;
};

}  // namespace equipoise
