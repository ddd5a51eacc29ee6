// Options that several commands share.
#include "options.hpp"

#include "equipoise/run/lane_kernels.hpp"
#include "equipoise/store/replacement.hpp"

namespace equipoise::app {

void choose_cpu(const std::string& name) {
  if (name.empty() || use_cpu_target(name)) return;
  std::string known;
  for (const std::string& target : cpu_targets()) known += (known.empty() ? "" : ", ") + target;
  throw InputError("--cpu", "", name, "must be one of those this machine has: " + known);
}

void require_writable(const char* option, const std::string& path) {
  if (path.empty()) return;
  if (const std::string problem = store::why_not_writable(path); !problem.empty())
    throw InputError(option, "", path, "cannot be written: " + problem + "; must be a file in a folder that exists");
}

void write_file(const std::string& path, const std::string& text) { store::write_whole(path, text); }

void add_overrides(CLI::App& app, std::vector<std::string>& overrides) {
  app.add_option("--set", overrides, "override a study key, e.g. speed.final=2.6; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
}

}  // namespace equipoise::app
