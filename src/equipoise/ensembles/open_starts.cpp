// The words of the note about open starts.
#include "equipoise/ensembles/open_starts.hpp"

#include <string>

#include <fmt/format.h>

#include "equipoise/base/percent_text.hpp"
#include "equipoise/words/runs.hpp"

namespace equipoise {

void note_open_starts(BasinResult& result, const Horizon& horizon, const LookAt& undecided, const LookAt& stalled) {
  const auto add = [&](const std::string& words) { result.note += (result.note.empty() ? "" : "; ") + words; };
  const double share = result.undecided.share;
  const bool many = result.starts > 0 && share > undecided_worth_a_word;
  const bool may_hold = result.study.speed.driven() && result.study.release.speed;
  const std::vector<UndecidedEnd> ends = many || may_hold ? undecided() : std::vector<UndecidedEnd>{};
  const std::string held = held_text(ends), held_stalled = may_hold ? held_text(stalled()) : "";
  if (many)
    add(fmt::format(words::runs::many_undecided, percent_text(share), why_undecided(result.study, horizon, ends)));
  if (!many && !held.empty()) add(fmt::format(words::runs::undecided_held, held));
  if (!held_stalled.empty()) add(fmt::format(words::runs::stalled_held, held_stalled));
}

}  // namespace equipoise
