// The program's commands: each adds itself to the command line and returns what to run if it is chosen.
#pragma once

#include <exception>
#include <functional>

#include <CLI/CLI.hpp>

#include "equipoise/core/base/error.hpp"

namespace equipoise::app {

/// Exit codes (docs/reference/commands/index.md).
enum ExitCode : int {
  done = 0,
  failed = 1,
  bad_input = 2,
  check_failed = 3,
  out_of_time = 4,
  interrupted = 130,
};

/// Set by Ctrl-C and by a request to terminate.
StopFlag& stop_flag();

/// Says what was thrown; returns the exit code. In the program, overrides come from --set.
int say_error(const std::exception_ptr& thrown);

using Command = std::function<int()>;
Command add_attractors(CLI::App& app);
Command add_basin(CLI::App& app);
Command add_capacity(CLI::App& app);
Command add_certify(CLI::App& app);
Command add_chart(CLI::App& app);
Command add_check(CLI::App& app);
Command add_compare(CLI::App& app);
Command add_design(CLI::App& app);
Command add_explain(CLI::App& app);
Command add_inspect(CLI::App& app);
Command add_map(CLI::App& app);
Command add_merge(CLI::App& app);
Command add_new(CLI::App& app);
Command add_report(CLI::App& app);
Command add_reproduce(CLI::App& app);
Command add_simulate(CLI::App& app);
Command add_stability(CLI::App& app);
Command add_sweep(CLI::App& app);

}  // namespace equipoise::app
