// Child processes whose output and resources are wanted.
#include "child.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"

extern char** environ;

namespace equipoise::bench {

ChildResult run_child(const std::vector<std::string>& command, const std::string& input, bool silent) {
  int to[2], from[2];
  if (pipe2(to, O_CLOEXEC) != 0) throw RunError("no pipe to a child process");
  if (pipe2(from, O_CLOEXEC) != 0) {
    close(to[0]);
    close(to[1]);
    throw RunError("no pipe from a child process");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from[1], STDOUT_FILENO);
  if (silent) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  // Written ahead: it fits into the pipe.
  const bool written = write(to[1], input.data(), input.size()) == static_cast<ssize_t>(input.size());
  close(to[1]);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(to[0]);
  close(from[1]);
  ChildResult result;
  if (failed == 0) {
    char buffer[4096];
    ssize_t got;
    while ((got = read(from[0], buffer, sizeof buffer)) > 0 || (got < 0 && errno == EINTR))
      if (got > 0) result.output.append(buffer, static_cast<std::size_t>(got));
    int status = 0;
    rusage used{};
    while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
    }
    result.ran = written && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    result.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
    result.peak_megabytes = static_cast<double>(used.ru_maxrss) / 1024.0;  // Linux counts in KiB
  }
  close(from[0]);
  return result;
}

std::string temporary_path(const std::string& ending) {
  static std::atomic<int> number{0};
  return (std::filesystem::temp_directory_path() / fmt::format("equipoise-bench-{}-{}{}", getpid(), number++, ending))
      .string();
}

}  // namespace equipoise::bench
