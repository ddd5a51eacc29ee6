// Attractors over a family: the family in parts, each with a rule that holds for all of its rotors.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/rotor_family/study_family.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

struct FamilyCell {
  FamilyBox box;
  AttractorSearch search;
  /// Identifiers in the mesh's catalogue, by those in its own; empty if they are the same.
  std::vector<int> ids;
  /// Starts left open by the horizon mostly end in a motion soon if followed on.
  bool follows_open = true;
  /// They are then followed together for this long beyond the horizon, before each goes on by itself.
  static constexpr double further = motion_patience;

  int id(int own) const { return own > 0 && !ids.empty() ? ids[static_cast<std::size_t>(own)] : own; }
};

/// Cells fill the unit cube of a family's fractions. A cell is halved if its starts are then decided much sooner, or if
/// many fewer come to motions that its list lacks.
struct FamilyMesh {
  std::vector<FamilyCell> cells;
  Catalogue catalogue{true};
  bool stopped = false;

  /// For a neighbouring family's search.
  WarmStartLevels warm_start_levels() const {
    return cells.empty() ? WarmStartLevels{} : cells.front().search.warm_start_levels;
  }
  /// The index of the cell that holds these fractions.
  std::size_t index(std::span<const double> fractions) const;
};

/// The starts that a mesh is made for.
struct FamilyStarts {
  /// With uncertain values the same number always, however many starts the mesh decides in the end.
  double count = 1e5;
  double rotors = count;  ///< distinct ones: starts with one rotor share the motions met (FamilyStart::met)
};

/// Makes a mesh as fine as pays for these starts. Depends on them, the family and settings.warm_start_states alone.
FamilyMesh search_attractor_mesh(const StudyFamily& family, const FamilyStarts& starts,
                                 const AttractorSearchSettings& settings);

}  // namespace equipoise
