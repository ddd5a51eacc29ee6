// Help is two tables, of commands and of groups of options; the options' own words are where commands add them.
#include "help.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise::app {

const std::vector<CommandGroup>& command_groups() {
  static const std::vector<CommandGroup> groups{
      {"Getting started",
       {{"new",
         "write an annotated template for your kind of machine",
         add_new,
         {"equipoise new fan -o fan.toml", "equipoise new blank -o machine.toml"}},
        {"check",
         "read a study back: what was understood, what was assumed",
         add_check,
         {"equipoise check fan.toml", "equipoise check fan.toml --set balancer.balls=4"}},
        {"basin",
         "run thousands of start-ups: verdict, probabilities, vibration",
         add_basin,
         {"equipoise basin fan.toml --starts 10000 -o fan.nc",
          "equipoise basin fan.toml --set balancer.balls=4 --details"}},
        {"report",
         "the same as a printable HTML report",
         add_report,
         {"equipoise report fan.toml -o fan.html", "equipoise report fan.toml -o fan.html --starts 10000"}},
        {"design",
         "search for a better balancer or spin-up",
         add_design,
         {"equipoise design fan.toml --best better.toml", "equipoise design fan.toml --within 10min -o trials.nc"}}}},
      {"A closer look",
       {{"explain",
         "critical speeds, capacity and rules of thumb; no simulation",
         add_explain,
         {"equipoise explain fan.toml", "equipoise explain fan.toml --cost"}},
        {"simulate",
         "one run over time, as CSV or NetCDF",
         add_simulate,
         {"equipoise simulate fan.toml -o run.csv",
          "equipoise simulate fan.toml --every \"10 ms\" --until \"40 s\" -o run.nc"}},
        {"attractors",
         "every steady motion the rotor can settle into",
         add_attractors,
         {"equipoise attractors fan.toml",
          "equipoise attractors fan.toml --along \"speed.final=900 rpm:1400 rpm:100 rpm\""}},
        {"map",
         "which starting positions end where, as a picture",
         add_map,
         {"equipoise map fan.toml --plot map.svg", "equipoise map fan.toml --size 128x128 -o map.nc"}}}},
      {"Varying parameters",
       {{"sweep",
         "probabilities over one to three parameters",
         add_sweep,
         {"equipoise sweep fan.toml --over balancer.balls=2,3,4 -o sweep.nc",
          "equipoise sweep fan.toml --over \"speed.final=900 rpm:1400 rpm:100 rpm\""}},
        {"capacity",
         "the largest unbalance the balancer can still handle",
         add_capacity,
         {"equipoise capacity machine.toml", "equipoise capacity machine.toml --at-least 0.99 --starts 2000"}},
        {"compare",
         "two designs on the same starts",
         add_compare,
         {"equipoise compare fan.toml better.toml",
          "equipoise compare fan.toml fan.toml --set-second balancer.balls=4"}},
        {"stability",
         "where balance is linearly stable, over two parameters",
         add_stability,
         {"equipoise stability row.toml --x speed.final=0.5:6 --y balancer.drag=0.005:0.5",
          "equipoise stability row.toml --x speed.final=0.5:6 --y rotor.damping=0.1:1"}},
        {"chart",
         "bifurcation curves over two parameters, with proofs",
         add_chart,
         {"equipoise chart row.toml --x speed.final=0.5:6 --y balancer.drag=0.005:0.5",
          "equipoise chart row.toml --x speed.final=2:4 --y rotor.damping=0.1:1 --cycles"}}}},
      {"Files and checks",
       {{"inspect",
         "look into a result file",
         add_inspect,
         {"equipoise inspect fan.nc", "equipoise inspect sweep.nc.part"}},
        {"merge",
         "join parts of a sweep",
         add_merge,
         {"equipoise merge part-1.nc part-2.nc -o sweep.nc", "equipoise merge part-*.nc -o sweep.nc --plot sweep.svg"}},
        {"certify",
         "prove that the balanced state attracts nearby motions",
         add_certify,
         {"equipoise certify row.toml -o proof.json", "equipoise certify --check proof.json"}},
        {"reproduce",
         "recompute published tables and compare",
         add_reproduce,
         {"equipoise reproduce table-1", "equipoise reproduce all --starts 1000 --report paper.html"}}}}};
  return groups;
}

namespace {

constexpr std::size_t description_column = 30;  // where descriptions of options begin

// Options in the order in which help lists them. One that is not listed belongs to "Advanced".
struct OptionGroup {
  const char* title;
  std::vector<std::string_view> names;
};
const std::vector<OptionGroup>& option_groups() {
  static const std::vector<OptionGroup> groups{
      {"Options",
       {"over",  "zip",   "of",    "between", "by",   "at-least", "x",      "y",   "size",       "along", "at",
        "every", "until", "check", "best",    "cost", "law",      "starts", "set", "set-second", "output"}},
      {"Starts", {"seed", "half-width", "state", "start-index"}},
      {"Output", {"details", "report", "csv", "plot", "json", "wide", "help"}},
      {"Time and hardware", {"within", "threads", "cpu", "shard", "trajectories", "quiet"}},
      {"Advanced", {}}};
  return groups;
}

const CommandEntry* entry_of(const std::string& name) {
  for (const CommandGroup& group : command_groups())
    for (const CommandEntry& command : group.commands)
      if (command.name == name) return &command;
  return nullptr;
}

// "-o,--output FILE.nc", "STUDY"
std::string left_of(const CLI::Option& option) {
  std::string text = option.get_positional() ? option.get_type_name() : option.get_name(false, true);
  if (!option.get_positional() && option.get_type_size() != 0) text += " " + option.get_type_name();
  return text + (option.get_expected_max() >= CLI::detail::expected_max_vector_size ? " ..." : "");
}

std::string described(const CLI::Option& option) {
  const std::string left = "  " + left_of(option);
  const std::string blank(description_column, ' ');
  const bool apart = left.size() + 2 > description_column;
  return (apart ? left + "\n" : "") +
         filled(apart ? blank : left + blank.substr(left.size()), option.get_description(), TextStyle());
}

// "equipoise report STUDY -o FILE.html [options]"
std::string usage_of(const CLI::App& command) {
  std::string text = "Usage: equipoise " + command.get_name();
  for (const CLI::Option* option : command.get_options()) {
    const bool needed = option->get_required();
    if (option->get_positional())
      text += needed ? " " + left_of(*option) : " [" + left_of(*option) + "]";
    else if (needed)
      text += fmt::format(" -{} {}", option->get_snames().front(), option->get_type_name());
  }
  return text + " [options]\n";
}

std::string command_help(const CLI::App& command) {
  const CommandEntry& entry = *entry_of(command.get_name());
  std::string text = fmt::format("{}: {}\n\n{}", entry.name, entry.words, usage_of(command));
  std::vector<std::pair<std::string, std::vector<const CLI::Option*>>> groups{{"Arguments", {}}};
  for (const OptionGroup& group : option_groups()) {
    auto& [title, options] = groups.emplace_back(group.title, std::vector<const CLI::Option*>());
    for (const std::string_view name : group.names)
      if (const auto* option = command.get_option_no_throw("--" + std::string(name))) options.push_back(option);
  }
  for (const CLI::Option* option : command.get_options()) {
    const bool listed = std::any_of(groups.begin(), groups.end(), [&](const auto& group) {
      return std::find(group.second.begin(), group.second.end(), option) != group.second.end();
    });
    if (!listed) (option->get_positional() ? groups.front() : groups.back()).second.push_back(option);
  }
  for (const auto& [title, options] : groups) {
    if (options.empty()) continue;
    text += "\n" + title + ":\n";
    for (const CLI::Option* option : options) text += described(*option);
  }
  text += "\nExamples:\n";
  for (const char* example : entry.examples) text += fmt::format("  {}\n", example);
  return text;
}

}  // namespace

std::string program_help() {
  std::string text = fmt::format(
      "equipoise {}: will a ball balancer work on this rotor?\n\n"
      "Usage: equipoise COMMAND STUDY.toml [options]\n"
      "       equipoise help COMMAND\n"
      "       equipoise --version\n",
      version_string);
  for (const CommandGroup& group : command_groups()) {
    text += fmt::format("\n{}\n", group.title);
    for (const CommandEntry& command : group.commands)
      text += fmt::format("  {:<12} {}\n", command.name, command.words);
  }
  return text +
         "\nExample:\n  equipoise new fan -o fan.toml\n  equipoise basin fan.toml\n\n"
         "Results go to standard output, messages to standard error. Exit codes: 0 ok,\n"
         "1 failed, 2 bad input, 3 check failed, 4 out of time, 130 interrupted.\n";
}

void set_help(CLI::App& app) {
  app.formatter_fn([](const CLI::App* command, const std::string&, CLI::AppFormatMode) {
    return command->get_parent() ? command_help(*command) : program_help();
  });
}

}  // namespace equipoise::app
