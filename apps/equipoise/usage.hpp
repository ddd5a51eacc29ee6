// Reports bad usage in one line: what was typed, what is allowed and what was probably meant.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace equipoise::app {

/// What is wrong with a command line that `app` refuses.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, char** argv);

/// Throws InputError for an option with an empty value, which never means anything.
void refuse_empty_values(const CLI::App& command);

/// Throws InputError if two options name one file: what is written would replace what is read.
void refuse_same_files(const CLI::App& command);

}  // namespace equipoise::app
