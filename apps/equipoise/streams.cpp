// Errors of standard output are kept until the end; those of standard error are ignored.
#include "streams.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "commands.hpp"

namespace equipoise::app {

namespace {

// Of the first write that failed.
int output_error = 0;

}  // namespace

void claim_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  // open() takes the lowest free descriptor. Standard input's is opened for writing and standard output's for reading,
  // so that using them fails as on closed streams. Standard error's swallows its text.
  const int modes[] = {O_WRONLY, O_RDONLY, O_WRONLY};
  for (int place = 0; place < 3; ++place)
    if (fcntl(place, F_GETFD) < 0 && errno == EBADF && open("/dev/null", modes[place]) != place) return;
}

void put(const std::string& text) {
  if (output_error != 0) return;
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written) output_error = errno != 0 ? errno : EIO;
}

void put_error(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void say(const std::string& line) { put_error("equipoise: " + line + "\n"); }

bool output_is_terminal() { return isatty(STDOUT_FILENO) != 0; }

bool error_is_terminal() { return isatty(STDERR_FILENO) != 0; }

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

int close_output(int code) {
  errno = 0;
  const bool lost = std::ferror(stdout) != 0;
  const bool closed = std::fclose(stdout) == 0;
  if (output_error == 0 && (lost || !closed)) output_error = errno != 0 ? errno : EIO;
  if (output_error == 0) return code;
  if (output_error == EPIPE) return 128 + SIGPIPE;
  if (output_error == EINTR) return interrupted;
  say("standard output cannot be written: {}", std::strerror(output_error));
  return failed;
}

}  // namespace equipoise::app
