// equipoise check: what was understood of a study, what was assumed, and which estimate matters most.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/explain/study_check.hpp"
#include "help.hpp"
#include "options.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct CheckArguments {
  std::string study;
  std::vector<std::string> overrides;
  std::optional<std::string> within;
};

int run_check(const CheckArguments& a) {
  begin_time(a.within);
  const StudySource source{read_study_text(a.study), display_text(a.study), a.overrides};
  const StudyCheck check = check_study(source.toml, source.name, source.overrides, &stop_flag());
  const SweepSetting sweep = source.with().sweep;
  if (!sweep.over.empty()) (void)sweep_axes(sweep.over, sweep.zip, own_sweep(source.name));
  put(lines_filled(check.text(), text_style()));
  return stop_flag() ? ended_early({}, nullptr, "") : done;
}

}  // namespace

Command add_check(CLI::App& app) {
  const auto a = std::make_shared<CheckArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  add_wide(app);
  add_overrides(app, a->overrides);
  add_within(app, a->within);
  return [a] { return run_check(*a); };
}

}  // namespace equipoise::app
