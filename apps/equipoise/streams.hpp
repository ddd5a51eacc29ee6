// Standard output and standard error: lost output is always reported, and never ends the work.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace equipoise::app {

/// Call this first: it ignores SIGPIPE and occupies the descriptors of closed standard streams: no file opened later
/// gets one of them. Writing to a closed standard output fails.
void claim_streams();

/// Writes to standard output. close_output() reports errors; after one, nothing more is written.
void put(const std::string& text);

/// Writes one line to standard error, after "equipoise: ". Failing to write it is no error.
void say(const std::string& line);

template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Writes to standard error verbatim, with the same rule.
void put_error(const std::string& text);

/// Whether somebody watches these streams, and how wide the terminal of standard error is: 80 if it does not say.
bool output_is_terminal();
bool error_is_terminal();
std::size_t terminal_width();

/// Flushes and closes standard output. Returns `code`; if anything was lost, by put() or by others, 1 after a line
/// that says so; 128 + SIGPIPE silently if the reader has gone, 130 if a stop ended the wait for it.
int close_output(int code);

}  // namespace equipoise::app
