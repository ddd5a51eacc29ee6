// When a proof counts.
#include "equipoise/results/certify_result.hpp"

#include <algorithm>

namespace equipoise {

bool CertifyResult::proved() const {
  return !states.empty() && std::all_of(states.begin(), states.end(), [](const StateProof& s) {
    return s.certificate.level > 0.0 && s.check.proved;
  });
}

bool CertificateFile::proved() const {
  return !checks.empty() && std::all_of(checks.begin(), checks.end(), [](const auto& check) { return check.proved; });
}

}  // namespace equipoise
