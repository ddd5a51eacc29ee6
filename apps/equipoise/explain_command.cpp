// equipoise explain: a study in physical and dimensionless form, and what follows without simulation.
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/base/display_text.hpp"
#include "equipoise/explain/explain.hpp"
#include "equipoise/report/explain_report.hpp"
#include "options.hpp"
#include "streams.hpp"

namespace equipoise::app {

namespace {

struct ExplainArguments {
  std::string study;
  std::vector<std::string> overrides;
  bool json = false;
};

int run_explain(const ExplainArguments& a) {
  const std::string text = read_study_text(a.study), name = display_text(a.study);
  const Explanation e =
      explain(at_medians(parse_study(text, name, a.overrides)), parse_ball_details(text, name, a.overrides));
  put(a.json ? explain_json(e) : explain_text(e));
  return done;
}

}  // namespace

Command add_explain(CLI::App& app) {
  const auto a = std::make_shared<ExplainArguments>();
  app.add_option("study", a->study, "study file (TOML)")->required()->type_name("STUDY");
  add_overrides(app, a->overrides);
  app.add_flag("--json", a->json, "print one JSON object");
  return [a] { return run_explain(*a); };
}

}  // namespace equipoise::app
