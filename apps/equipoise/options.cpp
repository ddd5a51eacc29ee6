// Options that several commands share.
#include "options.hpp"

#include <filesystem>
#include <fstream>

#include "equipoise/run/lane_kernels.hpp"

namespace equipoise::app {

void choose_cpu(const std::string& name) {
  if (name.empty() || use_cpu_target(name)) return;
  std::string known;
  for (const std::string& target : cpu_targets()) known += (known.empty() ? "" : ", ") + target;
  throw InputError("--cpu", "", name, "must be one of those this machine has: " + known);
}

void require_writable(const char* option, const std::string& path) {
  if (path.empty()) return;
  std::error_code ignored;
  const bool there = std::filesystem::exists(path, ignored);
  const bool opens = static_cast<bool>(std::ofstream(path, std::ios::app));
  if (opens && !there) std::filesystem::remove(path, ignored);
  if (!opens) throw InputError(option, "", path, "cannot be written; must be a file in a folder that exists");
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw RunError(path + ": writing failed");
}

void add_overrides(CLI::App& app, std::vector<std::string>& overrides) {
  app.add_option("--set", overrides, "override a study key, e.g. speed.final=2.6; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
}

}  // namespace equipoise::app
