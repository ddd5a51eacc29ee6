// Errors of standard output are kept until the end; those of standard error are ignored. Text is UTF-8 everywhere but
// on a terminal whose locale is of another encoding.
#include "streams.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "commands.hpp"
#include "equipoise/core/base/display_text.hpp"

namespace equipoise::app {

namespace {

// Of the first write that failed.
int output_error = 0;

// By the name of the locale, which a system need not have installed.
bool shows_utf8() {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(variable);
    const std::string_view name = value ? value : "";
    const auto says = [&](const char* codes) { return name.find(codes) != std::string_view::npos; };
    if (!name.empty()) return says("UTF-8") || says("utf-8") || says("UTF8") || says("utf8");
  }
  return false;
}

std::string in_ascii(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 22> signs{{
      {"±", "+-"},     {"Ω", "Omega"}, {"ω", "omega"}, {"φ", "phi"},  {"ψ", "psi"},   {"χ", "chi"},
      {"λ", "lambda"}, {"μ", "mu"},    {"ζ", "zeta"},  {"β", "beta"}, {"κ", "kappa"}, {"π", "pi"},
      {"√", "sqrt"},   {"²", "^2"},    {"³", "^3"},    {"−", "-"},    {"×", "x"},     {"≤", "<="},
      {"≥", ">="},     {"→", "->"},    {"µ", "u"},     {"°", " deg"},
  }};
  std::string plain;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view sign = text.substr(at, std::max<std::size_t>(character_length(text, at), 1));
    const auto known = std::find_if(signs.begin(), signs.end(), [&](const auto& s) { return s.first == sign; });
    const bool ascii = static_cast<unsigned char>(sign.front()) < 0x80;
    plain += ascii ? sign : known != signs.end() ? known->second : "?";
    at += sign.size();
  }
  return plain;
}

std::string for_stream(const std::string& text, int stream) {
  return isatty(stream) == 0 || shows_utf8() ? text : in_ascii(text);
}

}  // namespace

void claim_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  // open() takes the lowest free descriptor. Standard input's is opened for writing and standard output's for reading,
  // so that using them fails as on closed streams. Standard error's swallows its text.
  const int modes[] = {O_WRONLY, O_RDONLY, O_WRONLY};
  for (int place = 0; place < 3; ++place)
    if (fcntl(place, F_GETFD) < 0 && errno == EBADF && open("/dev/null", modes[place]) != place) return;
}

void put(const std::string& given) {
  if (output_error != 0) return;
  const std::string text = for_stream(given, STDOUT_FILENO);
  const bool stopped = stop_flag();
  for (std::string_view left = text; !left.empty() && output_error == 0;) {
    const ssize_t written = write(STDOUT_FILENO, left.data(), left.size());
    left.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    if (written < 0)
      output_error = errno;
    else if (!left.empty() && stop_flag() != stopped)  // a stop cuts short what waits for a reader
      output_error = EINTR;
  }
}

void put_error(const std::string& given) {
  const std::string text = for_stream(given, STDERR_FILENO);
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
