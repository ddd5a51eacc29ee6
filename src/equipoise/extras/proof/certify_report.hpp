// Proofs about balanced states: text, JSON, and certificates as files.
#pragma once

#include <string>
#include <vector>

#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// For the terminal.
std::string certify_text(const CertifyResult& result, const TextStyle& style = wide_style);

/// One JSON object without the boxes; docs/reference/commands/certify.md lists the keys.
std::string certify_json(const CertifyResult& result);
std::string check_text(const CertificateFile& file, const TextStyle& style = wide_style);
std::string check_json(const CertificateFile& file);

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
