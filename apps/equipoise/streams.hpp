// Standard output and standard error: what cannot be written is never lost unsaid, and never ends the work.
#pragma once

#include <string>

#include <fmt/format.h>

namespace equipoise::app {

/// To be called before anything else: ignores SIGPIPE, and takes the places of standard streams that are closed, so
/// that no file opened later gets one of them. Writing to a closed standard output fails, as it should. What goes to
/// std::cout goes through put().
void claim_streams();

/// Writes to standard output. What goes wrong is told by close_output(); after that nothing more is written.
void put(const std::string& text);

/// One line to standard error, after "equipoise: ". That nobody hears it is no failure.
void say(const std::string& line);

template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Writes to standard error as it is; likewise.
void put_error(const std::string& text);

/// Brings standard output to where it goes, whoever wrote to it, and closes it. `code`, or if anything was lost 1 after
/// a line that says so; 128 + SIGPIPE without a word if the reader has gone.
int close_output(int code);

}  // namespace equipoise::app
