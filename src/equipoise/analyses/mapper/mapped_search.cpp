// A mapper's attractor search for an ensemble of the same rotor: two studies' searches are compared key by key.
#include "equipoise/analyses/mapper/mapper.hpp"

#include <fmt/format.h>

#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

AttractorSearchCache mapped_search(const Mapper& mapper, const Study& study, const std::string& target) {
  const auto reject = [&](const std::string& problem) {
    throw InputError("attractors", "", display_text(mapper.study().name), problem);
  };
  if (!study.uncertain.empty())
    reject("was made for one rotor, and this study draws a rotor for every start; must be left out");
  if (study.system().coasts()) reject("starts of a coasting rotor are followed without a search; must be left out");
  const std::string there = attractor_search_subject(mapper.study()), here = attractor_search_subject(study);
  if (there != here)
    reject(fmt::format("of another search: {}; must be a mapper of the same rotor, final speed and [numerics]",
                       io::difference(there, here)));
  if (mapper.target() != target)
    reject(fmt::format("searched with {}, and starts are followed with {}; must be the same cpu", mapper.target(),
                       target));
  return mapper.search();
}

}  // namespace equipoise
