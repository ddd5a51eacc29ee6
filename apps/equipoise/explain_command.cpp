// equipoise explain: a study in physical and dimensionless form, and what follows without simulation.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/core/running/deadline.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/analyses/one_study/basin_cost.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/explain_report.hpp"
#include "options.hpp"
#include "streams.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

struct ExplainArguments {
  std::string study;
  std::vector<std::string> overrides;
  std::optional<std::string> within;
  bool json = false, cost = false;
};

int run_explain(const ExplainArguments& a) {
  const Study study = read_study(a.study, a.overrides);
  Explanation e = explain(at_medians(study), &stop_flag());
  if (a.cost) {
    RunOptions options;
    options.stop = &stop_flag();
    e.cost = measure_cost(study, options, a.within ? read_time_limit("--within", *a.within) : cost_patience);
  } else if (a.within) {
    throw InputError("--within", "", display_text(*a.within), words::cost_only);
  }
  put(a.json ? explain_json(e) : explain_text(e, text_style()));
  return stop_flag() ? interrupted : done;
}

}  // namespace

Command add_explain(CLI::App& app) {
  const auto a = std::make_shared<ExplainArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  app.add_flag("--cost", a->cost, help::explain::cost);
  app.add_option("--within", a->within, help::explain::within)->type_name("TIME");
  add_wide(app);
  add_overrides(app, a->overrides);
  app.add_flag("--json", a->json, help::json);
  return [a] { return run_explain(*a); };
}

}  // namespace equipoise::app
