// equipoise new: a study to begin with, commented, for a kind of machine.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/base/display_text.hpp"
#include "equipoise/base/embedded.hpp"
#include "equipoise/base/nearest_name.hpp"
#include "options.hpp"
#include "streams.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::embedded {
extern const Archive new_studies;
}

namespace equipoise::app {

namespace {

struct NewArguments {
  std::string machine;
  std::optional<std::string> output;
};

std::vector<std::string> new_machines() {
  const embedded::Archive& all = embedded::new_studies;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.count; ++i) names.emplace_back(all.files[i].name);
  return names;
}

int run_new(const NewArguments& a) {
  const std::string_view text = embedded::new_studies.find(a.machine);
  const std::vector<std::string> names = new_machines();
  if (text.empty())
    throw InputError("MACHINE", "", display_text(a.machine),
                     fmt::format(words::one_of_machines, did_you_mean(a.machine, names), fmt::join(names, ", ")));
  if (!a.output) {
    put(std::string(text));
    return done;
  }
  std::error_code ignored;
  if (std::filesystem::exists(*a.output, ignored))
    throw InputError("-o", "", display_text(*a.output), words::study_exists);
  require_writable("-o", *a.output);
  write_file(*a.output, std::string(text));
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
