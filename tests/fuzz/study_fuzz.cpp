// Fuzz target of the study reader: any bytes are either a study or an InputError with a one-line message.
//
// The input is TOML text; each line "#--set key=value" in it (a comment in TOML) is applied as an override. An accepted
// study must survive the round trip through to_toml(). Anything else is a finding: another exception, a sanitizer's
// report, or one of the aborts below.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/study.hpp"
#include "../support/study_difference.hpp"

namespace {

constexpr std::string_view override_mark = "#--set ";
constexpr std::size_t most_overrides = 8;

void require(bool holds, const char* property, const std::string& about) {
  if (holds) return;
  std::fprintf(stderr, "finding: %s\n%s\n", property, about.c_str());
  std::abort();
}

std::vector<std::string> overrides_in(std::string_view text) {
  std::vector<std::string> result;
  for (std::size_t begin = 0; begin < text.size() && result.size() < most_overrides;) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (line.starts_with(override_mark)) result.emplace_back(line.substr(override_mark.size()));
    begin = end + 1;
  }
  return result;
}

void check_message(const equipoise::InputError& error) {
  const std::string what = error.what();
  for (const char c : what) require(!std::iscntrl(static_cast<unsigned char>(c)), "a message is one line", what);
  require(!error.where().empty() && !error.problem().empty(), "a message names place and problem", what);
  require(what.ends_with(error.problem()), "a message is complete", what);
  require(what.size() < 2000, "a message is short", what);
}

void check_study(const equipoise::Study& study) {
  const std::string echo = equipoise::to_toml(study);
  const double release = study.release_time();
  const bool by_speed = study.speed.driven() && study.release.speed;  // a driven rotor reaches it at an unknown time
  require((std::isfinite(release) || by_speed) && release >= 0.0, "the release has a time", echo);
  const auto profile = study.speed_profile();
  require(profile.times.front() == 0.0 && profile.times.size() == profile.speeds.size(), "a profile is complete", echo);
  for (std::size_t i = 1; i < profile.times.size(); ++i)
    require(profile.times[i] > profile.times[i - 1], "a profile runs forward", echo);
  try {
    const equipoise::Study back = equipoise::parse_study(echo, "echo");
    const std::string difference = equipoise::first_difference(study, back);
    require(difference.empty(), "an echo reads back to the study", difference + " differs from\n" + echo);
    require(equipoise::to_toml(back) == echo, "an echo reads back to itself", echo);
  } catch (const equipoise::InputError& error) {
    require(false, error.what(), echo);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    check_study(equipoise::parse_study(text, "input", overrides_in(text)));
  } catch (const equipoise::InputError& error) {
    check_message(error);
  }
  return 0;
}
