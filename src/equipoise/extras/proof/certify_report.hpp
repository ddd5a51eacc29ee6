// Proofs about a study's balanced states as text and as JSON.
#pragma once

#include <string>

#include "equipoise/extras/proof/certify_result.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// For the terminal.
std::string certify_text(const CertifyResult& result, const TextStyle& style = wide_style);

/// One JSON object without the boxes; docs/reference/commands/certify.md lists the keys.
std::string certify_json(const CertifyResult& result);
std::string check_text(const CertificateFile& file, const TextStyle& style = wide_style);
std::string check_json(const CertificateFile& file);

}  // namespace equipoise
