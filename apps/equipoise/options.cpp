// Options that several commands share.
#include "options.hpp"

#include "equipoise/run/lane_kernels.hpp"

namespace equipoise::app {

void choose_cpu(const std::string& name) {
  if (name.empty() || use_cpu_target(name)) return;
  std::string known;
  for (const std::string& target : cpu_targets()) known += (known.empty() ? "" : ", ") + target;
  throw InputError("--cpu", "", name, "must be one of those this machine has: " + known);
}

void add_overrides(CLI::App& app, std::vector<std::string>& overrides) {
  app.add_option("--set", overrides, "override a study key, e.g. speed.final=2.6; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
}

}  // namespace equipoise::app
