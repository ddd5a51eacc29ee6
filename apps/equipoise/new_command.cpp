// equipoise new: a study to begin with, commented, for a kind of machine.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/explain/new_studies.hpp"
#include "options.hpp"
#include "streams.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

struct NewArguments {
  std::string machine;
  std::optional<std::string> output;
};

int run_new(const NewArguments& a) {
  const std::string text = new_study(a.machine, "MACHINE");
  if (!a.output) {
    put(text);
    return done;
  }
  std::error_code ignored;
  if (std::filesystem::exists(*a.output, ignored))
    throw InputError("-o", "", display_text(*a.output), words::study_exists);
  require_writable("-o", *a.output);
  write_file(*a.output, text);
  say(words::study_written, display_text(*a.output), a.machine == "blank" ? "machine" : a.machine,
      display_text(*a.output));
  return done;
}

}  // namespace

Command add_new(CLI::App& app) {
  const auto a = std::make_shared<NewArguments>();
  app.add_option("machine", a->machine, fmt::format(help::new_study::machine, fmt::join(new_machines(), ", ")))
      ->required()
      ->type_name("MACHINE");
  app.add_option("-o,--output", a->output, help::new_study::output)->type_name("FILE.toml");
  return [a] { return run_new(*a); };
}

}  // namespace equipoise::app
