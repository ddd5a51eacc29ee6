// Gives identifiers and names to a study's attractors.
#include "equipoise/attractors/motions/catalogue.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "equipoise/attractors/equilibria/equilibria.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

std::string without_number(const std::string& name) {
  const std::size_t at = name.rfind(" (");
  if (at == std::string::npos || !name.ends_with(')')) return name;
  return name.find_first_not_of("0123456789", at + 2) + 1 == name.size() ? name.substr(0, at) : name;
}

const Attractor* Catalogue::find(int id) const {
  const auto at = std::find_if(attractors_.begin(), attractors_.end(), [&](const Attractor& a) { return a.id == id; });
  return at == attractors_.end() ? nullptr : &*at;
}

std::vector<Attractor> Catalogue::listed_since(const Catalogue& earlier) const {
  std::vector<Attractor> added;
  std::copy_if(attractors_.begin(), attractors_.end(), std::back_inserter(added),
               [&](const Attractor& a) { return !earlier.find(a.id); });
  return added;
}

int Catalogue::find(const model::Parameters& p, const Motion& motion) const {
  const MotionName name = motion_name(p, motion);
  const auto is_it = [&](const Attractor& a) {
    if (name.id == balanced_id) return a.id == balanced_id;
    if (by_name_) return name.id ? a.id == name.id : a.name == name.name;
    return same_motion(p, a.motion, motion);
  };
  const auto at = std::find_if(attractors_.begin(), attractors_.end(), is_it);
  return at == attractors_.end() ? 0 : at->id;
}

int Catalogue::add(const model::Parameters& p, const Motion& motion, const std::optional<ContinuumPart>& continuum) {
  if (const int id = find(p, motion)) return id;
  MotionName name = motion_name(p, motion);
  const auto same_name = [&](const Attractor& a) { return without_number(a.name) == name.name; };
  const auto earlier = std::count_if(attractors_.begin(), attractors_.end(), same_name);
  if (earlier > 0) {
    name.name += fmt::format(" ({})", earlier + 1);
    name.alias.clear();  // the paper's name belongs to one motion
  }
  if (name.id == 0 || find(name.id)) name.id = free_id();
  const model::System system = system_of(p, motion);
  const bool partly = motion.kind == MotionKind::equilibrium && free_angles(system, motion.state) > 0;
  add({name.id, name.name, name.alias, motion,
       partly ? std::optional(partly_balanced_part(system, motion.state)) : continuum});
  return name.id;
}

int Catalogue::add(const MotionName& name, const Motion& motion, const std::optional<ContinuumPart>& continuum) {
  for (const Attractor& a : attractors_)
    if (name.id ? a.id == name.id : a.name == name.name) return a.id;
  const int id = name.id ? name.id : free_id();
  add({id, name.name, name.alias, motion, continuum});
  return id;
}

int Catalogue::free_id() const {
  int id = first_free_id;
  while (find(id)) ++id;
  return id;
}

void Catalogue::add(Attractor attractor) {
  attractors_.push_back(std::move(attractor));
  std::sort(attractors_.begin(), attractors_.end(), [](const Attractor& a, const Attractor& b) { return a.id < b.id; });
}

}  // namespace equipoise
