// --within: the time that a command may take, and its message when it ends early.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "progress.hpp"

namespace equipoise::app {

/// --within TIME.
void add_within(CLI::App& app, std::optional<std::string>& within);

/// Starts the command's time; when it ends, the program's stop flag is set. Empty: no limit. Throws InputError.
void begin_time(const std::optional<std::string>& within);

/// Whether --within was given.
bool time_is_limited();

/// Whether the time ended before anything else stopped the command.
bool time_is_over();

/// Ends the time now, if it is limited.
void end_time();

/// Whether half of the time is over, for the first of two works that only count together; empty without a limit.
std::function<bool()> half_of_the_time();

/// Where a command keeps its work: "-o FILE.nc". Null: nowhere.
using Keeper = const char*;
constexpr Keeper kept_by_output = "-o FILE.nc";

/// Reports that the command was stopped by Ctrl-C or ran out of time, how far it came, about how long the rest takes,
/// and how to continue. `output`: the file that holds the work; empty: none. Returns the exit code.
int ended_early(const std::optional<WorkLeft>& left, Keeper keeper, const std::string& output);

}  // namespace equipoise::app
