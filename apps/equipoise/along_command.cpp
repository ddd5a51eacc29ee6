// Attractors along a parameter: files, picture, exit code.
#include "along_command.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <csignal>
#include <fmt/format.h>
#include <unistd.h>

#include "commands.hpp"
#include "equipoise/report/branch_plot.hpp"
#include "equipoise/run/continuation.hpp"
#include "equipoise/store/branches_file.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace equipoise::app {

namespace {

void require_ending(const char* option, const std::string& path, const char* first, const char* second) {
  if (path.empty() || path.ends_with(first) || path.ends_with(second)) return;
  throw InputError(option, "", path, fmt::format("must be a file name that ends in {} or {}", first, second));
}

void require_gnuplot(const std::string& path) {
  if (path.empty()) return;
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (access((folder + "/gnuplot").c_str(), X_OK) == 0) return;
  throw InputError("--plot", "", path,
                   "needs the program gnuplot, which is not on the PATH; must be installed first (Debian, Ubuntu: "
                   "package gnuplot-nox)");
}

void write_csv(const std::string& path, const BranchesResult& result) {
  std::ofstream file(path, std::ios::binary);
  file << branches_csv(result);
  if (!file.flush()) throw RunError(path + ": writing failed");
}

void draw(const std::string& path, const BranchesResult& result) {
  std::signal(SIGPIPE, SIG_IGN);  // a gnuplot that gives up is told by its exit code
  std::FILE* gnuplot = popen("gnuplot", "w");
  if (!gnuplot) throw RunError("gnuplot cannot be started");
  const std::string script = branch_plot_script(result, path);
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !written) throw RunError(path + ": gnuplot could not draw it");
}

}  // namespace

int run_along(const Study& study, const AlongArguments& a) {
  require_ending("--output", a.output, ".csv", ".nc");
  require_ending("--plot", a.plot, ".png", ".svg");
  const ParameterLine line(study, a.along);
  require_gnuplot(a.plot);
  require_writable("--output", a.output);
  require_writable("--plot", a.plot);

  ContinuationOptions options;
  options.threads = a.threads;
  options.starts = a.starts;
  options.seeds = a.states;
  options.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  options.progress = [&](const ContinuationProgress& p) { progress.update(p.done, p.total, p.what); };
  const BranchesResult result = follow_attractors(study, line, options);
  progress.finish();
  fmt::print("{}", a.json ? branches_json(result) : branches_text(result));
  std::fflush(stdout);
  if (a.output.ends_with(".csv")) write_csv(a.output, result);
  if (a.output.ends_with(".nc")) write_branches_file(a.output, branch_table(result));
  if (!a.plot.empty()) draw(a.plot, result);
  return result.partial ? interrupted : done;
}

}  // namespace equipoise::app
