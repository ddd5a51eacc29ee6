// Drawing with the program gnuplot.
#include "gnuplot.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include <unistd.h>

#include "equipoise/base/error.hpp"

namespace equipoise::app {

void require_gnuplot(const char* option, const std::string& value) {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (access((folder + "/gnuplot").c_str(), X_OK) == 0) return;
  throw InputError(option, "", value,
                   "needs the program gnuplot, which is not on the PATH; must be installed first (Debian, Ubuntu: "
                   "package gnuplot-nox)");
}

void draw(const std::string& path, const std::string& script) {
  std::signal(SIGPIPE, SIG_IGN);  // a gnuplot that gives up is told by its exit code
  std::FILE* gnuplot = popen("gnuplot", "w");
  if (!gnuplot) throw RunError("gnuplot cannot be started");
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !written) throw RunError(path + ": gnuplot could not draw it");
}

}  // namespace equipoise::app
