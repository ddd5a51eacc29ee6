// What a search depends on, as text; and how long it follows a trajectory.
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/classification/attractor_search/search.hpp"

namespace equipoise {

double followed_for(const model::System& system, bool few_starts) {
  if (few_starts && !system.smooth()) return 0.125 * motion_patience;
  return is_dear(system) ? 0.25 * motion_patience : motion_patience;
}

std::string attractor_search_subject(const Study& study) { return to_toml(at_final_speed(study)); }

std::string search_key(const std::string& subject, const AttractorSearchSettings& settings) {
  std::string key = fmt::format("{}\n{}\n{}", subject, settings.warm_start_states, settings.warm_start);
  if (settings.brief) key += "\nbrief";
  if (settings.few_starts) key += "\nfew starts";
  for (const WarmStartLevel& h : settings.warm_start_levels.levels)
    key += fmt::format("\n{} {} {}", h.attractor, h.torus, h.level);
  for (const ModeWeight& w : settings.warm_start_levels.weights) key += fmt::format("\n{} {} {}", w.re, w.im, w.weight);
  return key;
}

std::string search_key(const FamilyBox& part, const AttractorSearchSettings& settings) {
  return search_key(fmt::format("{}\n{} to {}", settings.family, part.low, part.high), settings);
}

}  // namespace equipoise
