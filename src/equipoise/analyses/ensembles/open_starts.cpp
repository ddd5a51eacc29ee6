// The words of the note about open starts.
#include "equipoise/analyses/ensembles/open_starts.hpp"

#include <string>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"

namespace equipoise {

void note_chaos(BasinResult& result, const EscapeRate& chaos) {
  result.chaos = chaos;
  const double time = result.study.scales ? result.study.scales->time() : 1.0;
  const std::string unit = result.study.scales ? " s" : "";
  const char* per = result.study.scales ? "second" : "unit of time";
  const std::string rate =
      chaos.escapes == 0
          ? fmt::format("a rate below {:.2g} per {} and its median lifetime is above {:.2g}{}", chaos.high / time, per,
                        chaos.least * time, unit)
          : fmt::format(
                "a rate of {:.2g} ({:.2g} to {:.2g}) per {} and its median lifetime is {:.2g} ({:.2g} to {:.2g}){}",
                chaos.rate / time, chaos.low / time, chaos.high / time, per, chaos.median * time, chaos.least * time,
                chaos.most * time, unit);
  result.note += (result.note.empty() ? "" : "; ") +
                 fmt::format(
                     "long-lived chaos may end: of the {} starts that were in it, or on a slow approach, after {}, {} "
                     "came to something else later, so they leave it at {}",
                     chaos.trajectories, time_words(result.study, chaos.watched_from, 2), chaos.escapes, rate);
}

void note_open_starts(BasinResult& result, const Horizon& horizon, const LookAt& undecided, const LookAt& stalled) {
  const auto add = [&](const std::string& words) { result.note += (result.note.empty() ? "" : "; ") + words; };
  const double share = result.undecided.share;
  const bool many = result.starts > 0 && share > undecided_worth_a_word;
  const bool may_hold = result.study.speed.driven() && result.study.release.speed;
  const std::vector<UndecidedEnd> ends = many || may_hold ? undecided() : std::vector<UndecidedEnd>{};
  const std::string clamped = clamped_text(ends), clamped_stalled = may_hold ? clamped_text(stalled()) : "";
  if (many) add(fmt::format("{} are undecided: {}", percent_text(share), why_undecided(result.study, horizon, ends)));
  if (!many && !clamped.empty()) add(fmt::format("balls of undecided starts are never released: {}", clamped));
  if (!clamped_stalled.empty()) add(fmt::format("balls of stalled starts are never released: {}", clamped_stalled));
}

}  // namespace equipoise
