// The list of a study's attractors, which gives every motion its identifier and name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/types/attractor.hpp"

namespace equipoise {

/// A name without the number that distinguishes motions of one name: "locked (2)" becomes "locked", "locked (2
/// together)" stays.
std::string without_number(const std::string& name);

class Catalogue {
 public:
  Catalogue() = default;
  /// `by_name`: motions with one name are one, as where rotors differ.
  explicit Catalogue(bool by_name) : by_name_(by_name) {}

  const std::vector<Attractor>& attractors() const { return attractors_; }
  const Attractor* find(int id) const;
  /// The attractors that `earlier`, a former state of this list, lacked. The list is sorted by identifier, so new ones
  /// need not come last.
  std::vector<Attractor> listed_since(const Catalogue& earlier) const;
  /// Identifier of the same motion, 0 if it is not listed. All balanced states are one motion.
  int find(const model::Parameters& p, const Motion& motion) const;
  /// Lists a motion unless it is listed, and returns its identifier. A second motion of the same name gets a free
  /// identifier, and a number after its name.
  int add(const model::Parameters& p, const Motion& motion, const std::optional<ContinuumPart>& continuum = {});
  /// The same where rotors differ: all motions with one name are one.
  int add(const MotionName& name, const Motion& motion, const std::optional<ContinuumPart>& continuum = {});
  /// Lists an attractor under its own identifier, which must be free.
  void add(Attractor attractor);

 private:
  int free_id() const;

  std::vector<Attractor> attractors_;  // sorted by identifier
  bool by_name_ = false;
};

}  // namespace equipoise
