// Attractors as functions of what differs: parts of a family, each with the rule that holds for all of its rotors.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/attractor_search/attractor_search.hpp"
#include "equipoise/attractors/motion.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/rotor_family/study_family.hpp"

namespace equipoise {

struct FamilyCell {
  FamilyBox box;
  model::System middle;
  AttractorSearch discovery;
  /// Identifiers of its attractors in the mesh's catalogue, by those that they have in its own.
  std::vector<int> ids;
  /// Starts that the horizon leaves open mostly come to something soon if they are followed on.
  bool follows_open = true;
  /// So much longer than to the horizon those are followed together then, before one is alone.
  static constexpr double further = motion_patience;

  int id(int own) const { return own > 0 ? ids[static_cast<std::size_t>(own)] : own; }
};

/// Cells fill the unit cube of a family's fractions. One is halved while that makes its starts known much sooner, or
/// leaves many fewer that come to something its list does not hold.
struct FamilyMesh {
  std::vector<FamilyCell> cells;
  Catalogue catalogue{true};
  bool stopped = false;

  /// For the search of a neighbouring family.
  WarmStartLevels warm_start_levels() const {
    return cells.empty() ? WarmStartLevels{} : cells.front().discovery.warm_start_levels;
  }
  /// The number of the cell there.
  std::size_t index(std::span<const double> fractions) const;
  /// The largest r of an attractor of `catalogue` as the family's rotor there has it, to a few percent; none where only
  /// that of another rotor is known.
  std::optional<double> largest_radius(const StudyFamily& family, int attractor,
                                       std::span<const double> fractions) const;
};

/// For what a mesh is made.
struct FamilyStarts {
  /// Of a study with uncertain values always as many, however many are decided by its mesh in the end.
  double count = 1e5;
  double rotors = count;  ///< where starts share one, what one comes to names what others do (FamilyStart::met)
};

/// As fine as pays for these starts. Depends on them, the family and settings.seeds alone.
FamilyMesh search_attractor_mesh(const StudyFamily& family, const FamilyStarts& starts,
                                 const AttractorSearchSettings& settings);

}  // namespace equipoise
