// The program's commands in the order in which help lists them, and what help says of each.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "commands.hpp"

namespace equipoise::app {

struct CommandEntry {
  const char* name;
  const char* words;          ///< one line
  Command (*add)(CLI::App&);  ///< declares its options
  std::array<const char*, 2> examples;
};
struct CommandGroup {
  const char* title;
  std::vector<CommandEntry> commands;
};
/// Every command of the program, once.
const std::vector<CommandGroup>& command_groups();

/// Help of the program, for `equipoise --help` and `equipoise` alone.
std::string program_help();
/// Gives `app` and the commands that are added to it later their help, in lines of 80 columns.
void set_help(CLI::App& app);

}  // namespace equipoise::app
