// Drawing by the program gnuplot.
#include "gnuplot.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <unistd.h>

#include "equipoise/base/error.hpp"
#include "equipoise/io/replacement.hpp"
#include "words.hpp"

namespace equipoise::app {

void require_gnuplot(const char* option, const std::string& value) {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (access((folder + "/gnuplot").c_str(), X_OK) == 0) return;
  throw InputError(option, "", value, words::needs_gnuplot);
}

namespace {

// gnuplot does not report a full disk: only the end of a picture shows whether it is whole.
bool is_whole(const std::string& path) {
  const std::string end = path.ends_with(".svg") ? "</svg>" : "IEND";
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  constexpr std::streamoff last = 16;
  if (!file || file.tellg() < last) return false;
  std::string tail(static_cast<std::size_t>(last), '\0');
  file.seekg(-last, std::ios::end);
  file.read(tail.data(), last);
  return file && tail.find(end) != std::string::npos;
}

}  // namespace

void draw(const std::string& path, const std::function<std::string(const std::string&)>& script_for) {
  io::Replacement place(path, path.substr(path.rfind('.')));
  const std::string script = script_for(place.file());
  std::signal(SIGPIPE, SIG_IGN);  // the exit code tells that gnuplot gave up
  std::FILE* gnuplot = popen("gnuplot", "w");
  if (!gnuplot) throw RunError(words::gnuplot_not_started);
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !written) throw RunError(fmt::format(words::gnuplot_failed, path));
  if (!is_whole(place.file())) throw RunError(fmt::format(words::picture_not_whole, path));
  place.commit();
}

}  // namespace equipoise::app
