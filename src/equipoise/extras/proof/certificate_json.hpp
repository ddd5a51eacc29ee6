// Certificates as JSON whose numbers read back to the same bits.
#pragma once

#include <string>
#include <vector>

#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/extras/proof/certify_result.hpp"
#include "equipoise/extras/proof/member_certificate.hpp"

namespace equipoise {

/// One JSON object, readable by certificates_from_json(); docs/reference/commands/certify.md lists its keys.
std::string certificates_json(const std::vector<Certificate>& certificates,
                              const std::vector<MemberCertificate>& members = {});

/// Everything that `result` proved; empty if nothing.
std::string certificates_json(const CertifyResult& result);

/// Reads what certificates_json() wrote. Throws InputError, naming `where` and the key, for anything else. Whether a
/// certificate is valid is checked by check_certificate() and check_member().
std::vector<Certificate> certificates_from_json(const std::string& text, const std::string& where);
std::vector<MemberCertificate> members_from_json(const std::string& text, const std::string& where);

/// Reads such a text and checks each certificate from its own data. Throws what certificates_from_json() throws.
/// Once `stop` is set, what has not been checked counts as not proved.
CertificateFile checked_certificates(const std::string& text, const std::string& where, const StopFlag* stop = nullptr);

}  // namespace equipoise
