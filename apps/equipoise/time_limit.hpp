// --within: the time that a command may take, and what is said when it ends early.
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

/// The command's time begins: once it is over the program's stop flag is set. None: without end. Throws InputError.
void begin_time(const std::optional<std::string>& within);

/// Whether --within was given.
bool time_is_limited();

/// Asks whether half of the time is over, for the first of two works that only count together; empty without a limit.
std::function<bool()> half_of_the_time();

/// Where a command keeps what it has done: "-o FILE.nc". Null: nowhere.
using Keeper = const char*;
constexpr Keeper kept_by_output = "-o FILE.nc";

/// Says that the command was stopped by Ctrl-C, or that its time is over, how far it came, about how long the rest
/// takes, and how to go on. `output`: the file that holds what is done; empty: none. Returns the exit code.
int ended_early(const std::optional<WorkLeft>& left, Keeper keeper, const std::string& output);

}  // namespace equipoise::app
