// equipoise check: what was understood of a study, what was assumed, and which estimate matters most.
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/base/display_text.hpp"
#include "equipoise/explain/study_check.hpp"
#include "options.hpp"
#include "streams.hpp"
#include "help.hpp"

namespace equipoise::app {

namespace {

struct CheckArguments {
  std::string study;
  std::vector<std::string> overrides;
};

int run_check(const CheckArguments& a) {
  put(lines_filled(check_study(read_study_text(a.study), display_text(a.study), a.overrides).text(), text_style()));
  return done;
}

}  // namespace

Command add_check(CLI::App& app) {
  const auto a = std::make_shared<CheckArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  add_wide(app);
  add_overrides(app, a->overrides);
  return [a] { return run_check(*a); };
}

}  // namespace equipoise::app
