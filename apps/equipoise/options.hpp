// Options that several commands share.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "equipoise/base/error.hpp"

namespace equipoise::app {

/// A number given as an option, checked so that a bad one gets the same kind of error as in a study.
template <class T>
T option_number(const char* option, const std::string& text, T low, T high, const char* allowed) {
  T value{};
  if (!CLI::detail::lexical_cast(text, value) || !(value >= low && value <= high))
    throw InputError(option, "", text, fmt::format("must be {}", allowed));
  return value;
}

/// --cpu NAME. Throws InputError if this machine does not have it.
void choose_cpu(const std::string& name);

/// Throws InputError unless a file can be written at `path`, so that work is not lost to a missing folder. Nothing is
/// left behind. An empty path is none.
void require_writable(const char* option, const std::string& path);

/// Throws RunError, naming the file, if `text` cannot be written there whole; what was there stays then.
void write_file(const std::string& path, const std::string& text);

/// --set KEY=VALUE, repeated.
void add_overrides(CLI::App& app, std::vector<std::string>& overrides);

}  // namespace equipoise::app
