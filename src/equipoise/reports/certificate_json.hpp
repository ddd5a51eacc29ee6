// Certificates as JSON: every number is written so that reading gives the same bits.
#pragma once

#include <string>
#include <vector>

#include "equipoise/proof/certificate.hpp"
#include "equipoise/proof/member_certificate.hpp"
#include "equipoise/results/certify_result.hpp"

namespace equipoise {

/// One JSON object, readable by certificates_from_json(); docs/guide/command-line.md lists its keys.
std::string certificates_json(const std::vector<Certificate>& certificates,
                              const std::vector<MemberCertificate>& members = {});

/// Of all that `result` proved; empty if that is nothing.
std::string certificates_json(const CertifyResult& result);

/// Reads what certificates_json() wrote. Throws InputError, naming `where` and the key, for anything else; whether a
/// certificate proves what it claims is for check_certificate() and check_member() to say.
std::vector<Certificate> certificates_from_json(const std::string& text, const std::string& where);
std::vector<MemberCertificate> members_from_json(const std::string& text, const std::string& where);

}  // namespace equipoise
