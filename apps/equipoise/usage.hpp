// Bad usage in one line that says what was typed, what is allowed and what may have been meant.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace equipoise::app {

/// What is wrong with a command line that `app` would not take.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

/// Throws InputError for an option that was given an empty value: none means anything.
void refuse_empty_values(const CLI::App& command);

}  // namespace equipoise::app
