// equipoise certify: proves that trajectories close to balance end balanced, and checks such proofs.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/core/base/read_file.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct CertifyArguments : CommonArguments {
  std::string check;
};

// Certificates take some kilobytes.
constexpr std::size_t longest_certificates = std::size_t{64} << 20;

std::string read_certificates(const std::string& path) {
  auto [text, problem] = read_file(path, longest_certificates);
  if (!problem.empty())
    throw InputError("--check", "", display_text(path),
                     fmt::format("cannot be read ({}); must be a file written by equipoise certify -o", problem));
  return std::move(text);
}

int check_file(const std::string& path, bool as_json) {
  const CertificateFile checked = checked_certificates(read_certificates(path), display_text(path), &stop_flag());
  put(as_json ? json_text(checked) : check_text(checked, text_style()));
  return stop_flag() ? ended_early({}, nullptr, "") : checked.proved() ? done : check_failed;
}

void write_certificates(const std::string& path, const CertifyResult& result) {
  const std::string text = certificates_json(result);
  if (text.empty())
    say("nothing is proved, so {} is not written", display_text(path));
  else
    write_file(path, text);
}

int run_certify(const CertifyArguments& a) {
  if (a.check.empty() == a.study.empty())
    throw InputError("certify", "", "", "give either a study or --check with a certificate's file");
  if (!a.check.empty()) {
    if (!a.overrides.empty() || !a.output.empty())
      throw InputError("--check", "", a.check, "a certificate is checked as it is: --set and -o need a study");
    begin_time(a.within);
    return check_file(a.check, a.json);
  }
  RunOptions options;
  begin_computing(a, options);
  require_writable("--output", a.output);
  ProgressLine progress(a.quiet, options);
  const CertifyResult result = certify(at_medians(read_study(a.study, a.overrides)), options);
  progress.finish();
  put(a.json ? json_text(result) : certify_text(result, text_style()));
  if (!a.output.empty()) write_certificates(a.output, result);
  return result.partial ? ended_early(progress.left(), nullptr, "") : result.proved() ? done : check_failed;
}

}  // namespace

Command add_certify(CLI::App& app) {
  const auto a = std::make_shared<CertifyArguments>();
  add_study(app, *a)->required(false);
  app.add_option("--check", a->check, "verify a certificate file from its own data, without a study")
      ->type_name("FILE.json");
  add_overrides(app, a->overrides);
  app.add_option("-o,--output", a->output, "write the certificates here")->type_name("FILE.json");
  add_json(app, a->json);
  add_wide(app);
  add_within(app, a->within);
  add_quiet(app, a->quiet);
  return [a] { return run_certify(*a); };
}

}  // namespace equipoise::app
