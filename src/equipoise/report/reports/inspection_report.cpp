// Inspections as text and JSON.
#include "equipoise/report/reports/reports.hpp"

#include <sstream>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/text/json.hpp"

namespace equipoise {

std::string inspection_text(const Inspection& i) {
  std::string text =
      fmt::format("{}: {}, {} bytes", display_text(i.path), i.kind.empty() ? "results" : i.kind, i.bytes);
  if (!i.version.empty()) text += fmt::format(", of equipoise {}", i.version);
  if (i.complete) text += *i.complete ? ", complete" : ", NOT complete";
  text += "\n";
  if (!i.damage.empty()) text += fmt::format("DAMAGE: {}\n", i.damage);
  for (const auto& [name, value] : i.facts) text += fmt::format("  {:<14}{}\n", name, value);
  for (const OutcomeShare& o : i.outcomes)
    text += fmt::format("  {:>9.4f} %  {} ({})\n", 100.0 * o.share.share, o.name, o.id);
  if (i.study.empty()) return text;
  text += "study:\n";
  std::istringstream lines(i.study);
  for (std::string line; std::getline(lines, line);) text += line.empty() ? "" : "  " + line + "\n";
  return text;
}

std::string json_text(const Inspection& i) {
  const Json json = object(
      "path", i.path, "kind", i.kind, "version", i.version, "bytes", i.bytes, "damage", i.damage, "complete",
      i.complete, "facts",
      list_of(i.facts, [](const auto& fact) { return object("name", fact.first, "value", fact.second); }), "outcomes",
      list_of(i.outcomes,
              [](const OutcomeShare& o) { return object("id", o.id, "name", o.name, "share", o.share.share); }),
      "study", i.study);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
