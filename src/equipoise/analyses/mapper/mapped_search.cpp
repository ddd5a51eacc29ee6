// Compares two studies' searches key by key.
#include "equipoise/analyses/mapper/mapped_search.hpp"

#include <fmt/format.h>

#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/simulation/words/runs.hpp"

namespace equipoise {

AttractorSearchCache mapped_search(const Mapper& mapper, const Study& study, const std::string& target) {
  const auto reject = [&](const std::string& problem) {
    throw InputError("attractors", "", display_text(mapper.study().name), problem);
  };
  if (!study.uncertain.empty()) reject(words::runs::map_of_one_rotor);
  if (study.system().coasts()) reject(words::runs::map_not_searched);
  const std::string there = attractor_search_subject(mapper.study()), here = attractor_search_subject(study);
  if (there != here) reject(fmt::format(words::runs::map_of_another_search, io::difference(there, here)));
  if (mapper.target() != target) reject(fmt::format(words::runs::map_of_another_cpu, mapper.target(), target));
  return mapper.search();
}

}  // namespace equipoise
