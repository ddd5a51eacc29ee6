// An audit as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "checks.hpp"

namespace equipoise::audit {

/// The head of the table.
std::string table_head();
/// A study's line.
std::string table_line(const StudyAudit& audit);
/// All failures, each with the command that shows it; empty if there are none.
std::string faults_text(const StudyAudit& audit);
std::string audits_json(const std::vector<StudyAudit>& audits, std::uint64_t seed);

}  // namespace equipoise::audit
