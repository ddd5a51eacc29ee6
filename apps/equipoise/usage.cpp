// CLI11 reports what it did not understand; the rest comes from the application's definition.
#include "usage.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/nearest_name.hpp"

namespace equipoise::app {

namespace {

// " (is "basin" meant?)", or nothing if no name is near.
std::string meant(const std::string& typed, const std::vector<std::string>& names) {
  const auto begins = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return typed.size() >= 3 && name.starts_with(typed);
  });
  const std::string best = begins != names.end() ? *begins : nearest_name(typed, names);
  return best.empty() ? "" : fmt::format(" (is \"{}\" meant?)", best);
}

// "N, number of starts"
std::string takes(const CLI::Option& option) {
  return fmt::format("{}, {}", option.get_type_name(), option.get_description());
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// Ignores the value in "--starts=5".
std::string unknown_option(const CLI::App& app, const std::string& place, const std::string& typed) {
  const std::string name = typed.substr(0, typed.find('='));
  return fmt::format("{}unknown option \"{}\"{}; {} --help lists all", place, display_text(name),
                     meant(name, option_names(app)), app.get_parent() ? "equipoise " + app.get_name() : "equipoise");
}

// The error for a first word that is not a command.
std::string no_command(const CLI::App& app, char** argv) {
  const std::string allowed = fmt::format("must be one of: {}", fmt::join(command_names(app), ", "));
  const std::string typed = argv[1];
  if (typed.starts_with("-")) return unknown_option(app, "", typed);
  return fmt::format("unknown command \"{}\"{}; {}", display_text(typed), meant(typed, command_names(app)), allowed);
}

std::string unexpected(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  const auto option = std::find_if(words.begin(), words.end(), [](const std::string& w) { return w.starts_with("-"); });
  const std::string place = command.get_name() + ": ";
  if (option != words.end() && *option != "--") return unknown_option(command, place, *option);
  return fmt::format("{}unexpected \"{}\"; one study is enough, and options begin with --", place,
                     display_text(words.empty() ? "" : words.front()));
}

// An option without its value, or given twice. CLI11 names it before a colon.
std::string mismatch(const CLI::App& command, const std::string& message) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 1 && option->get_items_expected_max() <= 1 && !option->get_positional())
      return fmt::format("{}: {}: given {} times ({}); must be given once", command.get_name(), option->get_name(),
                         option->count(), display_text(fmt::format("{}", fmt::join(option->results(), ", "))));
  }
  const CLI::Option* option = command.get_option_no_throw(message.substr(0, message.find(':')));
  return option ? fmt::format("{}: {}: its value is missing; it takes {}", command.get_name(), option->get_name(),
                              takes(*option))
                : "";
}

// A required argument that is missing: CLI11's message begins with its name.
std::string missing(const CLI::App& command, const std::string& message) {
  const CLI::Option* option = command.get_option_no_throw(message.substr(0, message.find(' ')));
  return option ? fmt::format("{}: {} is missing; expected {}", command.get_name(), option->get_type_name(),
                              option->get_description())
                : "";
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error, char** argv) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (chosen.empty()) return no_command(app, argv);
  const CLI::App& command = *chosen.front();
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unexpected(command);
  std::string text = dynamic_cast<const CLI::ArgumentMismatch*>(&error) ? mismatch(command, error.what()) : "";
  if (text.empty() && dynamic_cast<const CLI::RequiredError*>(&error)) text = missing(command, error.what());
  if (text.empty()) text = command.get_name() + ": " + display_text(error.what());
  return text;
}

namespace {
std::string name_of(const CLI::Option& option) {
  return option.get_positional() ? option.get_type_name() : option.get_name();
}
}  // namespace

void refuse_empty_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_expected_min() == 0) continue;  // its value is optional
    for (const std::string& value : option->results())
      if (value.empty())
        throw InputError(name_of(*option), "", "", fmt::format("is empty; it takes {}", takes(*option)));
  }
}

namespace {

bool same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path first = fs::weakly_canonical(a, error), second = fs::weakly_canonical(b, error);
  if (error || (fs::exists(first, error) && !fs::is_regular_file(first, error))) return false;
  return first == second ||
         (fs::exists(first, error) && fs::exists(second, error) && fs::equivalent(first, second, error));
}

}  // namespace

void refuse_same_files(const CLI::App& command) {
  std::vector<std::pair<const CLI::Option*, std::string>> files;
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    if (!type.starts_with("FILE") && !type.starts_with("STUDY")) continue;
    for (const std::string& value : option->results()) {
      for (const auto& [other, path] : files)
        if (other != option && same_file(path, value))
          throw InputError(name_of(*option), "", display_text(value),
                           fmt::format("is the same file as {}; must be another one", name_of(*other)));
      files.emplace_back(option, value);
    }
  }
}

}  // namespace equipoise::app
