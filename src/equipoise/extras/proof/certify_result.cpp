// When a proof counts.
#include "equipoise/extras/proof/certify_result.hpp"

#include <algorithm>

namespace equipoise {

bool CertifyResult::proved() const {
  if (!members.empty()) return attracting() > 0 && attracting() + unstable() == static_cast<int>(members.size());
  return !states.empty() && std::all_of(states.begin(), states.end(), [](const StateProof& s) {
    return s.certificate.level > 0.0 && s.check.proved;
  });
}

int CertifyResult::members_proved(bool attracts) const {
  return static_cast<int>(std::count_if(members.begin(), members.end(), [&](const MemberProof& m) {
    return m.check.proved && m.certificate.attracts == attracts;
  }));
}

bool CertificateFile::proved() const {
  const auto all = [](const std::vector<CertificateResult>& results) {
    return std::all_of(results.begin(), results.end(), [](const auto& check) { return check.proved; });
  };
  return (!checks.empty() || !member_checks.empty()) && all(checks) && all(member_checks);
}

}  // namespace equipoise
