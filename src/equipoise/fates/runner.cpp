// Which runner follows a study's starts; how an unlisted one is named.
#include "equipoise/fates/checks.hpp"
#include "equipoise/fates/runner.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/fates/start_runner.hpp"

namespace equipoise {

namespace {

std::string words(const Uncertainty& uncertain, const std::vector<double>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k)
    text += fmt::format("{}{} = {}", k ? ", " : "", uncertain.values[k].key, uncertain.values[k].text(values[k]));
  return text;
}

void check_corner(const Study& study, const std::vector<double>& values, bool transients) {
  const std::string with = "; with " + words(study.uncertain, values);
  try {
    check_runnable(drawn_study(study, values), transients);
  } catch (const InputError& e) {
    throw InputError(e.place(), e.key(), e.value(), e.problem() + with);
  }
}

// Throws InputError for a study with uncertain values whose starts cannot be decided, at its medians or where all
// values are at one of their ends.
void check_drawable(const Study& study, bool transients) {
  check(study);
  if (study.numerics.decide != DecideMode::validated)
    throw InputError(
        study.name, "numerics.decide", decide_mode_names[static_cast<std::size_t>(study.numerics.decide)],
        "with uncertain values every start is followed to a motion of its own rotor; must be \"validated\"");
  check_runnable(with_medians(study), transients);
  const std::vector<UncertainValue>& uncertain = study.uncertain.values;
  if (uncertain.size() > most_tried_together) return;  // the reader has tried each end by itself
  for (std::size_t corner = 0; corner < std::size_t{1} << uncertain.size(); ++corner) {
    std::vector<double> values;
    for (std::size_t k = 0; k < uncertain.size(); ++k) values.push_back(uncertain[k].ends()[(corner >> k) & 1]);
    check_corner(study, values, transients);
  }
}

}  // namespace

bool Runner::run_from(std::span<const InitialState>, std::vector<Fate>&, std::vector<UnlistedStart>&,
                      std::vector<TransientRow>*) const {
  throw std::logic_error("starts that draw their rotors are known by their numbers alone");
}

int settle(Runner& runner, const UnlistedStart& start, Fate& fate) {
  const int attractor = runner.list(start);
  fate.attractor = static_cast<short>(attractor);
  if (attractor == 0) {
    fate.outcome = Outcome::undecided;
    fate.by = DecidedBy::nothing;
  }
  return attractor;
}

void check_runnable(const Study& study, bool transients) {
  if (!study.uncertain.empty()) return check_drawable(study, transients);
  check_decidable(study);
  if (transients && !study.speed.driven()) check_watchable(study);
}

std::unique_ptr<Runner> make_runner(const Study& study, const DiscoverySettings& settings, bool transients) {
  return std::make_unique<StartRunner>(study, settings, transients);
}

}  // namespace equipoise
