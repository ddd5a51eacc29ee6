// Markdown and JSON.
#include "table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace equipoise::audit {

namespace {

const char* word(Verdict verdict) {
  return verdict == Verdict::passed ? "ok" : verdict == Verdict::failed ? "FAILED" : "-";
}

std::string cell(const Check& check) {
  std::string text = word(check.verdict);
  if (check.verdict != Verdict::not_asked && !check.seen.empty()) text += " (" + check.seen + ")";
  return text;
}

}  // namespace

std::string table_head() {
  std::string head = "| no. | drawn for | balls | answer |", rule = "|---|---|---|---|";
  for (const char* name : column_names) {
    head += fmt::format(" {} |", name);
    rule += "---|";
  }
  return head + " CPU |\n" + rule + "---|\n";
}

std::string table_line(const StudyAudit& audit) {
  const DrawnStudy& d = audit.drawn;
  std::string line = fmt::format("| {} | {} | {} | {} |", d.number, d.kind, d.study.parameters.balls,
                                 audit.refused.empty() ? audit.answer : "refused: " + audit.refused);
  for (const Check& check : audit.checks) line += " " + cell(check) + " |";
  return line + fmt::format(" {:.1f} s |\n", audit.seconds);
}

std::string faults_text(const StudyAudit& audit) {
  std::string text;
  for (std::size_t k = 0; k < column_count; ++k)
    for (const Check::Fault& fault : audit.checks[k].faults)
      text += fmt::format("{} ({}), {}: {}\n    {}\n", audit.drawn.number, audit.drawn.kind, column_names[k],
                          fault.what, fault.command);
  return text;
}

std::string audits_json(const std::vector<StudyAudit>& audits, std::uint64_t seed) {
  nlohmann::ordered_json json{{"seed", seed}, {"studies", nlohmann::ordered_json::array()}};
  for (const StudyAudit& audit : audits) {
    nlohmann::ordered_json one{
        {"number", audit.drawn.number}, {"kind", audit.drawn.kind}, {"study", to_toml(audit.drawn.study)},
        {"answer", audit.answer},       {"refused", audit.refused}, {"undecided", audit.undecided_share},
        {"cpu_seconds", audit.seconds}, {"failed", audit.failed()}};
    for (std::size_t k = 0; k < column_count; ++k) {
      const Check& check = audit.checks[k];
      nlohmann::ordered_json c{{"verdict", word(check.verdict)}, {"seen", check.seen}};
      for (const Check::Fault& fault : check.faults)
        c["faults"].push_back({{"what", fault.what}, {"command", fault.command}});
      one["checks"][column_names[k]] = c;
    }
    json["studies"].push_back(one);
  }
  return json.dump(2) + "\n";
}

}  // namespace equipoise::audit
